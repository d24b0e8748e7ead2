# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be done is said where it is wrong: in Blender's status bar and on the mesh itself."""

import bmesh
import bpy
import polycube

from . import crossings

# More reports than this would hide the first one.
MOST_REPORTED = 5
# What to do about a broken rule, in Blender's own words.
REMEDIES = {
    "empty": "add faces in edit mode, or choose another object",
    "bad_face": "Mesh > Clean Up > Degenerate Dissolve",
    "flat_face": "Mesh > Clean Up > Degenerate Dissolve",
    "open_edge": "Mesh > Merge > By Distance where vertices lie at one place, else Mesh > Clean Up > Fill Holes, or a "
    "Solidify or Remesh modifier",
    "non_manifold_edge": "delete double and inner faces: Mesh > Merge > By Distance, Select > All by Trait > Interior "
    "Faces, Mesh > Delete > Faces",
    "inconsistent_orientation": "Mesh > Normals > Recalculate Outside",
    "inside_out": "Mesh > Normals > Recalculate Outside",
    "non_manifold_vertex": "Vertex > Rip Vertices for each sheet",
}
# What keeps any shape from having a polycube; other rules are about polycubes.
OF_SURFACES = ("empty", "bad_face", "open_edge", "non_manifold_edge", "inconsistent_orientation", "non_manifold_vertex")
# What to do where no polycube is found although the surface is sound.
UNMADE = {
    polycube.InvalidMesh: "Mesh > Normals > Recalculate Outside",
    polycube.InvalidPolycube: "raise Detail, or rework the shape around the face selected: Edge > Subdivide, Vertex > "
    "Smooth Vertices",
}


class Refused(Exception):
    """What is asked for makes no sense yet, and what to do about it."""

    def __init__(self, message, remedy=""):
        super().__init__(f"{message} ({remedy})" if remedy else message)


class Broken(Refused):
    """A mesh that is none, and where."""

    def __init__(self, error, source):
        super().__init__(str(error))
        self.source, self.element, self.elements = source, error.element, error.elements


def report(operator, context, error, source=None):
    """Reports an error and shows its place. Gives what the operator returns."""
    source = getattr(error, "source", source)
    if isinstance(error, polycube.Cancelled):
        operator.report({'WARNING'}, "Cancelled; nothing was changed")
        return {'CANCELLED'}
    if source is not None and isinstance(error, (polycube.InvalidMesh, polycube.InvalidPolycube)):
        # The error tells of the first violation only.
        found = violations(source, operator)
        if found:
            return report_all(operator, context, found, source)
    operator.report({'ERROR'}, _sentence(_text(error, source)))
    if source is not None and getattr(error, "elements", None):
        show(context, source, [(error.element, error.elements)])
    return {'CANCELLED'}


def violations(source, operator):
    """Everything that is wrong with a polycube, or with a shape that one is to be made of."""
    if source.polycube is not None:
        return polycube.check(source.polycube, labels=source.labels, shape=source.shape, **operator.tolerances())
    return [v for v in polycube.check(source.shape) if v.kind in OF_SURFACES]


def _text(error, source):
    """An error in Blender's words where the core's are others."""
    unmade = source is not None and source.plain and source.polycube is None
    remedy = UNMADE.get(type(error)) if unmade else None
    return f"{error.message} ({remedy})" if remedy else str(error)


def report_folds(operator, source):
    """Warns where the map to a polycube that was made is not one to one."""
    folded = source.made.report["folded"] if source.made else ()
    if folded:
        text = f"{len(folded)} triangles are turned over on the polycube (raise Detail, or smooth the shape)"
        operator.report({'WARNING'}, text)


def report_all(operator, context, violations, source):
    """Reports what keeps a mesh from being a polycube, rule by rule, and selects all places."""
    rules = {}
    for violation in violations:
        rules.setdefault(violation.kind, []).append(violation)
    for found in list(rules.values())[:MOST_REPORTED]:
        more = f"; {len(found) - 1} more like it" if len(found) > 1 else ""
        first = found[0]
        operator.report({'ERROR'}, _sentence(f"{_where(first, source)}{first.message}{more} "
                                          f"({REMEDIES.get(first.kind, first.remedy)})"))
    if source.plain:
        crossings.warn(operator, source, 'ERROR')
    show(context, source, [(v.element, v.elements) for v in violations if v.element])
    return {'CANCELLED'}


def _where(violation, source):
    if violation.element in {"face", "cell"}:
        return f"face {source.polygon_of_cell[violation.elements[0]]}: "
    if violation.element:
        return f"{violation.element} {'-'.join(map(str, violation.elements))}: "
    return ""


def _sentence(text):
    return text[:1].upper() + text[1:]


def show(context, source, places):
    """Selects elements of the polycube in edit mode. `places` are pairs of the kind of element and its numbers."""
    obj = bpy.data.objects.get(source.holder)
    if not source.editable or obj is None or obj.library is not None or obj.name not in context.view_layer.objects:
        return
    obj.hide_set(False)
    enter(context, obj)
    if source.key:
        obj.active_shape_key_index = obj.data.shape_keys.key_blocks.find(source.key)
    bpy.ops.object.mode_set(mode='EDIT')
    kinds = {kind for kind, _ in places}
    context.tool_settings.mesh_select_mode = (
        "vertex" in kinds,
        "edge" in kinds,
        not kinds & {"vertex", "edge"},
    )
    _select(obj.data, source, places)


def enter(context, obj):
    """Makes an object the active and only selected one, in object mode."""
    if context.view_layer.objects.active and context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')
    for other in context.view_layer.objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj


def _select(mesh, source, places):
    bm = bmesh.from_edit_mesh(mesh)
    for elements in (bm.verts, bm.edges, bm.faces):
        elements.ensure_lookup_table()
        for element in elements:
            element.select_set(False)
    for kind, numbers in places:
        for element in _elements(bm, source, kind, numbers):
            element.select_set(True)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _elements(bm, source, kind, numbers):
    if kind in {"face", "cell"}:
        # Numbers beyond those of the mesh are of faces that were cut to make a polycube.
        return [bm.faces[source.polygon_of_cell[i]] for i in numbers if i < len(source.polygon_of_cell)]
    vertices = [bm.verts[i] for i in numbers] if kind in {"vertex", "edge"} else []
    edge = bm.edges.get(vertices) if kind == "edge" else None
    return [edge] if edge else vertices
