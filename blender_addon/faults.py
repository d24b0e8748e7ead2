# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be done is said where it is wrong: in Blender's status bar and on the mesh itself."""

import bmesh
import bpy
import polycube

# More reports than this would hide the first one.
MOST_REPORTED = 5


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
        violations = polycube.check(source.polycube, shape=source.shape, **operator.tolerances())
        if violations:
            return report_all(operator, context, violations, source)
    operator.report({'ERROR'}, _sentence(str(error)))
    if source is not None and getattr(error, "elements", None):
        show(context, source, [(error.element, error.elements)])
    return {'CANCELLED'}


def report_all(operator, context, violations, source):
    """Reports what keeps a mesh from being a polycube, rule by rule, and selects all places."""
    rules = {}
    for violation in violations:
        rules.setdefault(violation.kind, []).append(violation)
    for found in list(rules.values())[:MOST_REPORTED]:
        more = f"; {len(found) - 1} more like it" if len(found) > 1 else ""
        first = found[0]
        operator.report({'ERROR'}, _sentence(f"{_where(first, source)}{first.message}{more} ({first.remedy})"))
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
        return [bm.faces[source.polygon_of_cell[i]] for i in numbers]
    vertices = [bm.verts[i] for i in numbers] if kind in {"vertex", "edge"} else []
    edge = bm.edges.get(vertices) if kind == "edge" else None
    return [edge] if edge else vertices
