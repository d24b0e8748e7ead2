"""Meshes go to other programs and come from them: every format that both know, both ways. Used by tests/readers.py.

The command writes one mesh of each kind of cells in every format, which meshio, gmsh and PyVista read with the very same
points and cells; and they write them in every way that they can, which the command reads as the same structure.
"""

import gmsh
import meshio
import numpy
import pyvista
from reading import check

# Of meshio: the format and what it is told.
MESHIO = {
    "gmsh22.msh": ("gmsh22", {"binary": False}),
    "gmsh22b.msh": ("gmsh22", {"binary": True}),
    "gmsh41.msh": ("gmsh", {"binary": False}),
    "gmsh41b.msh": ("gmsh", {"binary": True}),
    "abaqus.inp": ("abaqus", {}),
    "medit.mesh": ("medit", {}),
    "medit.meshb": ("medit", {}),
    "ascii.vtk": ("vtk", {"binary": False}),
    "binary.vtk": ("vtk", {"binary": True}),
    "ascii.vtu": ("vtu", {"binary": False}),
    "zlib.vtu": ("vtu", {"compression": "zlib"}),
}
SURFACES = {  # meshio has triangles alone in OFF.
    "meshio.obj": ("obj", {}),
    "meshio.off": ("off", {}),
    "ascii.ply": ("ply", {"binary": False}),
    "binary.ply": ("ply", {"binary": True}),
}



def same(what, mesh, points, cells, kind):
    check(numpy.array_equal(mesh.points, points), f"{what}: the points are others")
    found = numpy.concatenate([block.data for block in mesh.cells if block.type == kind])
    check(numpy.array_equal(found, cells), f"{what}: the {kind} cells are others")


def read_by_gmsh(file, points, cells, surface):
    """Gmsh reads the nodes by their numbers and the very same elements, in an order of its own."""
    gmsh.clear()
    gmsh.open(str(file))
    tags, found, _ = gmsh.model.mesh.getNodes()
    at = dict(zip(tags, found.reshape(-1, 3)))
    check(numpy.array_equal([at[i + 1] for i in numpy.unique(cells)], points[numpy.unique(cells)]), f"{file}: nodes")
    _, _, nodes = gmsh.model.mesh.getElements(2 if surface else 3)
    there = {tuple(cell) for cell in numpy.concatenate(nodes).reshape(-1, cells.shape[1]) - 1}
    check(there == {tuple(cell) for cell in cells}, f"{file}: Gmsh has other elements")


def written_by_us(polycube, source, kind, folder):
    """What the command writes of a mesh in every format, as other programs read it; gives its points and cells."""
    def written(extension):
        out = folder / f"{kind}-{extension}"
        polycube("simplify", source, "--strategy", "naive", "-q", "-o", out, "--format", extension)
        return out / f"polycube.{extension}"

    ours = meshio.read(written("vtu"))
    points, cells = ours.points, ours.cells_dict[kind]
    surface = kind in ("triangle", "quad")
    own = {"triangle": ("obj", "ply", "off"), "quad": ("obj", "ply")}
    for extension in ("mesh", "meshb", "vtk", "msh", "inp", *own.get(kind, ())):
        file = written(extension)
        same(file, meshio.read(file), points, cells, kind)
        if extension == "msh":
            read_by_gmsh(file, points, cells, surface)
    if surface:
        read = pyvista.read(written("vtp"))
        check(numpy.array_equal(read.points, points), f"{kind}.vtp: the points are others")
        check(numpy.array_equal(read.faces.reshape(len(cells), -1)[:, 1:], cells), f"{kind}.vtp: the faces are others")
    return points, cells


def written_by_others(points, cells, kind, folder):
    """Writes a mesh with other programs in every way that they know; gives the files."""
    folder.mkdir()
    mesh = meshio.Mesh(points, [(kind, cells)])
    surface = kind in ("triangle", "quad")
    for name, (format, options) in (MESHIO | (SURFACES if surface else {})).items():
        if (format, kind) == ("off", "quad"):
            continue
        meshio.write(folder / name, mesh, file_format=format, **options)
    if surface:
        faces = numpy.hstack([numpy.full((len(cells), 1), cells.shape[1]), cells]).ravel()
        for name, binary in (("ascii.vtp", False), ("binary.vtp", True)):
            pyvista.PolyData(points, faces).save(folder / name, binary=binary)
    gmsh.clear()
    gmsh.open(str(folder / "gmsh22.msh"))
    for version in (2.2, 4.1):
        for binary in (0, 1):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.Binary", binary)
            gmsh.write(str(folder / f"own{version}-{binary}.msh"))
    for extension in ("inp", "vtk", "mesh"):
        gmsh.write(str(folder / f"own.{extension}"))
    return sorted(folder.iterdir())


def all_formats(polycube, sources, folder):
    """Both ways, for each kind of cells, of which `sources` has a polycube."""
    count = 0
    for kind, source in sources.items():
        points, cells = written_by_us(polycube, source, kind, folder)
        files = written_by_others(points, cells, kind, folder / f"others-{kind}")
        # What is found in a file, but for its name.
        found = {file: polycube("inspect", file).split("\n", 1)[1] for file in files}
        for file in files:
            check(found[file] == found[folder / f"others-{kind}/ascii.vtu"], f"{file}: another structure is found")
        count += len(files)
    print(f"  formats: {count} files of other programs are read, and those of the command by them")
