# SPDX-License-Identifier: GPL-3.0-or-later
"""Face attributes of the results, and the colours that show them."""

import bpy
import numpy as np

from .source import get

# The colour attribute that the viewport shows.
LAYER = "polycube"

ITEMS = (
    ('block_id', "Blocks", "One colour for each block of the structure"),
    ('label', "Directions", "X red, Y white, Z blue; darker where the facet looks the other way"),
    ('scaled_jacobian', "Quality", "From red, 0 or less, over yellow to green, 1: how near a face is to a square"),
)

_AXES = np.array([[0.80, 0.10, 0.10], [0.85, 0.85, 0.85], [0.10, 0.20, 0.80]])


def write(mesh, **fields):
    """Writes face attributes: whole numbers or real ones, one per polygon."""
    for name, values in fields.items():
        old = mesh.attributes.get(name)
        if old is not None:
            mesh.attributes.remove(old)
        whole = np.issubdtype(values.dtype, np.integer)
        attribute = mesh.attributes.new(name, 'INT' if whole else 'FLOAT', 'FACE')
        attribute.data.foreach_set("value", values.astype(np.int32 if whole else np.float32))


def paint(mesh, name):
    """Colours every face by one of its attributes. Without the attribute nothing happens."""
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != 'FACE':
        return
    values = get(attribute.data, "value", np.int32 if attribute.data_type == 'INT' else np.float32)
    layer = mesh.color_attributes.get(LAYER)
    if layer is None:
        layer = mesh.color_attributes.new(LAYER, 'BYTE_COLOR', 'CORNER')
    rgba = np.ones((len(mesh.loops), 4), dtype=np.float32)
    rgba[:, :3] = np.repeat(_RULES[name](values), get(mesh.polygons, "loop_total", np.int32), axis=0)
    layer.data.foreach_set("color", rgba.ravel())
    mesh.color_attributes.active_color = layer
    mesh.update()


def _blocks(ids):
    """Colours far apart for numbers near to each other: hues a golden section apart, in three shades."""
    hue = (ids * 0.618033988749895) % 1.0
    shade = 0.55 + 0.15 * (ids % 3)
    steps = np.abs((hue[:, None] * 6.0 + np.array([0.0, 4.0, 2.0])) % 6.0 - 3.0) - 1.0
    return shade[:, None] * (0.35 + 0.65 * np.clip(steps, 0.0, 1.0))


def _labels(labels):
    return _AXES[np.clip(labels, 0, 5) // 2] * np.where(labels % 2 == 1, 0.6, 1.0)[:, None]


def _quality(values):
    part = np.clip(values, 0.0, 1.0)[:, None]
    red, yellow, green = np.array([0.8, 0.05, 0.05]), np.array([0.9, 0.8, 0.1]), np.array([0.1, 0.6, 0.2])
    return np.where(part < 0.5, red + (yellow - red) * part * 2.0, yellow + (green - yellow) * (part * 2.0 - 1.0))


_RULES = {'block_id': _blocks, 'label': _labels, 'scaled_jacobian': _quality}


def show(context, obj):
    """Paints a result, and has the solid views show colour attributes."""
    paint(obj.data, context.scene.polycube.colour)
    areas = (area for window in context.window_manager.windows for area in window.screen.areas)
    for space in (area.spaces.active for area in areas if area.type == 'VIEW_3D'):
        space.shading.color_type = 'VERTEX'


def repaint(settings, _context):
    """Called when the user chooses another colouring."""
    for mesh in bpy.data.meshes:
        if not mesh.is_editmode and LAYER in mesh.color_attributes:
            paint(mesh, settings.colour)
