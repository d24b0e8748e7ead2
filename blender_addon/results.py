# SPDX-License-Identifier: GPL-3.0-or-later
"""The simplified polycube in Blender: as a new object or a new shape key, with face attributes and numbers."""

import bpy
import numpy as np
import polycube

from . import colours, faults
from .source import ORIGIN, visible

KEY_NAME = "Simplified"
# The custom property that tells results from other objects, and of what kind they are.
KIND = "polycube_result"
# The custom property with the name that a result was given: under another one it is kept.
NAME = "polycube_name"
# Results whose faces are what one wants to see.
WIRED = ("Quads", "Hexes")


def check_output(source, output):
    """Refuses, before the work begins, a result that could not be put where it is wanted."""
    if not _as_key(source, output):
        return
    if source.plain:
        raise faults.Refused(
            "the result cannot be a shape key: a polycube that is made has vertices of its own",
            "take a new object as the result, or press Make Polycube first",
        )
    if not source.editable:
        raise faults.Refused(
            "the result cannot be a shape key: modifiers make other vertices than those of the mesh",
            "apply them, or take a new object as the result",
        )
    holder = bpy.data.objects[source.holder]
    if holder.library is not None or holder.data.library is not None:
        raise faults.Refused(f"{holder.name} is linked from another file", "take a new object as the result")


def _as_key(source, output):
    """Whether the result becomes a shape key; an object otherwise."""
    return output == 'KEY' or (output == 'AUTO' and source.key is not None and source.editable)


def place(context, source, simplified, output):
    """Makes a shape key or object of a result, in place of an earlier one, and shows it. The input is kept, hidden
    where it is covered."""
    if simplified.polycube is None:
        raise faults.Refused("rounding broke the polycube: " + "; ".join(simplified.notes), "use the strategy Best or Paper")
    as_key = _as_key(source, output)
    holder = bpy.data.objects[source.holder]
    obj, key = (holder, _key_of(holder, source.key)) if as_key else (_new_object(context, holder, source), "")
    result = context.scene.polycube.result
    result.object, result.key, result.meshed = obj, key, ""
    update(context, source, simplified)
    show(context, source, [obj], [holder])


def inputs(source):
    """The objects that a result is made of."""
    return [bpy.data.objects[name] for name in (source.holder, source.shape_name) if name]


def show(context, source, objects, covered):
    """Shows new results and selects the first. Hides other results of the same objects, and what the new ones cover."""
    origins = inputs(source)
    for other in context.view_layer.objects:
        if other in covered or (other.get(KIND) and other.get(ORIGIN) in origins):
            other.hide_set(other not in objects)
    faults.enter(context, objects[0])
    colours.show(context, objects[0])


def update(context, source, simplified):
    """Moves the vertices of the result shown, and writes its attributes and numbers."""
    settings = context.scene.polycube
    obj = settings.result.object
    if obj is None or simplified.polycube is None:
        return
    mesh = obj.data
    points = ((simplified.polycube.points / simplified.scale + source.offset) / source.size).astype(np.float32).ravel()
    if mesh.is_editmode or (3 * len(mesh.vertices), len(mesh.polygons)) != (len(points), source.polygon_count):
        settings.result.notes = f"{obj.name} is in edit mode or has other faces by now: leave edit mode, or simplify again"
        return
    if settings.result.key:
        key = mesh.shape_keys.key_blocks.get(settings.result.key)
        if key is None:
            return
        key.data.foreach_set("co", points)
    else:
        mesh.vertices.foreach_set("co", points)
    structure = polycube.structure(simplified.polycube, labels=simplified.labels)
    first = _first_cell(source)
    colours.write(mesh, block_id=structure.block_id[first], label=structure.label[first])
    colours.paint(mesh, settings.colour)
    _count(settings.result, simplified)


def _first_cell(source):
    """For every polygon the first of its cells."""
    return np.searchsorted(source.polygon_of_cell, np.arange(source.polygon_count))


