"""The block structure that `polycube remesh` writes, held against its hexahedra, and made anew by OpenFOAM's blockMesh.

Used by tests/readers.py.
"""

import itertools
import json
import re
import shutil
import subprocess

import numpy
import pyvista
from reading import FACES, FOAM, Union, check, gather, sides
from solver_measures import write_control
from vtkmodules.vtkIOParallel import vtkMultiBlockPLOT3DReader

BLOCK_FACES = ("-i", "+i", "-j", "+j", "-k", "+k")
OCTANTS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


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
