"""Measures a release build and prints a table of ratios; `bench/run` builds it and calls this.

    python bench/ratios.py target/release [--quick]

A ratio is measured over allowed: up to 1 is within the target. For SCIP it is its time over ours: above 1 we are faster.
Exits with 1 if a target is missed or a cost differs from SCIP's.
"""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUNNY = "marco2016sgp-bunny"
VARIABLES = [10, 20, 40]


class Table:
    """Rows of what was measured, against what is allowed."""

    def __init__(self):
        self.missed = 0
        print("`to counts` is structure, check, alignment and counts together; its size is the number of corners")
        print(f"{'what':46} {'size':>8} {'measured':>12} {'allowed':>10} {'ratio':>7}")

    def row(self, what, size, measured, allowed, unit="ms"):
        ratio = measured / allowed
        self.missed += ratio > 1
        mark = "" if ratio <= 1 else "  MISSED"
        print(f"{what:46} {size:>8} {measured:>9.2f} {unit:2} {allowed:>7.0f} {unit:2} {ratio:>7.2f}{mark}", flush=True)

    def note(self, text):
        print(text, flush=True)


def timings(release, mode, *arguments):
    """What the example prints, one object for each line."""
    command = [release / "examples" / "timings", mode, *map(str, arguments)]
    return [json.loads(line) for line in subprocess.check_output(command).splitlines()]


def data_folder():
    folder = Path(os.environ.get("POLYCUBE_DATA", ROOT.parent / "shared" / "data"))
    return folder if (folder / "reference.json").is_file() else None


def allowed(corners):
    """5 ms up to 60 corners, 50 ms for 230, in between in proportion."""
    return max(5.0, 5.0 + (corners - 60) * 45.0 / 170.0)


def models(table, release, folder):
    for line in timings(release, "models", *sorted(folder.glob("*.polycube.obj"))):
        name = Path(line["file"]).name.removesuffix(".polycube.obj")
        parts = f"structure {line['structure']:.1f}, check {line['check']:.1f}, align {line['align']:.1f}"
        table.row(f"to counts: {name}", line["corners"], line["total"], allowed(line["corners"]))
        table.note(f"    {parts}; padded blocks {line['before']['blocks_padded']} to {line['after']['blocks_padded']}")


def growth(table, release, quick):
    sizes = [100, 1000] if quick else [100, 1000, 10_000]
    lines = timings(release, "growth", *sizes)
    for line in lines:
        table.row("to counts: generated", line["corners"], line["total"], 0.2 * line["corners"])
    for small, large in zip(lines, lines[1:]):
        factor = large["total"] / small["total"]
        corners = large["corners"] / small["corners"]
        table.note(f"    {corners:.1f} times the corners take {factor:.1f} times as long: x^{exponent(corners, factor):.2f}")


def exponent(corners, factor):
    from math import log

    return log(factor) / log(corners)


def solvers(table, release):
    """The exact solver and SCIP on random problems as large as those of one axis."""
    if importlib.util.find_spec("pyscipopt") is None:
        return table.note("SCIP: pyscipopt is not installed")
    sys.path.insert(0, str(ROOT / "bench"))
    from solvers import scip, write_random

    for variables in VARIABLES:
        ours = theirs = 0.0
        for file in write_random(5, variables, 0, 1):
            solved = subprocess.check_output([release / "examples" / "solve_problem", "--exact-only", str(file)])
            exact = json.loads(solved)["exact"]
            cost, seconds, _ = scip(json.loads(file.read_text()), 60.0)[:3]
            ours, theirs = ours + exact["seconds"] * 1e3, theirs + seconds * 1e3
            if abs(cost - exact["cost"]) > 1e-6 * max(1.0, cost):
                table.missed += 1
                table.note(f"    {file}: SCIP finds {cost}, the exact solver {exact['cost']}")
        table.note(f"{'SCIP over the exact solver, 5 problems':46} {variables:>8} {theirs:>9.2f} ms {ours:>7.2f} ms {theirs / ours:>7.0f}")


def best_of(runs, work):
    """The shortest time that `work` takes, in milliseconds."""
    best = float("inf")
    for _ in range(runs):
        start = time.perf_counter()
        work()
        best = min(best, 1e3 * (time.perf_counter() - start))
    return best


def command(table, release, folder):
    """The whole command, against reading and writing both files."""
    files = [folder / f"{BUNNY}.{kind}.obj" for kind in ("polycube", "shape")]
    with tempfile.TemporaryDirectory() as out:
        lines = [timings(release, "copy", file, out)[0] for file in files]
        copies = sum(line["read"] + line["write"] for line in lines)
        call = [release / "polycube", "simplify", files[0], "--shape", files[1], "-o", Path(out) / "result", "--quiet"]
        if not call[0].is_file():
            return table.note("the command: not built")
        for strategy, allowed in (("paper", 4 * copies), ("best", 500.0)):
            whole = [*call, "--strategy", strategy]
            spent = best_of(5, lambda: subprocess.run(whole, capture_output=True, check=True))
            table.row(f"polycube simplify --strategy {strategy}, bunny", 18_496, spent, allowed)
    table.note(f"    reading and writing both files takes {copies:.1f} ms")


def bridge(table, release, folder):
    """What calling from C++ adds, against a twentieth of what the core takes."""
    program = release.parent / "cpp" / "bench" / "bench" / "bridge"
    if not program.is_file():
        return table.note("the bridge to C++: not built")
    files = [folder / f"{BUNNY}.{kind}.obj" for kind in ("polycube", "shape")]
    line = json.loads(subprocess.check_output([program, *files]))
    table.row("the bridge to C++, bunny", 18_496, 1e3 * line["added"], 1e3 * line["core"] / 20.0)


def morph(table, release, folder):
    line = timings(release, "morph", folder / f"{BUNNY}.polycube.mesh")[0]
    table.row("morph of tetrahedra", line["cells"], line["morph"], 2000.0)
    table.row("    most memory, reading and structure included", line["cells"], line["peak_mb"], 1024.0, "MB")


def main():
    release, quick = Path(sys.argv[1]).resolve(), "--quick" in sys.argv
    table, folder = Table(), data_folder()
    if folder is None:
        table.note("skipped: no data")
    else:
        models(table, release, folder)
        command(table, release, folder)
        bridge(table, release, folder)
        morph(table, release, folder)
    growth(table, release, quick)
    if not quick:
        solvers(table, release)
    print(f"{table.missed} targets missed")
    return 1 if table.missed else 0


if __name__ == "__main__":
    sys.exit(main())
