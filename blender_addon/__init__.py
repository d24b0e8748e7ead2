# SPDX-License-Identifier: GPL-3.0-or-later
"""Polycube inside Blender: a panel in the 3D view's sidebar and the operators behind it.

The geometry is all in the Python module `polycube`, which the extension carries as a wheel.
"""

import os

import bpy

from . import check, examples, export, hexes, jobs, layout, live, make, panel, quads, settings, simplify

# Settings come first: the others refer to them.
MODULES = (settings, check, make, simplify, quads, hexes, layout, export, examples, panel)


def register():
    """Called by Blender when the extension is switched on."""
    for module in MODULES:
        for cls in module.CLASSES:
            bpy.utils.register_class(cls)
    bpy.types.Scene.polycube = bpy.props.PointerProperty(type=settings.PolycubeSettings)
    bpy.types.VIEW3D_MT_mesh_add.append(examples.menu)
    bpy.app.handlers.load_pre.append(jobs.stop)
    bpy.utils.register_preset_path(os.path.dirname(__file__))


def unregister():
    """Called by Blender when the extension is switched off."""
    jobs.stop()
    live.forget()
    bpy.utils.unregister_preset_path(os.path.dirname(__file__))
    bpy.app.handlers.load_pre.remove(jobs.stop)
    bpy.types.VIEW3D_MT_mesh_add.remove(examples.menu)
    del bpy.types.Scene.polycube
    for module in reversed(MODULES):
        for cls in reversed(module.CLASSES):
            bpy.utils.unregister_class(cls)
