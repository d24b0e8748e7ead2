# SPDX-License-Identifier: GPL-3.0-or-later
"""*Export Hex Mesh*: the shape filled with hexahedra, as a file."""

import os

import bpy
import numpy as np
import polycube
from bpy.props import EnumProperty, StringProperty

from . import crossings, cut, faults, hexes, jobs, quads, settings, source

FORMATS = (
    ('.vtu', "VTK (.vtu)", "For ParaView and PyVista, with scaled_jacobian, edge_ratio, block_id and more"),
    ('.vtk', "VTK, old (.vtk)", "For older programs of the same kind, with the same numbers"),
    ('.mesh', "MEDIT (.mesh)", "For Gmsh, Graphite and other mesh generators"),
    ('.msh', "Gmsh (.msh)", "For Gmsh and what reads it, with names for blocks and boundary"),
    ('.inp', "Abaqus (.inp)", "For Abaqus and CalculiX, with sets of blocks and boundary"),
    ('.su2', "SU2 (.su2)", "For SU2, with markers for the boundary"),
    ('.foam', "OpenFOAM (.foam)", "The folder of a case, with zones for blocks and patches for the boundary"),
    ('.json', "Blocks (.json)", "The block structure: grids, neighbours, classes of edges and names"),
    ('.xyz', "Plot3D (.xyz)", "A grid of points for each block, without names"),
    ('.blockmesh', "OpenFOAM blockMesh (.blockmesh)", "The folder of a case with a blockMeshDict of the blocks"),
)
SOLVERS = ('.msh', '.inp', '.su2', '.foam', '.json', '.xyz', '.blockmesh')


class POLYCUBE_OT_write_hexes(jobs.JobOperator, settings.SearchOptions, settings.ToleranceOptions,
                              settings.VolumeOptions, settings.MakeOptions, bpy.types.Operator):
    """Fill the shape with hexahedra and write them to a file"""

    bl_idname = "polycube.write_hexes"
    bl_label = "Write Hex Mesh"
    # Nothing in the scene changes.
    bl_options = {'INTERNAL'}

    filepath: StringProperty(name="File", description="Where the file goes", subtype='FILE_PATH', options={'SKIP_SAVE'})

    def begin(self, context, read):
        if not self.filepath:
            raise faults.Refused("there is no file name", "give one")
        shape = bpy.data.objects[read.shape_name or read.holder]
        if self.filepath.endswith(SOLVERS) and _mirrored(shape):
            raise faults.Refused(f"{shape.name} is mirrored by its scale", "Object > Apply > Scale, and Mesh > Normals > "
                                 "Recalculate Outside")
        return quads.remesh(self, context, read, surface_only=False, padding=self.padding)

    def finish(self, context, read, meshes):
        shape = bpy.data.objects[read.shape_name or read.holder]
        placed = in_scene(shape, meshes.hexes.points / read.shape_size)
        # The file appears whole or not at all.
        if _mirrored(shape):
            _write_mirrored(meshes.hexes, placed, bpy.path.abspath(self.filepath))
        else:
            meshes.hexes.write(bpy.path.abspath(self.filepath), points=placed)
        summary = hexes.summary(meshes.report)
        context.scene.polycube.result.meshed = summary
        self.report({'INFO'}, f"{summary.replace(chr(10), ', ')}: {os.path.basename(self.filepath)}")
        for note in meshes.notes:
            self.report({'WARNING'}, note)
        crossings.warn(self, read)


def _mirrored(obj):
    return obj.matrix_world.determinant() < 0.0


def _write_mirrored(found, placed, path):
    # A mirrored object turns hexahedra inside out; what was below is above then.
    mesh = polycube.Mesh(placed, found.cells[:, [4, 5, 6, 7, 0, 1, 2, 3]], kind="hexahedra")
    mesh.write(path, fields={name: getattr(found, name) for name in cut.FIELDS})


def in_scene(obj, points):
    """Points of an object's own space where they are in the scene."""
    matrix = np.array(obj.matrix_world, dtype=np.float64)
    if np.array_equal(matrix, np.eye(4)):
        return points
    return points @ matrix[:3, :3].T + matrix[:3, 3]


class POLYCUBE_OT_export_hexes(jobs.NeedsMesh, bpy.types.Operator):
    """Fill the shape with hexahedra that follow the block structure and write them to a file for simulation,
    in the coordinates of the scene"""

    bl_idname = "polycube.export_hexes"
    bl_label = "Export Hex Mesh"

    filepath: StringProperty(name="File", description="Where the file goes", subtype='FILE_PATH', options={'SKIP_SAVE'})
    filter_glob: StringProperty(default=";".join(f"*{ending}" for ending, *_ in FORMATS), options={'HIDDEN'})
    format: EnumProperty(name="Format", description="The kind of file", items=FORMATS, default='.vtu')
    check_existing: bpy.props.BoolProperty(default=True, options={'HIDDEN', 'SKIP_SAVE'})

    def invoke(self, context, _event):
        if not self.filepath:
            self.filepath = bpy.path.clean_name(source.chosen(context).name) + self.format
        context.window_manager.fileselect_add(self)
        return {'RUNNING_MODAL'}

    def check(self, _context):
        """Called by the file browser: the name follows the format."""
        path = bpy.path.ensure_ext(os.path.splitext(self.filepath)[0], self.format)
        changed, self.filepath = path != self.filepath, path
        return changed

    def execute(self, _context):
        # An operator of its own, because one that asked for a file cannot show progress afterwards.
        how = 'EXEC_DEFAULT' if bpy.app.background else 'INVOKE_DEFAULT'
        try:
            answer = bpy.ops.polycube.write_hexes(how, filepath=self.filepath)
        except RuntimeError as error:
            self.report({'ERROR'}, str(error).removeprefix("Error: ").strip())
            return {'CANCELLED'}
        return {'FINISHED'} if answer & {'FINISHED', 'RUNNING_MODAL'} else {'CANCELLED'}


CLASSES = (POLYCUBE_OT_write_hexes, POLYCUBE_OT_export_hexes)
