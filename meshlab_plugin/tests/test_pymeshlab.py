"""The plugin in PyMeshLab: every filter, every way it can fail, and the same results as the command."""

import json
import os
from pathlib import Path

import numpy
import pytest
from conftest import ROOT, Mesh, required

ml = pytest.importorskip("pymeshlab")

FILTERS = {
    "generate_polycube_simplified",
    "generate_polycube_coarse_quad_layout",
    "generate_polycube_quad_remesh",
    "generate_polycube_hex_remesh",
    "compute_polycube_check",
    "set_polycube_color_by_label_per_face",
    "set_polycube_color_by_block_per_face",
    "create_polycube_example",
}
OCTAHEDRON = Mesh(
    [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
)


@pytest.fixture(scope="session", autouse=True)
def plugin():
    ml.load_plugin(str(required("POLYCUBE_PYMESHLAB")))


def document(*meshes):
    """Layers in this order; the last one is current.

    Not loaded from files: after a filter has failed, PyMeshLab 2025.7 logs what it loads to the last MeshSet, which may be gone.
    """
    layers = ml.MeshSet()
    for mesh in meshes:
        layers.add_mesh(ml.Mesh(mesh.points, numpy.array(mesh.faces, dtype=numpy.int32)))
    return layers


def snapshot(layers):
    """All that a filter might have changed."""
    ids = [layers.mesh(i) for i in range(layers.mesh_number())]
    return layers.current_mesh_id(), [
        (m.label(), m.is_visible(), *(a.tolist() for a in (m.vertex_matrix(), m.face_matrix(), m.face_selection_array())))
        for m in ids
    ]


def fails(layers, text, filter_name, **parameters):
    """Checks that the filter says this and leaves the document as it was."""
    before = snapshot(layers)
    with pytest.raises(ml.PyMeshLabException, match=text):
        layers.apply_filter(filter_name, **parameters)
    assert snapshot(layers) == before


def quads(mesh):
    """The quadrilaterals of a layer: a pair of triangles each."""
    triangles = mesh.face_matrix()
    first, second = triangles[0::2], triangles[1::2]
    assert (first[:, 0] == second[:, 0]).all() and (first[:, 2] == second[:, 1]).all()
    return numpy.column_stack([first, second[:, 2]]).tolist()


def simplified(pair, **parameters):
    layers = document(*reversed(pair))
    values = layers.apply_filter("generate_polycube_simplified", **parameters)
    return layers, values


def result(pair):
    """The vertices of the simplified polycube in lattice units."""
    layers, _ = simplified(pair, lattice_units=True)
    return layers.current_mesh().vertex_matrix()


def test_all_filters_have_their_names():
    assert FILTERS <= set(ml.filter_list())


def test_modules_for_another_meshlab_are_refused_by_name():
    with pytest.raises(ml.PyMeshLabException, match="different floating point precision"):
        ml.load_plugin(str(required("POLYCUBE_MODULE")))
    with pytest.raises(ml.PyMeshLabException, match="is not a MeshLab plugin"):
        ml.load_plugin(str(required("POLYCUBE_MODULE_2020")))


def test_the_example_makes_a_pair():
    layers = ml.MeshSet()
    values = layers.apply_filter("create_polycube_example", example="ring", seed=2)
    shape, polycube = layers.mesh(0), layers.mesh(1)
    assert shape.label() == "ring shape" and not shape.is_visible()
    assert polycube.label() == "ring polycube" and polycube.is_visible()
    assert (shape.face_matrix() == polycube.face_matrix()).all()
    assert values["faces"] == polycube.face_number()
    normals = numpy.abs(polycube.face_normal_matrix())
    assert (normals.max(axis=1) > 0.999).all()


def test_a_first_run_needs_no_settings():
    layers = ml.MeshSet()
    layers.apply_filter("create_polycube_example")
    values = layers.apply_filter("generate_polycube_simplified")
    assert (values["surface_patches_after"], values["blocks_after"], values["blocks_padded_after"]) == (78, 33, 111)
    assert layers.current_mesh().label() == "cube-spikes polycube simplified"


@pytest.mark.parametrize("strategy", ["Best", "Paper"])
def test_simplify_gives_what_the_command_gives(pair, command, tmp_path, strategy):
    polycube, shape = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(pair, ("polycube", "shape")))
    out = command(tmp_path / "out", "simplify", polycube, "--format", "obj", "--shape", shape, "--strategy", strategy.lower())
    layers, values = simplified(pair, strategy=strategy, lattice_units=True)
    expected, found = Mesh.read(out / "polycube.obj"), layers.current_mesh()
    assert (found.vertex_matrix() == expected.points).all()
    assert found.face_matrix().tolist() == expected.faces
    report = numpy.array([values["surface_patches_before"], values["surface_patches_after"], values["blocks_after"]])
    assert report.tolist() == counts_of(out / "report.json")


