# SPDX-License-Identifier: GPL-3.0-or-later
"""*Quad Remesh*: a quadrilateral mesh of the shape that follows the block structure."""

import bpy
import polycube

from . import colours, curves, jobs, live, panel, results, settings, simplify, source, transfer


class POLYCUBE_OT_quad_remesh(jobs.JobOperator, settings.SearchOptions, settings.ToleranceOptions, settings.MeshOptions,
                              settings.MakeOptions, bpy.types.Operator):
    """Mesh the shape with quadrilaterals that follow the block structure, as a new object with the materials,
    vertex groups and UV maps of the shape. The original is kept"""

    bl_idname = "polycube.quad_remesh"
    bl_label = "Quad Remesh"

    def begin(self, context, read):
        return remesh(self, context, read, surface_only=True)

    def finish(self, context, read, meshes):
        obj, shape = quad_object(context, read, meshes, "Quads")
        with source.visible(context, shape, 0 if read.key else None):
            transfer.carry_over(context, shape, obj)
        lines = curves.singular(context, shape, obj, meshes, read.shape_size)
        finish(self, context, read, [obj, *lines], meshes, summary(meshes))

    def draw(self, _context):
        panel.draw_search(self.layout, self)
        panel.draw_size(self.layout, self)


def remesh(options, context, read, surface_only, padding=1):
    """Starts to mesh the shape, with the blocks that the slider shows or with new ones."""
    cube, arguments = _structure(options, context, read)
    size = {
        "edge_length": options.edge_length if options.size == 'LENGTH' else None,
        "hexes": options.hexes if options.size == 'COUNT' else None,
    }
    shape = read.shape or read.polycube
    return polycube.Job.remesh(shape, cube, padding=padding, surface_only=surface_only, **size, **arguments)


def _structure(options, context, read):
    """The polycube to mesh with, and the arguments that make it so."""
    shown = live.current(context.scene.polycube) if options.blocks_from == 'SHOWN' else None
    if shown is not None and _same(shown[0], read) and shown[1].polycube is not None:
        # It lies on its lattice already, where rounding changes nothing.
        return shown[1].polycube, {"strategy": "naive", "labels": shown[1].labels, "scale": _scale(options)}
    locked = source.locked_cells(read, options, bpy.data.objects[read.holder])
    arguments = simplify.search_options(options, read, locked)
    if arguments["simplicity"] == 1.0:
        # The fewest blocks, or more where those make bad hexahedra.
        arguments["simplicity"] = None
    return read.polycube, {"labels": read.labels, **arguments}


def _same(one, other):
    """Whether two sources have the same shape and polycube."""
    return one.fingerprint == other.fingerprint and one.made is other.made


def _scale(options):
    return 1.0 if options.size == 'AUTO' else None


def quad_object(context, read, meshes, what):
    """The quadrilaterals as a new object where the shape lies, and the shape's object."""
    shape = bpy.data.objects[read.shape_name or read.holder]
    quads = meshes.quads
    mesh = bpy.data.meshes.new(what)
    results.set_faces(mesh, quads.points / read.shape_size, quads.cells)
    colours.write(
        mesh,
        block_id=quads.block_id,
        patch_id=quads.patch_id,
        label=quads.label,
        scaled_jacobian=quads.scaled_jacobian,
    )
    return results.new_object(context, shape, what, mesh), shape


def finish(operator, context, read, objects, meshes, summary):
    """Shows new objects in place of shape and polycube, and says how they turned out."""
    results.join(objects[0], objects[1:])
    results.show(context, read, objects, results.inputs(read))
    context.scene.polycube.result.meshed = summary
    operator.report({'INFO'}, summary.replace("\n", ", "))
    for note in meshes.notes:
        operator.report({'WARNING'}, note)


def summary(meshes):
    """How quadrilaterals turned out."""
    report = meshes.report
    distance = f"at most {report['hausdorff_percent']:.2f} % of the diagonal off the shape"
    return f"{report['quads']} quadrilaterals in {len(meshes.layout.patches.cells)} patches, {distance}"


CLASSES = (POLYCUBE_OT_quad_remesh,)
