# SPDX-License-Identifier: GPL-3.0-or-later
"""*Check*: whether the polycube is one, and what is wrong where."""

import bpy
import polycube

from . import crossings, faults, jobs, settings, source


class POLYCUBE_OT_check(jobs.NeedsMesh, settings.ToleranceOptions, bpy.types.Operator):
    """Check that the polycube is closed, that every face looks along an axis, and that shape and polycube fit; of an
    object without a polycube, that one can be made. Selects what is wrong in edit mode"""

    bl_idname = "polycube.check"
    bl_label = "Check"
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, context):
        self.settle(context.scene.polycube)
        read = None
        try:
            jobs.leave_edit_mode(context)
            read = source.read(context)
            violations = faults.violations(read, self)
            if violations:
                return faults.report_all(self, context, violations, read)
            if read.plain:
                return self._closed(read)
            counts = polycube.structure(read.polycube, **self.tolerances()).counts
        except (faults.Refused, polycube.PolycubeError) as error:
            return faults.report(self, context, error, read)
        self.report({'INFO'}, f"A valid polycube: {counts.surface_patches} patches, {counts.blocks} blocks, "
                              f"{counts.blocks_padded} with padding")
        return {'FINISHED'}


    def _closed(self, read):
        """Says that a polycube can be made."""
        self.report({'INFO'}, f"{read.holder} is closed: {read.polygon_count} faces, a polycube can be made")
        crossings.warn(self, read)
        return {'FINISHED'}


CLASSES = (POLYCUBE_OT_check,)
