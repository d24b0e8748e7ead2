# SPDX-License-Identifier: GPL-3.0-or-later
"""*Hex Mesh*: the hexahedra that fill a shape, as an object that is cut open."""

import bpy

from . import cut, jobs, live, panel, quads, results, settings


class POLYCUBE_OT_hex_mesh(jobs.JobOperator, settings.SearchOptions, settings.ToleranceOptions,
                           settings.VolumeOptions, settings.MakeOptions, bpy.types.Operator):
    """Fill the shape with hexahedra that follow the block structure and show them as an object, cut open so that the
    inside is seen. The original is kept"""

    bl_idname = "polycube.hex_mesh"
    bl_label = "Hex Mesh"

    def begin(self, context, read):
        return quads.remesh(self, context, read, surface_only=False, padding=self.padding)

    def finish(self, context, read, meshes):
        shape = bpy.data.objects[read.shape_name or read.holder]
        obj = results.new_object(context, shape, "Hexes", bpy.data.meshes.new("Hexes"))
        result = context.scene.polycube.result
        result.hexes = obj
        result.hexes_token = live.keep_hexes(cut.Hexahedra(meshes.hexes, read.shape_size))
        live.cut(context.scene.polycube, context)
        quads.finish(self, context, read, [obj], meshes, summary(meshes.report))

    def draw(self, _context):
        panel.draw_search(self.layout, self)
        panel.draw_size(self.layout, self)


def summary(report):
    """How hexahedra turned out, in three lines."""
    return (
        f"{report['hexes']} hexahedra in {report['hex_blocks']} blocks\n"
        f"scaled Jacobian {report['min_sj']:.2f} at worst, {report['avg_sj']:.2f} on average\n"
        f"edges differ by {report['edge_ratio']['max']:.1f} at most"
    )


CLASSES = (POLYCUBE_OT_hex_mesh,)
