"""Reads the meshes of `polycube remesh` with other programs and counts their blocks and patches independently.

For each pair: meshio, gmsh and VTK (through PyVista) read every file with the counts of the report, every volume is
positive and their sum is the reported one, the scaled Jacobians and the other measures written are those computed here,
the groups for solvers are there by name and complete, OpenFOAM's checkMesh finds no more than one thing wrong and
measures the same, CalculiX reproduces a linear field (both where they are installed), the block structure written is
that of the hexahedra, face by face, blockMesh makes as many of it on the same outside, and the base complex and the
patches, traced here from the definition, are as many as reported.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import gmsh
import meshio
import numpy
import plyfile
import pyvista
from block_readers import with_block_mesh, with_blocks
from format_readers import all_formats
from patch_test import with_ccx
from reading import FACES, FOAM, Union, check, gather, sides
from solver_measures import all_measures, write_control

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLYCUBE = ROOT / "target/release/polycube"
COLOURS = ("red", "green", "blue")
MEASURES = ("edge_ratio", "determinant", "non_orthogonality", "skewness")
ARRAYS = ("block_id", "label", "scaled_jacobian", *MEASURES)
# Of each corner of a hexahedron in VTK's order: the ends of its edges, right-handed seen from inside.
CORNERS = ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))
SOLVERS = ("vtk", "msh", "inp", "su2", "foam", "json", "xyz", "blockmesh")
FORMATS = [word for extension in SOLVERS for word in ("--format", extension)]
SIDES = {f"{sign}_{axis}" for sign in ("minus", "plus") for axis in "xyz"}


def polycube(*arguments):
    command = [str(a) for a in (POLYCUBE, *arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    check(done.returncode in (0, 4), f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout


def count_blocks(hexes):
    """Cells that hang together when every singular edge sends its sheets straight on, over regular inner edges, until
    they meet singular edges or the surface."""
    rings = {frozenset(h[k] for k in face): [h[k] for k in face] for h in hexes for face in FACES}
    cells_of = gather((frozenset(h[k] for k in face), i) for i, h in enumerate(hexes) for face in FACES)
    check(max(map(len, cells_of.values())) <= 2, "a face has more than two cells")
    faces_of = gather((side, face) for face, ring in rings.items() for side in sides(ring))
    surface = {side for face, ring in rings.items() if len(cells_of[face]) == 1 for side in sides(ring)}

    def singular(edge):
        around = {cell for face in faces_of[edge] for cell in cells_of[face]}
        return len(around) != (2 if edge in surface else 4)

    ends = {edge for edge in faces_of if singular(edge)}
    sheet = {face for edge in ends for face in faces_of[edge]}
    front = list(sheet)
    while front:
        face = front.pop()
        for edge in sides(rings[face]):
            if edge in ends or edge in surface:
                continue
            (beyond,) = (f for f in faces_of[edge] if not set(cells_of[f]) & set(cells_of[face]))
            if beyond not in sheet:
                sheet.add(beyond)
                front.append(beyond)
    blocks = Union(len(hexes))
    for face, cells in cells_of.items():
        if len(cells) == 2 and face not in sheet:
            blocks.join(*cells)
    return blocks.sets()


def count_patches(quads):
    """Quadrilaterals that hang together when every irregular vertex sends lines straight on, over regular vertices."""
    cells_of = gather((side, i) for i, quad in enumerate(quads) for side in sides(quad))
    check(all(len(c) == 2 for c in cells_of.values()), "the surface is not closed")
    edges_of = gather((v, edge) for edge in cells_of for v in edge)
    irregular = {v for v, edges in edges_of.items() if len(edges) != 4}
    front = [(v, edge) for v in irregular for edge in edges_of[v]]
    cut = {edge for _, edge in front}
    while front:
        (start, edge) = front.pop()
        (end,) = edge - {start}
        if end in irregular:
            continue
        (beyond,) = (e for e in edges_of[end] if not set(cells_of[e]) & set(cells_of[edge]))
        if beyond not in cut:
            cut.add(beyond)
            front.append((end, beyond))
    patches = Union(len(quads))
    for edge, cells in cells_of.items():
        if edge not in cut:
            patches.join(*cells)
    # Where no line cuts a handle, one patch may go round and close on itself; polycubes have no such patch.
    return patches.sets(), len(irregular)


def scaled_jacobians(points, hexes):
    """The smallest over the eight corners."""
    corners = points[hexes]
    least = numpy.full(len(hexes), numpy.inf)
    for at, ends in enumerate(CORNERS):
        edges = [corners[:, end] - corners[:, at] for end in ends]
        edges = [e / numpy.linalg.norm(e, axis=1)[:, None] for e in edges]
        least = numpy.minimum(least, numpy.einsum("ij,ij->i", edges[0], numpy.cross(edges[1], edges[2])))
    return least


def with_meshio(file, kind, count, arrays=()):
    mesh = meshio.read(file)
    found = sum(len(block.data) for block in mesh.cells if block.type == kind)
    check(found == count, f"meshio: {found} cells of {count} in {file}")
    for name in arrays:
        check(name in mesh.cell_data, f"meshio: no {name} in {file}")
    return mesh


def with_vtk(file, count, volume, arrays):
    mesh = pyvista.read(file)
    check(mesh.n_cells == count, f"VTK: {mesh.n_cells} cells of {count} in {file}")
    check((mesh.celltypes == pyvista.CellType.HEXAHEDRON).all(), f"VTK: other cells than hexahedra in {file}")
    volumes = mesh.compute_cell_sizes(length=False, area=False).cell_data["Volume"]
    check(volume is None or abs(volumes.sum() / volume - 1) < 1e-3, f"VTK: volume {volumes.sum()}, not {volume}, in {file}")
    check((volumes > 0).all(), f"VTK: volume {volumes.min()} in {file}")
    for name in arrays:
        check(len(mesh.cell_data.get(name, ())) == count, f"VTK: no {name} in {file}")
    return mesh


def with_gmsh(file, kind, count):
    """Element types of gmsh: 3 is a quadrilateral, 5 a hexahedron."""
    gmsh.clear()
    gmsh.merge(str(file))
    tags, _ = gmsh.model.mesh.getElementsByType(kind)
    check(len(tags) == count, f"gmsh: {len(tags)} cells of {count} in {file}")
    if kind == 5:
        worst = min(gmsh.model.mesh.getElementQualities(tags, "volume"))
        check(worst > 0, f"gmsh: volume {worst} in {file}")


def groups(file, dimension):
    """The numbers of the elements of each physical group by its name."""
    gmsh.clear()
    gmsh.merge(str(file))
    found = {}
    for _, tag in gmsh.model.getPhysicalGroups(dimension):
        entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, tag)
        tags = [numpy.concatenate(gmsh.model.mesh.getElements(dimension, entity)[1]) for entity in entities]
        found[gmsh.model.getPhysicalName(dimension, tag)] = numpy.concatenate(tags)
    return found


def each_once(name, groups, count):
    tags = numpy.concatenate(list(groups))
    check(len(tags) == len(set(tags)) == count, f"{name}: {len(tags)} elements in groups, not {count}")


def quads_of_sides(file):
    """The points and quadrilaterals of each side, as meshio reads them."""
    mesh = meshio.read(file)
    quads, tags = mesh.cells_dict["quad"], mesh.cell_data_dict["gmsh:physical"]["quad"]
    return {side: (mesh.points, quads[tags == mesh.field_data[side][0]]) for side in sorted(SIDES)}


def with_solvers(name, folder, report):
    """Blocks, facets and directions by their names, and linear fields are reproduced."""
    count, quads = report["hexes"], report["quads"]
    with_gmsh(folder / "hexes.msh", 5, count)
    with_gmsh(folder / "hexes.msh", 3, quads)
    blocks, outside = (groups(folder / "hexes.msh", dimension) for dimension in (3, 2))
    check(set(blocks) == {f"block_{i}" for i in range(report["after"]["blocks_padded"])}, f"{name}: {sorted(blocks)}")
    each_once(name, blocks.values(), count)
    check(SIDES < set(outside), f"{name}: {sorted(outside)}")
    each_once(name, (outside[side] for side in SIDES), quads)
    each_once(name, (tags for group, tags in outside.items() if re.fullmatch(r"facet_\d+", group)), quads)
    for file in ("hexes.msh", "hexes.su2"):
        read = with_meshio(folder / file, "hexahedron", count)
        check(sum(len(block.data) for block in read.cells if block.type == "quad") == quads, f"{name}: {file}")
    with_check_mesh(name, report, folder / "foam")
    mesh = with_meshio(folder / "hexes.inp", "hexahedron", count)
    check(SIDES < set(mesh.point_sets) and set(blocks) < set(mesh.cell_sets), f"{name}: sets of hexes.inp")
    if not shutil.which("ccx"):
        print("  The patch test is left out: there is no CalculiX.")
        return
    inside, through = with_ccx(folder, mesh, quads_of_sides(folder / "hexes.msh"))
    check(inside < 1e-5, f"{name}: CalculiX is {inside} off a linear field")
    check(through < 1e-5, f"{name}: the flux through a side is {through} off")


def same_measures(name, mesh, cells, report):
    """What is written of each cell and in total is what is computed here."""
    for measure, found in all_measures(mesh.points, cells).items():
        written, total = mesh.cell_data[measure], report[measure]
        check(numpy.abs(found - written).max() < 1e-6 * max(1, found.max()), f"{name}: {measure} of cells")
        for key, value in (("min", found.min()), ("max", found.max()), ("mean", found.mean())):
            check(abs(total[key] - value) < 1e-6 * max(1, value), f"{name}: {key} of {measure}: {total[key]}, not {value}")
        edges = total["from"] + total["bar"] * numpy.arange(1, len(total["histogram"]))
        bars = numpy.bincount(numpy.searchsorted(edges, written, side="right"), minlength=len(total["histogram"]))
        # A value on the edge between two bars may be rounded to either.
        check(numpy.abs(bars - total["histogram"]).sum() <= 0.001 * len(cells), f"{name}: bars of {measure}")
    check(report["edge_ratio"]["max"] <= 20, f"{name}: a cell's edges differ by {report['edge_ratio']['max']}")
    check(report["determinant"]["min"] >= 0.01, f"{name}: a determinant of {report['determinant']['min']}")


def with_check_mesh(name, report, case):
    """OpenFOAM's own opinion of its files, where it is installed."""
    if not shutil.which("checkMesh"):
        print("  checkMesh is left out: there is no OpenFOAM.")
        return
    write_control(case)
    command = ["checkMesh", "-allGeometry", "-allTopology", "-case", case]
    said = subprocess.run(command, capture_output=True, text=True, env=FOAM, timeout=600).stdout
    # Of all its checks one may fail: a face in a coarse corner that cuts into tetrahedra badly.
    failed = re.search(r"Failed (\d+) mesh checks", said)
    fine = "Mesh OK." in said or failed and failed[1] == "1" and "Error in face tets" in said
    check(fine, f"{name}: checkMesh says\n{said}")
    check(f" hexahedra:     {report['hexes']}\n" in said, f"{name}: hexahedra of checkMesh\n{said}")
    check(f" cell zones:       {report['after']['blocks_padded']}\n" in said, f"{name}: zones of checkMesh\n{said}")
    for measure, pattern in (("non_orthogonality", r"non-orthogonality Max: (\S+)"), ("skewness", r"Max skewness = (\S+)")):
        found = float(re.search(pattern, said)[1])
        check(abs(report[measure]["max"] / found - 1) < 1e-4, f"{name}: {measure} {report[measure]['max']}, checkMesh says {found}")


