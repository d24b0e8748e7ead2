"""`batch`: a row for each shape, whatever becomes of it, and going on after a stop."""

import csv
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_QUADS

import polycube

COUNT = 12
TIMEOUT = 10
OPTIONS = {"edge_length": 0.5, "max_hausdorff": 5}


def box(folder, i: int, size: float = 1):
    """A box of its own size."""
    path = folder / f"box-{i:02}.obj"
    polycube.Mesh(size * CUBE_POINTS * [1, 1 + i / 8, 2], CUBE_QUADS, "quads").write(path)
    return path


def endless(folder, i: int):
    """A box that takes nearly a million hexahedra."""
    return box(folder, i, size=37 / (1 + i / 8) ** (1 / 3))


@pytest.fixture(scope="module")
def shapes(tmp_path_factory):
    """Twelve shapes: boxes, of which one is open and one endless."""
    folder = tmp_path_factory.mktemp("shapes")
    paths = [box(folder, i) for i in range(COUNT)]
    polycube.Mesh(CUBE_POINTS, CUBE_QUADS[1:], "quads").write(paths[3])
    endless(folder, 5)
    return paths


@pytest.fixture(scope="module")
def made(shapes, tmp_path_factory):
    folder = tmp_path_factory.mktemp("made")
    return folder, polycube.batch(shapes, folder, timeout=TIMEOUT, workers=2, **OPTIONS)


def test_every_shape_has_a_row(shapes, made):
    folder, rows = made
    assert [row["shape"] for row in rows] == [str(path) for path in shapes]
    wanted = ["done"] * COUNT
    wanted[3], wanted[5] = "failed", "killed"
    assert [row["status"] for row in rows] == wanted
    assert (rows[3]["kind"], rows[5]["kind"]) == ("mesh", "time")
    assert "edge" in rows[3]["message"] and f"{TIMEOUT} s" in rows[5]["message"]
    with (folder / "results.csv").open(newline="") as file:
        table = list(csv.DictReader(file))
    assert [row["shape"] for row in table] == [str(path) for path in shapes]
    assert [row["hexes"] for row in table] == ["" if row["hexes"] is None else str(row["hexes"]) for row in rows]


def test_the_meshes_are_those_of_remesh(shapes, made, tmp_path):
    folder, rows = made
    meshes = polycube.remesh(polycube.read(shapes[7]), **OPTIONS)
    meshes.hexes.write(tmp_path / "hexes.vtu")
    assert (folder / "box-07" / "hexes.vtu").read_bytes() == (tmp_path / "hexes.vtu").read_bytes()
    assert rows[7]["hexes"] == len(meshes.hexes)
    assert rows[7]["min_sj"] == meshes.report["min_sj"]
    assert rows[7]["good"] is True


def test_it_goes_on_where_it_was(shapes, made):
    folder, rows = made
    (folder / "box-01" / "row.json").unlink()
    (folder / "box-02" / "row.json").write_text("{ half a row")
    kept = {i: (folder / f"box-{i:02}" / "quads.obj").stat().st_mtime_ns for i in (1, 2, 4)}
    again = polycube.batch(shapes, folder, timeout=TIMEOUT, **OPTIONS)
    strip = lambda rows: [{k: v for k, v in row.items() if k != "seconds"} for row in rows]  # noqa: E731
    assert strip(again) == strip(rows)
    now = {i: (folder / f"box-{i:02}" / "quads.obj").stat().st_mtime_ns for i in kept}
    assert [now[i] > kept[i] for i in kept] == [True, True, False]


def test_what_failed_is_tried_again_where_that_is_wanted(tmp_path):
    path, row = tmp_path / "open.obj", tmp_path / "out" / "open" / "row.json"
    polycube.Mesh(CUBE_POINTS, CUBE_QUADS[1:], "quads").write(path)
    first = polycube.batch([path], tmp_path / "out", **OPTIONS)
    at = row.stat().st_mtime_ns
    assert polycube.batch([path], tmp_path / "out", **OPTIONS) == first
    assert row.stat().st_mtime_ns == at
    assert polycube.batch([path], tmp_path / "out", retry=True, **OPTIONS) == first
    assert row.stat().st_mtime_ns > at


