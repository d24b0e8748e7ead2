"""`remesh`: the meshes, their fields, and equality with the command."""

import numpy as np
import pytest

import polycube


@pytest.fixture(scope="module")
def meshes(pair) -> polycube.Remeshed:
    return polycube.remesh(*pair, hexes=1500, max_hausdorff=5)


def volumes(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Of hexahedra, by the tetrahedra between the middles of their faces' halves and their own middle."""
    faces = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
    p = points[cells]
    middle = p.mean(axis=1)
    total = np.zeros(len(cells))
    for face in faces:
        a, b, c, d = (p[:, i] - middle for i in face)
        m = (a + b + c + d) / 4
        for s, t in ((a, b), (b, c), (c, d), (d, a)):
            total += np.einsum("ij,ij->i", m, np.cross(s, t)) / 6
    return total


def test_hexahedra(meshes):
    hexes = meshes.hexes
    count = len(hexes.cells)
    assert count == meshes.report["hexes"] == pytest.approx(1500, rel=0.25)
    assert (hexes.points.shape[1], hexes.cells.shape[1], hexes.mesh.kind) == (3, 8, "hexahedra")
    assert hexes.polycube_points.shape == hexes.points.shape
    assert (hexes.label.dtype, hexes.block_id.dtype, hexes.scaled_jacobian.dtype) == (np.int8, np.uint32, np.float64)
    assert len(hexes.label) == len(hexes.block_id) == len(hexes.scaled_jacobian) == count
    assert hexes.scaled_jacobian.min() == meshes.report["min_sj"] > 0
    assert set(hexes.block_id) == set(range(meshes.simplified.counts_after.blocks_padded))
    sizes = volumes(hexes.points, hexes.cells)
    assert sizes.min() > 0
    assert sizes.sum() == pytest.approx(meshes.report["volume"], rel=1e-3)
    assert meshes.good == (meshes.report["inverted"] == 0 and meshes.report["within_hausdorff"])


def test_quadrilaterals_are_the_surface_of_the_hexahedra(meshes):
    quads, hexes = meshes.quads, meshes.hexes
    surface = np.unique(hexes.mesh.boundary())
    assert len(quads.points) == len(surface)
    assert {tuple(p) for p in quads.points} == {tuple(p) for p in hexes.points[surface]}
    assert set(quads.patch_id) == set(range(meshes.simplified.counts_after.surface_patches))
    assert set(quads.label) == set(range(6))
    inner = meshes.simplified.counts_after.blocks
    assert set(quads.block_id) == set(range(inner, meshes.simplified.counts_after.blocks_padded))


def test_feature_edges_lie_on_edges_of_the_polycube(meshes):
    quads = meshes.quads
    edges = quads.feature_edges
    assert edges.dtype == np.uint32
    ends = quads.polycube_points[edges]
    assert np.all(np.abs(ends[:, 1] - ends[:, 0]).sum(axis=1) == 1)
    simple = meshes.simplified
    corners = simple.levels[simple.structure.corner_levels]
    chains = simple.structure.edges
    number = {int(v): i for i, v in enumerate(simple.structure.corners)}
    length = sum(np.abs(corners[number[int(c[-1])]] - corners[number[int(c[0])]]).sum() for c in chains)
    assert len(edges) == length


def test_layout(meshes):
    layout, counts = meshes.layout, meshes.simplified.counts_after
    assert (layout.blocks.kind, len(layout.blocks.cells)) == ("hexahedra", counts.blocks_padded)
    assert (layout.patches.kind, len(layout.patches.cells)) == ("quads", counts.surface_patches)
    assert len(layout.patch_label) == counts.surface_patches
    assert len(layout.singular_edges) >= len(meshes.simplified.structure.edges)
    for edge in layout.singular_edges:
        assert edge.points.shape[0] >= 2 and edge.points.shape[1] == 3
        assert edge.valence != 4


def test_a_surface_alone(surfaces):
    meshes = polycube.remesh(*surfaces, surface_only=True, edge_length=3)
    assert meshes.hexes is None and meshes.layout.blocks is None
    assert len(meshes.quads.cells) == meshes.report["quads"]
    assert len(meshes.layout.patches.cells) == meshes.simplified.counts_after.surface_patches


def test_padding(pair):
    bare = polycube.remesh(*pair, scale=0.15, padding=0, simplicity=1.0)
    padded = polycube.remesh(*pair, scale=0.15, padding=2, simplicity=1.0)
    quads = len(bare.quads.cells)
    assert len(padded.quads.cells) == quads
    assert len(padded.hexes.cells) == len(bare.hexes.cells) + 2 * quads


def test_the_same_bytes_as_the_command(tmp_path, command, pair, meshes):
    files = tmp_path / "shape.mesh", tmp_path / "polycube.mesh"
    for mesh, path in zip(pair, files):
        mesh.write(path)
    solvers = ["msh", "inp", "su2", "foam", "json", "xyz", "blockmesh"]
    formats = [word for name in solvers for word in ("--format", name)]
    size = ("--hexes", 1500, "--max-hausdorff", 5)
    command("remesh", files[0], "--polycube", files[1], "-o", tmp_path / "out", *size, *formats)
    meshes.hexes.write(tmp_path / "hexes.vtu")
    meshes.hexes.mesh.write(tmp_path / "hexes.mesh")
    meshes.quads.mesh.write(tmp_path / "quads.obj")
    meshes.layout.patches.write(tmp_path / "layout.obj")
    blocks = len(meshes.layout.blocks.cells)
    meshes.layout.blocks.write(tmp_path / "layout.vtk", {"block_id": np.arange(blocks)})
    meshes.simplified.polycube.write(tmp_path / "own.mesh")
    for extension in solvers:
        meshes.hexes.write(tmp_path / f"hexes.{extension}")
    names = ["hexes.vtu", "quads.obj", "layout.obj", "layout.vtk", "hexes.msh", "hexes.inp", "hexes.su2", "hexes.xyz"]
    surfaces = [f"constant/triSurface/{name}.obj" for name in ("boundary", "between")]
    case = ["system/blockMeshDict", *surfaces]
    other = [("own.mesh", "polycube.mesh"), ("hexes.json", "blocks.json")]
    other += [(f"hexes.blockmesh/{file}", f"blockmesh/{file}") for file in case]
    for own, theirs in [*zip(names, names), *other]:
        assert (tmp_path / own).read_bytes() == (tmp_path / "out" / theirs).read_bytes(), theirs
    case = tmp_path / "hexes.foam" / "constant" / "polyMesh"
    for own in ["points", "faces", "owner", "neighbour", "boundary", "cellZones"]:
        assert (case / own).read_bytes() == (tmp_path / "out/foam/constant/polyMesh" / own).read_bytes(), own
    again = polycube.read(tmp_path / "out" / "hexes.mesh")
    assert np.array_equal(again.points, meshes.hexes.points)
    assert np.array_equal(again.cells, meshes.hexes.cells)


def test_hexahedra_are_written_where_one_says(tmp_path, meshes):
    hexes = meshes.hexes
    turned = hexes.points @ [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]] + [1.0, 2.0, 3.0]
    for extension in ("vtu", "msh"):
        hexes.write(tmp_path / f"here.{extension}")
        hexes.write(tmp_path / f"there.{extension}", points=turned)
    here, there = (polycube.read(tmp_path / f"{name}.vtu") for name in ("here", "there"))
    assert np.array_equal(there.points, turned) and np.array_equal(there.cells, here.cells)
    # Gmsh's file lists the vertices by facet and block, those of both meshes alike.
    here, there = (polycube.read(tmp_path / f"{name}.msh") for name in ("here", "there"))
    assert np.array_equal(there.cells, here.cells)
    assert {*map(tuple, there.points.tolist())} == {*map(tuple, turned.tolist())}
    names = [(tmp_path / f"{name}.msh").read_text().split("$Entities")[0] for name in ("here", "there")]
    assert names[0] == names[1] and "plus_z" in names[0]
    for points in (turned[1:], turned[:, :2], np.full_like(turned, np.nan)):
        with pytest.raises(polycube.InvalidMesh):
            hexes.write(tmp_path / "none.msh", points=points)
    assert not (tmp_path / "none.msh").exists()