def volume_pair(name, shape, cube, hexes, folder):
    polycube("remesh", shape, "--polycube", cube, "-o", folder, "--hexes", hexes, *FORMATS, "-q", "--max-hausdorff", 5)
    report = json.loads((folder / "report.json").read_text())
    check(report["inverted"] == 0, f"{name}: inverted hexahedra")
    count, blocks = report["hexes"], report["after"]["blocks_padded"]
    for file in ("hexes.vtk", "hexes.vtu"):
        mesh = with_vtk(folder / file, count, report["volume"], ARRAYS)
        cells = mesh.cells.reshape(-1, 9)[:, 1:]
        computed = scaled_jacobians(mesh.points, cells)
        check(numpy.abs(computed - mesh.cell_data["scaled_jacobian"]).max() < 1e-9, f"{name}: scaled Jacobians in {file}")
        check(abs(computed.min() - report["min_sj"]) < 1e-9, f"{name}: least scaled Jacobian")
        check(abs(computed.mean() - report["avg_sj"]) < 1e-9, f"{name}: mean scaled Jacobian")
        same_measures(name, mesh, cells, report)
        check(len(set(mesh.cell_data["block_id"])) == blocks, f"{name}: blocks in {file}")
        check(set(mesh.cell_data["label"]) <= set(range(-1, 6)), f"{name}: labels in {file}")
        with_meshio(folder / file, "hexahedron", count, ARRAYS)
    with_solvers(name, folder, report)
    with_blocks(name, folder, report)
    with_block_mesh(name, folder, report)
    with_vtk(folder / "layout.vtk", blocks, None, ("block_id",))
    found = count_blocks(with_meshio(folder / "hexes.mesh", "hexahedron", count).cells[0].data.tolist())
    check(found == blocks, f"{name}: {found} blocks counted, {blocks} reported")
    check(count_blocks(with_meshio(folder / "layout.vtk", "hexahedron", blocks).cells[0].data.tolist()) == blocks, f"{name}: layout.vtk")
    for file in ("hexes.mesh", "hexes.vtk"):
        with_gmsh(folder / file, 5, count)
    surface(name, folder, report)
    print(f"  {name}: {count} hexahedra in {blocks} blocks, {report['quads']} quadrilaterals in {report['after']['surface_patches']} patches")


