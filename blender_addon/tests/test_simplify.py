# SPDX-License-Identifier: GPL-3.0-or-later
"""Check and Simplify: results are the command's, whatever the objects look like."""

import importlib
import json
import threading

import bpy
import numpy as np
import polycube
import pytest
from solids import add, add_pair, bent, faces_of, key_points, mesh_of, points_of, snapshot, solid, values, write

ops = bpy.ops.polycube


def simplified_by(command, tmp_path, points, faces, shape, *arguments):
    """What the command makes of a mesh: its points in units of the input, and its report."""
    cube = write(tmp_path / "cube.obj", points, faces)
    body = write(tmp_path / "body.obj", shape, faces)
    out = command("simplify", cube, "--shape", body, *arguments)
    report = json.loads((out / "report.json").read_text())
    return polycube.read(out / "polycube.obj").points / report["scale"], report


def test_a_new_object_like_that_of_the_command(pair, settings, command, tmp_path):
    shape, cube = pair
    before = snapshot()
    assert ops.simplify() == {'FINISHED'}
    result = bpy.context.object
    expected, report = simplified_by(command, tmp_path, points_of(cube.data), faces_of(cube.data), points_of(shape.data))
    assert np.array_equal(points_of(result.data), expected.astype(np.float32))
    assert faces_of(result.data) == faces_of(cube.data)
    names = ("surface_patches", "blocks", "blocks_padded")
    numbers = (settings.result.patches, settings.result.blocks, settings.result.padded)
    assert [tuple(n) for n in numbers] == [(report["before"][n], report["after"][n]) for n in names]
    assert settings.result.patches[1] < settings.result.patches[0]
    assert {name: state for name, state in snapshot().items() if name in before} == before
    assert cube.hide_get() and not result.hide_get()


def test_a_new_shape_key(settings, command, tmp_path):
    ops.add_example(example='stepped-l')
    obj = bpy.context.object
    basis, cube = key_points(obj, "Basis"), key_points(obj, "Polycube")
    assert ops.simplify() == {'FINISHED'}
    keys = obj.data.shape_keys.key_blocks
    assert keys.keys() == ["Basis", "Polycube", "Simplified"]
    assert obj.active_shape_key.name == "Simplified" and keys["Simplified"].value == 1.0
    assert np.array_equal(key_points(obj, "Basis"), basis) and np.array_equal(key_points(obj, "Polycube"), cube)
    expected, _ = simplified_by(command, tmp_path, cube, faces_of(obj.data), basis)
    assert np.array_equal(key_points(obj, "Simplified"), expected.astype(np.float32))
    # The shape is the basis, although the polycube shows now.
    assert ops.simplify() == {'FINISHED'}
    assert keys.keys() == ["Basis", "Polycube", "Simplified"]
    assert np.array_equal(key_points(obj, "Simplified"), expected.astype(np.float32))


def test_a_polycube_of_the_name_of_a_result_is_not_overwritten(settings):
    ops.add_example(example='stepped-l')
    obj = bpy.context.object
    obj.data.shape_keys.key_blocks["Polycube"].name = settings.key = "Simplified"
    cube = key_points(obj, "Simplified")
    for _ in range(2):
        assert ops.simplify(strategy='paper') == {'FINISHED'}
        assert obj.active_shape_key.name == "Simplified.001"
    assert np.array_equal(key_points(obj, "Simplified"), cube)


# A plate with one tower on it and two below, the same on both sides of x = 0 and on no two sides of y = 0.
EVEN = (((-5, 0, 0), (5, 8, 2)), ((-2, 1, 2), (2, 4, 5)), ((-4, 2, -3), (-1, 5, 0)), ((1, 2, -3), (4, 5, 0)))