def test_texture_coordinates(tmp_path, command, surfaces):
    files = tmp_path / "shape.off", tmp_path / "polycube.off"
    for mesh, path in zip(surfaces, files):
        mesh.write(path)
    command("remesh", files[0], "--polycube", files[1], "-o", tmp_path / "out", "--hexes", 1500, "--max-hausdorff", 5,
            "--surface-only", "--uv")
    quads = polycube.remesh(*surfaces, hexes=1500, max_hausdorff=5, surface_only=True).quads
    quads.write(tmp_path / "quads.obj", uv=True)
    assert (tmp_path / "quads.obj").read_bytes() == (tmp_path / "out" / "quads.obj").read_bytes()
    corners = quads.uv.reshape(-1, 4, 2)
    assert len(corners) == len(quads.cells) and (0 < corners).all() and (corners < 1).all()
    first, last = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    areas = first[:, 0] * last[:, 1] - first[:, 1] * last[:, 0]
    assert areas.min() > 0 and np.allclose(areas, areas[0])
    with pytest.raises(polycube.InvalidOption):
        quads.write(tmp_path / "quads.off", uv=True)


def test_groups_of_faces(tmp_path, command, pair, meshes):
    files = tmp_path / "shape.mesh", tmp_path / "polycube.mesh"
    for mesh, path in zip(pair, files):
        mesh.write(path)
    surface = polycube.Mesh(pair[0].points, pair[0].boundary(), "triangles")
    height = surface.points[surface.cells].mean(axis=1)[:, 2]
    painted = tmp_path / "painted.vtk"
    surface.write(painted, {"part": (height > np.median(height)).astype(np.int32)})
    size = ("--hexes", 1500, "--max-hausdorff", 5, "--format", "msh", "--format", "su2")
    command("remesh", files[0], "--polycube", files[1], "-o", tmp_path / "out", *size, "--groups", painted)
    for name in ("hexes.msh", "hexes.su2"):
        meshes.hexes.write(tmp_path / name, groups=painted)
        assert (tmp_path / name).read_bytes() == (tmp_path / "out" / name).read_bytes()
    moved = tmp_path / "moved.su2"
    meshes.hexes.write(moved, points=meshes.hexes.points + [1e3, 0.0, 0.0], groups=painted)
    marks = [path.read_text().split("NMARK")[1] for path in (moved, tmp_path / "hexes.su2")]
    assert marks[0] == marks[1] and marks[0].count("MARKER_TAG= group_") == 2
    with pytest.raises(polycube.InvalidOption):
        meshes.hexes.write(tmp_path / "none.vtu", groups=painted)
    with pytest.raises(polycube.ParseError):
        surface.write(tmp_path / "plain.obj")
        meshes.hexes.write(tmp_path / "none.msh", groups=tmp_path / "plain.obj")
    with pytest.raises(polycube.FileError):
        meshes.hexes.write(tmp_path / "none.msh", groups=tmp_path / "none.obj")
    assert not (tmp_path / "none.msh").exists()


@pytest.mark.parametrize(
    "option",
    [
        {"hexes": 0},
        {"hexes": 100, "scale": 1},
        {"edge_length": 0},
        {"padding": 17},
        {"max_hausdorff": 0},
        {"simplicity": -1},
        {"scale": 1e30},
    ],
)
def test_options_out_of_range(cube, option):
    with pytest.raises(polycube.InvalidOption):
        polycube.remesh(cube, cube, **option)


def test_locked_faces_stay(surfaces):
    shape, mesh = surfaces
    found = polycube.structure(mesh)
    meshes = polycube.remesh(shape, mesh, scale=0.5, surface_only=True, locked_faces=[0])
    facet = found.facet[0]
    level = found.facet_level[facet]
    assert meshes.simplified.levels[level] == round(found.levels[level] * 0.5)


def test_a_broken_polycube_is_not_meshed(pair, cube):
    with pytest.raises(polycube.Mismatch):
        polycube.remesh(cube, pair[1])
