"""Where the tests find the plugin, the command, and MeshLab.

POLYCUBE_COMMAND        the command `polycube`
POLYCUBE_PYMESHLAB      the plugin for PyMeshLab; tests of it are skipped without
POLYCUBE_MESHLABSERVER  a meshlabserver 2020.09 that has the plugin; tests of it are skipped without
POLYCUBE_MODULE         the plugin for the program MeshLab 2025.07; tests of it are skipped without
POLYCUBE_MODULE_2020    the plugin for the program MeshLab 2020.09
"""

import os
import subprocess
from pathlib import Path

import numpy
import pytest


ROOT = Path(__file__).resolve().parents[2]


def required(name):
    if name not in os.environ:
        pytest.skip(f"{name} is not set")
    return Path(os.environ[name]).resolve()


class Mesh:
    """Vertices, and faces as lists of vertices from 0."""

    def __init__(self, points, faces):
        self.points = numpy.asarray(points, dtype=float)
        self.faces = [list(map(int, face)) for face in faces]

    def write(self, path):
        """As OFF: the OBJ reader of MeshLab 2020.09 stops on sound files."""
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += [" ".join(repr(float(x)) for x in point) for point in self.points]
        lines += [" ".join(map(str, [len(face), *face])) for face in self.faces]
        Path(path).write_text("\n".join(lines) + "\n")
        return path

    @staticmethod
    def read(path):
        """From OBJ."""
        rows = [line.split() for line in Path(path).read_text().splitlines()]
        points = [row[1:4] for row in rows if row and row[0] == "v"]
        faces = [[int(v.split("/")[0]) - 1 for v in row[1:]] for row in rows if row and row[0] == "f"]
        return Mesh(numpy.array(points, dtype=float), faces)


@pytest.fixture(scope="session")
def command():
    """Runs the command; gives back the folder that it wrote to."""
    program = required("POLYCUBE_COMMAND")

    def run(folder, *arguments):
        arguments = [str(program), *map(str, arguments), "-o", str(folder)]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=300)
        assert done.returncode in (0, 4), done.stderr
        return Path(folder)

    return run


@pytest.fixture(scope="session")
def quad_pair(command, tmp_path_factory):
    """The ring as the command makes it, in quadrilaterals and single precision: a polycube and its shape."""
    required("POLYCUBE_COMMAND")
    folder = command(tmp_path_factory.mktemp("demo"), "demo")
    found = [Mesh.read(next(folder.rglob(f"ring.{name}.obj"))) for name in ("polycube", "shape")]
    return [Mesh(numpy.float32(mesh.points), mesh.faces) for mesh in found]


@pytest.fixture(scope="session")
def pair(command, tmp_path_factory):
    """The cube with spikes as the command makes it, in triangles and single precision: a polycube and its shape."""
    required("POLYCUBE_COMMAND")
    folder = command(tmp_path_factory.mktemp("demo"), "demo")
    found = []
    for name in ("polycube", "shape"):
        mesh = Mesh.read(next(folder.rglob(f"*spikes*.{name}.obj")))
        triangles = [half for a, b, c, d in mesh.faces for half in ([a, b, c], [a, c, d])]
        found.append(Mesh(numpy.float32(mesh.points), triangles))
    return found
