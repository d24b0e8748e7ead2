# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of a layout as curves that can be seen: singular edges and the borders of patches."""

import bpy
import numpy as np

from . import results

# Thickness of the lines as a part of the diagonal of the shape.
SINGULAR, BORDER = 1 / 300, 1 / 700


def singular(context, like, obj, meshes, size):
    """The edges of the block structure at which an irregular number of blocks meet."""
    lines = [edge.points / size for edge in meshes.layout.singular_edges]
    return _object(context, like, obj, "Singular Edges", lines, SINGULAR, (0.9, 0.25, 0.02, 1.0))


def borders(context, like, obj, meshes, size):
    """The borders between the patches of the surface."""
    quads = meshes.quads
    lines = [quads.points[pair] / size for pair in _border_edges(quads)]
    return _object(context, like, obj, "Patch Borders", lines, BORDER, (0.02, 0.02, 0.02, 1.0))


def _border_edges(quads):
    """(n, 2) vertices of the mesh edges that have different patches on their two sides."""
    cells = quads.cells.astype(np.int64)
    edges = np.sort(np.stack([cells, np.roll(cells, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    patch = np.repeat(quads.patch_id, 4)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    first, second = order[0::2], order[1::2]
    return edges[first][patch[first] != patch[second]]


def _object(context, like, obj, name, lines, thickness, colour):
    if not lines:
        return []
    curve = bpy.data.curves.new(name, 'CURVE')
    curve.dimensions = '3D'
    curve.bevel_depth = thickness * float(np.linalg.norm(np.array(obj.bound_box[6]) - np.array(obj.bound_box[0])))
    curve.bevel_resolution = 1
    for points in lines:
        spline = curve.splines.new('POLY')
        spline.points.add(len(points) - 1)
        spline.points.foreach_set("co", np.column_stack([points, np.ones(len(points))]).astype(np.float32).ravel())
    curve.materials.append(_material(name, colour))
    return [results.new_object(context, like, f"{obj[results.KIND]} {name}", curve)]


def _material(name, colour):
    material = bpy.data.materials.get(f"Polycube {name}") or bpy.data.materials.new(f"Polycube {name}")
    material.diffuse_color = colour
    return material
