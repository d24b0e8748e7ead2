"""Writes small files of every format into a folder, each after the byte that chooses it in the target `files`."""

import pathlib
import struct
import sys

POINTS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
HEX = (0, 1, 3, 2, 4, 5, 7, 6)


def lines(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def off(quads):
    return f"OFF\n8 {len(quads)} 0\n" + lines(POINTS) + lines((len(q), *q) for q in quads)


def obj(quads):
    return lines(("v", *p) for p in POINTS) + lines(("f", *(v + 1 for v in q)) for q in quads)


def ply(quads):
    head = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    return head + "element face 6\nproperty list uchar int vertex_indices\nend_header\n" + lines(POINTS) + lines((4, *q) for q in quads)


def stl(quads):
    triangle = lambda a, b, c: "facet normal 0 0 0\nouter loop\n" + lines(("vertex", *POINTS[v]) for v in (a, b, c)) + "endloop\nendfacet\n"
    return "solid\n" + "".join(triangle(a, b, c) + triangle(a, c, d) for a, b, c, d in quads) + "endsolid\n"


def medit():
    points = "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n" + lines((*p, 0) for p in POINTS)
    return points + "Hexahedra\n1\n" + lines([(*(v + 1 for v in HEX), 0)]) + "End\n"


def vtk():
    head = "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n" + lines(POINTS)
    return head + "CELLS 1 9\n" + lines([(8, *HEX)]) + "CELL_TYPES 1\n12\nCELL_DATA 1\nSCALARS q double 1\nLOOKUP_TABLE default\n1\n"


def vtu():
    array = lambda kind, name, text, extra="": f'<DataArray type="{kind}" Name="{name}" {extra} format="ascii">{text}</DataArray>'
    points = array("Float64", "Points", lines(POINTS), 'NumberOfComponents="3"')
    cells = array("Int64", "connectivity", lines([HEX])) + array("Int64", "offsets", 8) + array("UInt8", "types", 12)
    piece = f'<Piece NumberOfPoints="8" NumberOfCells="1"><Points>{points}</Points><Cells>{cells}</Cells></Piece>'
    return f'<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>{piece}</UnstructuredGrid></VTKFile>'


def vtp(quads):
    array = lambda kind, name, text, extra="": f'<DataArray type="{kind}" Name="{name}" {extra} format="ascii">{text}</DataArray>'
    points = array("Float64", "Points", lines(POINTS), 'NumberOfComponents="3"')
    polygons = array("Int64", "connectivity", lines(quads)) + array("Int64", "offsets", lines([range(4, 25, 4)]))
    piece = f'<Piece NumberOfPoints="8" NumberOfPolys="6"><Points>{points}</Points><Polys>{polygons}</Polys></Piece>'
    return f'<VTKFile type="PolyData" version="0.1"><PolyData>{piece}</PolyData></VTKFile>'


def msh():
    head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 8 1 8\n3 1 0 8\n" + lines([(i,) for i in range(1, 9)])
    return head + lines(POINTS) + "$EndNodes\n$Elements\n1 1 1 1\n3 1 5 1\n" + lines([(1, *(v + 1 for v in HEX))]) + "$EndElements\n"


def inp():
    nodes = "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(POINTS, 1))
    return "*NODE\n" + nodes + "*ELEMENT, TYPE=C3D8\n1, " + ", ".join(str(v + 1) for v in HEX) + "\n"


def meshb():
    def section(keyword, at, contents):
        return struct.pack("<iq", keyword, at + 12 + len(contents)) + contents

    head = struct.pack("<ii", 1, 3)
    for keyword, contents in (
        (3, struct.pack("<i", 3)),
        (4, struct.pack("<i", 8) + b"".join(struct.pack("<dddi", *p, 0) for p in POINTS)),
        (10, struct.pack("<i8ii", 1, *(v + 1 for v in HEX), 0)),
    ):
        head += section(keyword, len(head), contents)
    return head + struct.pack("<iq", 54, 0)


GUIDES = '{"fixed": [1], "together": [[0, 2]], "apart": [[3, 4]], "symmetry": [{"axis": 0, "at": 1.5}]}'


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    # In the order of the formats in the library.
    texts = [obj(QUADS), off(QUADS), ply(QUADS), stl(QUADS), medit(), meshb(), vtk(), vtu(), vtp(QUADS), msh(), inp()]
    texts += ["0\n1\n-1\n5\n", GUIDES]
    for choice, text in enumerate(texts):
        (folder / f"seed-{choice}").write_bytes(bytes([choice]) + (text if isinstance(text, bytes) else text.encode()))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