def counts_of(report):
    report = json.loads(report.read_text())
    return [report["before"]["surface_patches"], report["after"]["surface_patches"], report["after"]["blocks"]]


def test_the_result_lies_where_the_polycube_lies(pair):
    layers, values = simplified(pair, lattice_step=ml.PureValue(0.5))
    found, expected = layers.current_mesh().vertex_matrix(), layers.mesh(1).vertex_matrix()
    assert values["scale"] == 2.0
    assert numpy.abs(found - expected).max() <= 2 * values["max_displacement"] + 1.0
    assert numpy.abs(found - expected).max() > 0
    assert not layers.mesh(0).is_visible() and not layers.mesh(1).is_visible()


def test_faces_get_scalars_and_colours(pair):
    layers, values = simplified(pair)
    mesh = layers.current_mesh()
    patches = mesh.face_custom_scalar_attribute_array("patch_id")
    assert (mesh.face_scalar_array() == patches).all()
    assert len(set(patches)) == values["surface_patches_after"]
    assert set(mesh.face_custom_scalar_attribute_array("label")) == {0, 1, 2, 3, 4, 5}
    assert len(numpy.unique(mesh.face_color_matrix(), axis=0)) > 50


def test_simplicity_trades_blocks_for_displacement(pair):
    few, near = (simplified(pair, simplicity=s)[1] for s in (1.0, 0.0))
    assert few["surface_patches_after"] <= near["surface_patches_after"]
    # The front is ordered by the displacement of the order alone; rounding to the lattice adds a step at most.
    assert near["max_displacement"] <= few["max_displacement"] + 1
    assert near["surface_patches_after"] <= near["surface_patches_before"]


def test_a_displacement_limit_is_kept(quad_pair):
    ring = [Mesh(m.points, [half for a, b, c, d in m.faces for half in ([a, b, c], [a, c, d])]) for m in quad_pair]
    free, near = simplified(ring)[1], simplified(ring, max_displacement=6.0)[1]
    assert near["max_displacement"] <= 6.0 < free["max_displacement"]
    assert free["surface_patches_after"] < near["surface_patches_after"] < near["surface_patches_before"]


def test_what_is_meshed_can_be_chosen(pair, command, tmp_path):
    polycube, shape = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(pair, ("polycube", "shape")))
    options = ["remesh", shape, "--polycube", polycube, "--hexes", 800]
    made = {"polycube": 0, "shape": 1, "hexes": 800, "file": str(tmp_path / "hexes.vtu")}
    for choice, parameters in (
        (["--max-displacement", 5], {"max_displacement": 5.0}),
        (["--simplicity", 0.5], {"simplicity": 0.5, "by_quality": False}),
    ):
        out = command(tmp_path / choice[0].strip("-"), *options, *choice)
        document(*pair).apply_filter("generate_polycube_hex_remesh", **made, **parameters)
        assert (tmp_path / "hexes.vtu").read_bytes() == (out / "hexes.vtu").read_bytes()


def test_quads_and_layout_take_a_simplicity(pair):
    for name in ("generate_polycube_quad_remesh", "generate_polycube_coarse_quad_layout"):
        few, near = (document(*pair).apply_filter(name, simplicity=s, by_quality=False) for s in (1.0, 0.0))
        assert few["surface_patches_after"] < near["surface_patches_after"]


