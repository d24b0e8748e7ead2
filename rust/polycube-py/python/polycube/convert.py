"""Meshes of meshio, PyVista and trimesh from those of this library and back. None is needed until it is asked for."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._native import Hexes, Mesh, Quads
from .errors import Unsupported

# meshio has no types.
if TYPE_CHECKING:
    import pyvista
    import trimesh

# The name of each kind in meshio and its number in VTK; solids before surfaces, which files have around them.
_KINDS = {
    "hexahedra": ("hexahedron", 12),
    "tetrahedra": ("tetra", 10),
    "quads": ("quad", 9),
    "triangles": ("triangle", 5),
}
_FIELDS = {
    Hexes: ("block_id", "label", "scaled_jacobian", "edge_ratio", "determinant", "non_orthogonality", "skewness"),
    Quads: ("label", "patch_id", "block_id"),
}


def to_meshio(mesh: Mesh | Quads | Hexes) -> Any:
    """The mesh as a `meshio.Mesh`, which writes some forty formats; the arrays of `Quads` and `Hexes` come along.

    Raises:
        ImportError: meshio is not installed (`pip install meshio`).
    """
    module, own = _needed("meshio"), _mesh(mesh)
    data = {name: [values] for name, values in _fields(mesh).items()}
    return module.Mesh(own.points, [(_KINDS[own.kind][0], own.cells)], cell_data=data)


def from_meshio(mesh: Any) -> Mesh:
    """The mesh of a `meshio.Mesh`: its hexahedra or tetrahedra, or where it has none, its quadrilaterals or triangles.

    Raises:
        Unsupported: it has none of these, or two kinds of one dimension.
        InvalidMesh: a coordinate is not finite, or a cell names a vertex that is not there.
    """
    blocks: dict[str, list[npt.NDArray[Any]]] = {}
    for block in mesh.cells:
        blocks.setdefault(block.type, []).append(block.data)
    return _best(mesh.points, {kind: np.concatenate(blocks[name]) for kind, (name, _) in _KINDS.items() if name in blocks})


def to_pyvista(mesh: Mesh | Quads | Hexes) -> pyvista.PolyData | pyvista.UnstructuredGrid:
    """The mesh as a `pyvista.PolyData` (surfaces) or `pyvista.UnstructuredGrid` (volumes), to be drawn and filtered.
    The arrays of `Quads` and `Hexes` come along as cell data.

    Raises:
        ImportError: PyVista is not installed (`pip install pyvista`).
    """
    module, own = _needed("pyvista"), _mesh(mesh)
    cells = own.cells.astype(np.int64)
    if own.is_volume:
        made = module.UnstructuredGrid({_KINDS[own.kind][1]: cells}, own.points)
    else:
        made = module.PolyData.from_regular_faces(own.points, cells)
    for name, values in _fields(mesh).items():
        made.cell_data[name] = values
    return made  # type: ignore[no-any-return]


def from_pyvista(mesh: pyvista.DataSet) -> Mesh:
    """The mesh of a PyVista data set: its hexahedra or tetrahedra, or where it has none, its quadrilaterals or
    triangles.

    Raises:
        Unsupported: it has none of these, or two kinds of one dimension (`triangulate()` makes one of them).
        InvalidMesh: a coordinate is not finite.
    """
    grid = mesh.cast_to_unstructured_grid()
    cells: Any = grid.cells_dict
    return _best(np.asarray(grid.points), {kind: cells[number] for kind, (_, number) in _KINDS.items() if number in cells})


def to_trimesh(mesh: Mesh | Quads | Hexes) -> trimesh.Trimesh:
    """The surface of the mesh as a `trimesh.Trimesh`, quadrilaterals cut in two. Vertices keep their numbers; those
    inside a volume belong to no triangle.

    Raises:
        ImportError: trimesh is not installed (`pip install trimesh`).
    """
    module, own = _needed("trimesh"), _mesh(mesh)
    faces = own.boundary().astype(np.int64)
    if faces.shape[1] == 4:
        faces = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return module.Trimesh(own.points.copy(), faces, process=False)  # type: ignore[no-any-return]


def from_trimesh(mesh: trimesh.Trimesh) -> Mesh:
    """The triangles of a `trimesh.Trimesh`.

    Raises:
        InvalidMesh: a coordinate is not finite.
    """
    return Mesh(mesh.vertices, mesh.faces, "triangles")


def _needed(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{name} is not installed (pip install {name})", name=name) from error


def _mesh(mesh: Mesh | Quads | Hexes) -> Mesh:
    return mesh if isinstance(mesh, Mesh) else mesh.mesh


def _fields(mesh: Mesh | Quads | Hexes) -> dict[str, npt.NDArray[Any]]:
    return {name: getattr(mesh, name) for name in _FIELDS.get(type(mesh), ())}


def _best(points: npt.ArrayLike, cells: Mapping[str, npt.NDArray[Any]]) -> Mesh:
    """The cells of the highest dimension, which must be of one kind."""
    for kinds in (("hexahedra", "tetrahedra"), ("quads", "triangles")):
        found = [kind for kind in kinds if len(cells.get(kind, ()))]
        if len(found) == 2:
            raise _unsupported(f"the mesh has {found[0]} and {found[1]}", "cut them into cells of one kind")
        if found:
            return Mesh(points, cells[found[0]], found[0])
    raise _unsupported("the mesh has no cells that can be used", "give triangles, quads, tetrahedra or hexahedra")


def _unsupported(message: str, remedy: str) -> Unsupported:
    return Unsupported(f"{message} ({remedy})", "unsupported", message, remedy=remedy)
