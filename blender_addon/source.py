# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's objects to the arrays that the core works on.

Where no polycube is chosen, one is made of the shape: such a shape is called plain.

Both meshes are taken as the viewport shows them: with modifiers, and with the scale of their objects. The axes that the
faces of a polycube look along are those of its own object, so location and rotation do not matter.
"""

import contextlib
import hashlib
import math
from dataclasses import dataclass, field

import bpy
import numpy as np
import polycube

from . import faults

# The custom property of a result that names the object that it was made of.
ORIGIN = "polycube_origin"


@dataclass
class Surface:
    """A mesh of Blender as arrays, in the object's own space."""

    points: np.ndarray
    """(n, 3), single precision, without the object's scale."""
    corners: np.ndarray
    """The vertex of every corner, polygon by polygon."""
    sizes: np.ndarray
    """The number of corners of every polygon."""
    triangles: np.ndarray
    """(t, 3) vertices of Blender's own triangulation."""
    polygon_of_triangle: np.ndarray
    """(t,)"""

    def same_faces(self, other):
        """Whether two meshes have the same vertices and polygons."""
        return (
            len(self.points) == len(other.points)
            and np.array_equal(self.sizes, other.sizes)
            and np.array_equal(self.corners, other.corners)
        )


@dataclass
class Source:
    """Shape and polycube, ready for the core."""

    holder: str
    """The name of the object that the polycube belongs to."""
    shape_name: str | None
    """The name of the shape's object, where there is a shape."""
    key: str | None
    """The shape key that is the polycube; none where an object is."""
    polycube: polycube.Mesh | None
    """In scene units along the holder's axes; none for a plain shape whose polycube is yet to be made."""
    shape: polycube.Mesh | None
    """In scene units along the axes of the shape's object."""
    polygon_of_cell: np.ndarray
    """The Blender polygon that each cell is part of."""
    polygon_count: int
    size: np.ndarray
    """(3,) scale of the holder."""
    shape_size: np.ndarray
    """(3,) scale of the shape's object."""
    editable: bool
    """Whether vertices and polygons are those of the holder's mesh itself: no modifier makes others."""
    fingerprint: bytes
    plain: bool = False
    """Whether the polycube is made of the shape."""
    made: polycube.Made | None = None
    """What was made of a plain shape."""
    offset: np.ndarray = field(default_factory=lambda: np.zeros(3))
    """(3,) what to add to a polycube that was made so that it lies where the shape is, in scene units."""

    @property
    def labels(self):
        """The labels that go with the polycube; by the normals if none."""
        return self.made.labels if self.made else None

    def take(self, made):
        """Goes on with the polycube that was made of this plain shape."""
        self.made, self.shape = made, made.shape
        cube = made.polycube
        # As large as the shape, by a power of two, so that nothing is rounded.
        step = 2.0 ** round(math.log2(_diagonal(made.shape.points) / _diagonal(cube.points)))
        self.polycube = _mesh(cube.points * step, cube.cells)
        self.offset = _middle(made.shape.points) - _middle(self.polycube.points)
        # Its triangles are none of the object's faces.
        self.editable, self.polygon_count = False, len(cube.cells)
        self.polygon_of_cell = np.arange(self.polygon_count)

    def unchanged(self, context):
        """Whether the objects still are what they were when this was read."""
        try:
            # Another object may be active by now.
            again = read_plain(context, bpy.data.objects.get(self.holder)) if self.plain else read(context)
            return again.fingerprint == self.fingerprint
        except faults.Refused:
            return False


def chosen(context):
    """The object that would be meshed, or None: what the panel names, else the active object. Of a result, the object
    that it was made of."""
    settings = context.scene.polycube
    if settings.source == 'KEY':
        return settings.shape
    if settings.polycube or settings.shape:
        return settings.shape or settings.polycube
    active = context.view_layer.objects.active
    while active is not None and active.get(ORIGIN):
        active = active[ORIGIN]
    return active if active is not None and active.type == 'MESH' else None


def read(context):
    """Shape and polycube that the panel names.

    Raises `faults.Refused` where there is nothing to read or shape and polycube do not fit.
    """
    settings = context.scene.polycube
    if settings.source == 'KEY':
        return _read_key(context, settings)
    if settings.polycube is None:
        return read_plain(context, chosen(context))
    return _read_objects(context, settings)


