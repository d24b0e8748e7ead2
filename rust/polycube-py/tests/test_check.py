"""`check` and `structure`: what is wrong with a mesh, and what is found on a good one."""

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_QUADS

import polycube


def quads(points=CUBE_POINTS, cells=CUBE_QUADS) -> polycube.Mesh:
    return polycube.Mesh(points, np.asarray(cells, dtype=np.int64).reshape(-1, 4), "quads")


def moved(vertex, position) -> np.ndarray:
    points = CUBE_POINTS.copy()
    points[vertex] = position
    return points


WRONG = {
    "empty": (quads(cells=[]), None),
    "bad_face": (quads(cells=np.vstack([CUBE_QUADS[:5], [[1, 3, 3, 5]]])), "face"),
    "open_edge": (quads(cells=CUBE_QUADS[:5]), "edge"),
    "inconsistent_orientation": (quads(cells=np.vstack([CUBE_QUADS[:5], CUBE_QUADS[5:, ::-1]])), "edge"),
    "non_manifold_edge": (quads(cells=np.vstack([CUBE_QUADS, CUBE_QUADS[5:]])), "edge"),
    "inside_out": (quads(cells=CUBE_QUADS[:, ::-1]), "face"),
    "skew_face": (quads(CUBE_POINTS @ np.array([[1, 0.9, 0], [-0.9, 1, 0], [0, 0, 1]])), "face"),
}


@pytest.mark.parametrize("rule", WRONG)
def test_every_fault_is_found_with_place_and_remedy(rule):
    mesh, element = WRONG[rule]
    violations = polycube.check(mesh)
    assert rule in {v.kind for v in violations}
    for v in (v for v in violations if v.kind == rule):
        assert v.message and v.remedy and v.mesh == "polycube"
        assert v.element == element
        assert len(v.elements) == {None: 0, "edge": 2}.get(element, 1)
        assert (v.place is None) == (element is None)


# What has one right answer.
REPAIRED = ("inconsistent_orientation", "non_manifold_edge", "inside_out")


@pytest.mark.parametrize("rule", REPAIRED)
def test_what_has_one_right_answer_is_repaired_with_a_note(rule):
    simple = polycube.simplify(WRONG[rule][0])
    assert simple.report["valid"]
    assert any(note.startswith("repaired:") for note in simple.report["notes"])


@pytest.mark.parametrize("rule", [rule for rule in WRONG if rule not in REPAIRED])
def test_what_is_wrong_is_raised_by_all_that_work_on_it(rule):
    mesh, _ = WRONG[rule]
    for call in (polycube.structure, polycube.simplify, lambda m: polycube.remesh(m, m)):
        with pytest.raises((polycube.InvalidMesh, polycube.InvalidPolycube)) as caught:
            call(mesh)
        assert caught.value.message and caught.value.remedy


def test_the_place_is_the_middle_of_the_element():
    violations = polycube.check(quads(cells=CUBE_QUADS[:5]))
    assert {v.elements for v in violations} == {(1, 3), (3, 7), (5, 7), (1, 5)}
    for v in violations:
        assert v.place == tuple(CUBE_POINTS[list(v.elements)].mean(axis=0))
    with pytest.raises(polycube.InvalidMesh) as caught:
        polycube.simplify(quads(cells=CUBE_QUADS[:5]))
    assert caught.value.place == tuple(CUBE_POINTS[list(caught.value.elements)].mean(axis=0))


def test_a_shape_is_checked_too(pair, cube):
    shape, mesh = pair
    mirrored = polycube.Mesh(shape.points * [-1, 1, 1], shape.cells, "tetrahedra")
    violations = polycube.check(mesh, shape=mirrored)
    assert [(v.kind, v.mesh) for v in violations] == [("mirrored", "shape")]
    turned = shape.cells.copy()
    turned[:2] = turned[:2, [1, 0, 2, 3]]
    flat = polycube.Mesh(shape.points, turned, "tetrahedra")
    violations = polycube.check(polycube.Mesh(mesh.points, turned, "tetrahedra"), shape=flat)
    assert [(v.kind, v.mesh) for v in violations] == [("left_handed", "polycube")], "one cause"
    points = shape.points.copy()
    apex, *face = shape.cells[0]
    points[apex] = 2 * points[face].mean(axis=0) - points[apex]
    pushed = polycube.Mesh(points, shape.cells, "tetrahedra")
    assert ("inverted_cell", "shape") in {(v.kind, v.mesh) for v in polycube.check(mesh, shape=pushed)}
    assert "mismatch" in {v.kind for v in polycube.check(mesh, shape=cube)}


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_no_mesh(bad):
    with pytest.raises(polycube.InvalidMesh, match="not a finite number") as caught:
        quads(moved(3, [bad, 0, 0]))
    assert (caught.value.element, caught.value.elements) == ("vertex", (3,)) and caught.value.remedy


