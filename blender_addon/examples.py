# SPDX-License-Identifier: GPL-3.0-or-later
"""*Add Example*: a shape whose polycube is a shape key, to try everything on."""

import bpy
import numpy as np
import polycube
from bpy.props import EnumProperty, IntProperty

from . import faults, jobs

KEY = "Polycube"
# The examples are some 50 units long; Blender's own primitives are 2.
SIZE = 1.0 / 12.0

NAMES = {
    'cube-spikes': ("Cube with Spikes", "A cube with a smaller box on each of its faces"),
    'stepped-l': ("Stepped L", "An L whose arms carry steps"),
    'ring': ("Ring", "A square ring on legs, with teeth on top"),
    'double-torus': ("Double Torus", "A plate with two holes, and bumps on all sides"),
}


class POLYCUBE_OT_add_example(jobs.Idle, bpy.types.Operator):
    """Add a shape with its polycube as a shape key, and choose it as the input"""

    bl_idname = "polycube.add_example"
    bl_label = "Add Example"
    bl_options = {'REGISTER', 'UNDO'}

    example: EnumProperty(
        name="Example",
        description="The shape to add",
        items=[(key, *NAMES[key]) for key in NAMES],
        default='cube-spikes',
    )
    seed: IntProperty(
        name="Seed",
        description="Where parts are shifted, so that there is something to align; 0 leaves all of them aligned",
        min=0,
        default=1,
    )

    def execute(self, context):
        try:
            jobs.leave_edit_mode(context)
            shape, cube = polycube.example(self.example, seed=self.seed, kind="quads")
        except polycube.PolycubeError as error:
            return faults.report(self, context, error)
        mesh = bpy.data.meshes.new(NAMES[self.example][0])
        mesh.from_pydata(shape.points * SIZE, [], shape.cells.tolist())
        obj = bpy.data.objects.new(mesh.name, mesh)
        context.collection.objects.link(obj)
        obj.location = context.scene.cursor.location
        obj.shape_key_add(name="Basis")
        obj.shape_key_add(name=KEY).data.foreach_set("co", (cube.points * SIZE).astype(np.float32).ravel())
        faults.enter(context, obj)
        settings = context.scene.polycube
        settings.source, settings.shape, settings.key = 'KEY', obj, KEY
        return {'FINISHED'}


def menu(self, _context):
    """Entry of the menu Add > Mesh."""
    self.layout.operator_menu_enum(POLYCUBE_OT_add_example.bl_idname, "example", text="Polycube Example", icon='CUBE')


CLASSES = (POLYCUBE_OT_add_example,)
