"""Measures a build and writes tables of ratios in Markdown; `bench/run` builds it and calls this.

Exits with 1 if a target is missed or an answer differs from another program's.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from math import log
from pathlib import Path

import others
from report import Report, machine, milliseconds, process

ROOT = Path(__file__).resolve().parent.parent
BUNNY = "marco2016sgp-bunny"


def timings(release, mode, *arguments):
    """What the example prints, one object for each line."""
    command = [release / "examples" / "timings", mode, *map(str, arguments)]
    return [json.loads(line) for line in subprocess.check_output(command).splitlines()]


def data_folder():
    folder = Path(os.environ.get("POLYCUBE_DATA", ROOT.parent / "shared" / "data"))
    return folder if (folder / "reference.json").is_file() else None


def allowed(corners):
    """5 ms up to 60 corners, 50 ms for 230, in between in proportion."""
    return max(5.0, 5.0 + (corners - 60) * 45.0 / 170.0)


def models(report, release, folder):
    """From a mesh in memory to counts: structure, check, alignment."""
    for line in timings(release, "models", *sorted(folder.glob("*.polycube.obj"))):
        name = Path(line["file"]).name.removesuffix(".polycube.obj")
        report.target(f"mesh to counts, {name}", f"{line['corners']} corners", line["total"], allowed(line["corners"]))


def command(report, release, folder):
    """The whole command, against reading and writing both files."""
    files = [folder / f"{BUNNY}.{kind}.obj" for kind in ("polycube", "shape")]
    with tempfile.TemporaryDirectory() as out:
        lines = [timings(release, "copy", file, out)[0] for file in files]
        copies = sum(line["read"] + line["write"] for line in lines)
        call = [release / "polycube", "simplify", files[0], "--shape", files[1], "-o", Path(out) / "result", "--quiet"]
        for strategy, allowed in (("paper", 4 * copies), ("best", 500.0)):
            whole = [*call, "--strategy", strategy]
            spent = milliseconds(lambda: subprocess.run(whole, capture_output=True, check=True), runs=5)
            report.target(f"`polycube simplify --strategy {strategy}`, bunny", "18,496 triangles", spent, allowed)
            if strategy == "paper":
                report.row("… over reading and writing its files", "", f"{spent / copies:.2f}", "4", "")
    hexes, spent, _ = hexahedra(release, files[1], files[0])(30_000)
    report.target("`polycube remesh --hexes 30000`, bunny", f"{hexes:,} hexahedra", spent, 10_000.0)


def bridge(report, release, folder):
    """What calling from C++ adds, against a twentieth of what the core takes."""
    program = release.parent / "cpp" / "bench" / "bench" / "bridge"
    if not program.is_file():
        return report.row("what the bridge to C++ adds: not built", "", "", "", "")
    files = [folder / f"{BUNNY}.{kind}.obj" for kind in ("polycube", "shape")]
    line = json.loads(subprocess.check_output([program, *files]))
    report.target("what the bridge to C++ adds, bunny", "18,496 triangles", 1e3 * line["added"], 1e3 * line["core"] / 20.0)


def morph(report, release, folder):
    line = timings(release, "morph", folder / f"{BUNNY}.polycube.mesh")[0]
    size = f"{line['cells']:,} tetrahedra"
    report.target("morph", size, line["morph"], 2000.0)
    report.target("most memory: reading, structure, morph", size, line["peak_mb"], 1024.0, "MB")


def growth(report, title, unit, sizes, measure):
    """Time and memory as the input grows, one process for each size."""
    report.table(title, unit, "ms", "µs each", "MB", "kB each", "time grows as")
    last = None
    for wish in sizes:
        size, spent, peak = measure(wish)
        grows = "" if last is None else f"x^{log(spent / last[1]) / log(size / last[0]):.2f}"
        report.row(f"{size:,}", spent, 1e3 * spent / size, peak, 1024.0 * peak / size, grows)
        last = size, spent


def generated(release, mode, time):
    """Size, milliseconds and MB of the example `timings` on a generated polycube of a given size."""

    def measure(wish):
        line = timings(release, mode, wish)[0]
        return line[mode], line[time], line["peak_mb"]

    return measure


def hexahedra(release, shape, polycube, strategy="best"):
    """Size, milliseconds and MB of `polycube remesh` for a given number of hexahedra."""

    def measure(wish):
        with tempfile.TemporaryDirectory() as out:
            call = ["remesh", shape, "--polycube", polycube, "--hexes", wish, "--strategy", strategy, "-o", out, "--quiet"]
            spent, peak = process([release / "polycube", *call])
            report = json.loads((Path(out) / "report.json").read_text())
        return report["hexes"], spent, peak

    return measure


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("release", type=Path, help="folder with the build")
    parser.add_argument("highs", type=Path, help="folder with a build that has the feature `highs`")
    parser.add_argument("files", type=Path, help="folder with problems and systems of the library's tests, and systems.json")
    parser.add_argument("--quick", action="store_true", help="without other programs and without the largest sizes")
    parser.add_argument("--output", metavar="FILE", help="write the tables there, too")
    return parser.parse_args()


def main():
    given = arguments()
    release, report, folder = given.release.resolve(), Report(given.output), data_folder()
    report.line("# Measurements of Polycube\n")
    report.line(f"{machine()}. Where the machine was busy, times are processor times.")
    if folder is None:
        report.line("\nWithout real polycubes (POLYCUBE_DATA) there are no targets.")
    else:
        report.table("Targets", "what", "size", "measured", "allowed", "measured / allowed")
        for part in (models, command, bridge, morph):
            part(report, release, folder)
    last = slice(-1) if given.quick else slice(None)
    sizes = [100, 1000, 10_000][last]
    growth(report, "Growth: mesh to counts", "corners", sizes, generated(release, "corners", "total"))
    sizes = [10_000, 100_000, 1_000_000][last]
    measure = generated(release, "tetrahedra", "simplify")
    growth(report, "Growth: simplify with morph, strategy `paper`", "tetrahedra", sizes, measure)
    with tempfile.TemporaryDirectory() as demo:
        subprocess.run([release / "polycube", "demo", "-o", demo, "--quiet"], check=True)
        pair = [Path(demo) / "examples" / f"stepped-l.{kind}.mesh" for kind in ("shape", "polycube")]
        sizes = [10_000, 100_000, 500_000][last]
        # One mesh for each size: `best` may make several until one is good.
        measure = hexahedra(release, *pair, strategy="paper")
        growth(report, "Growth: `polycube remesh --strategy paper` of an example", "hexahedra", sizes, measure)
    if not given.quick:
        others.alignments(report, release, given.highs.resolve(), given.files)
        others.factorisations(report, json.loads((given.files / "systems.json").read_text()), given.files)
    report.line(f"\n{report.missed} targets missed or answers that differ")
    return 1 if report.missed else 0


if __name__ == "__main__":
    sys.exit(main())
