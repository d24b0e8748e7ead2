# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel *Polycube* in the sidebar of the 3D view, and the presets of its options."""

import textwrap

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from . import jobs, live, settings, source

PRESETS = "polycube"
# Characters in a line of the sidebar as Blender opens it.
WIDTH = 38


class POLYCUBE_PT_presets(PresetPanel, bpy.types.Panel):
    """Ready-made options and your own"""

    bl_label = "Polycube Presets"
    preset_subdir = PRESETS
    preset_operator = "script.execute_preset"
    preset_add_operator = "polycube.preset_add"


class POLYCUBE_OT_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the options of Polycube"""

    bl_idname = "polycube.preset_add"
    bl_label = "Add Polycube Preset"
    preset_menu = "POLYCUBE_PT_presets"
    preset_subdir = PRESETS
    preset_defines = ["polycube = bpy.context.scene.polycube"]
    # Not what belongs to one object alone: locks and lengths.
    preset_values = [
        f"polycube.{name}"
        for name in ("strategy", "objective", "simplicity", "steps", "max_distortion", "angle_tolerance",
                     "level_tolerance", "blocks_from", "padding", "detail", "axes")
    ]


class _SidePanel:
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = "Polycube"


class VIEW3D_PT_polycube(_SidePanel, bpy.types.Panel):
    bl_label = "Polycube"

    def draw(self, context):
        layout, choice = self.layout, context.scene.polycube
        layout.use_property_split = True
        layout.use_property_decorate = False
        _draw_inputs(layout, choice)
        for line in explain(context):
            layout.label(text=line)
        if jobs.running():
            stage, part = jobs.status()
            layout.progress(factor=part, text=f"{stage.capitalize()}  (Esc to cancel)")
            return
        if choice.source == 'OBJECTS' and choice.polycube is None:
            layout.prop(choice, "detail", slider=True)
            layout.prop(choice, "axes")
            layout.operator("polycube.make", icon='MESH_CUBE')
        row = layout.row(align=True)
        row.operator("polycube.check", icon='CHECKMARK')
        row.operator_menu_enum("polycube.add_example", "example", icon='ADD')


class VIEW3D_PT_polycube_simplify(_SidePanel, bpy.types.Panel):
    bl_label = "Simplify"
    bl_parent_id = "VIEW3D_PT_polycube"

    def draw_header_preset(self, _context):
        POLYCUBE_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout, choice = self.layout, context.scene.polycube
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.operator("polycube.simplify", icon='MOD_REMESH')
        if choice.strategy == 'best':
            layout.prop(choice, "simplicity", slider=True)
        _draw_counts(layout, choice)


class VIEW3D_PT_polycube_mesh(_SidePanel, bpy.types.Panel):
    bl_label = "Mesh"
    bl_parent_id = "VIEW3D_PT_polycube"

    def draw(self, context):
        layout, choice = self.layout, context.scene.polycube
        layout.use_property_split = True
        layout.use_property_decorate = False
        draw_size(layout, choice)
        column = layout.column(align=True)
        column.operator("polycube.quad_remesh", icon='MESH_GRID')
        column.operator("polycube.hex_mesh", icon='SNAP_VOLUME')
        column.operator("polycube.show_layout", icon='MOD_WIREFRAME')
        column.operator("polycube.export_hexes", icon='EXPORT')
        layout.prop(choice, "colour")
        _draw_cut(layout, choice)
        _draw_text(layout, choice.result.meshed, 'NONE')


class VIEW3D_PT_polycube_search(_SidePanel, bpy.types.Panel):
    bl_label = "Search, Lattice, Tolerance"
    bl_parent_id = "VIEW3D_PT_polycube"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        layout, choice = self.layout, context.scene.polycube
        layout.use_property_split = True
        layout.use_property_decorate = False
        draw_search(layout, choice)
        draw_lattice(layout, choice)
        for name in ("angle_tolerance", "level_tolerance", "steps"):
            layout.prop(choice, name)


def _draw_inputs(layout, choice):
    layout.row().prop(choice, "source", expand=True)
    layout.prop(choice, "shape")
    if choice.source == 'OBJECTS':
        layout.prop(choice, "polycube")
    elif choice.shape and choice.shape.type == 'MESH' and choice.shape.data.shape_keys:
        layout.prop_search(choice, "key", choice.shape.data.shape_keys, "key_blocks", text="Polycube")
    else:
        layout.prop(choice, "key", text="Polycube")


def explain(context):
    """Two lines that say what the buttons work on."""
    choice, shape = context.scene.polycube, source.chosen(context)
    if shape is None:
        return "Select a closed mesh, or add an example:", "quads and hexahedra of few blocks follow it."
    if choice.source == 'KEY':
        return f"Meshes {shape.name},", f"the polycube is its shape key {choice.key}."
    if choice.polycube:
        return f"Meshes {shape.name},", f"with {choice.polycube.name} as its polycube."
    return f"Meshes {shape.name}, a closed surface.", "A polycube of it is made on the way."


def draw_search(layout, options):
    """How the facets find their places: for the panel, and for the redo panels of operators."""
    layout.use_property_split = True
    layout.prop(options, "strategy")
    if options.strategy == 'best':
        layout.prop(options, "objective")
        if not isinstance(options, settings.PolycubeSettings):
            layout.prop(options, "simplicity", slider=True)
        layout.prop(options, "max_displacement")
        layout.prop(options, "max_distortion")
    layout.row(heading="Symmetry").prop(options, "symmetry", text="", toggle=True)
    layout.prop(options, "locks")
    if options.locks == 'GROUP':
        holder = live.holder(bpy.context.scene.polycube)
        if holder:
            layout.prop_search(options, "lock_group", holder, "vertex_groups")
        else:
            layout.prop(options, "lock_group")


def draw_lattice(layout, options):
    """The lattice, and where the result goes."""
    layout.prop(options, "lattice")
    if options.lattice == 'STEP':
        layout.prop(options, "lattice_step")
    layout.prop(options, "output")


def draw_size(layout, options):
    """How fine a mesh is."""
    layout.use_property_split = True
    layout.prop(options, "blocks_from")
    layout.prop(options, "size")
    if options.size == 'LENGTH':
        layout.prop(options, "edge_length")
    elif options.size == 'COUNT':
        layout.prop(options, "hexes")
    if hasattr(options, "padding"):
        layout.prop(options, "padding")


def _draw_cut(layout, choice):
    """Where the hexahedra shown are cut open."""
    if choice.result.hexes is None:
        return
    if live.can_cut(choice):
        layout.row().prop(choice, "cut_axis", expand=True)
        layout.prop(choice, "cut", slider=True)
    else:
        layout.label(text="Hex Mesh again to move the cut", icon='INFO')


def _draw_counts(layout, choice):
    """The numbers of the last result, before and after."""
    result = choice.result
    if not result.token:
        return
    grid = layout.box().grid_flow(row_major=True, columns=3, even_columns=True, align=True)
    for text in ("", "Before", "After"):
        grid.label(text=text)
    for name, (before, after) in (("Patches", result.patches), ("Blocks", result.blocks), ("Padded", result.padded)):
        grid.label(text=name)
        grid.label(text=str(before))
        grid.label(text=str(after))
    units = bpy.context.scene.unit_settings
    length = bpy.utils.units.to_string(units.system, 'LENGTH', result.displacement, precision=4)
    layout.label(text=f"Farthest move of a corner: {length}")
    if choice.strategy == 'best' and live.current(choice) is None:
        layout.label(text="Simplify again to use the slider", icon='INFO')
    _draw_text(layout, result.notes, 'ERROR')


def _draw_text(layout, text, icon):
    """Some lines of text, broken where the sidebar usually ends."""
    column = layout.column(align=True)
    for paragraph in text.splitlines():
        first, *others = textwrap.wrap(paragraph, WIDTH) or [""]
        column.label(text=first, icon=icon)
        for line in others:
            column.label(text=line, icon='BLANK1' if icon != 'NONE' else 'NONE')


CLASSES = (
    POLYCUBE_PT_presets,
    POLYCUBE_OT_preset_add,
    VIEW3D_PT_polycube,
    VIEW3D_PT_polycube_mesh,
    VIEW3D_PT_polycube_simplify,
    VIEW3D_PT_polycube_search,
)
