"""The job in the Python module: with_python.py SHAPE POLYCUBE FOLDER HEXES"""

import sys

import polycube

shape, cube, folder, hexes = sys.argv[1:]
pair = polycube.read_pair(shape, cube)
polycube.remesh(*pair, hexes=int(hexes)).hexes.write(f"{folder}/hexes.vtu")
