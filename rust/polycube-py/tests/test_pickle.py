"""Pickling and copying: what comes back is the same, bit by bit, and goes on working."""

import copy
import pickle

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_QUADS

import polycube

WAYS = {
    "protocol 2": lambda x: pickle.loads(pickle.dumps(x, 2)),
    "newest protocol": lambda x: pickle.loads(pickle.dumps(x, pickle.HIGHEST_PROTOCOL)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}


@pytest.fixture(scope="module")
def results() -> dict[str, object]:
    """An object of every class that can be pickled."""
    shape, cube = polycube.example("stepped-l", kind="triangles")
    volume = polycube.example("stepped-l")
    flat = polycube.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], "tetrahedra")
    meshes = polycube.remesh(polycube.Mesh(CUBE_POINTS, CUBE_QUADS, "quads"), hexes=60)
    simple = polycube.simplify(cube, shape, guides={"fixed": [0]}, max_displacement=0.01, steps=20)
    naive = polycube.simplify(volume[1], strategy="naive", scale=0.05)
    assert naive.polycube is None
    return {
        "Mesh": shape,
        "volume": volume[0],
        "Counts": simple.counts_before,
        "TradeOff": simple.front[0],
        "Violation": polycube.check(flat)[0],
        "Structure": polycube.structure(cube),
        "Made": meshes.made,
        "Simplified": simple,
        "paper": polycube.simplify(*reversed(volume), strategy="paper"),
        "naive": naive,
        "Quads": meshes.quads,
        "Hexes": meshes.hexes,
        "SingularEdge": meshes.layout.singular_edges[0],
        "Layout": meshes.layout,
        "Remeshed": meshes,
    }


def contents(value: object) -> object:
    """All that a result shows, as values that can be compared; arrays with their types and bits."""
    if isinstance(value, np.ndarray):
        return (str(value.dtype), value.shape, value.tobytes())
    if isinstance(value, list | tuple):
        return [contents(x) for x in value]
    if type(value).__module__ != "polycube":
        return repr(value)
    names = [name for name, member in vars(type(value)).items() if type(member).__name__ == "getset_descriptor"]
    return {name: contents(getattr(value, name)) for name in sorted(names)} | {"repr": repr(value)}


NAMES = ["Mesh", "volume", "Counts", "TradeOff", "Violation", "Structure", "Made", "Simplified", "paper", "naive"]
NAMES += ["Quads", "Hexes", "SingularEdge", "Layout", "Remeshed"]


@pytest.mark.parametrize("name", NAMES)
def test_everything_comes_back_bit_by_bit(results, name):
    before = contents(results[name])
    assert len(before) > 1
    bytes_before = pickle.dumps(results[name])
    for way in WAYS.values():
        again = way(results[name])
        assert type(again) is type(results[name])
        assert contents(again) == before
        assert pickle.dumps(again) == bytes_before


def test_every_class_is_among_them(results):
    classes = {v for v in vars(polycube).values() if isinstance(v, type) and v.__module__ == "polycube"}
    assert {type(value) for value in results.values()} == classes - {polycube.Job}
    with pytest.raises(TypeError, match="Job"):
        pickle.dumps(polycube.Job.make(results["Mesh"]))


def test_a_result_that_comes_back_moves_along_its_front(results):
    simple, again = results["Simplified"], pickle.loads(pickle.dumps(results["Simplified"]))
    for move in (lambda s: s.at(0.0), lambda s: s.rescaled(2 * s.scale)):
        one, other = move(simple), move(again)
        assert one.levels.tobytes() == other.levels.tobytes()
        assert one.polycube.points.tobytes() == other.polycube.points.tobytes()
        assert one.notes == other.notes


def test_meshes_that_come_back_write_the_same_files(results, tmp_path):
    again = pickle.loads(pickle.dumps(results["Remeshed"]))
    for name, meshes in (("one", results["Remeshed"]), ("other", again)):
        meshes.hexes.write(tmp_path / f"{name}.vtu")
        meshes.hexes.write(tmp_path / f"{name}.msh")
        meshes.quads.write(tmp_path / f"{name}.ply")
    for extension in ("vtu", "msh", "ply"):
        assert (tmp_path / f"one.{extension}").read_bytes() == (tmp_path / f"other.{extension}").read_bytes()


def test_a_repaired_input_comes_back():
    _, cube = polycube.example("ring", kind="quads")
    inward = polycube.Mesh(cube.points, cube.cells[:, ::-1], "quads")
    simple = polycube.simplify(inward, strategy="paper")
    assert any("turned" in note for note in simple.notes)
    assert contents(pickle.loads(pickle.dumps(simple))) == contents(simple)


def test_pickles_of_other_versions_and_broken_ones_are_refused(results):
    restore, (name, version, parts, rest) = results["Quads"].__reduce__()
    assert version == polycube.__version__
    with pytest.raises(polycube.Unsupported, match=f"pickled by polycube 99.0.0, and this is {version}") as caught:
        restore(name, "99.0.0", parts, rest)
    assert caught.value.remedy
    with pytest.raises(polycube.ParseError):
        restore(name, version, parts, rest[:-3])
    with pytest.raises(polycube.ParseError, match="Prisms"):
        restore("Prisms", version, parts, rest)
