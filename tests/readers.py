"""Reads the meshes of `polycube remesh` with other programs and counts their blocks and patches independently.

For each pair: meshio, gmsh and VTK (through PyVista) read every file with the counts of the report, every volume is
positive and their sum is the reported one, the scaled Jacobians and the other measures written are those computed here,
the groups for solvers are there by name and complete, OpenFOAM's checkMesh finds no more than one thing wrong and
measures the same, CalculiX reproduces a linear field (both where they are installed), the block structure written is
that of the hexahedra, face by face, blockMesh makes as many of it on the same outside, and the base complex and the patches, traced here from the definition, are as many as reported.
"""

import itertools
import json
import os
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
from patch_test import with_ccx
from solver_measures import all_measures, write_control
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLYCUBE = ROOT / "target/release/polycube"
COLOURS = ("red", "green", "blue")
MEASURES = ("edge_ratio", "determinant", "non_orthogonality", "skewness")
ARRAYS = ("block_id", "label", "scaled_jacobian", *MEASURES)
# Debian's OpenFOAM finds its own files by this alone.
FOAM = {**os.environ, "WM_PROJECT_DIR": "/usr/share/openfoam", "FOAM_SIGFPE": "false"}
# Of each corner of a hexahedron in VTK's order: the ends of its edges, right-handed seen from inside.
CORNERS = ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))
SOLVERS = ("vtk", "msh", "inp", "su2", "foam", "json", "xyz", "blockmesh")
FORMATS = [word for extension in SOLVERS for word in ("--format", extension)]
SIDES = {f"{sign}_{axis}" for sign in ("minus", "plus") for axis in "xyz"}
BLOCK_FACES = ("-i", "+i", "-j", "+j", "-k", "+k")
OCTANTS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def check(truth, message):
    if not truth:
        sys.exit(f"failed: {message}")


