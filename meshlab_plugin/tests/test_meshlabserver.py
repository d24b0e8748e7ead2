"""The plugin in MeshLab 2020.09, by scripts that meshlabserver runs under Xvfb."""

import json
import re
import subprocess
from xml.sax.saxutils import quoteattr

import numpy
import pytest
from conftest import Mesh, required

pymeshlab = pytest.importorskip("pymeshlab")


def param(kind, name, value, **more):
    attributes = {"type": kind, "name": name, "value": value, **more}
    return "<Param " + " ".join(f"{key}={quoteattr(str(text))}" for key, text in attributes.items()) + "/>"


def boolean(name, value):
    return param("RichBool", name, str(value).lower())


def integer(name, value):
    return param("RichInt", name, value)


def choice(name, value, *names):
    values = {f"enum_val{i}": text for i, text in enumerate(names)}
    return param("RichEnum", name, value, enum_cardinality=len(names), **values)


def length(name, value):
    return param("RichAbsPerc", name, value, min=0, max=1000)


def layers(polycube, shape):
    return [param("RichMesh", "polycube", polycube), param("RichMesh", "shape", shape)]


def number(name, value):
    return param("RichFloat", name, value)


def tolerance(angle=30):
    return [number("angle_tolerance", angle), number("level_tolerance", 5)]


def result(simplicity=1, displacement=0):
    return [
        param("RichDynamicFloat", "simplicity", simplicity, min=0, max=1),
        number("max_displacement", displacement),
    ]


def simplify(polycube=0, shape=1, strategy=0, step=0, lock=False, angle=30, **which):
    return "Polycube: Simplify", [
        *layers(polycube, shape),
        choice("strategy", strategy, "Best", "Paper", "Rounding"),
        choice("objective", 0, "Surface patches", "Blocks", "Blocks with padding"),
        *result(**which),
        length("lattice_step", step),
        boolean("lock_selected_faces", lock),
        boolean("lattice_units", True),
        *tolerance(angle),
    ]


def scalar_choice(value=0):
    return choice("face_scalar", value, "Patch id", "Scaled Jacobian")


def layout(polycube=0, shape=1):
    lock = boolean("lock_selected_faces", False)
    return "Polycube: Coarse Quad Layout", [
        *layers(polycube, shape),
        boolean("by_quality", True),
        *result(),
        lock,
        scalar_choice(),
        *tolerance(),
    ]


def quads(polycube=0, shape=1, edge=2, by_quality=True, **which):
    lock = boolean("lock_selected_faces", False)
    size = [*layers(polycube, shape), length("edge_length", edge)]
    return "Polycube: Quad Remesh", [*size, boolean("by_quality", by_quality), *result(**which), lock, scalar_choice(), *tolerance()]


def hexes(file, polycube=0, shape=1, count=3000, by_quality=True, **which):
    return "Polycube: Hex Remesh to File", [
        param("RichSaveFile", "file", file, ext="*.vtu"),
        *layers(polycube, shape),
        integer("hexes", count),
        integer("padding", 1),
        boolean("by_quality", by_quality),
        *result(**which),
        boolean("lock_selected_faces", False),
        *tolerance(),
    ]


def check():
    return "Polycube: Check", tolerance()


def colour(by, polycube=0, shape=1):
    return f"Polycube: Colour by {by}", [*layers(polycube, shape), *tolerance()]


def example(name=0, seed=1):
    names = ["cube-spikes", "stepped-l", "ring", "double-torus"]
    return "Polycube: Example", [choice("example", name, *names), integer("seed", seed)]


class Done:
    """What a run left behind."""

    def __init__(self, code, output, folder):
        self.code, self.output, self.folder = code, output, folder

    def layer(self):
        """The layer that was current at the end."""
        self.layers = pymeshlab.MeshSet()
        self.layers.load_new_mesh(str(self.folder / "out.ply"))
        return self.layers.current_mesh()


@pytest.fixture
def server(tmp_path):
    """Runs filters, one after the other, on layers from these meshes."""
    program = required("POLYCUBE_MESHLABSERVER")

    def run(meshes, *filters, log=True):
        lines = ["<!DOCTYPE FilterScript>", "<FilterScript>"]
        for name, parameters in filters:
            lines += [f' <filter name="{name}">', *parameters, " </filter>"]
        script = tmp_path / "script.mlx"
        script.write_text("\n".join([*lines, "</FilterScript>"]))
        arguments = [program, "-l", tmp_path / "log.txt"]
        for number, mesh in enumerate(meshes):
            arguments += ["-i", mesh.write(tmp_path / f"in{number}.off")]
        arguments += ["-s", script, "-o", tmp_path / "out.ply", "-m", "fc", "fq", "ff"]
        screen = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24"]
        arguments = [*screen, *map(str, arguments)]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=300, cwd=tmp_path)
        record = tmp_path / "log.txt"
        text = record.read_text() if record.exists() else ""
        return Done(done.returncode, done.stdout + done.stderr + text, tmp_path)

    return run


def files(pair, folder):
    return [mesh.write(folder / f"{name}.off") for mesh, name in zip(pair, ("polycube", "shape"))]


