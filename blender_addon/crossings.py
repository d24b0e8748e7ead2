# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a shape that cross each other. Quadrilaterals can be made all the same; hexahedra overlap there."""

import numpy as np
from mathutils.bvhtree import BVHTree

REMEDY = "a Remesh modifier joins what crosses; so does Face > Intersect (Boolean)"


def crossing(mesh):
    """The cells of a mesh of the core that cross others, in ascending order."""
    tree = BVHTree.FromPolygons(mesh.points.tolist(), mesh.cells.tolist())
    pairs = np.array(tree.overlap(tree), dtype=np.int64).reshape(-1, 2)
    first, second = mesh.cells[pairs[:, 0]], mesh.cells[pairs[:, 1]]
    # Neighbours always touch.
    apart = ~(first[:, :, None] == second[:, None, :]).any(axis=(1, 2))
    return np.unique(pairs[apart, 0])


def warn(operator, read, level='WARNING'):
    """Tells where hexahedra of a plain shape would overlap."""
    found = crossing(read.shape) if read.plain else ()
    if len(found):
        text = f"{len(found)} faces of {read.holder} cross others; hexahedra overlap there ({REMEDY})"
        operator.report({level}, text)
