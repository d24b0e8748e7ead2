#!/usr/bin/env python3
"""Makes polycubes of plain shapes, meshes them, and writes what came out as a table.

    bench/made.py [--polycube PROGRAM] [--hexes N] [--out FOLDER] [--output FILE] [SHAPE...]

SHAPE is a closed triangle mesh; by default all of $POLYCUBE_SHAPES (or ../shared/shapes beside the project) and the
shapes of $POLYCUBE_DATA (or ../shared/data). PROGRAM is target/release/polycube. Everything is done with default
options. Columns: corners; faces whose map is folded; share of the surface that is squashed; blocks without padding; least
and mean scaled Jacobian; inverted hexahedra; largest edge ratio; distance to the shape in per cent of its diagonal;
processor seconds to make and to mesh. The last rows say how many shapes meet each target.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from report import Report

HOME = Path(__file__).resolve().parent.parent


def inputs():
    beside = HOME.parent / "shared"
    shapes = sorted(Path(os.environ.get("POLYCUBE_SHAPES", beside / "shapes")).glob("*.obj"))
    return shapes + sorted(Path(os.environ.get("POLYCUBE_DATA", beside / "data")).glob("*.shape.obj"))


def run(program, *arguments):
    """Exit code, last line of what was said, processor seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:] or [""]
    return done.returncode, said[0], after.ru_utime - before.ru_utime


def one(program, shape, hexes, folder):
    """What is measured of one shape."""
    code, said, seconds = run(program, "make", "-q", shape, "-o", folder / "made")
    row = {"make_code": code, "make_seconds": seconds}
    if code not in (0, 4):
        return row | {"said": said}
    made = json.loads((folder / "made/report.json").read_text())["report"]
    row |= {"corners": made["corners"], "folded": len(made["folded"]), "misfit": made["misfit"]}
    row |= {"squashed": (made["distortion"] or {}).get("squashed_share"), "added": made["added"]}
    pair = [folder / f"made/{name}.obj" for name in ("shape", "polycube")]
    labels = folder / "made/polycube.labels"
    options = ["--polycube", pair[1], "--labels", labels, "--hexes", hexes, "-o", folder / "mesh"]
    code, said, seconds = run(program, "remesh", "-q", pair[0], *options)
    row |= {"mesh_code": code, "mesh_seconds": seconds}
    if code not in (0, 4):
        return row | {"said": said}
    report = json.loads((folder / "mesh/report.json").read_text())
    return row | {"report": report}


def measures(row):
    """The numbers of a row, or nothing where no mesh came out."""
    if "report" not in row:
        return None
    return row["report"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--polycube", type=Path, default=HOME / "target/release/polycube")
    parser.add_argument("--hexes", type=int, default=15000)
    parser.add_argument("--output", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("shapes", nargs="*", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        for shape in options.shapes or inputs():
            folder = (options.out or Path(scratch)) / shape.name.removesuffix(".obj")
            folder.mkdir(parents=True, exist_ok=True)
            row = one(options.polycube, shape, options.hexes, folder)
            print(json.dumps(row)[:3000])


if __name__ == "__main__":
    sys.exit(main())