def test_simplify_gives_what_the_command_gives(server, pair, command, tmp_path):
    polycube, shape = files(pair, tmp_path)
    out = command(tmp_path / "out", "simplify", polycube, "--format", "obj", "--shape", shape)
    done = server(pair, simplify())
    assert done.code == 0, done.output
    found, expected = done.layer(), Mesh.read(out / "polycube.obj")
    assert (found.vertex_matrix() == numpy.float32(expected.points)).all()
    assert found.face_matrix().tolist() == expected.faces
    after = json.loads((out / "report.json").read_text())["after"]
    text = "after:  {surface_patches} patches, {blocks} blocks, {blocks_padded} blocks padded".format(**after)
    assert text in done.output


def test_progress_is_shown(server, pair):
    output = server(pair, simplify()).output
    assert re.search("Polycube: (structure|pair|align|search|morph)", output), output


def test_quads_give_what_the_command_gives(server, pair, command, tmp_path):
    polycube, shape = files(pair, tmp_path)
    options = ["remesh", shape, "--polycube", polycube, "--surface-only"]
    for name, more, run in (("quads", ["--edge-length", 2], quads()), ("layout", [], layout())):
        out = command(tmp_path / name, *options, *more)
        done = server(pair, run)
        assert done.code == 0, done.output
        found, expected = done.layer(), Mesh.read(out / f"{name}.obj")
        assert found.face_number() == 2 * len(expected.faces)
        assert (found.vertex_matrix() == numpy.float32(expected.points)).all()


def test_hexahedra_are_the_files_that_the_command_writes(server, pair, command, tmp_path):
    polycube, shape = files(pair, tmp_path)
    out = command(tmp_path / "out", "remesh", shape, "--polycube", polycube, "--hexes", 3000)
    done = server(pair, hexes(tmp_path / "hexes.vtu"))
    assert done.code == 0, done.output
    assert (tmp_path / "hexes.vtu").read_bytes() == (out / "hexes.vtu").read_bytes()
    assert len(set(done.layer().face_scalar_array())) > 20


def test_what_is_meshed_can_be_chosen(server, pair, command, tmp_path):
    polycube, shape = files(pair, tmp_path)
    options = ["remesh", shape, "--polycube", polycube, "--hexes", 800, "--simplicity", 0]
    out = command(tmp_path / "out", *options)
    done = server(pair, hexes(tmp_path / "hexes.vtu", count=800, by_quality=False, simplicity=0))
    assert done.code == 0, done.output
    assert (tmp_path / "hexes.vtu").read_bytes() == (out / "hexes.vtu").read_bytes()


def test_check_says_why_and_colours_show_labels(server, pair):
    done = server(pair[:1], check())
    assert done.code == 0 and "this is a valid polycube" in done.output
    done = server([Mesh(pair[0].points, pair[0].faces[1:])], check())
    assert done.code == 0 and "this is not a valid polycube" in done.output and "edge" in done.output
    done = server(pair, colour("Label"))
    assert done.code == 0 and set(done.layer().face_scalar_array()) == {0, 1, 2, 3, 4, 5}
    done = server(pair, colour("Block"))
    assert done.code == 0 and len(set(done.layer().face_scalar_array())) > 100


def test_the_example_works_from_an_empty_document(server, pair):
    done = server(pair[:1], example(), simplify(polycube=2, shape=1))
    assert done.code == 0, done.output
    assert "after:  78 patches, 33 blocks, 111 blocks padded" in done.output


@pytest.mark.parametrize("name", ["simplify", "layout", "quads", "hexes", "label", "block"])
def test_a_bad_mesh_is_an_error_and_no_crash(server, pair, tmp_path, name):
    file = tmp_path / "hexes.vtu"
    step = {"simplify": simplify, "layout": layout, "quads": quads, "hexes": lambda **k: hexes(file, **k)}.get(name)
    step = step or (lambda **k: colour(name.capitalize(), **k))
    broken = Mesh(pair[0].points, pair[0].faces[1:])
    for meshes, shape in (([broken], 0), ([pair[0], broken], 1)):
        done = server(meshes, step(polycube=0, shape=shape))
        assert done.code == 255 and "Problem with filter" in done.output, done.output
        assert re.search(r"Error: \S.{20,}", done.output), done.output
    assert not file.exists()


def test_wrong_parameters_are_errors(server, pair, tmp_path):
    runs = [
        (simplify(strategy=2, step=40), "lattice"),
        (simplify(step=-1), "scale"),
        (simplify(simplicity=2), "simplicity"),
        (simplify(displacement=-1), "displacement"),
        (simplify(angle=60), "45"),
        (quads(simplicity=-1), "simplicity"),
        (quads(edge=0), "above 0"),
        (hexes(tmp_path / "hexes.obj"), "Choose a name"),
        (hexes(tmp_path / "none" / "hexes.vtu"), "Choose another"),
        (hexes(tmp_path / "hexes.vtu", count=0), "1 or more"),
        (example(seed=-1), "seed"),
    ]
    for run, text in runs:
        done = server(pair, run)
        assert done.code == 255 and re.search(f"Error: .*{text}", done.output), (run, done.output)