def surface(name, folder, report):
    quads = with_meshio(folder / "quads.obj", "quad", report["quads"])
    patches, irregular = count_patches(quads.cells[0].data.tolist())
    expected = report["after"]["surface_patches"]
    check(patches == expected, f"{name}: {patches} patches counted, {expected} reported")
    with_meshio(folder / "layout.obj", "quad", expected)
    mesh = pyvista.read(folder / "quads.obj")
    check(mesh.n_cells == report["quads"], f"VTK: {mesh.n_cells} cells in {folder / 'quads.obj'}")
    with_gmsh(folder / "quads.obj", 3, report["quads"])


def surface_pair(name, shape, cube, folder):
    polycube("remesh", shape, "--polycube", cube, "-o", folder, "--surface-only", "--format", "ply", "-q", "--max-hausdorff", 5)
    report = json.loads((folder / "report.json").read_text())
    surface(name, folder, report)
    faces = plyfile.PlyData.read(folder / "quads.ply")["face"].data  # meshio reads no values of faces in binary files
    check(all(len(f) == 4 for f in faces["vertex_indices"]) and len(faces) == report["quads"], f"{name}: quads.ply")
    check(all(faces.dtype[colour] == "u1" for colour in COLOURS), f"{name}: colours are not bytes")
    check({"label", "block_id"} <= set(faces.dtype.names), f"{name}: fields of quads.ply")
    each = {(f["patch_id"], *(f[colour] for colour in COLOURS)) for f in faces}
    check(len(each) == report["after"]["surface_patches"], f"{name}: one colour for each patch")
    mesh = pyvista.read(folder / "quads.ply")
    check(mesh.n_cells == report["quads"] and mesh.cell_data["RGB"].shape == (mesh.n_cells, 3), f"VTK: colours of {name}")
    print(f"  {name}: {report['quads']} quadrilaterals in {report['after']['surface_patches']} patches, coloured")