def test_symmetry_is_kept_as_by_the_command(settings, command, tmp_path):
    points, faces = solid(EVEN)
    settings.shape, settings.polycube = add_pair(points, faces)
    guides = tmp_path / "guides.json"
    guides.write_text('{"symmetry": [{"axis": 0, "at": 0.0}]}')
    assert ops.simplify(symmetry=(True, False, False)) == {'FINISHED'}
    found = points_of(bpy.context.object.data)
    expected, _ = simplified_by(command, tmp_path, points, faces, bent(points), "--guides", guides)
    assert np.array_equal(found, expected.astype(np.float32))
    structure = polycube.structure(mesh_of(found, faces))
    levels = np.sort(structure.levels[structure.level_axis == 0])
    assert np.ptp(levels + levels[::-1]) < 1e-6
    with pytest.raises(RuntimeError, match="symmetry"):
        ops.simplify(symmetry=(False, True, False))


def test_face_attributes_and_colours(pair):
    ops.simplify()
    mesh = bpy.context.object.data
    labels = polycube.structure(mesh_of(*solid())).label
    assert values(mesh, "label") == labels.tolist()
    assert len(set(values(mesh, "block_id"))) > 1
    colours = mesh.color_attributes.active_color
    by_block = {}
    for polygon, block in zip(mesh.polygons, values(mesh, "block_id")):
        for loop in polygon.loop_indices:
            by_block.setdefault(block, set()).add(tuple(colours.data[loop].color))
    assert all(len(found) == 1 for found in by_block.values())
    assert len({found.pop() for found in by_block.values()}) == len(set(values(mesh, "block_id")))


@pytest.mark.parametrize("options, arguments", [
    (dict(strategy='paper'), ("--strategy", "paper")),
    (dict(objective='blocks_padded'), ("--objective", "blocks_padded")),
    (dict(simplicity=0.0), ("--simplicity", "0")),
    (dict(lattice='STEP', lattice_step=0.5), ("--edge-length", "0.5")),
    (dict(max_displacement=0.25), ("--max-displacement", "0.25")),
])
def test_options_are_those_of_the_command(pair, command, tmp_path, options, arguments):
    shape, cube = pair
    ops.simplify(**options)
    expected, _ = simplified_by(
        command, tmp_path, points_of(cube.data), faces_of(cube.data), points_of(shape.data), *arguments
    )
    assert np.array_equal(points_of(bpy.context.object.data), expected.astype(np.float32))


def test_options_come_from_the_panel_unless_given(pair, settings):
    settings.strategy, settings.output = 'paper', 'KEY'
    ops.simplify()
    assert bpy.context.object.data.shape_keys.key_blocks.keys() == ["Basis", "Simplified"]
    ops.simplify(output='OBJECT')
    assert bpy.context.object.name == "Cube Simplified"
    assert settings.output == 'KEY'


def test_location_and_rotation_do_not_matter_and_scale_does(pair, command, tmp_path):
    shape, cube = pair
    cube.scale, cube.location, cube.rotation_euler = (2.0, 0.5, 3.0), (7.0, 8.0, 9.0), (0.3, 0.2, 0.1)
    shape.scale = (1.5, 1.5, -1.5)
    bpy.context.view_layer.update()
    assert ops.check() == {'FINISHED'}
    ops.simplify(lattice='STEP', lattice_step=0.5)
    result = bpy.context.object
    size = np.array([2.0, 0.5, 3.0])
    expected, _ = simplified_by(command, tmp_path, points_of(cube.data) * size, faces_of(cube.data),
                                points_of(shape.data) * 1.5, "--edge-length", "0.5")
    assert np.array_equal(points_of(result.data), (expected / size).astype(np.float32))
    assert np.allclose(np.array(result.matrix_world), np.array(cube.matrix_world), atol=1e-6)


def test_modifiers_count_as_shown(pair, command, tmp_path):
    for obj in pair:
        obj.modifiers.new("finer", 'SUBSURF').subdivision_type = 'SIMPLE'
    ops.simplify(lattice='STEP', lattice_step=1.0)
    result = bpy.context.object
    assert len(result.data.polygons) == 4 * len(pair[1].data.polygons) and not result.modifiers
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shown = []
    for obj in pair:
        obj.hide_set(False)
        bpy.context.view_layer.update()
        mesh = obj.evaluated_get(depsgraph).to_mesh()
        shown.append((points_of(mesh), faces_of(mesh)))
    (shape, _), (cube, faces) = shown
    expected, _ = simplified_by(command, tmp_path, cube, faces, shape, "--edge-length", "1")
    assert np.array_equal(points_of(result.data), expected.astype(np.float32))
    with pytest.raises(RuntimeError, match="cannot be a shape key"):
        ops.simplify(output='KEY')


