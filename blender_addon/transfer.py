# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, vertex groups and UV maps of a shape, carried over to another mesh of the same surface."""

import bpy
from mathutils.bvhtree import BVHTree


def carry_over(context, shape, obj):
    """Gives `obj`, whose surface lies on that of `shape` as the viewport shows it, what `shape` has there."""
    _materials(context, shape, obj)
    if shape.vertex_groups:
        _layers(context, shape, obj, 'VGROUP_WEIGHTS', vert_mapping='POLYINTERP_NEAREST')
    if shape.data.uv_layers:
        _layers(context, shape, obj, 'UV', loop_mapping='POLYINTERP_NEAREST', islands_precision=1.0)


def _layers(context, shape, obj, data_type, **mapping):
    with context.temp_override(
        object=shape, active_object=shape, selected_objects=[shape, obj], selected_editable_objects=[shape, obj]
    ):
        bpy.ops.object.data_transfer(
            data_type=data_type,
            use_create=True,
            layers_select_src='ALL',
            layers_select_dst='NAME',
            use_object_transform=True,
            **mapping,
        )


def _materials(context, shape, obj):
    for slot in shape.material_slots:
        obj.data.materials.append(slot.material)
    if len(shape.material_slots) < 2:
        return
    depsgraph = context.evaluated_depsgraph_get()
    tree = BVHTree.FromObject(shape, depsgraph)
    source = shape.evaluated_get(depsgraph).data.polygons
    to_shape = shape.matrix_world.inverted() @ obj.matrix_world
    for polygon in obj.data.polygons:
        nearest = tree.find_nearest(to_shape @ polygon.center)[2]
        if nearest is not None:
            polygon.material_index = source[nearest].material_index
