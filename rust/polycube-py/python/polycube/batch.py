"""Many shapes: each meshed in a process of its own, within a cap of memory and time, to a row of a table.

A row is kept beside the meshes of its shape, so that a call that is stopped goes on where it was, and machines that
share a folder can share the work.
"""

from __future__ import annotations

import csv
import hashlib
import importlib
import json
import os
import queue
import signal
import subprocess
import sys
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from pathlib import Path
from typing import Any, Protocol, TypedDict

from ._native import __version__
from .errors import InvalidOption

_Path = str | os.PathLike[str]
_Given = _Path | tuple[_Path, _Path]

COLUMNS: dict[str, type] = {
    "shape": str,
    "polycube": str,
    "status": str,
    "kind": str,
    "message": str,
    "good": bool,
    "quads": int,
    "hexes": int,
    "blocks_before": int,
    "blocks_after": int,
    "min_sj": float,
    "avg_sj": float,
    "inverted": int,
    "hausdorff_percent": float,
    "seconds": float,
    "version": str,
    "options": str,
    "sha256": str,
}
"""The columns of the table and what they hold."""

Row = dict[str, Any]
"""What became of a shape: a value for each of `COLUMNS`, None where there is none."""


class Future(Protocol):
    """What `concurrent.futures` and Dask call a future."""

    def result(self) -> Any: ...
    def add_done_callback(self, fn: Any, /) -> Any: ...


class Client(Protocol):
    """What runs functions elsewhere: a `dask.distributed.Client` or a `concurrent.futures.Executor`."""

    def submit(self, fn: Any, /, *args: Any) -> Any: ...


class Job(TypedDict):
    """What a process is told."""

    shape: str
    polycube: str | None
    folder: str
    threads: int
    max_memory: float | None
    timeout: float | None
    options: dict[str, Any]


