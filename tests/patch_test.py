"""The linear patch test in CalculiX: where the boundary has the temperature T = x + 2y - z/2, so has the inside.

Used by tests/readers.py.
"""

import re
import subprocess

import numpy

GRADIENT = numpy.array((1, 2, -0.5))
MODEL = """\
*INCLUDE, INPUT=hexes.inp
*MATERIAL, NAME=one
*CONDUCTIVITY
1.
*SOLID SECTION, ELSET=all_elements, MATERIAL=one
*INITIAL CONDITIONS, TYPE=TEMPERATURE
all_nodes, 0.
*STEP
*HEAT TRANSFER, STEADY STATE
*BOUNDARY
{boundary}
*NODE PRINT, NSET=all_nodes
NT
{sections}
*END STEP
"""


def area(points, quads):
    """The area vector of a surface of quadrilaterals."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    return numpy.cross(c - a, d - b).sum(axis=0) / 2


def with_ccx(folder, mesh, quads):
    """How far temperatures inside and the flux through each side are off, by their ranges; of each side the points and
    quadrilaterals are given."""
    right = mesh.points @ GRADIENT
    outside = sorted({node for side in quads for node in mesh.point_sets[side]})
    fixed = "\n".join(f"{node + 1}, 11, 11, {right[node]:.12e}" for node in outside)
    sections = "\n".join(f"*SECTION PRINT, SURFACE={side}, NAME={side}\nFLUX" for side in quads)
    (folder / "patch.inp").write_text(MODEL.format(boundary=fixed, sections=sections))
    done = subprocess.run(["ccx", "patch"], cwd=folder, capture_output=True, text=True, timeout=600)
    if "Job finished" not in done.stdout:
        raise SystemExit(f"failed: CalculiX says\n{done.stdout}{done.stderr}")
    said = (folder / "patch.dat").read_text()
    found = numpy.full(len(right), numpy.nan)
    for node, value in re.findall(r"^ +(\d+) +(\S+)$", said, re.M):
        found[int(node) - 1] = float(value)
    inside = numpy.abs(found - right).max() / numpy.ptp(right)
    through = re.findall(r"flux \(q\) for set (\S+) .*\n\n +(\S+)\n", said)
    fluxes = {side.lower(): float(value) for side, value in through}
    exact = {side: -GRADIENT @ area(*of) for side, of in quads.items()}
    largest = max(map(abs, exact.values()))
    return inside, max(abs(fluxes[side] - exact[side]) for side in quads) / largest
