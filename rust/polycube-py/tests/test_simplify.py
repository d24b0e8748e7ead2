"""`simplify`: results, options, guides, the front, and equality with the command."""

import inspect
import json

import numpy as np
import pytest

import polycube


def test_fewer_blocks_and_a_valid_polycube(pair):
    shape, mesh = pair
    simple = polycube.simplify(mesh, shape)
    assert simple.valid
    assert simple.counts_after.blocks_padded < simple.counts_before.blocks_padded
    assert np.array_equal(simple.polycube.cells, mesh.cells)
    found = polycube.structure(simple.polycube, simple.labels)
    assert found.counts == simple.counts_after
    assert np.array_equal(found.levels, simple.levels)
    assert np.array_equal(found.label, simple.labels)
    assert simple.structure.counts == simple.counts_before
    assert {v.kind for v in polycube.check(simple.polycube, simple.labels)} <= {"inverted_cell", "flipped_face"}


def test_dtypes(pair):
    simple = polycube.simplify(pair[1], strategy="paper")
    assert (simple.labels.dtype, simple.levels.dtype) == (np.int8, np.int64)
    with pytest.raises(ValueError, match="read-only"):
        simple.levels[0] = 0


def test_the_report_is_that_of_the_library(pair):
    simple = polycube.simplify(pair[1], pair[0])
    report = simple.report
    assert report["after"]["blocks"] == simple.counts_after.blocks
    assert report["scale"] == simple.scale
    assert report["notes"] == simple.notes
    assert [(p["count"], p["displacement"]) for p in report["front"]] == [(p.count, p.displacement) for p in simple.front]


@pytest.mark.parametrize("strategy", ["best", "paper"])
@pytest.mark.parametrize("index", [0, 1])
def test_the_same_bytes_as_the_command(tmp_path, command, pair, strategy, index):
    """The polycube and its labels, of a volume and of a surface, for each strategy."""
    shape, mesh = pair if index == 0 else polycube.example("cube-spikes", kind="triangles")
    extension = "mesh" if index == 0 else "obj"
    files = tmp_path / f"shape.{extension}", tmp_path / f"polycube.{extension}"
    shape.write(files[0])
    mesh.write(files[1])
    options = ["--strategy", strategy, "--scale", 2]
    command("simplify", files[1], "--shape", files[0], "-o", tmp_path / "out", *options)
    simple = polycube.simplify(*reversed(polycube.read_pair(*files)), strategy=strategy, scale=2)
    own = tmp_path / f"own.{extension}"
    simple.polycube.write(own)
    assert own.read_bytes() == (tmp_path / "out" / f"polycube.{extension}").read_bytes()
    labels = "".join(f"{label}\n" for label in simple.labels)
    assert labels == (tmp_path / "out" / "polycube.labels").read_text()
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    for key in ("after", "front", "distortion", "flipped", "max_displacement", "notes"):
        assert report[key] == simple.report[key], key


def test_lattice_size(pair):
    twice = polycube.simplify(pair[1], strategy="paper", scale=2)
    same = polycube.simplify(pair[1], strategy="paper", edge_length=0.5)
    assert twice.scale == same.scale == 2
    assert np.array_equal(twice.levels, same.levels)


def test_labels_are_used(cube):
    simple = polycube.simplify(cube, labels=[5, 4, 3, 2, 1, 0])
    assert simple.labels.tolist() == [5, 4, 3, 2, 1, 0]
    with pytest.raises(polycube.InvalidPolycube):
        polycube.simplify(cube, labels=[5, 4, 3, 2, 0, 1], angle_tolerance=30)


def test_a_shape_of_something_else(pair, cube):
    with pytest.raises(polycube.Mismatch) as caught:
        polycube.simplify(pair[1], cube)
    assert caught.value.kind == "mismatch"
    assert caught.value.remedy


def test_naive_may_break_the_polycube():
    mesh = polycube.example("ring", kind="quads")[1]
    simple = polycube.simplify(mesh, strategy="naive", scale=0.05)
    assert not simple.valid
    assert simple.polycube is None and simple.counts_after is None
    assert simple.notes and "not valid" in repr(simple)