def test_check_never_raises_for_a_mesh():
    random = np.random.default_rng(1)
    for kind, corners in [("triangles", 3), ("quads", 4), ("tetrahedra", 4), ("hexahedra", 8)]:
        for _ in range(40):
            points = random.choice([-1e300, -1.0, 0.0, 1.0, 2.0], (9, 3))
            cells = random.integers(0, 9, (random.integers(0, 12), corners))
            assert isinstance(polycube.check(polycube.Mesh(points, cells.reshape(-1, corners), kind)), list)


@pytest.mark.parametrize("labels", [[6] * 6, [0.5] * 6, [[0] * 6]])
def test_labels_that_are_none(cube, labels):
    with pytest.raises((polycube.InvalidOption, TypeError)):
        polycube.check(cube, labels)


def test_labels_count_more_than_normals(cube):
    tilted = polycube.Mesh(cube.points @ np.array([[1, 0.9, 0], [-0.9, 1, 0], [0, 0, 1]]), cube.cells, "quads")
    kinds = {v.kind for v in polycube.check(tilted, [5, 4, 3, 2, 1, 0], level_tolerance=1.0)}
    assert "skew_face" not in kinds


@pytest.mark.parametrize("tolerance", [{"angle_tolerance": 46}, {"angle_tolerance": -1}, {"level_tolerance": 2}])
def test_tolerances_out_of_range(cube, tolerance):
    for call in (polycube.check, polycube.structure, polycube.simplify):
        with pytest.raises(polycube.InvalidOption):
            call(cube, **tolerance)
    with pytest.raises(TypeError, match="unexpected keyword argument 'tolerance'"):
        polycube.check(cube, tolerance=1)


def test_the_structure_of_a_cube(cube):
    found = polycube.structure(cube)
    assert (len(found.corners), len(found.edges), len(found.facet_label)) == (8, 12, 6)
    assert found.label.tolist() == [5, 4, 3, 2, 1, 0]
    assert found.counts == polycube.structure(cube).counts
    counts = found.counts
    assert (counts.surface_patches, counts.blocks, counts.blocks_padded) == (6, 1, 7)
    assert sorted(found.patch_id.tolist()) == [0, 1, 2, 3, 4, 5]
    assert found.block_id.tolist() == [0] * 6
    assert (found.components, found.genus, found.deviation) == (1, 0, (0, 0))
    assert found.corner_valence.tolist() == [3] * 8


def test_the_structure_holds_together(pair):
    mesh = pair[1]
    found = polycube.structure(mesh)
    assert np.array_equal(found.faces, mesh.boundary())
    axis = found.level_axis
    assert np.array_equal(axis[found.facet_level], found.facet_label // 2)
    assert np.array_equal(found.facet_label[found.facet], found.label)
    assert np.array_equal(axis[found.corner_levels], np.tile([0, 1, 2], (len(found.corners), 1)))
    assert np.array_equal(found.levels[found.corner_levels], mesh.points[found.corners])
    at_level = mesh.points[found.faces][np.arange(len(found.faces)), :, found.label // 2]
    assert np.array_equal(at_level, np.repeat(found.levels[found.facet_level[found.facet]][:, None], 3, axis=1))
    assert set(found.patch_id) == set(range(found.counts.surface_patches))
    assert set(found.block_id) <= set(range(found.counts.blocks))
    corners = set(found.corners.tolist())
    for chain, facets in zip(found.edges, found.edge_facets):
        assert chain[0] in corners and chain[-1] in corners and not corners & set(chain[1:-1].tolist())
        assert len(set(facets.tolist())) == 2


def test_genus():
    assert polycube.structure(polycube.example("double-torus", kind="quads")[1]).genus == 2


def test_arrays_of_the_structure_are_read_only(pair):
    found = polycube.structure(pair[1])
    for name in ("faces", "label", "facet", "patch_id", "levels", "corner_levels"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(found, name)[0] = 0


def test_a_shape_is_checked_for_what_makes_it_a_solid():
    turned = CUBE_POINTS @ np.array([[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]])
    assert polycube.check_shape(quads(turned)) == []
    for kind in ("open_edge", "non_manifold_edge", "inside_out"):
        found = polycube.check_shape(WRONG[kind][0])
        assert {(v.kind, v.mesh) for v in found} == {(kind, "shape")}
    two = quads(np.vstack([CUBE_POINTS, turned + [0.3, 0.2, 0.4]]), np.vstack([CUBE_QUADS, CUBE_QUADS + 8]))
    crossing = polycube.check_shape(two)
    assert {v.kind for v in crossing} == {"crossing_faces"}
    # Two convex solids cross: faces of the one with faces of the other.
    assert all(v.elements[0] < 6 and "face" in v.message for v in crossing)
