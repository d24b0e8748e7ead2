"""What solvers look at in a mesh of hexahedra, computed with numpy from the definitions.

Used by tests/readers.py. Non-orthogonality and skewness are those of OpenFOAM's primitiveMeshTools.
"""

import numpy

EDGES = numpy.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])
# Of each corner in VTK's order itself and the ends of its edges, right-handed seen from inside.
CORNERS = numpy.array(
    [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]
)
# Counter-clockwise seen from outside.
FACES = numpy.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
TINY = 1e-150
HEADER = 'FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {};\n    location "{}";\n    object {};\n}}\n'
CONTROL = (
    "application checkMesh;\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1;\ndeltaT 1;\n"
    "writeControl timeStep;\nwriteInterval 1;\n"
)
SCHEMES = "gradSchemes {}\ndivSchemes {}\nlaplacianSchemes {}\n"


def row_dot(a, b):
    return numpy.einsum("ij,ij->i", a, b)


def norm(a):
    return numpy.linalg.norm(a, axis=-1)


def edge_ratios(points, hexes):
    lengths = norm(points[hexes[:, EDGES[:, 0]]] - points[hexes[:, EDGES[:, 1]]])
    return lengths.max(axis=1) / lengths.min(axis=1)


def determinants(points, hexes):
    """The least of each cell, and all of them over their mean."""
    corners = points[hexes][:, CORNERS]
    edges = corners[:, :, 1:] - corners[:, :, :1]
    each = numpy.linalg.det(edges)
    return each.min(axis=1) / each.mean()


def faces_of(hexes):
    """Faces with owner and neighbour in OpenFOAM's order: inner ones by these, then those of the surface."""
    faces = hexes[:, FACES].reshape(-1, 4)
    cells = numpy.repeat(numpy.arange(len(hexes)), 6)
    keys = numpy.sort(faces, axis=1)
    order = numpy.lexsort((cells, *keys.T))
    twin = numpy.append((keys[order][1:] == keys[order][:-1]).all(axis=1), False)
    second = numpy.append(False, twin[:-1])
    own, other, lone = order[twin], order[second], order[~twin & ~second]
    inner = numpy.lexsort((cells[other], cells[own]))
    own, other = own[inner], other[inner]
    lone = lone[numpy.argsort(cells[lone], kind="stable")]
    both = numpy.concatenate((own, lone))
    return faces[both], cells[both], cells[other]


def centres_and_areas(points, faces):
    """Of quadrilaterals, as four triangles around the mean of the corners."""
    corners = points[faces]
    mean = corners.mean(axis=1)
    after = numpy.roll(corners, -1, axis=1)
    normals = numpy.cross(after - corners, mean[:, None] - corners)
    weights = norm(normals)
    moments = (weights[..., None] * (corners + after + mean[:, None])).sum(axis=1)
    return moments / (3 * weights.sum(axis=1)[:, None]), normals.sum(axis=1) / 2


def middles(points, hexes):
    """Of hexahedra, as pyramids over their faces."""
    centres, areas = centres_and_areas(points, hexes[:, FACES].reshape(-1, 4))
    centres, areas = centres.reshape(-1, 6, 3), areas.reshape(-1, 6, 3)
    mean = centres.mean(axis=1, keepdims=True)
    volumes = (areas * (centres - mean)).sum(axis=2)
    return ((0.75 * centres + 0.25 * mean) * volumes[..., None]).sum(axis=1) / volumes.sum(axis=1)[:, None]


def largest_of_cells(count, cells, values):
    largest = numpy.zeros(count)
    numpy.maximum.at(largest, cells, values)
    return largest


def face_measures(points, hexes):
    """Of each cell the largest non-orthogonality, in degrees, and the largest skewness."""
    faces, owner, neighbour = faces_of(hexes)
    inner = len(neighbour)
    centres, areas = centres_and_areas(points, faces)
    middle = middles(points, hexes)
    arms = centres - middle[owner]
    normals = areas / norm(areas)[:, None]
    lines = normals * row_dot(normals, arms)[:, None]
    lines[:inner] = middle[neighbour] - middle[owner[:inner]]
    cosines = row_dot(lines[:inner], areas[:inner]) / (norm(lines[:inner]) * norm(areas[:inner]))
    angles = numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))
    off = arms - lines * (row_dot(areas, arms) / (row_dot(areas, lines) + TINY))[:, None]
    towards = off / (norm(off) + TINY)[:, None]
    extents = numpy.abs(((points[faces] - centres[:, None]) * towards[:, None]).sum(axis=2)).max(axis=1)
    least = numpy.where(numpy.arange(len(faces)) < inner, 0.2, 0.4) * norm(lines)
    skew = norm(off) / (numpy.maximum(extents, least) + TINY)
    pairs, both = numpy.concatenate((owner[:inner], neighbour)), numpy.concatenate((owner, neighbour))
    count = len(hexes)
    return largest_of_cells(count, pairs, numpy.tile(angles, 2)), largest_of_cells(
        count, both, numpy.concatenate((skew, skew[:inner]))
    )


def all_measures(points, hexes):
    angles, skewness = face_measures(points, hexes)
    return {
        "edge_ratio": edge_ratios(points, hexes),
        "determinant": determinants(points, hexes),
        "non_orthogonality": angles,
        "skewness": skewness,
    }


def write_control(case):
    """What checkMesh and blockMesh want beside the mesh of a case."""
    system = case / "system"
    system.mkdir(exist_ok=True)
    for name, body in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", "")):
        (system / name).write_text(HEADER.format("dictionary", "system", name) + body)