def _count(result, simplified):
    before, after = simplified.counts_before, simplified.counts_after
    result.patches = before.surface_patches, after.surface_patches
    result.blocks = before.blocks, after.blocks
    result.padded = before.blocks_padded, after.blocks_padded
    result.displacement = simplified.report["max_displacement"]
    result.notes = "\n".join(simplified.notes)


def _key_of(holder, taken):
    """The shape key for a result: that of an earlier one, unless it is the one that is simplified, or a new one."""
    if holder.data.shape_keys is None:
        holder.shape_key_add(name="Basis", from_mix=False)
    for key in holder.data.shape_keys.key_blocks[1:]:
        key.value = 0.0
    named = (key for key in holder.data.shape_keys.key_blocks if key.name.split(".")[0] == KEY_NAME)
    key = next((key for key in named if key.name != taken), None)
    if key is None:
        key = holder.shape_key_add(name=KEY_NAME, from_mix=False)
    key.value = 1.0
    holder.active_shape_key_index = holder.data.shape_keys.key_blocks.find(key.name)
    return key.name


def _new_object(context, holder, source):
    if source.made:
        mesh = bpy.data.meshes.new("Simplified")
        set_faces(mesh, source.shape.points / source.size, source.shape.cells)
        return new_object(context, holder, "Simplified", mesh)
    with visible(context, holder):
        depsgraph = context.evaluated_depsgraph_get()
        evaluated = holder.evaluated_get(depsgraph)
        mesh = bpy.data.meshes.new_from_object(evaluated, preserve_all_data_layers=True, depsgraph=depsgraph)
    return new_object(context, holder, "Simplified", mesh)


def set_faces(mesh, points, cells):
    """Fills an empty mesh with triangles or quadrilaterals."""
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.loops.add(cells.size)
    mesh.loops.foreach_set("vertex_index", cells.astype(np.int32).ravel())
    mesh.polygons.add(len(cells))
    mesh.polygons.foreach_set("loop_start", np.arange(0, cells.size, cells.shape[1], dtype=np.int32))
    mesh.update(calc_edges=True)


def new_object(context, like, kind, data):
    """The object for a result of a kind: it lies where `like` lies, in the same collections. One of the same kind that
    was made of the same object before gets the new data, unless the user has renamed or copied it."""
    obj = _earlier(context, like, kind)
    if obj is None:
        obj = beside(context, like, f"{like.name} {kind}", data)
        obj.show_wire = obj.show_all_edges = kind in WIRED
    else:
        _exchange(obj, data)
        obj.matrix_world = like.matrix_world
    obj[KIND], obj[ORIGIN], obj[NAME] = kind, like, obj.name
    return obj


def _earlier(context, like, kind):
    for obj in context.view_layer.objects:
        if obj.get(KIND) == kind and obj.get(ORIGIN) == like and obj.get(NAME) == obj.name:
            return obj
    return None


def _exchange(obj, data):
    old, collection = obj.data, bpy.data.meshes if obj.type == 'MESH' else bpy.data.curves
    name, obj.data = old.name, data
    if old.users == 0:
        collection.remove(old)
        data.name = name


def join(obj, parts):
    """Makes the parts of a result follow it, and removes those that an earlier one had."""
    for part in list(obj.children):
        if part.get(KIND) and part.get(NAME) == part.name and part not in parts:
            bpy.data.objects.remove(part)
    for part in parts:
        place = part.matrix_world.copy()
        part.parent, part.matrix_parent_inverse = obj, obj.matrix_world.inverted()
        part.matrix_world = place


def beside(context, like, name, data):
    """A new object that lies where `like` lies, in the same collections."""
    data.name = name
    obj = bpy.data.objects.new(name, data)
    for collection in like.users_collection or [context.scene.collection]:
        collection.objects.link(obj)
    obj.matrix_world = like.matrix_world
    return obj