def read_plain(context, shape):
    """An object whose polycube is to be made."""
    if shape is None:
        raise faults.Refused("there is no shape", "select a mesh object, or choose one in the panel")
    own, body = _surface(context, shape, None), _shown(context, shape, None)
    found = _source(shape, None, body, shape, body, body.same_faces(own))
    found.plain, found.polycube = True, None
    return found


def _read_objects(context, settings):
    holder, shape = settings.polycube, settings.shape
    own, cube = _surface(context, holder, None), _shown(context, holder, None)
    body = None if shape is None or shape == holder else _shown(context, shape, None)
    if body is not None and not cube.same_faces(body):
        raise faults.Refused(*_mismatch(holder, cube, shape, body))
    return _source(holder, None, cube, shape if body is not None else None, body, cube.same_faces(own))


def _read_key(context, settings):
    holder = settings.shape
    if holder is None:
        raise faults.Refused("there is no object", "choose one with a shape key in the panel, or add an example")
    keys = holder.data.shape_keys
    key = keys.key_blocks.get(settings.key) if keys else None
    if key is None or key == keys.reference_key:
        name = settings.key or "its name"
        raise faults.Refused(
            f"{holder.name} has no shape key {name!r} besides its basis",
            "choose the polycube's key, or Objects without a polycube, to have one made"
        )
    own, body = _surface(context, holder, 0), _shown(context, holder, 0)
    index = keys.key_blocks.find(key.name)
    # Modifiers that keep the faces deform the shape only; the polycube is the key as it is stored.
    editable = body.same_faces(own)
    cube = _surface(context, holder, index) if editable else _shown(context, holder, index)
    if not cube.same_faces(body):
        raise faults.Refused(
            "the modifiers make other faces of the polycube than of the shape",
            "apply them, or use those that treat both alike, such as Mirror, or Triangulate by a fixed method",
        )
    return _source(holder, key.name, cube, holder, body, editable)


def _source(holder, key, cube, shape, body, editable):
    size = _scale(holder)
    shape_size = _scale(shape or holder)
    cells, polygon_of_cell = _cells(cube)
    points = cube.points.astype(np.float64) * size
    shape_points = None if body is None else body.points.astype(np.float64) * shape_size
    digest = hashlib.blake2b(digest_size=16)
    for array in (points, shape_points, cells):
        digest.update(b"" if array is None else np.ascontiguousarray(array).tobytes())
    digest.update(repr((holder.name, key, shape and shape.name)).encode())
    found = Source(
        holder=holder.name,
        shape_name=shape.name if shape else None,
        key=key,
        polycube=None,
        shape=None,
        polygon_of_cell=polygon_of_cell,
        polygon_count=len(cube.sizes),
        size=size,
        shape_size=shape_size,
        editable=editable,
        fingerprint=digest.digest(),
    )
    try:
        found.polycube = _mesh(points, cells)
        found.shape = None if body is None else _mesh(shape_points, cells)
    except polycube.InvalidMesh as error:
        raise faults.Broken(error, found) from error
    return found


def _mesh(points, cells):
    return polycube.Mesh(points, cells, kind="quads" if cells.shape[1] == 4 else "triangles")