def test_surfaces_are_not_folded_by_default(quad_pair):
    """The fewest patches of the ring fold it: quadrilaterals lie far from the shape."""
    ring = [Mesh(m.points, [half for a, b, c, d in m.faces for half in ([a, b, c], [a, c, d])]) for m in quad_pair]
    found, fewest = (document(*ring).apply_filter("generate_polycube_quad_remesh", by_quality=q) for q in (True, False))
    assert fewest["surface_patches_after"] < found["surface_patches_after"]
    assert 4 * found["hausdorff"] < fewest["hausdorff"]


@pytest.mark.parametrize("name", ["compute_polycube_check", "generate_polycube_simplified", "set_polycube_color_by_label_per_face"])
def test_a_slanted_polycube_needs_a_tolerance(pair, name):
    """Turned by 12 degrees about Z, it is one with a tolerance of 30 degrees and none with 10."""
    c, s = numpy.cos(numpy.radians(12)), numpy.sin(numpy.radians(12))
    slanted = Mesh(pair[0].points @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]), pair[0].faces)
    tolerant = {"angle_tolerance": 30.0, "level_tolerance": 30.0}
    values = document(slanted).apply_filter(name, **tolerant)
    assert values.get("valid", True)
    if name == "compute_polycube_check":
        assert not document(slanted).apply_filter(name, **{**tolerant, "angle_tolerance": 10.0})["valid"]
    else:
        fails(document(slanted), "axis|axes|degrees", name, **{**tolerant, "angle_tolerance": 10.0})


def test_objectives_differ_in_what_they_make_few(pair):
    blocks = simplified(pair, objective="Blocks")[1]
    assert blocks["blocks_after"] <= simplified(pair, objective="Surface patches")[1]["blocks_after"]


def test_the_pair_is_found_whichever_layer_is_current(pair):
    layers = document(*pair)
    assert layers.current_mesh_id() == 1, "the shape is current"
    layers.apply_filter("generate_polycube_simplified", lattice_units=True)
    assert (layers.current_mesh().vertex_matrix() == result(pair)).all()


def test_filters_in_a_row_find_their_pair_again(pair):
    made = {}
    for name in ("quad_remesh", "coarse_quad_layout", "hex_remesh", "simplified"):
        made[name] = document(*pair).apply_filter(f"generate_polycube_{name}")
    layers = document(*pair)
    for name in (*made, *reversed(made)):
        again = layers.apply_filter(f"generate_polycube_{name}")
        assert {key: again[key] for key in again} == {key: made[name][key] for key in made[name]}
    # Where the pair is gone, the layer stands for itself.
    quads = document(*pair)
    quads.apply_filter("generate_polycube_quad_remesh", edge_length=ml.PureValue(4.0))
    quads.set_current_mesh(0)
    quads.delete_current_mesh()
    quads.set_current_mesh(2)
    assert not quads.apply_filter("compute_polycube_check")["valid"]
    assert quads.current_mesh_id() == 2 and quads.current_mesh().selected_face_number() > 0


@pytest.mark.parametrize("layer", ["shape", "polycube"])
def test_selected_faces_stay_where_they_are(pair, layer):
    polycube = pair[0]
    corners = polycube.points[numpy.array(polycube.faces)]
    flat = corners.max(axis=1) - corners.min(axis=1) < 1e-6
    moved = {}
    free = result(pair)
    faces = [face for face in range(0, len(polycube.faces), 7) if flat[face].sum() == 1]
    axis = {face: int(numpy.argmax(flat[face])) for face in faces}
    for face in faces:
        vertex = polycube.faces[face][0]
        moved[face] = abs(free[vertex][axis[face]] - polycube.points[vertex][axis[face]])
    face = max(moved, key=moved.get)
    assert moved[face] > 1, "without a lock, this side moves"
    layers = document(*reversed(pair))
    layers.set_current_mesh(["shape", "polycube"].index(layer))
    layers.compute_selection_by_condition_per_face(condselect=f"(fi == {face})")
    values = layers.apply_filter("generate_polycube_simplified", lattice_units=True)
    assert values["locked_faces"] == 0, "a selection locks nothing unless that is asked for"
    assert (layers.current_mesh().vertex_matrix() == free).all()
    values = layers.apply_filter("generate_polycube_simplified", lattice_units=True, lock_selected_faces=True)
    assert values["locked_faces"] == 1
    vertex = polycube.faces[face][0]
    kept = layers.current_mesh().vertex_matrix()[vertex][axis[face]]
    assert abs(kept - polycube.points[vertex][axis[face]]) <= 0.5


