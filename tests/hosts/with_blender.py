"""The job in the Blender extension: with_blender.py SHAPE POLYCUBE FOLDER HEXES EXTENSION.zip"""

import os
import sys
import tempfile

# Before Blender starts: it must not see the settings of whoever runs this.
settings = tempfile.TemporaryDirectory(prefix="polycube-blender-")
os.environ["BLENDER_USER_RESOURCES"] = settings.name

import bpy  # noqa: E402


def add(path):
    """An object with the mesh of an OFF file."""
    rows = [line.split() for line in open(path)]
    points = int(rows[1][0])
    mesh = bpy.data.meshes.new(path)
    mesh.from_pydata(
        [tuple(map(float, row)) for row in rows[2 : 2 + points]], [], [list(map(int, row[1:])) for row in rows[2 + points :]]
    )
    thing = bpy.data.objects.new(path, mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.update()
    return thing


shape, cube, folder, hexes, extension = sys.argv[1:]
bpy.ops.extensions.package_install_files(filepath=os.path.abspath(extension), repo="user_default", enable_on_install=True)
given = bpy.context.scene.polycube
given.source, given.shape, given.polycube = 'OBJECTS', add(shape), add(cube)
bpy.ops.polycube.write_hexes(filepath=f"{folder}/hexes.vtu", blocks_from='SEARCH', size='COUNT', hexes=int(hexes))
