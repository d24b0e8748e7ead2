# SPDX-License-Identifier: GPL-3.0-or-later
"""*Make Polycube*: the polycube of a plain shape, as an object of its own."""

import bpy
import numpy as np
import polycube

from . import faults, jobs, live, results, settings, source, transfer

KEY = "Polycube"


class POLYCUBE_OT_make(jobs.JobOperator, settings.MakeOptions, bpy.types.Operator):
    """Make a polycube of a closed surface and add it as an object, whose basis is the shape, as triangles, and whose
    shape key is the polycube. All else then works on this object. The original is kept"""

    bl_idname = "polycube.make"
    bl_label = "Make Polycube"

    def read(self, context):
        return source.read_plain(context, source.chosen(context))

    def admit(self, read):
        """Nothing is refused beforehand."""

    def next_job(self, _context, read):
        return polycube.Job.make(read.shape, **self.making())

    def finish(self, context, read, made):
        live.keep_made(read, self.making(), made)
        read.take(made)
        shape = bpy.data.objects[read.holder]
        obj = _object(context, shape, read)
        shape.hide_set(True)
        faults.enter(context, obj)
        choice = context.scene.polycube
        choice.source, choice.shape, choice.key = 'KEY', obj, KEY
        report = made.report
        self.report({'INFO'}, f"A polycube with {report['corners']} corners and {report['facets']} facets")
        for repair in report["repairs"]:
            self.report({'WARNING'}, repair)

    def draw(self, _context):
        self.layout.prop(self, "detail", slider=True)
        self.layout.prop(self, "axes")


def _object(context, shape, read):
    """The shape as it was cut for its polycube, which is a shape key of it, shown."""
    mesh = bpy.data.meshes.new("Polycube")
    results.set_faces(mesh, read.shape.points / read.size, read.shape.cells)
    obj = results.beside(context, shape, f"{shape.name} Polycube", mesh)
    with source.visible(context, shape):
        transfer.carry_over(context, shape, obj)
    obj.shape_key_add(name="Basis", from_mix=False)
    key = obj.shape_key_add(name=KEY, from_mix=False)
    points = (read.polycube.points + read.offset) / read.size
    key.data.foreach_set("co", points.astype(np.float32).ravel())
    key.value, obj.active_shape_key_index = 1.0, 1
    return obj


CLASSES = (POLYCUBE_OT_make,)
