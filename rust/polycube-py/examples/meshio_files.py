"""Any file that meshio reads to any that it writes: simplify a polycube, mesh its shape, keep the numbers per cell.

    python meshio_files.py [FOLDER [SHAPE POLYCUBE]]

Without files an example stands in for them. Needs `pip install meshio` and this module.
"""

import sys
from pathlib import Path

import meshio

import polycube

KINDS = {"triangle": "triangles", "quad": "quads", "tetra": "tetrahedra", "hexahedron": "hexahedra"}


def from_meshio(mesh: meshio.Mesh) -> polycube.Mesh:
    """The first cells of a kind that is known."""
    for block in mesh.cells:
        if block.type in KINDS:
            return polycube.Mesh(mesh.points, block.data, KINDS[block.type])
    raise SystemExit("there are no triangles, quadrilaterals, tetrahedra or hexahedra")


def example(folder: Path) -> list[Path]:
    """Writes an example with meshio."""
    files = [folder / "shape.vtk", folder / "polycube.vtk"]
    for mesh, file in zip(polycube.example("cube-spikes"), files):
        meshio.Mesh(mesh.points, [("tetra", mesh.cells)]).write(file, binary=True)
    return files


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    files = [Path(name) for name in sys.argv[2:4]] or example(folder)
    shape, cube = (from_meshio(meshio.read(file)) for file in files)
    meshes = polycube.remesh(shape, cube, hexes=2000)
    hexes, before, after = meshes.hexes, meshes.simplified.counts_before, meshes.simplified.counts_after
    assert hexes and after  # there are none with surface_only=True, or when strategy="naive" breaks the polycube
    data = {"block_id": [hexes.block_id], "scaled_jacobian": [hexes.scaled_jacobian]}
    meshio.Mesh(hexes.points, [("hexahedron", hexes.cells)], cell_data=data).write(folder / "hexes.vtu")
    print(f"{before.blocks_padded} blocks became {after.blocks_padded}: {folder / 'hexes.vtu'}")


if __name__ == "__main__":
    main()
