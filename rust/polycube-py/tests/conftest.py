"""What the tests share: example pairs, the command to compare with, and meshes that are wrong in one way each."""

import os
import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

import polycube

ROOT = Path(__file__).resolve().parents[3]


# A shell that starts the tests in the background leaves SIGINT ignored, and Python then does not listen to it.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def pair() -> tuple[polycube.Mesh, polycube.Mesh]:
    """Shape and polycube of tetrahedra."""
    return polycube.example("stepped-l")


@pytest.fixture(scope="session")
def surfaces() -> tuple[polycube.Mesh, polycube.Mesh]:
    """Shape and polycube of quadrilaterals."""
    return polycube.example("stepped-l", kind="quads")


@pytest.fixture(scope="session")
def slow() -> tuple[polycube.Mesh, dict]:
    """A polycube and options that keep `simplify` busy for minutes."""
    return polycube.example("double-torus")[1], {"steps": 10_000_000}


@pytest.fixture(scope="session")
def command():
    """Runs the `polycube` command of the same build."""
    program = os.environ.get("POLYCUBE_COMMAND")
    if program is None:
        pytest.skip("POLYCUBE_COMMAND does not name the command")

    def run(*arguments: object) -> None:
        subprocess.run([program, *map(str, arguments), "--quiet"], check=True)

    return run


CUBE_POINTS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
CUBE_QUADS = np.array(
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]], dtype=np.uint32
)


@pytest.fixture
def cube() -> polycube.Mesh:
    """The unit cube of six quadrilaterals; labels 5 4 3 2 1 0."""
    return polycube.Mesh(CUBE_POINTS, CUBE_QUADS, "quads")