def test_the_front_and_simplicity():
    mesh = polycube.example("cube-spikes", kind="quads")[1]
    simple = polycube.simplify(mesh)
    front = simple.front
    assert len(front) > 1
    assert all(a.count < b.count and a.displacement > b.displacement for a, b in zip(front, front[1:]))
    for simplicity, point in [(1.0, front[0]), (0.0, front[-1])]:
        moved = simple.at(simplicity)
        again = polycube.simplify(mesh, simplicity=simplicity)
        assert moved.counts_after.surface_patches == point.count
        assert np.array_equal(moved.polycube.points, again.polycube.points)
        assert moved.at(1.0).counts_after == simple.counts_after
    with pytest.raises(polycube.InvalidOption):
        simple.at(1.5)
    with pytest.raises(polycube.InvalidOption, match="no front"):
        polycube.simplify(mesh, strategy="paper").at(0.5)


def test_another_scale_has_the_same_blocks():
    mesh = polycube.example("cube-spikes", kind="quads")[1]
    simple = polycube.simplify(mesh)
    finer = simple.rescaled(2.5)
    again = polycube.simplify(mesh, scale=2.5)
    assert finer.scale == 2.5 and finer.counts_after == simple.counts_after
    assert np.array_equal(finer.levels, again.levels)
    assert np.array_equal(finer.polycube.points, again.polycube.points)
    assert np.array_equal(finer.rescaled(simple.scale).polycube.points, simple.polycube.points)
    with pytest.raises(polycube.InvalidOption):
        simple.rescaled(0.0)
    fixed = polycube.simplify(mesh, guides={"fixed": list(range(len(simple.structure.facet_level)))})
    with pytest.raises(polycube.Infeasible):
        fixed.rescaled(0.05)


def facet_planes(simple: polycube.Simplified) -> np.ndarray:
    return simple.levels[simple.structure.facet_level]


def test_locked_faces_stay():
    mesh = polycube.example("cube-spikes", kind="quads")[1]
    found = polycube.structure(mesh)
    before = found.levels[found.facet_level]
    free = facet_planes(polycube.simplify(mesh))
    facet = int(np.flatnonzero(free != before)[0])
    face = int(np.flatnonzero(found.facet == facet)[0])
    for lock in ({"locked_faces": [face]}, {"guides": {"fixed": [facet]}}):
        assert facet_planes(polycube.simplify(mesh, **lock))[facet] == before[facet]


def test_guides_together_and_apart():
    mesh = polycube.example("cube-spikes", kind="quads")[1]
    found = polycube.structure(mesh)
    free = facet_planes(polycube.simplify(mesh))
    axis = found.facet_label // 2
    levels = found.facet_level
    pairs = [
        (a, b)
        for a in range(len(axis))
        for b in range(a)
        if axis[a] == axis[b] and levels[a] != levels[b] and free[a] == free[b]
    ]
    a, b = pairs[0]
    apart = facet_planes(polycube.simplify(mesh, guides={"apart": [[int(a), int(b)]]}))
    assert apart[a] != apart[b]
    together = facet_planes(polycube.simplify(mesh, guides={"together": [[int(a), int(b)]]}))
    assert together[a] == together[b]


def test_bad_guides(cube):
    for guides in ({"fixed": [6]}, {"fixed": "all"}, {"loose": []}, {"symmetry": [{"axis": 3, "at": 0.5}]}, [1]):
        with pytest.raises(polycube.InvalidOption):
            polycube.simplify(cube, guides=guides)
    with pytest.raises(polycube.InvalidOption, match="face 6: .* only 6 boundary faces"):
        polycube.simplify(cube, locked_faces=[6])
    with pytest.raises(polycube.InvalidOption, match=r"locked_faces is a mask of the shape \[5\], .* 6 boundary faces"):
        polycube.simplify(cube, locked_faces=np.ones(5, bool))
    with pytest.raises(polycube.InvalidOption, match="negative"):
        polycube.simplify(cube, locked_faces=[-1])
    with pytest.raises(TypeError):
        polycube.simplify(cube, guides={"fixed": object()})


