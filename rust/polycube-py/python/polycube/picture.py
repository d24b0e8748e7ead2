"""A small picture of a mesh or result for notebooks, drawn with numpy alone. `polycube view` makes a page to turn."""

from __future__ import annotations

import colorsys
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

from ._native import Hexes, Made, Mesh, Quads, Remeshed, Simplified, structure

_Array = npt.NDArray[Any]

SIZE = 320
"""Pixels to a side."""
FINER = 2
"""Drawn larger by this and scaled down, for smooth lines."""
VIEW = np.array([0.50, 0.42, 0.76])
"""Towards the eye; Y is up."""
LIGHT = np.array([0.25, 0.85, 0.55])
GREY = (0.80, 0.82, 0.86)


def of(value: Mesh | Quads | Hexes | Made | Simplified | Remeshed) -> bytes | None:
    """A PNG file: surfaces coloured by patch, polycubes by patch or label; None where there is nothing to see."""
    if isinstance(value, Remeshed):
        return of(value.quads)
    if isinstance(value, Quads):
        return png(value.mesh, value.patch_id)
    if isinstance(value, Made):
        return png(value.polycube, value.labels)
    if isinstance(value, Simplified):
        cube = value.polycube
        return None if cube is None else png(cube, structure(cube, value.labels).patch_id)
    return png(value.mesh if isinstance(value, Hexes) else value)


def png(mesh: Mesh, numbers: _Array | None = None) -> bytes:
    """The boundary of a mesh, its faces coloured by a number each and parted by lines where that changes."""
    faces = mesh.boundary()
    if len(faces) == 0:
        return _encode(np.full((SIZE, SIZE, 3), 255, np.uint8))
    shown = np.zeros(len(faces), int) if numbers is None else numbers.astype(int)
    palette = np.array([_pastel(i) for i in range(shown.max() + 1)] if numbers is not None else [GREY])
    colours = np.vstack([palette[shown] * _light(mesh.points, faces)[:, None], [1, 1, 1]])
    seen = _seen(_project(mesh.points), faces)
    picture = colours[seen]
    picture[_lines(np.append(shown, -1)[seen])] = 0.15
    fine = picture.reshape(SIZE, FINER, SIZE, FINER, 3).mean(axis=(1, 3))
    return _encode((255 * fine + 0.5).astype(np.uint8))


def _light(points: _Array, faces: _Array) -> _Array:
    """The light on every face, 0 to 1."""
    first = points[faces[:, 0]]
    normals = np.cross(points[faces[:, 1]] - first, points[faces[:, -1]] - first)
    lengths = np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    light: _Array = np.clip(0.78 + 0.22 * (normals / lengths) @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
    return light


def _pastel(number: int) -> tuple[float, float, float]:
    """Colours far apart for numbers that are near."""
    return colorsys.hls_to_rgb(number * 0.618034 % 1, 0.74, 0.62)


def _project(points: _Array) -> _Array:
    """Pixels to the right, pixels down, and the distance towards the eye."""
    right = np.cross([0, 1, 0], VIEW)
    axes = np.array([right, np.cross(VIEW, right), VIEW])
    seen = points @ (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = 0.92 * SIZE * FINER / max((high - low)[:2].max(), np.finfo(float).tiny)
    middle = np.array([SIZE * FINER / 2, SIZE * FINER / 2, 0])
    flat: _Array = (seen - (low + high) / 2) * scale * [1, -1, 1] + middle
    return flat


def _seen(screen: _Array, faces: _Array) -> _Array:
    """The face nearest to the eye in every pixel, -1 where there is none: of points of all faces, the nearest last."""
    triangles = np.concatenate([faces[:, [0, k, k + 1]] for k in range(1, faces.shape[1] - 1)])
    face = np.tile(np.arange(len(faces)), faces.shape[1] - 2)
    corners = screen[triangles]
    edges = (corners - np.roll(corners, 1, axis=1))[:, :, :2]
    steps = np.ceil(np.linalg.norm(edges, axis=2).max(axis=1) * 1.3).astype(int) + 1
    points, owners = [], []
    for step in np.unique(steps):
        own = steps == step
        sampled = np.einsum("sk,tka->tsa", _weights(int(step)), corners[own])
        points.append(sampled.reshape(-1, 3))
        owners.append(np.repeat(face[own], sampled.shape[1]))
    at, owner = np.concatenate(points), np.concatenate(owners)
    order = np.argsort(at[:, 2], kind="stable")
    pixels = np.clip(at[order, :2].astype(int), 0, SIZE * FINER - 1)
    seen = np.full((SIZE * FINER, SIZE * FINER), -1)
    seen[pixels[:, 1], pixels[:, 0]] = owner[order]
    return seen


def _weights(steps: int) -> _Array:
    """Points of a triangle, evenly apart, by their weights."""
    i, j = np.meshgrid(np.arange(steps + 1), np.arange(steps + 1))
    inside = i + j <= steps
    return np.stack([i[inside], j[inside], (steps - i - j)[inside]], axis=1) / steps


def _lines(shown: _Array) -> _Array:
    """The pixels whose right or lower neighbour shows another number."""
    line = np.zeros(shown.shape, bool)
    line[:, :-1] |= shown[:, :-1] != shown[:, 1:]
    line[:-1] |= shown[:-1] != shown[1:]
    return line


def _encode(pixels: _Array) -> bytes:
    """A PNG file of red, green and blue."""
    rows = np.pad(pixels.reshape(len(pixels), -1), ((0, 0), (1, 0)))
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes(), 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
