"""A picture of a shape with its blocks before and after, and of the hexahedra by quality, drawn with PyVista.

    python pyvista_picture.py [FOLDER]

Needs `pip install pyvista` and this module. In a notebook, call `plotter.show()` instead of `screenshot`.
"""

import sys
from pathlib import Path

import numpy as np
import pyvista

import polycube


def surface(mesh: polycube.Mesh, **numbers: np.ndarray) -> pyvista.PolyData:
    """The boundary of a mesh with numbers per face."""
    data: pyvista.PolyData = pyvista.PolyData.from_regular_faces(mesh.points, mesh.boundary().astype(int))
    for name, values in numbers.items():
        data.cell_data[name] = values
    return data


def patches(shape: polycube.Mesh, structure: polycube.Structure) -> pyvista.PolyData:
    """The shape coloured by patch: neighbouring numbers get colours far apart."""
    return surface(shape, patch=structure.patch_id * 7 % 20)


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    shape, cube = polycube.example("cube-spikes")
    meshes = polycube.remesh(shape, cube, hexes=2000)
    simple, hexes = meshes.simplified, meshes.hexes
    assert hexes and simple.polycube  # there are none with surface_only=True, or when strategy="naive" breaks the polycube
    after = polycube.structure(simple.polycube, simple.labels)

    plotter = pyvista.Plotter(off_screen=True, shape=(1, 3), window_size=[1500, 550])
    for i, (title, structure) in enumerate([("before", simple.structure), ("after", after)]):
        plotter.subplot(0, i)
        plotter.add_mesh(patches(shape, structure), scalars="patch", cmap="tab20", show_scalar_bar=False)
        plotter.add_text(f"{title}: {structure.counts.surface_patches} patches", font_size=12)
    plotter.subplot(0, 2)
    grid = pyvista.UnstructuredGrid({pyvista.CellType.HEXAHEDRON: hexes.cells}, hexes.points)
    grid.cell_data["scaled Jacobian"] = hexes.scaled_jacobian
    plotter.add_mesh(grid.clip("y"), scalars="scaled Jacobian", cmap="viridis", clim=(0, 1), show_edges=True)
    for edge in meshes.layout.singular_edges:
        plotter.add_mesh(pyvista.lines_from_points(edge.points), color="red", line_width=3)
    plotter.add_text(f"{grid.n_cells} hexahedra", font_size=12)
    plotter.link_views()
    plotter.screenshot(folder / "blocks.png")


if __name__ == "__main__":
    main()