def test_layout_and_quads_give_what_the_command_gives(pair, command, tmp_path):
    polycube, shape = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(pair, ("polycube", "shape")))
    options = ["remesh", shape, "--polycube", polycube, "--surface-only"]
    out = command(tmp_path / "out", *options, "--edge-length", 2)
    layers = document(*pair)
    length = ml.PureValue(2.0)
    values = layers.apply_filter("generate_polycube_quad_remesh", polycube=0, shape=1, edge_length=length)
    expected, found = Mesh.read(out / "quads.obj"), layers.current_mesh()
    assert (found.vertex_matrix() == expected.points).all()
    assert quads(found) == expected.faces
    assert values["quads"] == len(expected.faces)
    layers.set_current_mesh(1)
    layers.apply_filter("generate_polycube_coarse_quad_layout", polycube=0, shape=1)
    expected = Mesh.read(command(tmp_path / "coarse", *options) / "layout.obj")
    found = layers.current_mesh()
    assert (found.vertex_matrix() == expected.points).all()
    assert quads(found) == expected.faces


def test_quads_are_kept_with_faux_edges(pair, tmp_path):
    layers = document(*pair)
    values = layers.apply_filter("generate_polycube_quad_remesh", edge_length=ml.PureValue(4.0))
    layers.save_current_mesh(str(tmp_path / "quads.obj"))
    faces = Mesh.read(tmp_path / "quads.obj").faces
    assert len(faces) == values["quads"] and {len(face) for face in faces} == {4}


def test_quads_have_patches_and_quality(pair):
    layers = document(*pair)
    parameters = {"edge_length": ml.PureValue(4.0), "face_scalar": "Scaled Jacobian"}
    values = layers.apply_filter("generate_polycube_quad_remesh", **parameters)
    mesh = layers.current_mesh()
    quality = mesh.face_scalar_array()
    assert (quality == mesh.face_custom_scalar_attribute_array("scaled_jacobian")).all()
    assert quality.max() <= 1 and quality.mean() > 0.7
    patches = mesh.face_custom_scalar_attribute_array("patch_id")
    assert len(set(patches)) == values["surface_patches_after"]
    corners = mesh.vertex_matrix()[numpy.array(quads(mesh))]
    ahead = numpy.roll(corners, -1, axis=1) - corners
    behind = numpy.roll(corners, 1, axis=1) - corners
    cross = numpy.linalg.norm(numpy.cross(ahead, behind), axis=2)
    sines = cross / numpy.linalg.norm(ahead, axis=2) / numpy.linalg.norm(behind, axis=2)
    assert (quality[0::2] <= sines.min(axis=1) + 1e-9).all()


def test_hexahedra_are_the_files_that_the_command_writes(pair, command, tmp_path):
    polycube, shape = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(pair, ("polycube", "shape")))
    formats = [word for name in ("msh", "json", "xyz") for word in ("--format", name)]
    out = command(tmp_path / "out", "remesh", shape, "--polycube", polycube, "--hexes", 3000, *formats)
    for name in ("hexes.vtu", "hexes.mesh", "hexes.msh", "blocks.json", "hexes.xyz"):
        layers = document(*pair)
        parameters = {"polycube": 0, "shape": 1, "hexes": 3000, "file": str(tmp_path / name)}
        values = layers.apply_filter("generate_polycube_hex_remesh", **parameters)
        assert (tmp_path / name).read_bytes() == (out / name).read_bytes()
    assert 2000 < values["hexes"] < 4500
    mesh = layers.current_mesh()
    assert (mesh.vertex_matrix() == Mesh.read(out / "quads.obj").points).all()
    assert len(set(mesh.face_scalar_array())) == values["blocks_padded_after"] - values["blocks_after"]


