"""To the meshes of other libraries and back."""

import sys

import numpy as np
import pytest

import polycube

KINDS = ("triangles", "quads", "tetrahedra", "hexahedra")


@pytest.mark.parametrize("name", ["meshio", "pyvista"])
@pytest.mark.parametrize("kind", KINDS)
def test_there_and_back(name, kind):
    pytest.importorskip(name)
    mesh = polycube.example("stepped-l", kind=kind)[0]
    again = getattr(polycube, f"from_{name}")(getattr(polycube, f"to_{name}")(mesh))
    assert again.kind == kind
    assert np.array_equal(again.points, mesh.points)
    assert np.array_equal(again.cells, mesh.cells)


@pytest.mark.parametrize("kind", KINDS)
def test_the_surface_for_trimesh(kind):
    pytest.importorskip("trimesh")
    mesh = polycube.example("stepped-l", kind=kind)[0]
    other = polycube.to_trimesh(mesh)
    assert other.is_watertight and other.volume > 0
    again = polycube.from_trimesh(other)
    assert np.array_equal(again.points, mesh.points)
    if kind in ("triangles", "tetrahedra"):
        assert np.array_equal(again.cells, mesh.boundary())
    else:
        corners = again.cells.reshape(-1, 6)
        assert np.array_equal(corners[:, [0, 1, 2, 5]], mesh.boundary())


def test_the_arrays_of_meshes_come_along(cube):
    pytest.importorskip("meshio")
    pyvista = pytest.importorskip("pyvista")
    meshes = polycube.remesh(cube, cube, hexes=60)
    for mesh, name in ((meshes.hexes, "scaled_jacobian"), (meshes.quads, "patch_id")):
        wanted = getattr(mesh, name)
        assert np.array_equal(polycube.to_meshio(mesh).cell_data[name][0], wanted)
        assert np.array_equal(polycube.to_pyvista(mesh).cell_data[name], wanted)
        wrapped = pyvista.wrap(polycube.to_meshio(mesh))
        assert np.array_equal(wrapped.cell_data[name], wanted)
        assert wrapped.n_cells == len(mesh)


def test_pyvista_wraps_what_it_is_given():
    pyvista = pytest.importorskip("pyvista")
    pytest.importorskip("trimesh")
    mesh = polycube.example("stepped-l", kind="triangles")[0]
    for other in (polycube.to_pyvista(mesh), polycube.to_trimesh(mesh)):
        assert np.array_equal(polycube.from_pyvista(pyvista.wrap(other)).cells, mesh.cells)


def test_solids_come_before_the_surfaces_around_them():
    meshio = pytest.importorskip("meshio")
    mesh = polycube.example("stepped-l")[0]
    other = meshio.Mesh(mesh.points, [("triangle", mesh.boundary()), ("tetra", mesh.cells[:9]), ("tetra", mesh.cells[9:])])
    assert np.array_equal(polycube.from_meshio(other).cells, mesh.cells)


def test_what_cannot_be_taken_is_told():
    meshio = pytest.importorskip("meshio")
    points = np.eye(4, 3)
    with pytest.raises(polycube.Unsupported, match="quads and triangles"):
        polycube.from_meshio(meshio.Mesh(points, [("triangle", [[0, 1, 2]]), ("quad", [[0, 1, 2, 3]])]))
    with pytest.raises(polycube.Unsupported, match="no cells"):
        polycube.from_meshio(meshio.Mesh(points, [("line", [[0, 1]])]))
    points[1] = np.nan
    with pytest.raises(polycube.InvalidMesh) as caught:
        polycube.from_meshio(meshio.Mesh(points, [("triangle", [[0, 1, 2]])]))
    assert (caught.value.element, caught.value.elements) == ("vertex", (1,))


@pytest.mark.parametrize("name", ["meshio", "pyvista", "trimesh"])
def test_what_is_missing_is_named(name, cube, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=f"pip install {name}"):
        getattr(polycube, f"to_{name}")(cube)