def grid(size, solid):
    """The hexahedra of the unit cells that are solid."""
    number = lambda x, y, z: x + (size + 1) * (y + (size + 1) * z)
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = ((x, y, z) for x in range(size) for y in range(size) for z in range(size))
    return [[number(x + i, y + j, z + k) for i, j, k in corners] for x, y, z in cells if solid(x, y, z)]


def polycubes(examples, folder):
    """A polycube of each kind of cells."""
    quads = meshio.read(examples / "ring.polycube.obj")
    halves = numpy.concatenate([quads.cells_dict["quad"][:, corners] for corners in ((0, 1, 2), (0, 2, 3))])
    meshio.write(folder / "triangles.vtk", meshio.Mesh(quads.points, [("triangle", halves)]))
    points = [(x, y, z) for z in range(3) for y in range(3) for x in range(3)]
    hexes = grid(2, lambda x, y, z: True)
    meshio.write(folder / "hexes.vtk", meshio.Mesh(numpy.array(points, float), [("hexahedron", hexes)]))
    volume = examples / "stepped-l.polycube.mesh"
    files = (folder / "triangles.vtk", examples / "ring.polycube.obj", volume, folder / "hexes.vtk")
    return dict(zip(("triangle", "quad", "tetra", "hexahedron"), files))


def main(data):
    # What is known without a program: one block in a cube, three in an L.
    check(count_blocks(grid(3, lambda x, y, z: True)) == 1, "a cube has one block")
    check(count_blocks(grid(2, lambda x, y, z: (x, y) != (1, 1))) == 3, "an L has three blocks")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        polycube("demo", "-q", "-o", folder)
        all_formats(polycube, polycubes(folder / "examples", folder), folder)
        for name in ("stepped-l", "ring"):
            pair = folder / "examples" / name
            volume_pair(name, f"{pair}.shape.mesh", f"{pair}.polycube.mesh", 800, folder / name)
            surface_pair(f"{name}, surface", f"{pair}.shape.obj", f"{pair}.polycube.obj", folder / f"{name}-surface")
        real = data / "marco2016sgp-bunny"
        if data.is_dir():  # tests/readers says so where it is not
            volume_pair("bunny", f"{real}.shape.mesh", f"{real}.polycube.mesh", 3000, folder / "bunny")
    gmsh.finalize()


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
