# SPDX-License-Identifier: GPL-3.0-or-later
"""*Simplify*: the polycube with fewer blocks."""

import bpy
import polycube

from . import jobs, live, panel, results, settings, source


class POLYCUBE_OT_simplify(jobs.JobOperator, settings.SimplifyOptions, settings.MakeOptions, bpy.types.Operator):
    """Move the facets of the polycube onto a lattice so that corners align and the solid falls into fewer blocks.
    Every corner, edge and facet is kept, and so is the original"""

    bl_idname = "polycube.simplify"
    bl_label = "Simplify"

    def admit(self, read):
        super().admit(read)
        results.check_output(read, self.output)

    def begin(self, context, read):
        locked = source.locked_cells(read, self, bpy.data.objects[read.holder])
        given = {"labels": read.labels, "edge_length": self.lattice_step if self.lattice == 'STEP' else None}
        return polycube.Job.simplify(read.polycube, read.shape, **given, **search_options(self, read, locked))

    def finish(self, context, read, found):
        results.place(context, read, found, self.output)
        context.scene.polycube.result.token = live.remember(read, found)
        live.tell(context.scene.polycube, self.simplicity)
        before, after = found.counts_before, found.counts_after
        self.report({'INFO'}, f"Patches {before.surface_patches} → {after.surface_patches}, "
                              f"blocks {before.blocks} → {after.blocks}")
        for note in found.notes:
            self.report({'WARNING'}, note)

    def draw(self, _context):
        panel.draw_search(self.layout, self)
        panel.draw_lattice(self.layout, self)


def search_options(options, read, locked):
    """The arguments that `Job.simplify` and `Job.remesh` share, from an operator's or the panel's options."""
    given = {
        "strategy": options.strategy,
        "objective": None if options.objective == 'AUTO' else options.objective,
        "simplicity": options.simplicity,
        "max_displacement": options.max_displacement or None,
        "max_distortion": options.max_distortion or None,
        "locked_faces": locked,
        "guides": _planes(options, read),
        "steps": options.steps,
        **options.tolerances(),
    }
    return {name: value for name, value in given.items() if value is not None}


def _planes(options, read):
    """The planes of symmetry as the module takes them, where the polycube is as large as the scene."""
    planes = [{"axis": axis, "at": -float(read.offset[axis])} for axis, kept in enumerate(options.symmetry) if kept]
    return {"symmetry": planes} if planes else None


CLASSES = (POLYCUBE_OT_simplify,)
