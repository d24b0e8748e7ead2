"""`make`, and `remesh` of a shape alone: validity, errors with their places, and equality with the command."""

import threading

import numpy as np
import pytest

import polycube


@pytest.fixture(scope="module")
def shape() -> polycube.Mesh:
    return polycube.example("ring", kind="triangles")[0]


@pytest.fixture(scope="module")
def made(shape) -> polycube.Made:
    return polycube.make(shape)


def test_a_valid_polycube_of_the_shape(shape, made):
    assert polycube.check(made.polycube, made.labels, shape=made.shape) == []
    assert np.array_equal(made.shape.cells, made.polycube.cells)
    assert np.array_equal(made.shape.points[: len(shape.points)], shape.points)
    assert len(made.shape.points) - len(shape.points) == made.report["added"]
    found = polycube.structure(made.polycube, made.labels)
    assert (found.genus, found.components) == (1, 1)
    assert made.report["genus"] == 1
    sizes = [len(found.corners), len(found.edges), len(found.facet_label)]
    assert [made.report[name] for name in ("corners", "edges", "facets")] == sizes
    assert (made.labels.dtype, len(made.labels)) == (np.int8, len(made.shape.cells))
    assert not made.labels.flags.writeable
    levels = made.polycube.points[made.polycube.cells[:, 0], made.labels // 2]
    assert np.array_equal(levels, np.round(levels))


def test_triangles_are_turned_over_where_it_is_not_good(made):
    p = made.polycube.points[made.polycube.cells]
    normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    axis, sign = made.labels // 2, 1 - 2 * (made.labels % 2)
    outward = normals[np.arange(len(normals)), axis] * sign
    assert set(np.flatnonzero(outward <= 0)) == set(made.report["folded"])
    assert made.good == (not made.report["folded"])


def test_fewer_corners(shape, made):
    few = polycube.make(shape, detail=0.2)
    assert few.report["corners"] <= made.report["corners"]
    assert few.report["genus"] == 1
    assert repr(few) == f"Made({few.report['corners']} corners, {few.report['facets']} facets)"


def test_what_looks_inward_is_turned_and_told(shape, made):
    inward = polycube.Mesh(shape.points, shape.cells[:, ::-1])
    found = polycube.make(inward)
    assert len(found.report["repairs"]) == 1 and "turned to look outward" in found.report["repairs"][0]
    assert made.report["repairs"] == [] and found.report["corners"] == made.report["corners"]
    with pytest.raises(polycube.InvalidMesh, match="looks inward"):
        polycube.make(inward, no_repair=True)
    with pytest.raises(polycube.InvalidMesh, match="looks inward"):
        polycube.remesh(inward, no_repair=True)


def test_a_polycube_that_looks_inward_is_taken_as_it_is_where_that_is_asked_for():
    shape, cube = polycube.example("stepped-l", kind="triangles")
    inward = [polycube.Mesh(mesh.points, mesh.cells[:, ::-1]) for mesh in (cube, shape)]
    assert "repaired" in polycube.simplify(*inward, strategy="paper").notes[0]
    with pytest.raises(polycube.PolycubeError):
        polycube.simplify(*inward, strategy="paper", no_repair=True)


def test_the_axes_of_the_surface_are_found():
    _, shape = polycube.example("stepped-l", kind="triangles")
    c, s = np.cos(0.5), np.sin(0.5)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    askew = polycube.Mesh(shape.points @ turn.T, shape.cells)
    found = polycube.make(askew, axes="best")
    assert np.array_equal(found.shape.points[: len(shape.points)], askew.points)
    assert found.report["misfit"] < 1e-9 < polycube.make(askew).report["misfit"]
    assert polycube.check(found.polycube, found.labels, shape=found.shape) == []
    with pytest.raises(polycube.InvalidOption, match="keep"):
        polycube.make(askew, axes="worst")


def test_the_same_bytes_as_the_command(tmp_path, command, shape, made):
    shape.write(tmp_path / "shape.off")
    command("make", tmp_path / "shape.off", "-o", tmp_path / "out")
    made.shape.write(tmp_path / "own.shape.off")
    made.polycube.write(tmp_path / "own.polycube.off")
    for kind in ("shape", "polycube"):
        assert (tmp_path / f"own.{kind}.off").read_bytes() == (tmp_path / "out" / f"{kind}.off").read_bytes()
    labels = polycube.read_labels(tmp_path / "out" / "polycube.labels", made.polycube)
    assert np.array_equal(labels, made.labels)


def test_a_shape_alone_is_meshed(shape, made):
    stages = []
    # So few cannot be nearer to the shape, and no other blocks are looked for in vain.
    size = {"hexes": 1500, "max_hausdorff": 5}
    meshes = polycube.remesh(shape, **size, progress=lambda *now: stages.append(now))
    assert np.array_equal(meshes.made.shape.points, made.shape.points)
    assert np.array_equal(meshes.simplified.polycube.cells, made.polycube.cells)
    assert meshes.report["inverted"] == 0
    fractions = [fraction for _, fraction in stages]
    assert fractions == sorted(fractions)
    assert "loops" in {stage for stage, _ in stages}
    both = polycube.remesh(made.shape, made.polycube, labels=made.labels, **size)
    assert both.made is None
    assert np.array_equal(both.hexes.points, meshes.hexes.points)


def test_a_job(shape, made):
    job = polycube.Job.make(shape)
    assert np.array_equal(job.result().polycube.points, made.polycube.points)
    with pytest.raises(polycube.InvalidOption):
        polycube.Job.make(shape, detail=-1)


def test_an_event_cancels(shape):
    cancel = threading.Event()
    with pytest.raises(polycube.Cancelled):
        polycube.make(shape, progress=lambda stage, fraction: cancel.set(), cancel=cancel)


def test_an_open_surface_is_refused_with_the_edge(shape):
    opened = polycube.Mesh(shape.points, shape.cells[1:])
    with pytest.raises(polycube.InvalidMesh) as caught:
        polycube.make(opened)
    error = caught.value
    assert error.element == "edge"
    assert set(error.elements) < set(shape.cells[0])
    assert error.place == pytest.approx(shape.points[list(error.elements)].mean(axis=0))


def test_a_volume_is_refused(pair):
    with pytest.raises(polycube.Unsupported):
        polycube.make(pair[0])


@pytest.mark.parametrize("option", [{"detail": 1.5}, {"detail": float("nan")}])
def test_options_out_of_range(shape, option):
    with pytest.raises(polycube.InvalidOption):
        polycube.make(shape, **option)


def test_unknown_options(shape):
    with pytest.raises(TypeError, match="simplicity"):
        polycube.make(shape, simplicity=1)


@pytest.mark.parametrize("option", [{"detail": 0.3}, {"corners": 16}])
def test_options_of_making_have_no_effect_with_a_polycube(surfaces, option):
    with pytest.raises(polycube.InvalidOption, match=next(iter(option))):
        polycube.remesh(*surfaces, **option)


def test_a_labelled_shape_gets_the_polycube_of_its_labels():
    shape, cube = polycube.example("ring", kind="quads")
    own = polycube.structure(cube)
    made = polycube.make(shape, labels=own.label)
    assert made.good
    assert polycube.check(made.polycube, made.labels, shape=made.shape) == []
    found = polycube.structure(made.polycube, made.labels)
    assert np.array_equal(np.sort(found.facet_label), np.sort(own.facet_label))
    assert (len(found.corners), len(found.edges)) == (len(own.corners), len(own.edges))
    meshes = polycube.remesh(shape, labels=own.label, scale=0.05, max_hausdorff=5)
    assert np.array_equal(meshes.made.polycube.points, made.polycube.points)


def test_labels_that_are_no_polycube_are_refused_with_their_place(surfaces):
    shape, cube = surfaces
    labels = polycube.structure(cube).label.copy()
    labels[labels == 0] = 3
    with pytest.raises(polycube.InvalidPolycube, match="opposite") as caught:
        polycube.make(shape, labels=labels)
    assert caught.value.element == "edge" and caught.value.place is not None
    with pytest.raises(polycube.Mismatch):
        polycube.make(shape, labels=labels[1:])
    with pytest.raises(polycube.InvalidOption, match="detail"):
        polycube.make(shape, labels=labels, detail=0.5)
