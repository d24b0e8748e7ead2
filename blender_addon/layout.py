# SPDX-License-Identifier: GPL-3.0-or-later
"""*Show Layout*: the coarse block structure on the shape."""

import bpy
import numpy as np
from bpy.props import BoolProperty

from . import colours, curves, jobs, panel, quads, results, settings


class POLYCUBE_OT_show_layout(jobs.JobOperator, settings.SearchOptions, settings.ToleranceOptions, settings.MeshOptions,
                              settings.MakeOptions, bpy.types.Operator):
    """Show the patches that the blocks of the polycube make on the shape, with their borders and the singular edges,
    as new objects"""

    bl_idname = "polycube.show_layout"
    bl_label = "Show Layout"

    cage: BoolProperty(
        name="One Face per Patch",
        description="Only the coarse layout itself: a quadrilateral for each patch, a cage to subdivide",
        default=False,
    )

    def begin(self, context, read):
        return quads.remesh(self, context, read, surface_only=True)

    def finish(self, context, read, meshes):
        if self.cage:
            shape, objects = self._cage(context, read, meshes)
        else:
            obj, shape = quads.quad_object(context, read, meshes, "Layout")
            objects = [obj, *curves.borders(context, shape, obj, meshes, read.shape_size)]
        objects += curves.singular(context, shape, objects[0], meshes, read.shape_size)
        quads.finish(self, context, read, objects, meshes, quads.summary(meshes))

    def _cage(self, context, read, meshes):
        shape = bpy.data.objects[read.shape_name or read.holder]
        patches = meshes.layout.patches
        mesh = bpy.data.meshes.new("Layout")
        results.set_faces(mesh, patches.points / read.shape_size, patches.cells)
        colours.write(mesh, block_id=np.arange(len(patches.cells)), label=meshes.layout.patch_label)
        return shape, [results.new_object(context, shape, "Layout", mesh)]

    def draw(self, _context):
        self.layout.use_property_split = True
        self.layout.prop(self, "cage")
        panel.draw_search(self.layout, self)
        panel.draw_size(self.layout, self)


CLASSES = (POLYCUBE_OT_show_layout,)
