"""Meshes: arrays in and out, what is refused, files."""

import gc

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_QUADS

import polycube

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]


@pytest.mark.parametrize(
    ("cells", "given", "kind"),
    [
        ([[0, 1, 2]], None, "triangles"),
        ([[0, 1, 2, 3]], "quads", "quads"),
        ([[0, 1, 2, 3]], "quadrilaterals", "quads"),
        ([[0, 1, 2, 3]], "tetrahedra", "tetrahedra"),
        ([[0, 1, 2, 3]], "tets", "tetrahedra"),
        ([[0, 1, 2, 3, 0, 1, 2, 3]], None, "hexahedra"),
    ],
)
def test_the_kind_follows_from_the_cells_or_is_given(cells, given, kind):
    mesh = polycube.Mesh(POINTS, cells, given)
    assert (mesh.kind, mesh.is_volume) == (kind, kind in ("tetrahedra", "hexahedra"))
    assert mesh.cells.tolist() == cells


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int64, np.uint8])
@pytest.mark.parametrize("order", ["C", "F"])
def test_points_of_any_number_type_and_layout_are_taken(dtype, order):
    mesh = polycube.Mesh(np.array(CUBE_POINTS, dtype, order=order), CUBE_QUADS, "quads")
    assert mesh.points.dtype == np.float64
    assert np.array_equal(mesh.points, CUBE_POINTS)


@pytest.mark.parametrize("dtype", [np.uint32, np.int64, np.uint64, np.int8])
@pytest.mark.parametrize("stride", [1, -1])
def test_cells_of_any_integer_type_and_layout_are_taken(dtype, stride):
    cells = CUBE_QUADS.astype(dtype)[::stride]
    mesh = polycube.Mesh(CUBE_POINTS, cells, "quads")
    assert mesh.cells.dtype == np.uint32
    assert np.array_equal(mesh.cells, cells)


@pytest.mark.parametrize(
    ("points", "cells", "kind", "message"),
    [
        (np.zeros((4, 2)), [[0, 1, 2]], None, "points have the shape"),
        (np.zeros(12), [[0, 1, 2]], None, "points have the shape"),
        (POINTS, [0, 1, 2], None, "cells have the shape"),
        (POINTS, [[0, 1]], None, "no cells of 2 vertices"),
        (POINTS, [[0, 1, 2, 3]], None, "may be quads or tetrahedra"),
        (POINTS, [[0, 1, 2]], "hexahedra", "do not have 3 vertices"),
        (POINTS, [[0, 1, 2], [1, 2, 4]], None, "names vertex 4.* of 4"),
        (POINTS, [[0, 1, -1]], None, "names vertex -1"),
        (POINTS, np.array([[0, 1, 2**63 + 5]], np.uint64), None, "names vertex"),
    ],
)
def test_arrays_of_wrong_shape_and_cells_without_vertices_are_refused(points, cells, kind, message):
    with pytest.raises(polycube.InvalidMesh, match=message) as caught:
        polycube.Mesh(points, cells, kind)
    assert caught.value.kind == "mesh"
    assert caught.value.remedy


def test_the_bad_cell_is_named():
    with pytest.raises(polycube.InvalidMesh) as caught:
        polycube.Mesh(POINTS, [[0, 1, 2], [1, 2, 4]])
    assert (caught.value.element, caught.value.elements) == ("cell", (1,))


@pytest.mark.parametrize(
    ("points", "cells"),
    [
        ([["a", "b", "c"]], [[0, 0, 0]]),
        (np.zeros((4, 3), complex), [[0, 1, 2]]),
        (POINTS, [[0.0, 1.0, 2.5]]),
        (POINTS, [[0.0, 1.0, np.nan]]),
        (POINTS, [[0.0, 1.0, 1e300]]),
        (POINTS, np.array([[True, False, True]])),
        (object(), [[0, 1, 2]]),
    ],
)
def test_other_types_are_refused(points, cells):
    with pytest.raises(TypeError):
        polycube.Mesh(points, cells)