def test_a_polycube_is_told_from_what_is_none(pair):
    layers = document(pair[0])
    values = layers.apply_filter("compute_polycube_check")
    assert values["valid"] and values["selected_faces"] == 0 and values["corners"] == 56 and values["facets"] == 36
    layers = document(OCTAHEDRON)
    values = layers.apply_filter("compute_polycube_check")
    assert not values["valid"] and values["violations"] > 0
    assert layers.current_mesh().selected_face_number() == values["selected_faces"] > 0


def test_the_faces_at_a_hole_are_selected(pair):
    polycube = pair[0]
    layers = document(Mesh(polycube.points, polycube.faces[1:]))
    values = layers.apply_filter("compute_polycube_check")
    assert not values["valid"]
    selected = numpy.flatnonzero(layers.current_mesh().face_selection_array())
    hole = set(polycube.faces[0])
    assert len(selected) and all(hole & set(polycube.faces[1 + face]) for face in selected)


def test_colours_by_label_and_block(pair):
    layers = document(*pair)
    layers.apply_filter("set_polycube_color_by_label_per_face")
    for number in (0, 1):
        mesh = layers.mesh(number)
        labels = mesh.face_scalar_array().astype(int)
        colours = mesh.face_color_matrix()
        assert (colours[labels == 0, 0] > colours[labels == 0, 2]).all(), "X is red"
        assert (colours[labels == 4, 2] > colours[labels == 4, 0]).all(), "Z is blue"
    normals = layers.mesh(0).face_normal_matrix()
    axes, signs = labels // 2, 1 - 2 * (labels % 2)
    assert (normals[numpy.arange(len(labels)), axes] * signs > 0.99).all()
    values = layers.apply_filter("set_polycube_color_by_block_per_face")
    blocks = layers.mesh(1).face_scalar_array()
    assert (layers.mesh(0).face_scalar_array() == blocks).all() and blocks.max() == values["block_id_max"]


def test_quadrilaterals_stay_what_they_are(quad_pair, command, tmp_path):
    polycube, shape = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(quad_pair, ("polycube", "shape")))
    out = command(tmp_path / "out", "simplify", polycube, "--format", "obj", "--shape", shape)
    layers = ml.MeshSet()
    layers.load_new_mesh(str(shape))
    layers.load_new_mesh(str(polycube))
    layers.apply_filter("generate_polycube_simplified", lattice_units=True)
    found, expected = layers.current_mesh(), Mesh.read(out / "polycube.obj")
    assert (found.vertex_matrix() == expected.points).all()
    assert [set(face) for face in quads(found)] == [set(face) for face in expected.faces]
    layers.apply_filter("set_polycube_color_by_label_per_face", polycube=1, shape=0)
    colours = [layers.mesh(number).face_color_matrix() for number in (0, 1)]
    assert len(numpy.unique(colours[0], axis=0)) == 6
    corners = [frozenset(face) for face in layers.mesh(0).face_matrix().tolist()]
    assert corners != [frozenset(face) for face in layers.mesh(1).face_matrix().tolist()], "split in different ways"


def test_unused_and_deleted_vertices_do_no_harm(pair):
    polycube, shape = pair
    clean = result(pair)
    extra = numpy.vstack([[[9, 9, 9]], polycube.points])
    layers = document(shape, Mesh(extra, [[v + 1 for v in face] for face in polycube.faces]))
    layers.apply_filter("generate_polycube_simplified", polycube=1, shape=0, lattice_units=True)
    assert (layers.current_mesh().vertex_matrix() == clean).all()


def test_one_layer_is_enough(pair):
    layers = document(pair[0])
    values = layers.apply_filter("generate_polycube_simplified")
    assert values["surface_patches_after"] == 78 and layers.mesh_number() == 2
    layers.apply_filter("generate_polycube_quad_remesh", polycube=0, shape=0, edge_length=ml.PureValue(4.0))
    corners = layers.current_mesh().vertex_matrix()
    distance = numpy.abs(corners).max(axis=0) - numpy.abs(pair[0].points).max(axis=0)
    assert numpy.abs(distance).max() < 1e-6, "without a shape, the polycube is meshed"


