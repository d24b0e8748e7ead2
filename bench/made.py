#!/usr/bin/env python3
"""Makes polycubes of plain shapes, meshes them, and writes what came out as a table.

    bench/made.py [--polycube PROGRAM] [--hexes N] [--make-only] [--output FILE] [SHAPE...]

SHAPE is a closed triangle mesh; by default all of $POLYCUBE_SHAPES (or ../shared/shapes beside the project) and the
shapes of $POLYCUBE_DATA (or ../shared/data). PROGRAM is target/release/polycube. Everything is done with default
options. Folded is the number of faces turned over by the map, blocks are counted without padding, min and mean are of
the scaled Jacobian, distances are in per cent of the shape's diagonal, and seconds are those of processors. The last
lines say how many shapes meet each target.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from report import Report, machine, processor_time

# Exit codes of the command with results: done, and done with warnings.
FINISHED = (0, 4)
HOME = Path(__file__).resolve().parent.parent


def inputs():
    beside = HOME.parent / "shared"
    shapes = sorted(Path(os.environ.get("POLYCUBE_SHAPES", beside / "shapes")).glob("*.obj"))
    return shapes + sorted(Path(os.environ.get("POLYCUBE_DATA", beside / "data")).glob("*.shape.obj"))


def run(program, *arguments):
    """Exit code, last line of what was said, processor seconds."""
    before = processor_time()
    done = subprocess.run([str(program), *map(str, arguments)], capture_output=True, text=True)
    seconds = processor_time() - before
    said = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:] or [""]
    return done.returncode, said[0], seconds


def made(program, shape, folder):
    """What is measured of the polycube of a shape."""
    code, said, seconds = run(program, "make", "-q", shape, "-o", folder / "made")
    row = {"make_seconds": seconds}
    if code not in FINISHED:
        return row | {"said": said}
    report = json.loads((folder / "made/report.json").read_text())
    return row | {name: report[name] for name in ("corners", "misfit", "squashed")} | {"folded": len(report["folded"])}


def meshed(program, hexes, folder):
    """What is measured of the hexahedra of that polycube."""
    shape, polycube = [next(folder.glob(f"made/{name}.[!l]*")) for name in ("shape", "polycube")]
    labels = folder / "made/polycube.labels"
    options = ["--polycube", polycube, "--labels", labels, "--hexes", hexes, "-o", folder / "mesh"]
    code, said, seconds = run(program, "remesh", "-q", shape, *options)
    row = {"mesh_seconds": seconds}
    if code not in FINISHED:
        return row | {"said": said}
    report = json.loads((folder / "mesh/report.json").read_text())
    row |= {name: report[name] for name in ("hexes", "inverted", "min_sj", "avg_sj", "hausdorff_percent")}
    return row | {"blocks": report["after"]["blocks"], "edge_ratio": report["edge_ratio"]["max"]}


# What a column shows of a row, and how.
COLUMNS = {
    "corners": "{corners}",
    "folded": "{folded}",
    "misfit": "{misfit:.4f}",
    "squashed": "{squashed:.4f}",
    "make s": "{make_seconds:.1f}",
    "hexahedra": "{hexes}",
    "blocks": "{blocks}",
    "inverted": "{inverted}",
    "min": "{min_sj:.3f}",
    "mean": "{avg_sj:.3f}",
    "edge ratio": "{edge_ratio:.1f}",
    "distance %": "{hausdorff_percent:.3f}",
    "mesh s": "{mesh_seconds:.1f}",
}


def cell(text, row):
    """A cell of the table; a dash where nothing was measured."""
    try:
        return text.format(**row)
    except (KeyError, TypeError, ValueError):
        return "-"


def summary(report, rows):
    """How many shapes meet each target of the project."""
    meshes = [r for r in rows if r.get("hexes")]
    report.line(f"\nOf {len(rows)} shapes:\n")
    report.line(f"- a polycube for {sum('corners' in r for r in rows)}, {sum(r.get('corners', 0) for r in rows)} corners")
    report.line(f"- no folded face on {sum(r.get('folded') == 0 for r in rows)}")
    report.line(f"- hexahedra for {len(meshes)}, none inverted on {sum(r['inverted'] == 0 for r in meshes)}")
    report.line(f"- least scaled Jacobian .3 or more on {sum(r['min_sj'] >= 0.3 for r in meshes)}")
    report.line(f"- distance .5 % or less on {sum(r['hausdorff_percent'] <= 0.5 for r in meshes)}")
    if meshes:
        least, mean = (statistics.median(r[name] for r in meshes) for name in ("min_sj", "avg_sj"))
        report.line(f"- medians: least scaled Jacobian {least:.3f}, mean {mean:.3f}")
    seconds = [r["make_seconds"] for r in rows]
    report.line(f"- seconds to make: {statistics.median(seconds):.1f} in the median, {max(seconds):.1f} at most")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--polycube", type=Path, default=HOME / "target/release/polycube")
    parser.add_argument("--hexes", type=int, default=15000)
    parser.add_argument("--output", type=Path)
    parser.add_argument("--make-only", action="store_true")
    parser.add_argument("shapes", nargs="*", type=Path)
    options = parser.parse_args()
    shapes = options.shapes or inputs()
    if not shapes:
        parser.error("there are no shapes: name some, or set POLYCUBE_SHAPES")
    report, rows = Report(options.output), []
    report.line(machine())
    report.table("Polycubes of plain shapes", "shape", *COLUMNS)
    for shape in shapes:
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            row = made(options.polycube, shape, folder)
            if "corners" in row and not options.make_only:
                row |= meshed(options.polycube, options.hexes, folder)
        rows.append(row)
        name = shape.name.removesuffix(".obj").removesuffix(".shape")
        report.row(name, *(cell(text, row) for text in COLUMNS.values()))
        if "said" in row:
            report.line(f"| | {row['said']} |")
    summary(report, rows)


if __name__ == "__main__":
    sys.exit(main())
