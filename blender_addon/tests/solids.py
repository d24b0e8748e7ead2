# SPDX-License-Identifier: GPL-3.0-or-later
"""Small polycubes made for the tests, and the ways to look at meshes of Blender."""

import itertools

import bpy
import numpy as np
import polycube

# A plate with a tower on either side; the towers miss each other by one step along x and y.
BOXES = (((0, 0, 0), (9, 8, 2)), ((2, 2, 2), (5, 5, 5)), ((3, 3, -3), (6, 6, 0)))

# The corners of a cube's faces, counter-clockwise seen from outside, by the direction that the face looks.
FACES = {
    (1, 0, 0): ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
    (-1, 0, 0): ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)),
    (0, 1, 0): ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
    (0, -1, 0): ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)),
    (0, 0, 1): ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)),
    (0, 0, -1): ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)),
}


def solid(boxes=BOXES):
    """Points and quadrilaterals of the surface of a union of boxes."""
    cells = {c for low, high in boxes for c in itertools.product(*map(range, low, high))}
    numbers, quads = {}, []
    for cell in sorted(cells):
        for normal, corners in FACES.items():
            if tuple(np.add(cell, normal)) not in cells:
                quads.append([numbers.setdefault(tuple(np.add(cell, c)), len(numbers)) for c in corners])
    return np.array(list(numbers), dtype=float), quads


def bent(points):
    """A shape that such a polycube could have come from."""
    x, y, z = points.T
    return np.column_stack([x + 0.3 * np.sin(0.4 * z), y + 0.02 * x * x, z + 0.2 * np.cos(0.5 * x)])


def add(name, points, faces):
    """A new object in the scene."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(points).tolist(), [], [list(map(int, f)) for f in faces])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def add_pair(points, faces):
    """Shape and polycube as two objects."""
    return add("Body", bent(points), faces), add("Cube", points, faces)


def points_of(mesh):
    """(n, 3) points of a mesh, in single precision as Blender has them."""
    return np.array([v.co[:] for v in mesh.vertices], dtype=np.float32)


def key_points(obj, name):
    """(n, 3) points of a shape key."""
    return np.array([p.co[:] for p in obj.data.shape_keys.key_blocks[name].data], dtype=np.float32)


def faces_of(mesh):
    """The vertices of every polygon."""
    return [list(p.vertices) for p in mesh.polygons]


def mesh_of(points, faces):
    """A mesh of triangles or quadrilaterals for the core."""
    faces = np.array(faces)
    return polycube.Mesh(np.asarray(points, dtype=float), faces, kind="quads" if faces.shape[1] == 4 else "triangles")


def write(path, points, faces):
    """A mesh file for the command."""
    mesh_of(points, faces).write(path)
    return path


def values(mesh, name):
    """An attribute of the faces."""
    return [item.value for item in mesh.attributes[name].data]


def snapshot():
    """Everything about the meshes in the file that an operator that fails must leave alone."""
    found = {}
    for obj in bpy.data.objects:
        keys = obj.data.shape_keys.key_blocks.keys() if obj.type == 'MESH' and obj.data.shape_keys else ()
        found[obj.name] = (points_of(obj.data).tobytes(), tuple(keys), obj.data.attributes.keys())
    return found