def test_a_real_polycube_gives_what_the_command_gives(command, tmp_path):
    folder = Path(os.environ.get("POLYCUBE_DATA", ROOT / "../shared/data"))
    names = [folder / f"marco2016sgp-block.{name}.obj" for name in ("shape", "polycube")]
    if not names[1].exists():
        assert os.environ.get("POLYCUBE_REQUIRE_DATA") != "1", f"{names[1]} is missing"
        pytest.skip("the real polycubes are not there")
    layers = ml.MeshSet()
    for name in names:
        layers.load_new_mesh(str(name))
    # As MeshLab reads them.
    read = [Mesh(layer.vertex_matrix(), layer.face_matrix()) for layer in map(layers.mesh, (0, 1))]
    shape, polycube = (mesh.write(tmp_path / f"{name}.off") for mesh, name in zip(read, ("shape", "polycube")))
    out = command(tmp_path / "out", "simplify", polycube, "--format", "obj", "--shape", shape)
    values = layers.apply_filter("generate_polycube_simplified", lattice_units=True)
    found = [values["surface_patches_before"], values["surface_patches_after"], values["blocks_after"]]
    assert found == counts_of(out / "report.json")
    expected = Mesh.read(out / "polycube.obj").points
    assert (layers.current_mesh().vertex_matrix() == expected).all()


PAIR_FILTERS = sorted(f for f in FILTERS if f not in ("compute_polycube_check", "create_polycube_example"))
MESHING_FILTERS = [f for f in PAIR_FILTERS if "remesh" in f or "layout" in f]


@pytest.mark.parametrize("name", [f for f in PAIR_FILTERS if f not in MESHING_FILTERS])
def test_no_polycube_no_result(name):
    fails(document(OCTAHEDRON), "face", name)


def torus(around=18, across=8):
    """Triangles none of which looks along an axis to begin with."""
    at = [(2 * numpy.pi * i / around, 2 * numpy.pi * j / across) for i in range(around) for j in range(across)]
    points = [((3 + numpy.cos(b)) * numpy.cos(a), (3 + numpy.cos(b)) * numpy.sin(a), numpy.sin(b)) for a, b in at]
    number = lambda i, j: i % around * across + j % across
    quads = [
        (number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1))
        for i in range(around)
        for j in range(across)
    ]
    return Mesh(points, [half for a, b, c, d in quads for half in ([a, b, c], [a, c, d])])


def test_the_current_layer_alone_is_meshed(command, tmp_path):
    shape = torus().write(tmp_path / "shape.off")
    out = command(tmp_path / "out", "remesh", shape, "--surface-only", "--edge-length", 0.5)
    layers = document(OCTAHEDRON, torus())
    values = layers.apply_filter("generate_polycube_quad_remesh", edge_length=ml.PureValue(0.5))
    assert (layers.current_mesh().vertex_matrix() == Mesh.read(out / "quads.obj").points).all()
    assert values["quads"] == layers.current_mesh().face_number() / 2 and layers.mesh_number() == 3
    layers = document(torus())
    values = layers.apply_filter("generate_polycube_hex_remesh", file=str(tmp_path / "hexes.vtu"), hexes=500)
    assert values["inverted"] == 0 and (tmp_path / "hexes.vtu").stat().st_size > 10_000


def test_what_has_no_polycube_is_refused_with_what_to_do(tmp_path):
    points, faces = torus().points, torus().faces
    wing = numpy.vstack([points, [[9, 9, 9]]])
    for mesh, text in (
        (Mesh(points, faces[1:]), "open here.*2 more like it.*Close Holes"),
        (Mesh(wing, [*faces, [*faces[0][:2], len(points)]]), "more than two faces.*Repair non Manifold Edges"),
    ):
        for name in MESHING_FILTERS:
            parameters = {"file": str(tmp_path / "hexes.vtu")} if "hex" in name else {}
            fails(document(mesh), text, name, **parameters)
    assert not list(tmp_path.iterdir())


