# SPDX-License-Identifier: GPL-3.0-or-later
"""One object and one button: a polycube is made where none is chosen."""

import importlib
import re

import bpy
import numpy as np
import polycube
import pytest
from solids import add, bent, faces_of, key_points, points_of, snapshot, solid, values, write

ops = bpy.ops.polycube

# A ring with a foot.
RING = (((0, 0, 0), (5, 5, 1)), ((0, 0, 1), (5, 1, 2)), ((0, 4, 1), (5, 5, 2)), ((0, 0, -1), (1, 5, 0)))


@pytest.fixture
def body(settings):
    """An object alone, the active one; nothing is chosen in the panel."""
    points, faces = solid(RING)
    return add("Body", bent(points), faces)


def selected_edges(mesh):
    """The edges selected in edit mode, as pairs of vertices."""
    bpy.ops.object.mode_set(mode='OBJECT')
    return {tuple(sorted(edge.vertices)) for edge in mesh.edges if edge.select}


def open_edges(mesh):
    """The edges with one face, by counting."""
    count = {}
    for polygon in mesh.polygons:
        for edge in polygon.edge_keys:
            count[edge] = count.get(edge, 0) + 1
    return {edge for edge, faces in count.items() if faces == 1}


def test_quads_are_those_of_the_command(body, command, tmp_path):
    shape = write(tmp_path / "shape.obj", points_of(body.data), faces_of(body.data))
    assert ops.quad_remesh() == {'FINISHED'}
    quads = polycube.read(command("remesh", shape, "--surface-only") / "quads.obj")
    result = bpy.context.object
    assert result.name == "Body Quads" and body.hide_get()
    assert faces_of(result.data) == quads.cells.tolist()
    assert np.array_equal(points_of(result.data), quads.points.astype(np.float32))


def test_hexahedra_fill_the_object(body, tmp_path):
    assert ops.export_hexes(filepath=str(tmp_path / "hexes.vtu")) == {'FINISHED'}
    hexes = polycube.read(tmp_path / "hexes.vtu")
    first, along, across, up = (hexes.points[hexes.cells[:, i]] for i in (0, 1, 3, 4))
    assert (np.einsum('ij,ij->i', np.cross(along - first, across - first), up - first) > 0.0).all()
    assert np.allclose(np.ptp(hexes.points, axis=0), np.ptp(points_of(body.data), axis=0), rtol=0.1)


def test_again_with_the_result_active_meshes_the_shape(body):
    ops.quad_remesh(size='LENGTH', edge_length=1.0)
    assert bpy.context.object != body
    coarse = len(bpy.context.object.data.polygons)
    ops.quad_remesh(size='LENGTH', edge_length=0.5)
    assert len(bpy.context.object.data.polygons) > 2 * coarse
    assert bpy.context.object.name == "Body Quads"