def batch(
    paths: Iterable[_Given],
    folder: _Path,
    *,
    table: str = "results.csv",
    workers: int | None = None,
    threads: int = 1,
    max_memory: float | None = None,
    timeout: float | None = None,
    client: Client | None = None,
    part: tuple[int, int] = (0, 1),
    retry: bool = False,
    **options: Any,
) -> list[Row]:
    """Meshes many shapes, each in a process of its own, and returns a row for each, in the order of `paths`.

    What fails or is killed gets a row, too, and nothing else ends with it. Of each shape `NAME.EXT` the folder `NAME` in
    `folder` gets `hexes.vtu`, `quads.obj` and `row.json`. A shape whose row is there, of the same file, version and
    options, is not meshed again: call `batch` again to go on after a stop.

    A row has `shape` and `polycube` (the files), `status` ("done", "failed" or "killed"), `kind` (of the error, or
    "time", "memory" or "process" where killed), `message` (what went wrong, or notes), `good` (as in `Remeshed`),
    `quads`, `hexes`, `blocks_before` and `blocks_after` (padded), `min_sj`, `avg_sj`, `inverted`,
    `hausdorff_percent`, `seconds`, and what it holds for: `version`, `options` (JSON) and `sha256` (of the files).

    Args:
        paths: files of shapes as `remesh` takes them; or pairs, SHAPE FIRST, then its polycube.
        folder: where the results go; made if it is not there.
        table: the file in `folder` with all rows, written at the end: `.csv`, or `.parquet` (needs pyarrow).
        workers: how many shapes at a time; by default as many as there are processors for `threads` each.
        threads: of each process.
        max_memory: the most address space that a process may take, in GiB. No limit by default. (Linux, macOS)
        timeout: seconds after which a process is killed. No limit by default.
        client: what runs the processes instead of this machine: a `dask.distributed.Client` (or an `Executor`), whose
            workers see the same files; `workers` then has no effect.
        part: `(i, n)` takes every n-th shape from the i-th on, from 0: for n machines, or the tasks of an array of
            Slurm. The table then has the rows of this part; a last call without it makes that of all.
        retry: mesh again what failed or was killed before.
        **options: those of `remesh`, the same for all shapes, as numbers, words, lists and dictionaries.

    Raises:
        InvalidOption: two shapes have one name, an option cannot be written as JSON, or a number is out of its range.
            (What `remesh` does not take is told by the rows.)
        ImportError: the table is Parquet, and pyarrow is not installed (`pip install pyarrow`).
    """
    _check(threads, max_memory, timeout, part)
    if table.endswith(".parquet"):
        _pyarrow()
    limits = {"threads": threads, "max_memory": max_memory, "timeout": timeout, "options": options}
    jobs = [_job(given, Path(folder), limits) for given in paths]
    _check_names(jobs)
    jobs = jobs[part[0] :: part[1]]
    rows = {job["folder"]: row for job in jobs if (row := _kept(job, retry)) is not None}
    left = [job for job in jobs if job["folder"] not in rows]
    pool = ThreadPoolExecutor(workers or max(1, (os.cpu_count() or 1) // threads)) if client is None else None
    with pool or nullcontext():
        rows |= _run(left, pool or client)
    ordered = [rows[job["folder"]] for job in jobs]
    _write_table(Path(folder) / _part_name(table, part), ordered)
    return ordered


def _check(threads: int, max_memory: float | None, timeout: float | None, part: tuple[int, int]) -> None:
    for name, value in (("threads", threads), ("max_memory", max_memory), ("timeout", timeout)):
        if value is not None and not value > 0:
            raise _invalid(f"{name} is {value}", "give a number above 0")
    if not 0 <= part[0] < part[1]:
        raise _invalid(f"part is {part}", "give (i, n) with i from 0 to n - 1")


def _job(given: _Given, folder: Path, limits: dict[str, Any]) -> Job:
    shape, polycube = given if isinstance(given, tuple) else (given, None)
    job = {"shape": os.fspath(shape), "polycube": None if polycube is None else os.fspath(polycube)}
    job |= {"folder": str(folder / Path(shape).stem), **limits}
    try:
        json.dumps(job)
    except TypeError as error:
        raise _invalid(f"options: {error}", "give numbers, words, lists and dictionaries") from None
    return job  # type: ignore[return-value]


def _check_names(jobs: Sequence[Job]) -> None:
    first: dict[str, Job] = {}
    for job in jobs:
        other = first.setdefault(job["folder"], job)
        if other is not job:
            raise _invalid(f"{other['shape']} and {job['shape']} have one name", "give each shape a name of its own")


def _kept(job: Job, retry: bool) -> Row | None:
    """The row of an earlier call, unless it is to be made again."""
    try:
        row: Row = json.loads((Path(job["folder"]) / "row.json").read_text())
    except (OSError, ValueError):
        return None
    same = all(row.get(name) == value for name, value in _said(job).items())
    return row if same and (row["status"] == "done" or not retry) else None


def _said(job: Job) -> Row:
    """What a row says of its job."""
    options, files = json.dumps(job["options"], sort_keys=True), [job["shape"], job["polycube"]]
    return dict(zip(("shape", "polycube"), files)) | {
        "version": __version__,
        "options": options,
        "sha256": " ".join(_digest(Path(file)) for file in files if file),
    }


def _digest(file: Path) -> str:
    """What is in a file, as a number; nothing for one that is not there."""
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def _run(jobs: Sequence[Job], client: Any) -> dict[str, Row]:
    """The rows by folder. Those of jobs that have not begun when one raises, as at Ctrl-C, are not made."""
    done: queue.SimpleQueue[Future] = queue.SimpleQueue()
    futures = [client.submit(run_one, job) for job in jobs]
    try:
        for future in futures:
            future.add_done_callback(done.put)
        return dict(done.get().result() for _ in futures)
    except BaseException:
        for future in futures:
            future.cancel()
        raise


def run_one(job: Job) -> tuple[str, Row]:
    """Meshes a shape in a process of its own; its folder and its row, which is kept there."""
    folder = Path(job["folder"])
    folder.mkdir(parents=True, exist_ok=True)
    row = dict.fromkeys(COLUMNS) | _said(job) | _outcome(job)
    whole = folder / "row.json.part"
    whole.write_text(json.dumps(row, indent=1))
    whole.replace(folder / "row.json")
    return job["folder"], row


def _outcome(job: Job) -> Row:
    command = [sys.executable, "-P", "-m", "polycube._one"]
    threads = str(job["threads"])
    own = {"RAYON_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads}
    try:
        ended = subprocess.run(
            command, input=json.dumps(job), capture_output=True, text=True, timeout=job["timeout"], env=os.environ | own
        )
    except subprocess.TimeoutExpired:
        return _killed("time", f"not done after {job['timeout']} s")
    if ended.returncode == -signal.SIGINT:
        raise KeyboardInterrupt
    if ended.returncode == 0:
        return json.loads(ended.stdout)  # type: ignore[no-any-return]
    return _crashed(ended.returncode, ended.stderr.splitlines())


def _crashed(status: int, said: Sequence[str]) -> Row:
    out_of_memory = [line for line in said if line.startswith(("memory allocation", "MemoryError"))]
    last = ["nothing was said", *said, *out_of_memory][-1]
    return _killed("memory" if out_of_memory else "process", f"the process ended with status {status}: {last}")


def _killed(kind: str, message: str) -> Row:
    return {"status": "killed", "kind": kind, "message": message}


def _part_name(table: str, part: tuple[int, int]) -> str:
    path = Path(table)
    return table if part[1] == 1 else f"{path.stem}-{part[0]}-of-{part[1]}{path.suffix}"


def _write_table(path: Path, rows: Sequence[Row]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    whole = path.with_name(path.name + ".part")
    if path.suffix == ".parquet":
        _write_parquet(whole, rows)
    else:
        with whole.open("w", newline="") as file:
            writer = csv.DictWriter(file, list(COLUMNS))
            writer.writeheader()
            writer.writerows(rows)
    whole.replace(path)


def _write_parquet(path: Path, rows: Sequence[Row]) -> None:
    arrow, parquet = _pyarrow()
    types = {str: arrow.string(), bool: arrow.bool_(), int: arrow.int64(), float: arrow.float64()}
    schema = arrow.schema([(name, types[kind]) for name, kind in COLUMNS.items()])
    parquet.write_table(arrow.Table.from_pylist(list(rows), schema), path)


def _pyarrow() -> tuple[Any, Any]:
    try:
        return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    except ImportError as error:
        raise ImportError("pyarrow is not installed (pip install pyarrow)", name="pyarrow") from error


def _invalid(message: str, remedy: str) -> InvalidOption:
    return InvalidOption(f"{message} ({remedy})", "option", message, remedy=remedy)
