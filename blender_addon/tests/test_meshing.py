# SPDX-License-Identifier: GPL-3.0-or-later
"""Quad Remesh, Show Layout and Export Hex Mesh."""

import json

import bpy
import numpy as np
import polycube
import pytest
from solids import add, faces_of, key_points, mesh_of, points_of, solid, values, write

ops = bpy.ops.polycube


@pytest.fixture
def files(pair, tmp_path):
    """The two objects as files for the command."""
    shape, cube = pair
    faces = faces_of(cube.data)
    return (
        write(tmp_path / "shape.obj", points_of(shape.data), faces),
        "--polycube",
        write(tmp_path / "cube.obj", points_of(cube.data), faces),
    )


def test_quads_are_those_of_the_command(pair, files, command):
    assert ops.quad_remesh(blocks_from='SEARCH', size='LENGTH', edge_length=0.5) == {'FINISHED'}
    quads = polycube.read(command("remesh", *files, "--surface-only", "--edge-length", "0.5") / "quads.obj")
    mesh = bpy.context.object.data
    assert faces_of(mesh) == quads.cells.tolist()
    assert np.array_equal(points_of(mesh), quads.points.astype(np.float32))
    assert pair[0].hide_get() and not mesh.validate()


def test_quads_follow_the_polycube_shown(pair, settings, command, tmp_path):
    """After Simplify the mesh has the blocks that the slider shows."""
    ops.simplify()
    settings.simplicity = 0.0
    patches = settings.result.patches[1]
    shown = bpy.context.object
    ops.quad_remesh()
    mesh = bpy.context.object.data
    assert len(set(values(mesh, "patch_id"))) == patches
    faces = faces_of(pair[1].data)
    shape = write(tmp_path / "shape.obj", points_of(pair[0].data), faces)
    cube = write(tmp_path / "cube.obj", points_of(shown.data), faces)
    out = command("remesh", shape, "--polycube", cube, "--strategy", "naive", "--surface-only", "--scale", "1")
    quads = polycube.read(out / "quads.obj")
    assert np.array_equal(points_of(mesh), quads.points.astype(np.float32))


