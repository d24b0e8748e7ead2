# SPDX-License-Identifier: GPL-3.0-or-later
"""Hex Mesh: hexahedra as an object that is cut open."""

import bpy
import numpy as np
import polycube
import pytest
from solids import faces_of, points_of, values, write

ops = bpy.ops.polycube

# For each axis the column of its coordinate, and the sign that makes the side that is cut away the larger one.
SIDES = {'X': (0, 1.0), 'Y': (1, -1.0), 'Z': (2, 1.0)}
# The corners of a cube in VTK's order.
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])


@pytest.fixture
def hexes(pair, command, tmp_path):
    """The command's hexahedra of the pair; the same have been made in Blender."""
    shape, cube = pair
    faces = faces_of(cube.data)
    body = write(tmp_path / "shape.obj", points_of(shape.data), faces)
    out = command("remesh", body, "--polycube", write(tmp_path / "cube.obj", points_of(cube.data), faces), "--hexes", "2000")
    assert ops.hex_mesh(blocks_from='SEARCH', size='COUNT', hexes=2000) == {'FINISHED'}
    return polycube.read(out / "hexes.vtu")


def enclosed(points, faces):
    """The volume inside of bilinear quadrilaterals: the mean of both ways to cut them into triangles."""
    ways = ((0, 1, 2), (0, 2, 3), (0, 1, 3), (1, 2, 3))
    return sum(np.linalg.det(points[np.array(faces)[:, way]]).sum() for way in ways) / 12.0


def volumes(hexes):
    """The volume of every hexahedron as the image of a cube, by a Gauss rule that is exact for it."""
    corners, found = hexes.points[hexes.cells], 0.0
    for where in np.ndindex(2, 2, 2):
        at = 0.5 + (np.array(where) - 0.5) / np.sqrt(3.0)
        weights = np.where(CORNERS, at, 1.0 - at)
        slopes = [np.where(CORNERS[:, i], 1, -1) * np.delete(weights, i, axis=1).prod(axis=1) for i in range(3)]
        found = found + np.linalg.det(np.einsum('ik,mkj->mij', slopes, corners)) / 8.0
    return found


def test_the_whole_is_the_outside_of_the_commands_hexahedra(hexes, settings):
    settings.cut = 0.0
    obj = bpy.context.object
    assert obj.name == "Body Hexes" and not obj.data.validate()
    points = points_of(obj.data)
    found = {frozenset(map(tuple, points[face].tolist())) for face in faces_of(obj.data)}
    there = hexes.points.astype(np.float32)
    assert found == {frozenset(map(tuple, there[face].tolist())) for face in hexes.boundary()}
    assert len(found) == len(obj.data.polygons)


@pytest.mark.parametrize("axis", SIDES)
def test_cut_open_along_an_axis(hexes, settings, axis):
    mesh = bpy.context.object.data
    along, sign = SIDES[axis]
    place = sign * hexes.points[:, along]
    middles = sign * hexes.points[hexes.cells].mean(axis=1)[:, along]
    settings.cut_axis = axis
    for part in (0.0, 0.3, 0.5, 0.8):
        settings.cut = part
        left = middles <= place.max() - part * np.ptp(place)
        inside = enclosed(points_of(mesh).astype(float), faces_of(mesh))
        assert inside == pytest.approx(volumes(hexes)[left].sum(), rel=1e-6)
        count = {}
        for polygon in mesh.polygons:
            for edge in polygon.edge_keys:
                count[edge] = count.get(edge, 0) + 1
        assert set(count.values()) <= {2, 4} and not mesh.validate()
        assert set(values(mesh, "block_id")) and mesh.color_attributes.active_color.name == "polycube"
    settings.cut = 1.0
    assert len(mesh.polygons) == 0


def test_again_takes_the_place_of_the_first(pair, settings):
    ops.hex_mesh(size='COUNT', hexes=500)
    first = bpy.context.object
    coarse = len(first.data.polygons)
    ops.hex_mesh(size='COUNT', hexes=4000)
    assert bpy.context.object == first and len(first.data.polygons) > 2 * coarse
    assert set(bpy.data.objects.keys()) == {"Body", "Cube", "Body Hexes"}
    assert set(bpy.data.meshes.keys()) == {"Body", "Cube", "Body Hexes"}
    # Renamed, it is the user's.
    first.name = "Mine"
    faces = faces_of(first.data)
    ops.hex_mesh(size='COUNT', hexes=500)
    assert bpy.context.object.name == "Body Hexes" and faces_of(first.data) == faces


def test_the_parts_of_an_earlier_result_go_with_it(pair):
    ops.show_layout()
    layout = bpy.context.object
    assert len(layout.children) == 2
    pair[0].location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    ops.show_layout()
    bpy.context.view_layer.update()
    assert bpy.context.object == layout and len(layout.children) == 2
    assert all(np.allclose(np.array(o.matrix_world), np.array(pair[0].matrix_world)) for o in (layout, *layout.children))
    ops.show_layout(cage=True)
    assert bpy.context.object == layout and len(layout.children) == 1


def test_another_shape_leaves_results_alone(pair, settings):
    ops.quad_remesh()
    quads = bpy.context.object
    ops.add_example(example='ring')
    ops.quad_remesh()
    assert bpy.context.object != quads and not quads.hide_get()


def test_after_undo_the_cut_moves_nothing(pair, settings, extension):
    bpy.ops.ed.undo_push(message="before")
    ops.hex_mesh(size='COUNT', hexes=500)
    bpy.ops.ed.undo_push(message="hexahedra")
    bpy.ops.ed.undo()
    assert "Body Hexes" not in bpy.data.objects
    bpy.context.scene.polycube.cut = 0.2
    assert bpy.context.scene.polycube.result.hexes is None
