# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad meshes are refused at the place, and nothing else happens."""

import bmesh
import bpy
import numpy as np
import pytest
from solids import add, add_pair, bent, points_of, snapshot, solid

ops = bpy.ops.polycube


def selected():
    """What is selected in edit mode: vertices, edges and faces, as the select mode has it."""
    obj = bpy.context.object
    bm = bmesh.from_edit_mesh(obj.data)
    mode = bpy.context.tool_settings.mesh_select_mode
    kinds = [elements for elements, on in zip((bm.verts, bm.edges, bm.faces), mode) if on]
    return [[element.index for element in kind if element.select] for kind in kinds]


def hole(points, faces):
    """One face less."""
    return points, faces[:5] + faces[6:]


def turned(points, faces):
    """One face the wrong way round."""
    return points, [*faces[:5], faces[5][::-1], *faces[6:]]


def inside_out(points, faces):
    """All faces the wrong way round."""
    return points, [face[::-1] for face in faces]


def wing(points, faces):
    """A third face at an edge."""
    a, b = faces[0][0], faces[0][1]
    wide = np.vstack([points, points[[a, b]] + [0.0, 0.0, 40.0]])
    return wide, [*faces, [a, b, len(points) + 1, len(points)]]


def spike(points, faces):
    """A vertex pulled out of its facet."""
    pulled = points.copy()
    pulled[faces[0][0]] += [0.0, 0.0, -7.0]
    return pulled, faces


def bow(points, faces):
    """Not a polycube at all."""
    return bent(points) * [1.0, 1.0, 3.0] @ rotation(0.7), faces


def rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])


def not_finite(points, faces):
    """A coordinate that is no number."""
    broken = points.copy()
    broken[7, 1] = np.nan
    return broken, faces


def crossing(points, faces):
    """A second cube through the top of the plate."""
    cube, sides = solid((((0, 0, 0), (1, 1, 1)),))
    return np.vstack([points, cube + [4.5, 4.5, 1.5]]), [*faces, *(np.array(sides) + len(points)).tolist()]


@pytest.mark.parametrize("spoil, message", [
    (hole, "open here"),
    (wing, "more than two faces|open here"),
    (spike, "off the"),
    (bow, "off the nearest axis|chart|corner"),
    (not_finite, "not a finite number"),
    (crossing, "touches or crosses|looks inward"),
])
def test_bad_meshes_are_shown_in_edit_mode(settings, spoil, message):
    settings.polycube = add("Bad", *spoil(*solid()))
    before = snapshot()
    for operator in (ops.check, ops.simplify):
        with pytest.raises(RuntimeError, match=message):
            operator()
        assert bpy.context.mode == 'EDIT_MESH' and bpy.context.object.name == "Bad"
        assert any(selected())
        bpy.ops.object.mode_set(mode='OBJECT')
        after = snapshot()
        assert [(name, state[:2]) for name, state in after.items()] == [(n, s[:2]) for n, s in before.items()]


@pytest.mark.parametrize("spoil, message", [
    (turned, "oriented against each other"),
    (inside_out, "looks inward"),
])
def test_faces_the_wrong_way_round_are_shown_by_check_and_turned_by_simplify(settings, spoil, message):
    settings.polycube = add("Bad", *spoil(*solid()))
    with pytest.raises(RuntimeError, match=message):
        ops.check()
    assert bpy.context.mode == 'EDIT_MESH' and any(selected())
    bpy.ops.object.mode_set(mode='OBJECT')
    assert ops.simplify() == {'FINISHED'}


def test_exactly_the_open_edges_are_selected(settings):
    points, faces = hole(*solid())
    obj = settings.polycube = add("Bad", points, faces)
    with pytest.raises(RuntimeError, match="3 more like it"):
        ops.check()
    (edges,) = selected()
    gone = set(solid()[1][5])
    assert len(edges) == 4 and all(set(obj.data.edges[e].vertices) <= gone for e in edges)


def test_triangulated_faces_are_found_again(settings):
    """An n-gon that is not flat: the triangles that the core sees are not the mesh's faces."""
    outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
    points = [(x, y, z) for z in (0, 1) for x, y in outline]
    faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]]
    faces += [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    points[6] = (0, 0, 2.5)
    settings.polycube = add("Bad", points, faces)
    with pytest.raises(RuntimeError, match=r"[Ff]ace [0-7]:|[Vv]ertex|[Ee]dge"):
        ops.check()
    for number, kind in enumerate(selected()):
        assert kind, number


def test_an_empty_mesh(settings):
    settings.polycube = add("Nothing", np.zeros((0, 3)), [])
    for operator in (ops.check, ops.simplify, ops.quad_remesh, ops.show_layout):
        with pytest.raises(RuntimeError, match="no faces|empty"):
            operator()


def test_nothing_chosen(settings):
    for source in ('OBJECTS', 'KEY'):
        settings.source = source
        with pytest.raises(RuntimeError, match="Select a mesh object"):
            ops.simplify()
    settings.shape = add("Plain", *solid())
    with pytest.raises(RuntimeError, match="no shape key 'Polycube'"):
        ops.simplify()


def test_shape_and_polycube_of_different_faces(settings):
    shape, cube = add_pair(*solid())
    settings.shape, settings.polycube = add("Other", *solid((((0, 0, 0), (1, 1, 1)),))), cube
    with pytest.raises(RuntimeError, match="do not have the same vertices and faces: Other has 8 vertices"):
        ops.simplify()


def test_a_flat_object(pair):
    pair[1].scale.z = 0.0
    with pytest.raises(RuntimeError, match="scale of 0"):
        ops.simplify()


def test_rounding_that_breaks_the_polycube(pair, settings):
    before = snapshot()
    with pytest.raises(RuntimeError, match="Rounding broke the polycube"):
        ops.simplify(strategy='naive', lattice='STEP', lattice_step=20.0)
    assert snapshot() == before and settings.result.token == 0


def test_an_object_outside_the_view_layer(pair):
    bpy.context.collection.objects.unlink(pair[0])
    with pytest.raises(RuntimeError, match="not in this view layer"):
        ops.simplify()


def test_points_are_where_they_were(pair):
    """A refused operator leaves even the modes of a shape key alone."""
    ops.add_example(example='stepped-l')
    obj = bpy.context.object
    obj.show_only_shape_key, obj.active_shape_key_index = False, 1
    points = points_of(obj.data)
    ops.check()
    assert not obj.show_only_shape_key and obj.active_shape_key_index == 1
    assert np.array_equal(points_of(obj.data), points)