def test_a_mask_locks_the_faces_that_it_names():
    mesh = polycube.example("cube-spikes", kind="quads")[1]
    found = polycube.structure(mesh)
    moved = facet_planes(polycube.simplify(mesh, strategy="paper")) != found.levels[found.facet_level]
    mask = found.facet == np.flatnonzero(moved)[0]
    masked = polycube.simplify(mesh, strategy="paper", locked_faces=mask)
    numbered = polycube.simplify(mesh, strategy="paper", locked_faces=np.flatnonzero(mask))
    assert np.array_equal(masked.levels, numbered.levels)
    assert not np.array_equal(masked.levels, polycube.simplify(mesh, strategy="paper").levels)


def test_whole_numbers_may_be_floats(cube):
    whole = {"hexes": 60, "padding": 2, "steps": 30, "proof_nodes": 10}
    wanted = polycube.remesh(cube, cube, **whole).hexes.points
    for kind in (float, np.float64, np.float32, np.int16):
        given = {name: kind(value) for name, value in whole.items()}
        assert np.array_equal(polycube.remesh(cube, cube, **given).hexes.points, wanted)
    for bad in (60.5, float("nan"), float("inf"), "60"):
        with pytest.raises(TypeError, match="hexes"):
            polycube.remesh(cube, cube, hexes=bad)


@pytest.mark.parametrize("function", [polycube.Job.simplify, polycube.Job.remesh, polycube.Job.make])
def test_no_option_is_nan(cube, function):
    """At once, before any work, with the name of the option."""
    refused = 0
    for name, parameter in inspect.signature(function).parameters.items():
        if parameter.kind is parameter.KEYWORD_ONLY:
            with pytest.raises((polycube.InvalidOption, TypeError), match=name):
                function(cube, **{name: float("nan")})
            refused += 1
    assert refused >= 3


def test_limits(pair):
    shape, mesh = pair
    free = polycube.simplify(mesh, shape)
    limit = free.report["max_displacement"] / 2
    near = polycube.simplify(mesh, shape, max_displacement=limit)
    assert near.report["max_displacement"] <= limit or near.notes
    before, after = free.report["distortion"]
    tight = polycube.simplify(mesh, shape, max_distortion=max(1.0, after["angle"] * 0.999))
    assert tight.report["distortion"][1]["angle"] <= after["angle"]


@pytest.mark.parametrize(
    "option",
    [
        {"strategy": "worst"},
        {"objective": "faces"},
        {"solver": "magic"},
        {"scale": 0},
        {"scale": float("nan")},
        {"scale": 1e30},
        {"edge_length": -1},
        {"scale": 1, "edge_length": 1},
        {"simplicity": 1.1},
        {"lambda_min": -0.1},
        {"max_displacement": -1},
        {"max_displacement": float("inf")},
        {"max_distortion": 0.5},
        {"time_limit": 0},
        {"time_limit": 1e300},
    ],
)
def test_options_out_of_range(cube, option):
    with pytest.raises(polycube.InvalidOption) as caught:
        polycube.simplify(cube, **option)
    assert caught.value.kind == "option"


@pytest.mark.parametrize("option", [{"steps": -1}, {"steps": "many"}, {"scale": "big"}, {"strategy": 1}, {"speed": 1}])
def test_options_of_wrong_type(cube, option):
    with pytest.raises(TypeError, match=next(iter(option))):
        polycube.simplify(cube, **option)


@pytest.mark.parametrize("function", [polycube.simplify, polycube.Job.simplify, polycube.remesh, polycube.Job.remesh])
def test_every_option_of_the_signature_is_taken_with_its_default(cube, function):
    """The signature is text: it could name what the function does not know, or miss what it does."""
    parameters = inspect.signature(function).parameters.values()
    defaults = {p.name: p.default for p in parameters if p.kind is p.KEYWORD_ONLY}
    assert len(defaults) >= 17
    meshes = [cube, cube]
    result = function(*meshes, **defaults)
    if isinstance(result, polycube.Job):
        result = result.result()
    plain = function(*meshes)
    plain = plain.result() if isinstance(plain, polycube.Job) else plain
    for r in (result, plain):
        assert isinstance(r, (polycube.Simplified, polycube.Remeshed))
    a, b = (getattr(r, "simplified", r).levels for r in (result, plain))
    assert np.array_equal(a, b)