def test_faces_that_look_the_wrong_way_are_turned():
    points, faces = torus().points, torus().faces
    found = []
    for turned in (faces, [faces[0][::-1], *faces[1:]], [face[::-1] for face in faces]):
        values = document(Mesh(points, turned)).apply_filter("generate_polycube_hex_remesh", hexes=500)
        found.append((values["blocks_after"], values["inverted"]))
    assert found[0][1] == 0 and found == 3 * found[:1]


@pytest.mark.parametrize("name", PAIR_FILTERS)
def test_a_foreign_shape_is_refused(pair, name, tmp_path):
    parameters = {"file": str(tmp_path / "hexes.vtu")} if "hex" in name else {}
    fails(document(OCTAHEDRON, pair[0]), "same", name, polycube=1, shape=0, **parameters)


@pytest.mark.parametrize("name", PAIR_FILTERS)
def test_points_alone_are_refused(name):
    layers = ml.MeshSet()
    layers.add_mesh(ml.Mesh(numpy.eye(3)))
    fails(layers, "(?i)faces", name)


def test_an_open_mesh_is_refused_with_the_place(pair):
    broken = Mesh(pair[0].points, pair[0].faces[1:])
    fails(document(broken), "edge", "generate_polycube_simplified")


def test_a_broken_rounding_is_refused(pair):
    step = ml.PureValue(40.0)
    fails(document(*pair), "lattice", "generate_polycube_simplified", strategy="Rounding", lattice_step=step)


def test_files_that_cannot_be_are_refused_before_the_work(pair, tmp_path):
    for name in (str(tmp_path / "hexes.obj"), str(tmp_path / "missing" / "hexes.vtu")):
        fails(document(*pair), "Choose", "generate_polycube_hex_remesh", file=name)
    folder = tmp_path / "folder.vtu"
    folder.mkdir()
    fails(document(*pair), "folder.vtu", "generate_polycube_hex_remesh", file=str(folder), hexes=500)


def test_without_a_file_hexahedra_are_shown_only(pair, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    layers = document(*pair)
    values = layers.apply_filter("generate_polycube_hex_remesh", hexes=800)
    assert values["hexes"] > 0 and layers.mesh_number() == 3
    assert not list(tmp_path.iterdir())


def test_numbers_out_of_range_are_refused(pair, tmp_path):
    layers = document(*pair)
    file = str(tmp_path / "hexes.vtu")
    fails(layers, "1 or more", "generate_polycube_hex_remesh", file=file, hexes=0)
    fails(layers, "0 to 16", "generate_polycube_hex_remesh", file=file, padding=17)
    fails(layers, "0 to 16", "generate_polycube_hex_remesh", file=file, padding=-1)
    fails(layers, "edge_length is 0.*above 0", "generate_polycube_quad_remesh", edge_length=ml.PureValue(0.0))
    fails(layers, "scale", "generate_polycube_simplified", lattice_step=ml.PureValue(-1.0))
    fails(layers, "tolerance|45", "compute_polycube_check", angle_tolerance=60.0)
    fails(layers, "tolerance|45", "generate_polycube_simplified", angle_tolerance=60.0)
    fails(layers, "tolerance", "generate_polycube_quad_remesh", level_tolerance=-1.0)
    fails(layers, "displacement", "generate_polycube_hex_remesh", file=file, max_displacement=-1.0)
    fails(layers, "seed", "create_polycube_example", seed=-1)
    with pytest.raises(ml.PyMeshLabException):
        layers.apply_filter("generate_polycube_simplified", polycube=7)


def test_not_finite_coordinates_are_refused(pair):
    points = pair[0].points.copy()
    points[5] = numpy.nan
    fails_nan = document(Mesh(points, pair[0].faces))
    with pytest.raises(ml.PyMeshLabException):
        fails_nan.apply_filter("generate_polycube_simplified")
    assert fails_nan.mesh_number() == 1
