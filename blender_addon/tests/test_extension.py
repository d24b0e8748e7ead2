# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user sees of the extension itself."""

import importlib
import os
import zipfile

import bpy
import polycube
import pytest

OPERATORS = ("check", "make", "simplify", "quad_remesh", "show_layout", "export_hexes", "add_example")


def test_the_module_is_the_one_in_the_zip():
    assert polycube.__file__.startswith(os.environ["BLENDER_USER_RESOURCES"])
    names = zipfile.ZipFile(os.environ["POLYCUBE_ZIP"]).namelist()
    assert {"blender_manifest.toml", "LICENSE", "__init__.py"} <= set(names)
    assert not [n for n in names if "test" in n or "__pycache__" in n or n == "build"]


@pytest.mark.parametrize("name", OPERATORS)
def test_every_tooltip_says_something(name):
    kind = getattr(bpy.ops.polycube, name).get_rna_type()
    assert kind.name and kind.description
    own = [p for p in kind.properties if p.identifier not in {"rna_type", "filter_glob", "check_existing"}]
    assert not [p.identifier for p in own if not p.description]


def test_every_setting_has_a_tooltip(settings):
    own = [p for p in settings.bl_rna.properties if p.identifier not in {"rna_type", "name", "result"}]
    assert not [p.identifier for p in own if not p.description]
    choices = [item for p in own if p.type == 'ENUM' for item in p.enum_items]
    assert not [item.identifier for item in choices if not item.description]


def test_operators_can_be_undone_and_repeated(extension):
    for module, name in (("check", "check"), ("make", "make"), ("simplify", "simplify"), ("quads", "quad_remesh"),
                         ("layout", "show_layout"), ("examples", "add_example")):
        cls = getattr(importlib.import_module(f"{extension}.{module}"), f"POLYCUBE_OT_{name}")
        assert {'REGISTER', 'UNDO'} <= cls.bl_options


def test_presets(settings, extension):
    paths = [p for p in bpy.utils.preset_paths("polycube")]
    files = sorted(os.path.join(p, f) for p in paths for f in os.listdir(p) if f.endswith(".py"))
    assert len(files) >= 4
    seen = set()
    for file in files:
        bpy.ops.script.execute_preset(filepath=file, menu_idname="POLYCUBE_PT_presets")
        seen.add((settings.strategy, settings.objective, round(settings.simplicity, 3), settings.steps))
    assert len(seen) == len(files)


def test_own_presets(settings):
    settings.steps = 123
    assert bpy.ops.polycube.preset_add(name="Mine") == {'FINISHED'}
    settings.steps = 7
    (path,) = [os.path.join(p, "Mine.py") for p in bpy.utils.preset_paths("polycube")
               if os.path.exists(os.path.join(p, "Mine.py"))]
    bpy.ops.script.execute_preset(filepath=path, menu_idname="POLYCUBE_PT_presets")
    assert settings.steps == 123
    assert path.startswith(os.environ["BLENDER_USER_RESOURCES"])


def test_switched_off_and_on_again(extension, pair):
    bpy.ops.polycube.simplify()
    bpy.ops.preferences.addon_disable(module=extension)
    assert not hasattr(bpy.types.Scene, "polycube")
    bpy.ops.preferences.addon_enable(module=extension)
    # What the scene says is still there, and the slider rests.
    settings = bpy.context.scene.polycube
    settings.simplicity = 0.5
    assert bpy.ops.polycube.simplify() == {'FINISHED'}


def test_another_file_during_a_job(extension, pair):
    jobs = importlib.import_module(f"{extension}.jobs")
    assert jobs.stop in bpy.app.handlers.load_pre
    jobs.stop()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert not jobs.running()
