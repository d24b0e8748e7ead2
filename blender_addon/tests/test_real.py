# SPDX-License-Identifier: GPL-3.0-or-later
"""Real polycubes, where they are: POLYCUBE_DATA, by default ../shared/data."""

import os
from pathlib import Path

import bpy
import numpy as np
import polycube
import pytest
from solids import add, faces_of, points_of, write

DATA = Path(os.environ.get("POLYCUBE_DATA", Path(__file__).parents[3] / "shared" / "data"))


@pytest.fixture
def folder():
    """The folder with the models."""
    if not DATA.is_dir():
        assert os.environ.get("POLYCUBE_REQUIRE_DATA") != "1", f"{DATA} is missing"
        pytest.skip("no data")
    return DATA


@pytest.mark.parametrize("name", ["marco2016sgp-asm", "l12014-rod"])
def test_results_are_those_of_the_command(folder, settings, command, tmp_path, name):
    shape, cube = (polycube.read(folder / f"{name}.{what}.obj") for what in ("shape", "polycube"))
    settings.shape = add("Shape", shape.points, shape.cells)
    settings.polycube = add("Cube", cube.points, cube.cells)
    assert bpy.ops.polycube.check() == {'FINISHED'}
    bpy.ops.polycube.simplify(steps=100)
    simplified = points_of(bpy.context.object.data)
    body = write(tmp_path / "body.obj", points_of(settings.shape.data), faces_of(settings.shape.data))
    out = command("simplify", folder / f"{name}.polycube.obj", "--shape", body, "--steps", 100)
    # Its levels are whole numbers, so the lattice is that of the file.
    assert np.array_equal(simplified, polycube.read(out / "polycube.obj").points.astype(np.float32))
    bpy.ops.polycube.quad_remesh()
    assert not bpy.context.object.data.validate()