def test_a_modifier_of_one_object_alone_does_not_fit(pair):
    pair[0].modifiers.new("finer", 'SUBSURF')
    with pytest.raises(RuntimeError, match="do not have the same vertices and faces"):
        ops.check()


def test_modifiers_deform_the_shape_of_a_key_and_not_its_polycube(settings):
    ops.add_example(example='stepped-l')
    obj = bpy.context.object
    obj.modifiers.new("lift", 'DISPLACE').strength = 3.0
    assert ops.check() == {'FINISHED'}
    triangles = obj.modifiers.new("triangles", 'TRIANGULATE')
    with pytest.raises(RuntimeError, match="make other faces of the polycube than of the shape"):
        ops.check()
    # Other faces than the mesh has: the polycube goes through the modifiers, too.
    triangles.quad_method = 'FIXED'
    with pytest.raises(RuntimeError, match="length|off the|level"):
        ops.check()
    bpy.ops.object.mode_set(mode='OBJECT')
    obj.modifiers.remove(obj.modifiers["lift"])
    assert ops.check() == {'FINISHED'}
    ops.simplify()
    assert bpy.context.object != obj and len(bpy.context.object.data.polygons) == 2 * len(obj.data.polygons)


def test_hidden_objects_are_evaluated(pair):
    for obj in pair:
        obj.modifiers.new("finer", 'SUBSURF').subdivision_type = 'SIMPLE'
    pair[0].hide_set(True)
    pair[1].hide_viewport = True
    assert ops.simplify() == {'FINISHED'}
    assert len(bpy.context.object.data.polygons) == 4 * len(pair[1].data.polygons)
    assert pair[0].hide_get() and pair[1].hide_viewport