def polycube(*arguments):
    command = [str(a) for a in (POLYCUBE, *arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    check(done.returncode in (0, 4), f"{' '.join(command)}\n{done.stdout}{done.stderr}")


class Union:
    """Disjoint sets of the numbers below `count`."""

    def __init__(self, count):
        self.parent = list(range(count))

    def find(self, a):
        while self.parent[a] != a:
            self.parent[a] = self.parent[self.parent[a]]
            a = self.parent[a]
        return a

    def join(self, a, b):
        self.parent[self.find(a)] = self.find(b)

    def sets(self):
        return len({self.find(a) for a in range(len(self.parent))})


def sides(ring):
    return [frozenset((ring[i - 1], ring[i])) for i in range(len(ring))]


def gather(pairs):
    """Lists of the second values by the first."""
    lists = {}
    for key, value in pairs:
        lists.setdefault(key, []).append(value)
    return lists


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


def key(quad):
    return tuple(sorted(quad))


def count_inner_faces(hexes, block):
    """Faces of hexahedra between two blocks, joined over the edges that they share with others between the same two."""
    rings = {key([h[k] for k in face]): [h[k] for k in face] for h in hexes for face in FACES}
    cells_of = gather((key([h[k] for k in face]), i) for i, h in enumerate(hexes) for face in FACES)
    blocks_of = {face: key([block[c] for c in cells]) for face, cells in cells_of.items() if len(cells) == 2}
    between = [face for face, pair in blocks_of.items() if pair[0] != pair[1]]
    number = {face: i for i, face in enumerate(between)}
    sets = Union(len(between))
    for same in gather(((blocks_of[face], side), face) for face in between for side in sides(rings[face])).values():
        for face in same[1:]:
            sets.join(number[same[0]], number[face])
    return sets.sets()


def along(start, end):
    """The places from one to another, both included, where at most one coordinate goes down."""
    return [range(a, b + 1) if a <= b else range(a, b - 1, -1) for a, b in zip(start, end)]


def same_face(name, blocks, grids, b, f):
    """Vertex for vertex a face of a block is that of its neighbour, which looks back."""
    block, there = blocks[b], blocks[b]["faces"][f]
    other = grids[there["block"]]
    back = blocks[there["block"]]["faces"][BLOCK_FACES.index(there["face"])]
    check((back["block"], back["face"]) == (b, BLOCK_FACES[f]), f"{name}: face {f} of block {b} is not looked back at")
    turn = numpy.zeros((3, 3), int)
    for axis, to in enumerate(there["transform"]):
        turn[abs(to) - 1, axis] = numpy.sign(to)
    check(round(numpy.linalg.det(turn)) == 1, f"{name}: {there['transform']} is a mirror")
    start, end = [0, 0, 0], list(block["size"])
    start[f // 2] = end[f // 2] = block["size"][f // 2] if f % 2 else 0
    for at in itertools.product(*along(start, end)):
        to = there["first"] + turn @ (numpy.array(at) - start)
        check(grids[b][at] == other[tuple(to)], f"{name}: face {f} of block {b} at {at}")


def with_blocks(name, folder, report):
    """blocks.json and hexes.xyz have the hexahedra of hexes.mesh, vertex for vertex."""
    file = json.loads((folder / "blocks.json").read_text())
    mesh = pyvista.read(folder / "hexes.vtu")
    hexes, blocks = mesh.cells.reshape(-1, 9)[:, 1:].tolist(), file["blocks"]
    points = numpy.array(file["points"])
    check(numpy.array_equal(points, mesh.points), f"{name}: points of blocks.json")
    check(len(blocks) == report["after"]["blocks_padded"], f"{name}: {len(blocks)} blocks in blocks.json")
    shape = lambda block: [n + 1 for n in block["size"]]
    grids = [numpy.array(block["vertices"]).reshape(shape(block), order="F") for block in blocks]
    found = []
    for number, grid in enumerate(grids):
        corners = numpy.array([grid[i : i - 1 or None, j : j - 1 or None, k : k - 1 or None] for i, j, k in OCTANTS])
        found += [(key(cell), number) for cell in corners.reshape(8, -1).T.tolist()]
    expected = [(key(cell), block) for cell, block in zip(hexes, mesh.cell_data["block_id"].tolist())]
    check(sorted(found) == sorted(expected), f"{name}: hexahedra of blocks.json")
    neighbours = [(b, f) for b, block in enumerate(blocks) for f, face in enumerate(block["faces"]) if "block" in face]
    inner = count_inner_faces(hexes, mesh.cell_data["block_id"].tolist())
    check(len(neighbours) == 2 * inner == 2 * file["inner_faces"], f"{name}: {len(neighbours)} neighbours, {inner} inner faces")
    for b, f in neighbours:
        same_face(name, blocks, grids, b, f)
    for block in blocks:
        check([file["classes"][c] for c in block["class"]] == block["size"], f"{name}: classes of {block['name']}")
    with_plot3d(name, folder / "hexes.xyz", points, grids)


def with_plot3d(name, file, points, grids):
    """VTK reads the points of all blocks, in single precision; in the text they are exact."""
    numbers = file.read_text().split()
    count = int(numbers[0])
    check(count == len(grids), f"{name}: {count} blocks in {file}")
    check([int(n) for n in numbers[1 : 1 + 3 * count]] == [n for g in grids for n in g.shape], f"{name}: sizes in {file}")
    flat = numpy.concatenate([points[g.ravel(order="F")].T.ravel() for g in grids])
    check(numpy.array_equal(flat, numpy.array(numbers[1 + 3 * count :], float)), f"{name}: points of {file}")
    reader = vtkMultiBlockPLOT3DReader(auto_detect_format=False, binary_file=False, multi_grid=True)
    reader.SetXYZFileName(str(file))
    reader.Update()
    read = pyvista.wrap(reader.GetOutput())
    check(read.n_blocks == count, f"{name}: VTK reads {read.n_blocks} blocks of {file}")
    for grid, block in zip(grids, read):
        check(block.dimensions == grid.shape, f"{name}: VTK reads {block.dimensions}, not {grid.shape}")
        check(numpy.allclose(block.points, points[grid.ravel(order="F")], rtol=1e-6, atol=1e-5), f"{name}: VTK in {file}")


def with_block_mesh(name, folder, report):
    """blockMesh makes as many hexahedra, fine ones, and the outside lies where ours does."""
    if not shutil.which("blockMesh"):
        print("  blockMesh is left out: there is no OpenFOAM.")
        return
    case = folder / "blockmesh"
    write_control(case)
    done = subprocess.run(["blockMesh", "-case", case], capture_output=True, text=True, env=FOAM, timeout=600)
    check(done.returncode == 0, f"{name}: blockMesh says\n{done.stdout}{done.stderr}")
    said = subprocess.run(["checkMesh", "-case", case], capture_output=True, text=True, env=FOAM, timeout=600).stdout
    check("Mesh OK." in said, f"{name}: checkMesh says of blockMesh\n{said}")
    check(f" hexahedra:     {report['hexes']}\n" in said, f"{name}: hexahedra of blockMesh\n{said}")
    check(f" cell zones:       {report['after']['blocks_padded']}\n" in said, f"{name}: zones of blockMesh\n{said}")
    mesh = case / "constant/polyMesh"
    text = {file: (mesh / file).read_text().split("\n(\n")[1] for file in ("points", "faces")}
    points = numpy.array([line.strip("()").split() for line in text["points"].split("\n)")[0].splitlines()], float)
    faces = [line[2:-1].split() for line in text["faces"].split("\n)")[0].splitlines()]
    start = min(map(int, re.findall(r"startFace\s+(\d+)", (mesh / "boundary").read_text())))
    outside = numpy.unique(numpy.array(faces[start:], int))
    ours = pyvista.read(folder / "quads.obj")
    check(len(outside) == ours.n_points, f"{name}: {len(outside)} vertices outside, not {ours.n_points}")
    cloud = pyvista.PolyData(points[outside]).compute_implicit_distance(ours.triangulate())
    off = numpy.abs(cloud["implicit_distance"]).max() / ours.length
    check(off < 0.0035, f"{name}: blockMesh is {100 * off} % of the diagonal off our outside")
    print(f"  {name}: blockMesh is {100 * off:.3f} % of the diagonal off our outside")


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


def main(data):
    # What is known without a program: one block in a cube, three in an L.
    check(count_blocks(grid(3, lambda x, y, z: True)) == 1, "a cube has one block")
    check(count_blocks(grid(2, lambda x, y, z: (x, y) != (1, 1))) == 3, "an L has three blocks")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        polycube("demo", "-q", "-o", folder)
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