def test_cells_may_be_floats_without_a_fraction_and_others_are_named():
    mesh = polycube.Mesh(CUBE_POINTS, CUBE_QUADS.astype(float), "quads")
    assert np.array_equal(mesh.cells, CUBE_QUADS)
    cells = CUBE_QUADS.astype(float)
    cells[4, 1] = np.nan
    with pytest.raises(TypeError, match="cells: .* row 4 has NaN"):
        polycube.Mesh(CUBE_POINTS, cells, "quads")
    with pytest.raises(TypeError, match="labels: .* row 2 has 0.5"):
        polycube.check(mesh, labels=[0, 1, 0.5, 3, 4, 5])


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_point_that_is_not_finite_is_named(bad):
    points = CUBE_POINTS.copy()
    points[5, 2] = bad
    with pytest.raises(polycube.InvalidMesh) as caught:
        polycube.Mesh(points, CUBE_QUADS, "quads")
    assert (caught.value.element, caught.value.elements) == ("vertex", (5,))


def test_the_length_is_the_number_of_cells(cube, pair):
    assert (len(cube), len(pair[0])) == (6, len(pair[0].cells))
    meshes = polycube.remesh(cube, cube, hexes=60)
    assert len(meshes.hexes) == len(meshes.hexes.cells) == meshes.report["hexes"]
    assert len(meshes.quads) == len(meshes.quads.cells) == meshes.report["quads"]


def test_an_unknown_kind_is_refused():
    with pytest.raises(polycube.InvalidOption, match="prisms"):
        polycube.Mesh(POINTS, [[0, 1, 2, 3]], "prisms")


def test_the_input_is_copied_and_the_output_is_not():
    points = np.array(POINTS, float)
    mesh = polycube.Mesh(points, [[0, 1, 2]])
    points[0] = 7
    assert mesh.points[0].tolist() == [0, 0, 0]
    assert np.shares_memory(mesh.points, mesh.points)
    assert np.shares_memory(mesh.cells, mesh.cells)


