# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests in a real Blender (`bpy`), with the extension installed from its zip as a user would install it.

`tests/blender` runs them, with these variables:
POLYCUBE_ZIP      the extension
POLYCUBE_COMMAND  the command whose results must be the same
"""

import os
import subprocess
import tempfile
from pathlib import Path

# Before Blender starts: it must not see the settings of whoever runs the tests.
SETTINGS = tempfile.TemporaryDirectory(prefix="polycube-blender-", ignore_cleanup_errors=True)
os.environ["BLENDER_USER_RESOURCES"] = SETTINGS.name

import bpy
import pytest

# As a user does it, and before the tests import the Python module that comes with it.
INSTALLED = bpy.ops.extensions.package_install_files(
    filepath=os.environ["POLYCUBE_ZIP"], repo="user_default", enable_on_install=True
)

from solids import add_pair, solid  # noqa: E402


@pytest.fixture(scope="session")
def extension():
    """The name under which Blender knows the extension, which is switched on."""
    assert INSTALLED == {'FINISHED'}
    return "bl_ext.user_default.polycube"


@pytest.fixture(autouse=True)
def empty_file(extension):
    """Every test starts from an empty scene."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.ed.undo_push(message="empty")


@pytest.fixture
def settings(empty_file):
    """What the panel says."""
    return bpy.context.scene.polycube


@pytest.fixture
def pair(settings):
    """Two objects: a bent shape and its polycube, whose parts miss each other by one step."""
    shape, cube = add_pair(*solid())
    settings.source, settings.shape, settings.polycube = 'OBJECTS', shape, cube
    return shape, cube


@pytest.fixture
def command(tmp_path):
    """Runs the command on meshes; gives its output folder."""

    def run(subcommand, *arguments):
        out = tmp_path / f"out{len(list(tmp_path.iterdir()))}"
        call = [os.environ["POLYCUBE_COMMAND"], subcommand, *map(str, arguments), "-o", str(out), "--quiet"]
        subprocess.run(call, check=True)
        return Path(out)

    return run