def _diagonal(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def _middle(points):
    return 0.5 * (points.min(axis=0) + points.max(axis=0))


def _scale(obj):
    # Scales such as 0.1 are not exact in single precision, and matrices add noise in the last digits.
    size = np.array([float(f"{abs(s):.6g}") for s in obj.matrix_world.to_scale()])
    if not np.all(size > 0.0):
        raise faults.Refused(f"{obj.name} has a scale of 0", "give it a size along every axis")
    return size


def _cells(surface):
    """Cells for the core, and the polygon that each is part of. Meshes of mixed polygons are cut into triangles: those
    of the polycube, for shape and polycube alike."""
    sizes = set(np.unique(surface.sizes).tolist())
    if len(sizes) == 1 and sizes <= {3, 4}:
        return surface.corners.reshape(-1, sizes.pop()), np.arange(len(surface.sizes))
    return surface.triangles, surface.polygon_of_triangle


def _mismatch(holder, cube, shape, body):
    counts = f"{len(body.points)} vertices and {len(body.sizes)} faces, {holder.name} has {len(cube.points)} and {len(cube.sizes)}"
    return (
        f"shape and polycube do not have the same vertices and faces: {shape.name} has {counts}",
        "give the pair that one deformation connects, with the same numbering, and check their modifiers",
    )


def _surface(context, obj, key):
    """The object's mesh as it is stored, or one of its shape keys."""
    obj.update_from_editmode()
    surface = _arrays(obj.data)
    if key is not None:
        co = np.empty(len(surface.points) * 3, dtype=np.float32)
        obj.data.shape_keys.key_blocks[key].data.foreach_get("co", co)
        surface.points = co.reshape(-1, 3)
    return surface


def _shown(context, obj, key):
    """The object's mesh as the viewport shows it, or would show it with one shape key alone."""
    with visible(context, obj, key):
        evaluated = obj.evaluated_get(context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        try:
            return _arrays(mesh)
        finally:
            evaluated.to_mesh_clear()


@contextlib.contextmanager
def visible(context, obj, key=None):
    """Shows an object for a moment, with one shape key alone if its number is given. Blender evaluates no modifiers of
    hidden objects."""
    if obj.name not in context.view_layer.objects:
        raise faults.Refused(f"{obj.name} is not in this view layer", "link it to a collection that is switched on")
    before = obj.hide_get(), obj.hide_viewport, obj.show_only_shape_key, obj.active_shape_key_index
    _show(obj, False, False, *(before[2:] if key is None else (True, key)))
    context.view_layer.update()
    try:
        yield
    finally:
        _show(obj, *before)


def _show(obj, hidden, disabled, only_key, key):
    # Shown in all view layers first: an object that is not cannot be shown in one.
    obj.hide_viewport = False
    obj.hide_set(hidden)
    obj.hide_viewport = disabled
    obj.show_only_shape_key, obj.active_shape_key_index = only_key, key


def _arrays(mesh):
    mesh.calc_loop_triangles()
    return Surface(
        points=get(mesh.vertices, "co", np.float32, 3),
        corners=get(mesh.loops, "vertex_index", np.int32),
        sizes=get(mesh.polygons, "loop_total", np.int32),
        triangles=get(mesh.loop_triangles, "vertices", np.int32, 3),
        polygon_of_triangle=get(mesh.loop_triangles, "polygon_index", np.int32),
    )


def get(collection, name, dtype, width=1):
    """One property of all elements, as an array of `width` columns."""
    values = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def locked_cells(source, settings, obj):
    """The cells whose facets may not move, or none. `settings` are the options of the operator."""
    if settings.locks == 'NONE':
        return None
    if source.plain:
        raise faults.Refused(
            "faces cannot be locked before there is a polycube", "press Make Polycube, and choose faces of what it adds"
        )
    if not source.editable:
        raise faults.Refused(
            "faces cannot be locked: modifiers make other ones than those of the mesh", "apply the modifiers first"
        )
    locked = _selected(obj) if settings.locks == 'SELECTION' else _in_group(obj, settings.lock_group)
    if not locked.any():
        chosen = "is selected" if settings.locks == 'SELECTION' else f"has all its vertices in {settings.lock_group!r}"
        raise faults.Refused(f"no face of {obj.name} {chosen}", "choose faces to keep in place, or Keep in Place: Nothing")
    return np.flatnonzero(locked[source.polygon_of_cell])


def _selected(obj):
    return get(obj.data.polygons, "select", bool)


def _in_group(obj, name):
    group = obj.vertex_groups.get(name)
    if group is None:
        raise faults.Refused(f"{obj.name} has no vertex group {name!r}", "choose one in the panel")
    inside = np.array([any(g.group == group.index and g.weight > 0.0 for g in v.groups) for v in obj.data.vertices])
    corners = inside[get(obj.data.loops, "vertex_index", np.int32)]
    starts = get(obj.data.polygons, "loop_start", np.int32)
    return np.logical_and.reduceat(corners, starts) if len(starts) else np.zeros(0, bool)