def test_faces_of_any_number_of_corners(settings):
    """An L of two hexagons and six quadrilaterals, as one models it by hand."""
    outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
    points = [(x, y, z) for z in (0, 1) for x, y in outline]
    faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]]
    faces += [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    settings.polycube = add("L", points, faces)
    assert ops.check() == {'FINISHED'}
    assert ops.simplify(strategy='paper') == {'FINISHED'}
    result = bpy.context.object
    assert faces_of(result.data) == faces
    assert len(values(result.data, "label")) == 8


def test_the_slider_moves_along_what_was_found(pair, settings, command, tmp_path):
    shape, cube = pair
    ops.simplify()
    result = bpy.context.object
    fewest, count = points_of(result.data), settings.result.patches[1]
    settings.simplicity = 0.0
    expected, report = simplified_by(command, tmp_path, points_of(cube.data), faces_of(cube.data),
                                     points_of(shape.data), "--simplicity", "0")
    assert np.array_equal(points_of(result.data), expected.astype(np.float32))
    assert settings.result.patches[1] == report["after"]["surface_patches"] > count
    settings.simplicity = 1.0
    assert np.array_equal(points_of(result.data), fewest) and settings.result.patches[1] == count


def test_locked_facets_stay(pair, settings):
    _, cube = pair
    ops.simplify()
    assert not np.array_equal(tower(bpy.context.object), tower(cube))
    sides = [p.index for p in cube.data.polygons if p.center.z < 0 and abs(p.normal.z) < 0.5]
    for polygon in cube.data.polygons:
        polygon.select = polygon.index in sides
    ops.simplify(locks='SELECTION')
    assert np.array_equal(tower(bpy.context.object), tower(cube))
    group = cube.vertex_groups.new(name="fixed")
    group.add(sorted({v for i in sides for v in cube.data.polygons[i].vertices}), 1.0, 'ADD')
    for polygon in cube.data.polygons:
        polygon.select = False
    ops.simplify(locks='GROUP', lock_group="fixed")
    assert np.array_equal(tower(bpy.context.object), tower(cube))
    for locks, group in (('SELECTION', ""), ('GROUP', "no such"),):
        with pytest.raises(RuntimeError, match="No face of|has no vertex group"):
            ops.simplify(locks=locks, lock_group=group)


def tower(obj):
    """Where the lower tower stands, which Simplify moves: its vertices without their height."""
    return points_of(obj.data)[solid()[0][:, 2] < 0][:, :2]


def test_undo_and_redo(pair, settings):
    bpy.ops.ed.undo_push(message="before")
    ops.simplify()
    moved = points_of(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="simplify")
    bpy.ops.ed.undo()
    settings = bpy.context.scene.polycube
    assert bpy.data.objects.keys() == ["Body", "Cube"] and settings.result.token == 0
    settings.simplicity = 0.2
    assert bpy.data.objects.keys() == ["Body", "Cube"]
    bpy.ops.ed.undo_push(message="slider")
    bpy.ops.ed.undo()
    bpy.ops.ed.redo()
    assert "Cube Simplified" not in bpy.data.objects
    bpy.ops.ed.undo()
    ops.simplify()
    assert np.array_equal(points_of(bpy.context.object.data), moved)


def test_cancel_changes_nothing(pair, extension):
    """The job is cancelled while the operator waits for it."""
    jobs = importlib.import_module(f"{extension}.jobs")
    before, seen = snapshot(), []

    def press_escape():
        while not jobs.running():
            pass
        names = ("check", "simplify", "quad_remesh", "show_layout", "export_hexes", "add_example")
        seen.extend(name for name in names if getattr(ops, name).poll())
        jobs.stop()

    thread = threading.Thread(target=press_escape)
    thread.start()
    # Long enough that it cannot be done before it is cancelled.
    assert ops.simplify(steps=100_000) == {'CANCELLED'}
    thread.join()
    assert not seen and not jobs.running()
    assert snapshot() == before
    assert ops.simplify() == {'FINISHED'}


def test_settings_are_saved_and_the_slider_rests_in_another_session(pair, settings, tmp_path):
    settings.strategy, settings.edge_length = 'paper', 0.25
    settings.strategy = 'best'
    settings.steps = 77
    ops.simplify()
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    settings = bpy.context.scene.polycube
    assert settings.steps == 77 and settings.edge_length == 0.25 and settings.result.patches[1] > 0


def test_the_slider_leaves_a_result_of_another_session_alone(extension, pair, settings, tmp_path):
    ops.simplify()
    token = settings.result.token
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    # What a new session counts from.
    live = importlib.import_module(f"{extension}.live")
    live._Last.token = token - 1
    live.forget()
    ops.add_example(example='cube-spikes')
    ops.simplify()
    bpy.ops.wm.open_mainfile(filepath=path)
    settings = bpy.context.scene.polycube
    before = points_of(settings.result.object.data)
    settings.simplicity = 0.0
    assert np.array_equal(points_of(settings.result.object.data), before)


def test_the_slider_rests_while_the_result_is_edited(pair, settings):
    ops.simplify()
    bpy.ops.object.mode_set(mode='EDIT')
    settings.simplicity = 0.0
    assert "edit mode" in settings.result.notes
    bpy.ops.object.mode_set(mode='OBJECT')


def test_edit_mode_is_left_first(pair):
    _, cube = pair
    bpy.context.view_layer.objects.active = cube
    bpy.ops.object.mode_set(mode='EDIT')
    assert ops.simplify() == {'FINISHED'}
    assert bpy.context.mode == 'OBJECT'


@pytest.mark.parametrize("example", ['cube-spikes', 'ring', 'double-torus'])
def test_examples_are_valid_and_become_simpler(settings, example):
    assert ops.add_example(example=example) == {'FINISHED'}
    assert ops.check() == {'FINISHED'}
    ops.simplify(strategy='paper')
    assert settings.result.padded[1] < settings.result.padded[0]


def test_shape_and_bent_shape_differ():
    """The test above that compare distortion and meshes need a shape that is not the polycube."""
    points, faces = solid()
    shape, cube = add_pair(points, faces)
    assert not np.allclose(points_of(shape.data), points_of(cube.data))
    assert np.allclose(points_of(shape.data), bent(points))