def test_other_files_and_options_are_other_meshes(tmp_path):
    path = tmp_path / "late.obj"
    first = polycube.batch([path], tmp_path / "out", **OPTIONS)
    assert (first[0]["status"], first[0]["kind"]) == ("failed", "io")
    box(tmp_path, 0).rename(path)
    done = polycube.batch([path], tmp_path / "out", **OPTIONS)
    assert done[0]["status"] == "done"
    finer = polycube.batch([path], tmp_path / "out", edge_length=0.25, max_hausdorff=5)
    assert finer[0]["hexes"] > done[0]["hexes"]


def test_a_cap_on_memory_ends_a_shape_alone(tmp_path):
    rows = polycube.batch([box(tmp_path, 0), endless(tmp_path, 1)], tmp_path / "out", max_memory=0.5, **OPTIONS)
    assert [row["status"] for row in rows] == ["done", "killed"]
    assert (rows[1]["kind"], "memory" in rows[1]["message"]) == ("memory", True)


def test_parts_for_several_machines_and_any_executor(tmp_path):
    paths = [box(tmp_path, i) for i in range(3)]
    with ThreadPoolExecutor(1) as pool:
        parts = [polycube.batch(paths, tmp_path / "out", part=(i, 2), client=pool, **OPTIONS) for i in range(2)]
    assert [len(rows) for rows in parts] == [2, 1]
    tables = sorted(path.name for path in (tmp_path / "out").glob("*.csv"))
    assert tables == ["results-0-of-2.csv", "results-1-of-2.csv"]
    whole = polycube.batch(paths, tmp_path / "out", **OPTIONS)
    assert whole == [parts[0][0], parts[1][0], parts[0][1]]


def test_a_shape_with_its_polycube(tmp_path):
    cube = box(tmp_path, 0)
    row = polycube.batch([(cube, cube)], tmp_path / "out", surface_only=True, **OPTIONS)[0]
    assert (row["status"], row["hexes"], row["polycube"]) == ("done", 0, str(cube))
    assert not (tmp_path / "out" / "box-00" / "hexes.vtu").exists()


def test_mistakes_are_told_before_anything_is_done(tmp_path):
    a = box(tmp_path, 0)
    (tmp_path / "other").mkdir()
    b = box(tmp_path / "other", 0)
    for wrong, what in (({"threads": 0}, "threads"), ({"timeout": float("nan")}, "timeout"), ({"part": (2, 2)}, "part")):
        with pytest.raises(polycube.InvalidOption, match=what):
            polycube.batch([a], tmp_path / "out", **wrong)
    with pytest.raises(polycube.InvalidOption, match="one name"):
        polycube.batch([a, b], tmp_path / "out")
    with pytest.raises(polycube.InvalidOption, match="options"):
        polycube.batch([a], tmp_path / "out", locked_faces=np.arange(3))
    assert not (tmp_path / "out").exists()
    row = polycube.batch([a], tmp_path / "out", hexen=3)[0]
    assert (row["status"], row["kind"]) == ("failed", "option")
    assert "hexen" in row["message"]


def test_a_parquet_table(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    rows = polycube.batch([box(tmp_path, 0)], tmp_path / "out", table="all.parquet", **OPTIONS)
    assert parquet.read_table(tmp_path / "out" / "all.parquet").to_pylist() == rows


def test_forty_shapes_on_a_cluster(tmp_path):
    distributed = pytest.importorskip("distributed")
    paths = [box(tmp_path, i) for i in range(40)]
    polycube.Mesh(CUBE_POINTS, CUBE_QUADS[1:], "quads").write(paths[11])
    endless(tmp_path, 23)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=2, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            rows = polycube.batch(paths, tmp_path / "out", timeout=TIMEOUT, client=client, **OPTIONS)
    wanted = ["done"] * 40
    wanted[11], wanted[23] = "failed", "killed"
    assert [row["status"] for row in rows] == wanted
