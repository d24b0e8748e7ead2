"""The job in PyMeshLab: with_pymeshlab.py SHAPE POLYCUBE FOLDER HEXES PLUGIN"""

import sys

import pymeshlab

shape, cube, folder, hexes, plugin = sys.argv[1:]
pymeshlab.load_plugin(plugin)
layers = pymeshlab.MeshSet()
layers.load_new_mesh(shape)
layers.load_new_mesh(cube)
layers.apply_filter("generate_polycube_hex_remesh", polycube=1, shape=0, hexes=int(hexes), file=f"{folder}/hexes.vtu")
