# SPDX-License-Identifier: GPL-3.0-or-later
"""Hexahedra as a mesh that is cut open: those on one side of a plane, whole, with what they show."""

import numpy as np

from . import colours, results

# The faces of a hexahedron in VTK's order, outward.
_FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
# The side that the cut begins at, along each axis: that which Blender's first view looks at.
_SIDES = {'X': (0, 1.0), 'Y': (1, -1.0), 'Z': (2, 1.0)}
# What a file or a mesh has of every hexahedron.
FIELDS = ("block_id", "label", "scaled_jacobian", "edge_ratio", "determinant", "non_orthogonality", "skewness")


class Hexahedra:
    """Hexahedra with what is needed to cut them open again and again."""

    def __init__(self, hexes, size):
        """`size` is the scale of the object that they belong to."""
        self.points = hexes.points / size
        self.fields = {name: getattr(hexes, name) for name in FIELDS}
        cells = hexes.cells.astype(np.int64)
        self.middles = self.points[cells].mean(axis=1)
        self.faces = cells[:, _FACES].reshape(-1, 4)
        self.cell = np.repeat(np.arange(len(cells)), 6)
        self.beyond = _beyond(self.faces, self.cell)

    def fill(self, mesh, axis, part):
        """Shows what is left once the hexahedra of a part of the length along an axis, 0 to 1, are taken away."""
        shown = self._shown(axis, part)
        used, faces = np.unique(self.faces[shown], return_inverse=True)
        mesh.clear_geometry()
        results.set_faces(mesh, self.points[used], faces.reshape(-1, 4))
        colours.write(mesh, **{name: values[self.cell[shown]] for name, values in self.fields.items()})

    def _shown(self, axis, part):
        """The faces between what is left and what is not there."""
        along, sign = _SIDES[axis]
        place = sign * self.points[:, along]
        left = sign * self.middles[:, along] <= place.max() - part * np.ptp(place)
        # The cell beyond the surface is the last one, which is never there.
        left = np.append(left, False)
        return np.flatnonzero(left[self.cell] & ~left[self.beyond])


def _beyond(faces, cell):
    """For every face the cell on its other side; -1 where there is none."""
    corners = np.sort(faces, axis=1)
    order = np.lexsort(corners.T)
    same = (corners[order[1:]] == corners[order[:-1]]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    found = np.full(len(faces), -1)
    found[first], found[second] = cell[second], cell[first]
    return found
