"""Rewrites an OBJ file as triangles in OFF, with coordinates in single precision: triangles.py FROM.obj TO.off"""

import struct
import sys

points, triangles = [], []
for words in map(str.split, open(sys.argv[1])):
    if words[:1] == ["v"]:
        points.append(struct.unpack("3f", struct.pack("3f", *map(float, words[1:4]))))
    elif words[:1] == ["f"]:
        first, *others = (int(word.split("/")[0]) - 1 for word in words[1:])
        triangles += [(first, *pair) for pair in zip(others, others[1:])]
with open(sys.argv[2], "w") as file:
    print(f"OFF\n{len(points)} {len(triangles)} 0", file=file)
    for row in points:
        print(*row, file=file)
    for row in triangles:
        print(3, *row, file=file)
