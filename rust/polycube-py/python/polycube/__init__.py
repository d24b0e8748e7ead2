"""Turn a polycube into the coarsest good block structure there is, and mesh its shape with it.

A *polycube* is a mesh whose boundary faces look along the axes; its *shape* is the mesh that it was deformed from, with
the same vertices and cells. Arrays are numpy arrays, indices count from 0, labels 0 to 5 stand for +X -X +Y -Y +Z -Z.

>>> import polycube
>>> shape, cube = polycube.example("cube-spikes")
>>> simple = polycube.simplify(cube, shape)
>>> simple.counts_before.blocks_padded, simple.counts_after.blocks_padded
(937, 111)
>>> meshes = polycube.remesh(shape, cube, hexes=2000)
>>> meshes.hexes.mesh.write("cube-spikes.vtu")

`make` makes a polycube of any closed surface; `remesh` does so by itself where it is given a shape alone.

>>> surface, _ = polycube.example("ring", kind="triangles")
>>> made = polycube.make(surface)
>>> made.shape.cells.shape == made.polycube.cells.shape
True
"""

from ._native import (
    EXAMPLES,
    Counts,
    Hexes,
    Job,
    Layout,
    Made,
    Mesh,
    Quads,
    Remeshed,
    Simplified,
    SingularEdge,
    Structure,
    TradeOff,
    Violation,
    __version__,
    check,
    check_shape,
    example,
    make,
    read,
    read_labels,
    read_pair,
    remesh,
    simplify,
    structure,
)
from .batch import batch
from .convert import from_meshio, from_pyvista, from_trimesh, to_meshio, to_pyvista, to_trimesh
from .errors import (
    Cancelled,
    FileError,
    Infeasible,
    InternalError,
    InvalidMesh,
    InvalidOption,
    InvalidPolycube,
    Mismatch,
    ParseError,
    PolycubeError,
    Unsupported,
)

__all__ = [
    "EXAMPLES",
    "Cancelled",
    "Counts",
    "FileError",
    "Hexes",
    "Infeasible",
    "InternalError",
    "InvalidMesh",
    "InvalidOption",
    "InvalidPolycube",
    "Job",
    "Layout",
    "Made",
    "Mesh",
    "Mismatch",
    "ParseError",
    "PolycubeError",
    "Quads",
    "Remeshed",
    "Simplified",
    "SingularEdge",
    "Structure",
    "TradeOff",
    "Unsupported",
    "Violation",
    "__version__",
    "batch",
    "check",
    "check_shape",
    "example",
    "from_meshio",
    "from_pyvista",
    "from_trimesh",
    "make",
    "read",
    "read_labels",
    "read_pair",
    "remesh",
    "simplify",
    "structure",
    "to_meshio",
    "to_pyvista",
    "to_trimesh",
]
