#!/usr/bin/env python3
"""Draws docs/before-after.png from what `polycube demo` writes (needs numpy and matplotlib).

    cargo run --release -p polycube-cli -- demo -o out/demo
    python3 docs/picture.py out/demo/cube-spikes/structure.json docs/before-after.png

The polycube is rebuilt on its lattice from structure.json, and its surface patches are traced as the
separatrices of the corners: dark lines.
"""

import io
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image

VIEW = np.array([0.50, 0.74, 0.56])  # towards the eye
AXIS_COLOURS = [(0.86, 0.36, 0.32), (0.40, 0.68, 0.42), (0.36, 0.52, 0.80)]  # X red, Y green, Z blue
FINER = 4
INK = (0.10, 0.10, 0.13)


def solid(structure, when):
    """The lattice cells inside the polycube, as a boolean array with an empty margin."""
    corners = np.array([c[when] for c in structure["corners"]], dtype=int)
    low = corners.min(axis=0) - 1
    size = corners.max(axis=0) + 1 - low
    corners -= low
    change = np.zeros(size + 1, dtype=int)
    for facet in structure["facets"]:
        if facet["label"] // 2 == 0:
            sign = 1 if facet["label"] % 2 else -1  # the solid starts behind a facet that looks towards -X
            x, mask = facet_mask(structure, facet, corners, size)
            change[x][mask] += sign
    return np.cumsum(change, axis=0)[:-1, :-1, :-1] > 0


def facet_mask(structure, facet, corners, size):
    """Where a facet across X lies, and the cells of the plane that it covers, by the parity of its sides along Z."""
    parity = np.zeros((size[1] + 1, size[2] + 1), dtype=int)
    for side in (side for loop in facet["loops"] for side in loop):
        edge = structure["edges"][side["edge"]]
        low, high = corners[edge["corners"][0]], corners[edge["corners"][1]]
        if edge["axis"] == 2:
            parity[low[1], low[2] : high[2]] += 1
        x = low[0]
    return x, np.cumsum(parity, axis=0) % 2 == 1


def surface(cells):
    """Unit quadrilaterals of the surface: axis, side (1 towards plus), cell."""
    for axis in range(3):
        for side in (0, 1):
            beyond = np.roll(cells, 1 if side == 0 else -1, axis=axis)
            for cell in np.argwhere(cells & ~beyond):
                yield axis, side, cell


def quad(axis, side, cell):
    """Its corners in cyclic order."""
    u, v = (a for a in range(3) if a != axis)
    start = np.array(cell)
    start[axis] += side
    steps = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = []
    for a, b in steps:
        p = start.copy()
        p[u] += a
        p[v] += b
        corners.append(tuple(int(x) for x in p))
    return corners


def separatrices(quads):
    """The unit edges on lines that leave irregular vertices and go straight on through regular ones."""
    around = {}
    for index, corners in enumerate(quads):
        for k, corner in enumerate(corners):
            around.setdefault(corner, []).append((index, corners[k - 1], corners[(k + 1) % 4]))

    def opposite(vertex, neighbour):
        fan = around[vertex]
        ends = {p for _, a, b in fan for p in (a, b)}
        if len(fan) != 4 or len(ends) != 4:
            return None
        beside = {p for _, a, b in fan if neighbour in (a, b) for p in (a, b)}
        (far,) = ends - beside
        return far

    lines = set()
    for vertex, fan in around.items():
        if len(fan) == 4:
            continue
        for start in {p for _, a, b in fan for p in (a, b)}:
            before, here = vertex, start
            while here is not None and (before, here) not in lines:
                lines.update([(before, here), (here, before)])
                before, here = here, opposite(here, before)
    return lines


def draw(axes, cells, title):
    right = np.cross([0, 0, 1], VIEW)
    right /= np.linalg.norm(right)
    up = np.cross(VIEW, right)
    up /= np.linalg.norm(up)
    quads = list(surface(cells))
    corners = [quad(*q) for q in quads]
    lines = separatrices(corners)
    seen = [i for i, (axis, side, _) in enumerate(quads) if side == 1]
    # What hides a cell has a larger sum of coordinates, as the eye is on the positive side of all axes.
    seen.sort(key=lambda i: int(quads[i][2].sum()))
    polygons, colours = [], []

    def project(points):
        points = np.asarray(points, dtype=float)
        return np.stack([points @ right, points @ up], axis=1)

    for i in seen:
        polygons.append(project(corners[i]))
        colours.append(AXIS_COLOURS[quads[i][0]])
        middle = np.mean(corners[i], axis=0)
        for k in range(4):
            a, b = corners[i][k], corners[i][(k + 1) % 4]
            if (a, b) in lines:
                a, b = np.array(a, dtype=float), np.array(b, dtype=float)
                inward = middle - (a + b) / 2
                polygons.append(project([a, b, b + 0.3 * inward, a + 0.3 * inward]))
                colours.append(INK)
    axes.add_collection(PolyCollection(polygons, facecolors=colours, linewidths=0, antialiaseds=False))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")
    axes.set_title(title, fontsize=13, color=INK, y=-0.07)


def main(source, target):
    with open(source, encoding="utf-8") as file:
        structure = json.load(file)
    with open(source.replace("structure.json", "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    figure, panels = plt.subplots(1, 2, figsize=(9, 4.6))
    for axes, when in zip(panels, ("before", "after")):
        counts = report[when]
        title = f"{when}: {counts['surface_patches']} patches, {counts['blocks']} blocks"
        draw(axes, solid(structure, when), title)
    figure.tight_layout()
    # Drawn larger without antialiasing and scaled down, so that no seams show between the unit faces.
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110 * FINER, facecolor="white")
    picture = Image.open(buffer).convert("RGB")
    picture = picture.resize([n // FINER for n in picture.size], Image.Resampling.BOX)
    picture.quantize(96).save(target, optimize=True)


if __name__ == "__main__":
    main(*sys.argv[1:3])