def test_attributes_of_the_faces(pair, files, command):
    ops.quad_remesh(blocks_from='SEARCH')
    mesh = bpy.context.object.data
    count = len(mesh.polygons)
    quality = np.array(values(mesh, "scaled_jacobian"))
    corners = points_of(mesh)[np.array(faces_of(mesh))].astype(float)
    # By the angles, as a second way to the same number.
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(ahead, back), axis=2)
    sine /= np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2)
    flat = np.abs(np.einsum('ij,ij->i', np.cross(ahead[:, 0], back[:, 0]), corners[:, 2] - corners[:, 0])) < 1e-3
    assert flat.sum() > count / 2
    assert np.allclose(quality[flat], sine[flat].min(axis=1), atol=2e-3)
    labels = np.array(values(mesh, "label"))
    normals = np.array([p.normal[:] for p in mesh.polygons])
    along = normals[np.arange(count), labels // 2] * np.where(labels % 2 == 0, 1, -1)
    assert (along > 0.5).mean() > 0.95
    assert len(set(values(mesh, "block_id"))) > 1 and mesh.color_attributes.active_color.name == "polycube"


def test_colours_follow_the_choice(pair, settings):
    ops.quad_remesh()
    mesh = bpy.context.object.data
    seen = set()
    for choice in ('block_id', 'label', 'scaled_jacobian'):
        settings.colour = choice
        seen.add(tuple(tuple(item.color) for item in mesh.color_attributes["polycube"].data))
    assert len(seen) == 3


def test_materials_groups_and_uvs_are_carried_over(pair):
    shape, _ = pair
    mesh = shape.data
    for name in ("low", "high"):
        mesh.materials.append(bpy.data.materials.new(name))
    group = shape.vertex_groups.new(name="height")
    uv = mesh.uv_layers.new(name="map")
    for polygon in mesh.polygons:
        polygon.material_index = int(polygon.center.z > 2.5)
    for vertex in mesh.vertices:
        group.add([vertex.index], max(0.0, min(1.0, vertex.co.z / 5.0)), 'REPLACE')
    for loop in mesh.loops:
        point = mesh.vertices[loop.vertex_index].co
        uv.data[loop.index].uv = point.x / 10.0, point.y / 10.0
    shape.location.x = 3.0
    bpy.context.view_layer.update()
    ops.quad_remesh(size='LENGTH', edge_length=0.4)
    obj = bpy.context.object
    assert obj.data.materials.keys() == ["low", "high"] and obj.vertex_groups.keys() == ["height"]
    assert obj.data.uv_layers.keys() == ["map"]
    for polygon in obj.data.polygons:
        if abs(polygon.center.z - 2.5) > 1.2:
            assert polygon.material_index == int(polygon.center.z > 2.5)
    for vertex in obj.data.vertices:
        expected = max(0.0, min(1.0, vertex.co.z / 5.0))
        assert abs(sum(g.weight for g in vertex.groups) - expected) < 0.03
    for loop in obj.data.loops:
        point = obj.data.vertices[loop.vertex_index].co
        found = obj.data.uv_layers["map"].data[loop.index].uv
        assert abs(found.x - point.x / 10.0) < 0.01 and abs(found.y - point.y / 10.0) < 0.01


def test_uvs_are_those_of_the_shape_while_the_polycube_shows(settings):
    """One object: after Simplify it shows the polycube, but UVs belong to its basis."""
    ops.add_example(example='stepped-l')
    obj = bpy.context.object
    uv, basis = obj.data.uv_layers.new(name="map"), key_points(obj, "Basis")
    for loop in obj.data.loops:
        uv.data[loop.index].uv = basis[loop.vertex_index][:2]
    ops.simplify(strategy='paper')
    ops.quad_remesh()
    mesh = bpy.context.object.data
    off = [
        np.abs(np.array(mesh.uv_layers["map"].data[loop.index].uv) - mesh.vertices[loop.vertex_index].co[:2]).max()
        for loop in mesh.loops
    ]
    assert max(off) < 0.02


def test_a_scaled_shape_is_meshed_in_scene_units(pair):
    shape, _ = pair
    ops.quad_remesh(blocks_from='SEARCH', size='LENGTH', edge_length=0.5)
    fine = len(bpy.context.object.data.polygons)
    shape.scale = (2.0, 2.0, 2.0)
    shape.location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    ops.quad_remesh(blocks_from='SEARCH', size='LENGTH', edge_length=1.0)
    result = bpy.context.object
    assert len(result.data.polygons) == fine
    assert np.allclose(np.array(result.matrix_world), np.array(shape.matrix_world))
    low, high = points_of(result.data).min(axis=0), points_of(result.data).max(axis=0)
    assert np.allclose(low, points_of(shape.data).min(axis=0), atol=0.2)
    assert np.allclose(high, points_of(shape.data).max(axis=0), atol=0.2)


def test_singular_edges_and_borders_are_curves(pair, settings):
    ops.simplify()
    ops.show_layout()
    layout = bpy.context.object
    borders, singular = sorted(layout.children, key=lambda c: c.name)
    assert borders.type == singular.type == 'CURVE' and borders.data.bevel_depth > 0
    patches = np.array(values(layout.data, "patch_id"))
    inside = {}
    for face, polygon in enumerate(layout.data.polygons):
        for edge in polygon.edge_keys:
            inside.setdefault(edge, []).append(patches[face])
    different = sum(a != b for a, b in inside.values())
    assert len(borders.data.splines) == different
    # An edge of the polycube is singular: its ends are corners of it.
    corners = set(polycube.structure(mesh_of(*solid())).corners.tolist())
    shape = points_of(pair[0].data).astype(float)
    ends = {tuple(np.round(s.points[i].co[:3], 4)) for s in singular.data.splines for i in (0, -1)}
    assert ends == {tuple(np.round(shape[c], 4)) for c in corners}


def test_the_layout_as_a_cage(pair, settings):
    ops.simplify()
    ops.show_layout(cage=True)
    mesh = bpy.context.object.data
    assert len(mesh.polygons) == settings.result.patches[1]
    assert all(len(p.vertices) == 4 for p in mesh.polygons) and all(len(e) == 2 for e in faces_per_edge(mesh))


def faces_per_edge(mesh):
    found = {}
    for polygon in mesh.polygons:
        for edge in polygon.edge_keys:
            found.setdefault(edge, []).append(polygon.index)
    return found.values()


def test_hexahedra_are_those_of_the_command(pair, files, command, tmp_path):
    objects = len(bpy.data.objects)
    out = command("remesh", *files, "--hexes", "2000")
    for ending in (".vtu", ".mesh"):
        path = tmp_path / f"hexes{ending}"
        assert ops.write_hexes(filepath=str(path), blocks_from='SEARCH', size='COUNT', hexes=2000) == {'FINISHED'}
        found, expected = polycube.read(path), polycube.read(out / path.name)
        assert np.array_equal(found.points, expected.points) and np.array_equal(found.cells, expected.cells)
    # With the numbers of the hexahedra, too.
    assert (tmp_path / "hexes.vtu").read_bytes() == (out / "hexes.vtu").read_bytes()
    assert len(bpy.data.objects) == objects
    report = json.loads((out / "report.json").read_text())
    assert str(report["hexes"]) in bpy.context.scene.polycube.result.meshed


def test_hexahedra_lie_where_the_shape_is(pair, tmp_path):
    shape, _ = pair
    shape.location, shape.scale, shape.rotation_euler = (5.0, 0.0, 0.0), (2.0, 2.0, 2.0), (0.0, 0.0, 0.5)
    bpy.context.view_layer.update()
    path = tmp_path / "hexes.vtu"
    ops.export_hexes(filepath=str(path))
    found = polycube.read(path)
    corners = np.array([shape.matrix_world @ v.co for v in shape.data.vertices])
    assert found.kind == "hexahedra"
    assert np.allclose(found.points.min(axis=0), corners.min(axis=0), atol=0.5)
    assert np.allclose(found.points.max(axis=0), corners.max(axis=0), atol=0.5)


def test_hexahedra_of_a_mirrored_object_are_not_inverted(pair, tmp_path):
    for obj in pair:
        obj.scale = (-1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    path = tmp_path / "hexes.vtu"
    ops.export_hexes(filepath=str(path))
    found = polycube.read(path)
    first, along, across, up = (found.points[found.cells[:, i]] for i in (0, 1, 3, 4))
    assert (np.einsum('ij,ij->i', np.cross(along - first, across - first), up - first) > 0.0).all()


def test_hexahedra_for_solvers(pair, files, command, tmp_path):
    """Where the shape lies at the origin, the very file of the command; elsewhere its vertices in the scene."""
    given = dict(blocks_from='SEARCH', size='COUNT', hexes=2000)
    formats = ("msh", "inp", "su2", "xyz", "json", "foam", "blockmesh")
    out = command("remesh", *files, "--hexes", "2000", *(word for name in formats for word in ("--format", name)))
    for ending in formats[:5]:
        path = tmp_path / f"hexes.{ending}"
        assert ops.export_hexes(filepath=str(path)) == {'FINISHED'} and path.stat().st_size > 10_000
        assert ops.write_hexes(filepath=str(path), **given) == {'FINISHED'}
        assert path.read_bytes() == (out / ("blocks.json" if ending == "json" else path.name)).read_bytes()
    ops.write_hexes(filepath=str(tmp_path / "case.blockmesh"), **given)
    dictionary = "system/blockMeshDict"
    assert (tmp_path / "case.blockmesh" / dictionary).read_bytes() == (out / "blockmesh" / dictionary).read_bytes()
    ops.write_hexes(filepath=str(tmp_path / "case.foam"), **given)
    for name in ("points", "faces", "boundary", "cellZones"):
        within = f"constant/polyMesh/{name}"
        assert (tmp_path / "case.foam" / within).read_bytes() == (out / "foam" / within).read_bytes()
    before = polycube.read(tmp_path / "hexes.msh")
    pair[0].location, pair[0].rotation_euler = (5.0, 0.0, 1.0), (0.0, 0.3, 0.5)
    bpy.context.view_layer.update()
    ops.write_hexes(filepath=str(tmp_path / "hexes.msh"), **given)
    after = polycube.read(tmp_path / "hexes.msh")
    matrix = np.array(pair[0].matrix_world)
    assert np.allclose(after.points, before.points @ matrix[:3, :3].T + matrix[:3, 3], atol=1e-5)
    assert np.array_equal(after.cells, before.cells)


def test_a_mirrored_object_is_not_for_solvers(pair, tmp_path):
    for obj in pair:
        obj.scale = (-1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="mirrored.*Apply > Scale"):
        ops.write_hexes(filepath=str(tmp_path / "hexes.msh"))
    assert not list(tmp_path.glob("hexes*"))


def test_a_file_that_cannot_be_written(pair):
    with pytest.raises(RuntimeError, match="no/such/folder"):
        ops.export_hexes(filepath="/no/such/folder/hexes.vtu")


def test_a_polycube_without_a_shape_is_its_own_shape(settings):
    settings.polycube = add("Cube", *solid())
    assert ops.quad_remesh() == {'FINISHED'}
    assert bpy.context.object.name == "Cube Quads"