def test_arrays_are_read_only_and_outlive_the_mesh():
    mesh = polycube.Mesh(CUBE_POINTS, CUBE_QUADS, "quads")
    points, cells = mesh.points, mesh.cells
    with pytest.raises(ValueError, match="read-only"):
        points[0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        cells.flags.writeable = True
    del mesh
    gc.collect()
    np.zeros(10_000)  # what might reuse the memory
    assert np.array_equal(points, CUBE_POINTS)
    assert np.array_equal(cells, CUBE_QUADS)


def test_the_boundary_of_a_volume(pair):
    mesh = pair[1]
    faces = mesh.boundary()
    assert (faces.shape[1], faces.dtype) == (3, np.uint32)
    sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    assert np.all(np.unique(sides, axis=0, return_counts=True)[1] == 2)
    a, b, c = mesh.points[faces].transpose(1, 0, 2)
    p, q, r, s = mesh.points[mesh.cells].transpose(1, 0, 2)
    volume = np.einsum("ij,ij->i", np.cross(q - p, r - p), s - p).sum() / 6
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(volume)


@pytest.mark.parametrize("extension", ["obj", "off", "ply", "mesh", "vtk", "vtu"])
def test_a_surface_is_read_back_from_every_format(tmp_path, cube, extension):
    path = tmp_path / f"cube.{extension}"
    cube.write(path)
    again = polycube.read(str(path))
    assert again.kind == "quads"
    assert np.array_equal(again.points, cube.points)
    assert np.array_equal(again.cells, cube.cells)


@pytest.mark.parametrize("extension", ["mesh", "vtk", "vtu"])
def test_a_volume_is_read_back_and_meshio_agrees(tmp_path, pair, extension):
    meshio = pytest.importorskip("meshio")
    path = tmp_path / f"solid.{extension}"
    pair[0].write(path)
    again, other = polycube.read(path), meshio.read(path)
    assert np.array_equal(again.points, pair[0].points)
    assert np.array_equal(other.points, pair[0].points)
    assert np.array_equal(other.cells_dict["tetra"], pair[0].cells)


def test_fields_are_written(tmp_path, cube):
    meshio = pytest.importorskip("meshio")
    path = tmp_path / "cube.vtu"
    whole = np.arange(6.0)
    cube.write(path, {"label": np.arange(6), "weight": np.linspace(0, 1, 6), "many": [2**40] * 6, "whole": whole})
    data = meshio.read(path).cell_data
    assert data["label"][0].tolist() == [0, 1, 2, 3, 4, 5]
    assert data["weight"][0].tolist() == np.linspace(0, 1, 6).tolist()
    assert data["many"][0].tolist() == [2.0**40] * 6
    assert (data["label"][0].dtype.kind, data["whole"][0].dtype.kind) == ("i", "f")


def test_bad_fields_are_refused(tmp_path, cube):
    with pytest.raises(polycube.InvalidOption, match="5 values for 6 cells"):
        cube.write(tmp_path / "cube.vtu", {"label": np.arange(5)})
    with pytest.raises(polycube.InvalidOption, match="cannot be named"):
        cube.write(tmp_path / "cube.vtu", {"a b": np.arange(6)})
    with pytest.raises(TypeError):
        cube.write(tmp_path / "cube.vtu", {"label": ["a"] * 6})
    assert list(tmp_path.iterdir()) == []


def test_errors_of_files(tmp_path, pair):
    with pytest.raises(polycube.FileError) as caught:
        polycube.read(tmp_path / "none.obj")
    assert isinstance(caught.value, OSError)
    broken = tmp_path / "broken.obj"
    broken.write_text("v 0 0 0\nv 1 0\n")
    with pytest.raises(polycube.ParseError) as caught:
        polycube.read(broken)
    assert (caught.value.element, caught.value.elements) == ("line", (2,))
    with pytest.raises(polycube.Unsupported):
        polycube.read(tmp_path / "mesh.xyz")
    with pytest.raises(polycube.Unsupported, match="cannot hold"):
        pair[0].write(tmp_path / "solid.obj")
    with pytest.raises(polycube.FileError):
        pair[0].write(tmp_path / "no" / "folder.vtk")


def test_pairs_are_read_together(tmp_path, surfaces, cube):
    surfaces[0].write(tmp_path / "shape.obj")
    surfaces[1].write(tmp_path / "polycube.obj")
    shape, simple = polycube.read_pair(tmp_path / "shape.obj", tmp_path / "polycube.obj")
    assert np.array_equal(shape.points, surfaces[0].points)
    assert np.array_equal(simple.points, surfaces[1].points)
    cube.write(tmp_path / "cube.obj")
    with pytest.raises(polycube.Mismatch):
        polycube.read_pair(tmp_path / "cube.obj", tmp_path / "polycube.obj")


def test_labels_are_read(tmp_path, cube):
    path = tmp_path / "cube.labels"
    path.write_text("5\n4\n3\n2\n1\n-1\n")
    assert polycube.read_labels(path, cube).tolist() == [5, 4, 3, 2, 1, -1]
    path.write_text("5\n4\n")
    with pytest.raises(polycube.Mismatch):
        polycube.read_labels(path, cube)
    path.write_text("6\n5\n4\n3\n2\n-1\n")
    assert polycube.read_labels(path, cube, order="1:+X-X+Y-Y+Z-Z").tolist() == [5, 4, 3, 2, 1, -1]
    with pytest.raises(polycube.InvalidOption):
        polycube.read_labels(path, cube, order="+X-X")
    path.write_text("5\nseven\n")
    with pytest.raises(polycube.ParseError):
        polycube.read_labels(path, cube)


@pytest.mark.parametrize("name", polycube.EXAMPLES)
def test_examples_are_pairs_of_valid_meshes(name):
    shape, mesh = polycube.example(name, seed=3, kind="quads")
    assert np.array_equal(shape.cells, mesh.cells)
    assert polycube.check(mesh, shape=shape) == []


def test_examples_that_there_are_not():
    with pytest.raises(polycube.InvalidOption, match="no example 'teapot'"):
        polycube.example("teapot")
