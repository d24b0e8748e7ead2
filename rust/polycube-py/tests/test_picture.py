"""The picture in notebooks: a PNG file, with what there is to see in its place and colour."""

import struct
import zlib

import numpy as np
import pytest

import polycube


def pixels(png: bytes) -> np.ndarray:
    """The colours of a PNG file as the module writes it; chunks and their sums are checked."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(png):
        (length,), name = struct.unpack(">I", png[at : at + 4]), png[at + 4 : at + 8]
        chunks[name] = png[at + 8 : at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length : at + 12 + length])[0] == zlib.crc32(name + chunks[name])
        at += 12 + length
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, 1 + 3 * width)
    return rows[:, 1:].reshape(height, width, 3)


def test_a_cube_shows_three_faces(cube):
    picture = pixels(cube._repr_png_())
    assert picture.shape == (320, 320, 3)
    assert (picture[0] == 255).all() and (picture[-1] == 255).all()
    colours, counts = np.unique(picture.reshape(-1, 3), axis=0, return_counts=True)
    large = colours[counts > 5000]
    assert len(large) == 4  # the ground and three faces
    brightness = {name: int(picture[y, x].sum()) for name, (y, x) in (("top", (80, 160)), ("left", (200, 100)))}
    assert brightness["top"] > brightness["left"]


def test_other_programs_read_it(cube, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    (tmp_path / "cube.png").write_bytes(cube._repr_png_())
    image = pyvista.read(tmp_path / "cube.png")
    assert image.dimensions == (320, 320, 1)
    read = np.asarray(image.point_data.active_scalars).reshape(320, 320, 3)[::-1]
    assert np.array_equal(read, pixels(cube._repr_png_()))


def test_every_result_has_its_own(surfaces):
    shape, mesh = surfaces
    meshes = polycube.remesh(shape, mesh, scale=0.05, max_hausdorff=5, strategy="paper")
    pictures = [x._repr_png_() for x in (shape, mesh, meshes.simplified, meshes.quads, meshes.hexes, meshes)]
    assert len(set(pictures[:5])) == 5
    assert pictures[5] == pictures[3] == meshes.quads._repr_png_()
    broken = polycube.simplify(mesh, strategy="naive", scale=0.05)
    assert broken.polycube is None and broken._repr_png_() is None


def test_patches_have_colours(surfaces):
    shown = polycube.simplify(surfaces[1], strategy="paper")
    colours = np.unique(pixels(shown._repr_png_()).reshape(-1, 3), axis=0, return_counts=True)[1]
    assert (colours > 100).sum() > 15
