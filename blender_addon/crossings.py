# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a shape that cross each other. Quadrilaterals can be made all the same; hexahedra overlap there."""

import polycube

REMEDY = "a Remesh modifier joins what crosses; so does Face > Intersect (Boolean)"


def crossing(mesh):
    """Every two faces of a mesh of the core that cross, as what is wrong with the first."""
    return [violation for violation in polycube.check_shape(mesh) if violation.kind == "crossing_faces"]


def warn(operator, read, level='WARNING'):
    """Tells where hexahedra of a plain shape would overlap."""
    found = crossing(read.shape) if read.plain else ()
    if len(found):
        text = f"{len(found)} pairs of faces of {read.holder} cross; hexahedra overlap there ({REMEDY})"
        operator.report({level}, text)