def test_simplify_the_slider_and_quads_of_what_it_shows(body, settings):
    body.scale, body.location = (2.0, 2.0, 2.0), (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    assert ops.simplify() == {'FINISHED'}
    shown = bpy.context.object
    # It lies where the shape is, as large as that.
    low, high = points_of(body.data).min(axis=0), points_of(body.data).max(axis=0)
    found = points_of(shown.data)
    assert np.allclose(found.min(axis=0) + found.max(axis=0), low + high, atol=0.5 * (high - low).max())
    assert 0.5 < np.ptp(found, axis=0).max() / (high - low).max() < 2.0
    assert np.allclose(np.array(shown.matrix_world), np.array(body.matrix_world))
    settings.simplicity = 0.0
    assert not np.array_equal(points_of(shown.data), found) or settings.result.patches[0] == settings.result.patches[1]
    ops.quad_remesh()
    assert len(set(values(bpy.context.object.data, "patch_id"))) == settings.result.patches[1]


def test_a_polycube_as_an_object(body, settings):
    body.data.materials.append(bpy.data.materials.new("paint"))
    before = snapshot()["Body"]
    bpy.ops.ed.undo_push(message="before")
    assert ops.make() == {'FINISHED'}
    made = bpy.context.object
    assert made.name == "Body Polycube" and made.data.materials.keys() == ["paint"]
    basis = key_points(made, "Basis")
    assert np.array_equal(basis[: len(body.data.vertices)], points_of(body.data))
    assert (settings.source, settings.shape, settings.key) == ('KEY', made, "Polycube")
    assert snapshot()["Body"] == before and body.hide_get()
    assert ops.check() == {'FINISHED'} and ops.simplify() == {'FINISHED'}
    assert made.data.shape_keys.key_blocks.keys() == ["Basis", "Polycube", "Simplified"]
    bpy.ops.ed.undo_push(message="make and simplify")
    bpy.ops.ed.undo()
    assert bpy.data.objects.keys() == ["Body"] and bpy.context.scene.polycube.source == 'OBJECTS'
    assert ops.quad_remesh() == {'FINISHED'}


@pytest.mark.parametrize("operator", ["check", "make", "quad_remesh", "simplify"])
def test_suzanne_is_refused_at_once(settings, operator):
    bpy.ops.mesh.primitive_monkey_add()
    suzanne = bpy.context.object
    with pytest.raises(RuntimeError, match="(?s)open here.*41 more.*Mesh > Clean Up > Fill Holes") as refused:
        getattr(ops, operator)()
    assert re.search("[0-9]+ pairs of faces of Suzanne cross.*Remesh modifier", str(refused.value))
    assert bpy.context.mode == 'EDIT_MESH' and bpy.context.object == suzanne
    assert selected_edges(suzanne.data) == open_edges(suzanne.data)
    assert bpy.data.objects.keys() == ["Suzanne"]


def test_suzanne_with_a_remesh_modifier_is_meshed(settings):
    bpy.ops.mesh.primitive_monkey_add()
    modifier = bpy.context.object.modifiers.new("closed", 'REMESH')
    modifier.mode, modifier.voxel_size = 'VOXEL', 0.12
    assert ops.quad_remesh() == {'FINISHED'}
    assert not bpy.context.object.data.validate() and not open_edges(bpy.context.object.data)


def test_faults_and_their_remedies(settings):
    points, faces = solid(RING)
    wide = np.vstack([points, points[faces[0][:2]] + [0.0, 0.0, 40.0]])
    wing = [*faces, [*faces[0][:2], len(points) + 1, len(points)]]
    for vertices, wrong, message in (
        (wide, wing, "more than two faces.*Interior Faces"),
    ):
        bpy.context.view_layer.objects.active = add("Wrong", vertices, wrong)
        with pytest.raises(RuntimeError, match=f"(?s){message}"):
            ops.quad_remesh()
        bpy.ops.object.mode_set(mode='OBJECT')


def test_faces_that_look_the_wrong_way_are_turned(settings):
    points, faces = solid((((0, 0, 0), (4, 2, 2)), ((0, 2, 0), (2, 4, 2))))
    for turned in ([*faces[:5], faces[5][::-1], *faces[6:]], [face[::-1] for face in faces]):
        bpy.context.view_layer.objects.active = add("Turned", bent(points), turned)
        assert ops.quad_remesh() == {'FINISHED'}
        assert not bpy.context.object.data.validate() and not open_edges(bpy.context.object.data)


def test_what_does_not_go_with_a_plain_shape_is_refused_before_the_work(body, extension):
    importlib.import_module(f"{extension}.live").forget()
    body.data.polygons[0].select = True
    for options, message in ((dict(locks='SELECTION'), "Make Polycube"), (dict(output='KEY'), "vertices of its own")):
        with pytest.raises(RuntimeError, match=message):
            ops.simplify(**options)
    # Nothing was made.
    assert importlib.import_module(f"{extension}.live")._Made.key is None


def test_cancelled_while_the_polycube_is_made(body, extension, monkeypatch):
    jobs = importlib.import_module(f"{extension}.jobs")
    importlib.import_module(f"{extension}.live").forget()
    before = snapshot()
    start = jobs._Running.start

    def start_and_press_escape(*job):
        start(*job)
        jobs.stop()

    # A polycube may be made before another thread has looked whether a job runs.
    monkeypatch.setattr(jobs._Running, "start", start_and_press_escape)
    assert ops.quad_remesh() == {'CANCELLED'}
    assert snapshot() == before and not jobs.running()


def test_crossing_faces_are_found(extension, settings):
    crossings = importlib.import_module(f"{extension}.crossings")
    points, faces = (np.array(part) for part in solid((((0, 0, 0), (1, 1, 1)),)))
    apart = polycube.Mesh(np.vstack([points, points + 3.0]), np.vstack([faces, faces + 8]), kind="quads")
    through = polycube.Mesh(np.vstack([points, points + 0.5]), np.vstack([faces, faces + 8]), kind="quads")
    assert not crossings.crossing(apart)
    # Three faces at a corner of each go through two of the other, all but that which looks the opposite way.
    assert len(crossings.crossing(through)) == 6


def test_the_panel_says_what_it_works_on(settings, extension):
    panel = importlib.import_module(f"{extension}.panel")
    assert "Select a closed mesh" in panel.explain(bpy.context)[0]
    with pytest.raises(RuntimeError, match="Select a mesh object"):
        ops.quad_remesh()
    add("Body", *solid())
    assert "Body" in panel.explain(bpy.context)[0] and "made" in panel.explain(bpy.context)[1]
    settings.polycube = add("Cube", *solid())
    assert panel.explain(bpy.context)[1] == "with Cube as its polycube."
    ops.add_example(example='ring')
    assert "shape key" in panel.explain(bpy.context)[1]
    assert all(len(line) <= panel.WIDTH + 8 for line in panel.explain(bpy.context))
