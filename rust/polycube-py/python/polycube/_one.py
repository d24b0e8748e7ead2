"""The process of `polycube.batch`: meshes the shape that standard input tells of, and prints its row."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import polycube

GIB = 1024**3


def limit_memory(gib: float | None) -> None:
    """Caps the address space of this process, so that a shape too large ends it and not the machine."""
    if gib is not None:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (int(gib * GIB), int(gib * GIB)))


def mesh(job: dict[str, Any]) -> dict[str, Any]:
    """Meshes the shape and writes the meshes."""
    if job["polycube"] is None:
        shape, cube = polycube.read(job["shape"]), None
    else:
        shape, cube = polycube.read_pair(job["shape"], job["polycube"])
    meshes = polycube.remesh(shape, cube, **job["options"])
    folder = Path(job["folder"])
    meshes.quads.write(folder / "quads.obj")
    if meshes.hexes is not None:
        meshes.hexes.write(folder / "hexes.vtu")
    return row(meshes)


def row(meshes: polycube.Remeshed) -> dict[str, Any]:
    """What the table says of meshes."""
    report, after = meshes.report, meshes.simplified.counts_after
    names = ("quads", "hexes", "min_sj", "avg_sj", "inverted", "hausdorff_percent")
    return {
        "status": "done",
        "message": "; ".join(meshes.notes) or None,
        "good": meshes.good,
        **{name: report[name] for name in names},
        "blocks_before": meshes.simplified.counts_before.blocks_padded,
        "blocks_after": after and after.blocks_padded,
        "seconds": report["seconds"]["total"],
    }


def main() -> None:
    job = json.load(sys.stdin)
    limit_memory(job["max_memory"])
    try:
        found = mesh(job)
    except polycube.PolycubeError as error:
        found = {"status": "failed", "kind": error.kind, "message": str(error)}
    except TypeError as error:  # an option that there is not
        found = {"status": "failed", "kind": "option", "message": str(error)}
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main()
