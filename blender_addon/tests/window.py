# SPDX-License-Identifier: GPL-3.0-or-later
"""Works the extension in Blender's real window, with simulated clicks and keys, and takes pictures.

Started by `tests/blender_gui` as `blender --enable-event-simulate --python window.py -- FOLDER`. Writes FOLDER/done
when all went well, FOLDER/failed with the reason otherwise.
"""

import os
import subprocess
import sys
import traceback

import bpy
from mathutils import Euler

FOLDER = sys.argv[sys.argv.index("--") + 1]
MODULE = "bl_ext.user_default.polycube"
# Seconds to let Blender draw.
SOON, LATER = 0.3, 1.5
# The longest to wait for anything.
LONG = 120.0


def window():
    return bpy.context.window_manager.windows[0]


def view():
    """The area of the 3D view and its region of a kind."""
    return next(area for area in window().screen.areas if area.type == 'VIEW_3D')


def region(kind):
    return next(r for r in view().regions if r.type == kind)


def override(kind='WINDOW'):
    return bpy.context.temp_override(window=window(), area=view(), region=region(kind))


def key(kind, **modifiers):
    """A key is pressed and released over the 3D view."""
    main = region('WINDOW')
    x, y = main.x + main.width // 3, main.y + main.height // 2
    window().event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y)
    for value in ('PRESS', 'RELEASE'):
        window().event_simulate(type=kind, value=value, x=x, y=y, **modifiers)


def click(x, y):
    window().event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y)
    for value in ('PRESS', 'RELEASE'):
        window().event_simulate(type='LEFTMOUSE', value=value, x=x, y=y)


def picture(name):
    """The whole screen as a file."""
    subprocess.run(["import", "-window", "root", os.path.join(FOLDER, f"{name}.png")], check=True)


def press(name, **options):
    """Starts an operator as its button does."""
    with override():
        return getattr(bpy.ops.polycube, name)('INVOKE_DEFAULT', True, **options)


def keys():
    """The shape keys of the example."""
    return bpy.data.objects["Cube with Spikes"].data.shape_keys.key_blocks.keys()


def until(condition):
    """Waits for something to happen."""
    waited = 0.0
    while not condition():
        assert waited < LONG, "this never happens"
        waited += SOON
        yield SOON
    yield LATER


def finished():
    """Waits for the job at work."""
    yield from until(lambda: not sys.modules[f"{MODULE}.jobs"].running())


def open_panel():
    """Shows the sidebar and clicks at its tabs until ours is open."""
    view().spaces.active.show_region_ui = True
    yield LATER
    side = region('UI')
    for y in range(side.y + side.height - 30, side.y + side.height // 4, -20):
        if side.active_panel_category == "Polycube":
            return
        click(side.x + side.width - 10, y)
        yield SOON
    assert side.active_panel_category == "Polycube", "there is no tab Polycube"


def look(scale=1.1):
    """Frames what is selected, from the front, the right and above."""
    with override():
        bpy.ops.view3d.view_selected()
    yield LATER
    space = view().spaces.active.region_3d
    space.view_perspective, space.view_rotation = 'ORTHO', Euler((1.1, 0.0, 0.7)).to_quaternion()
    space.view_distance *= scale
    yield LATER


def redo_panel():
    """Chooses another strategy in the panel at the bottom left, and the first one again."""
    hud = region('HUD')
    click(hud.x + hud.width // 2, hud.y + hud.height - 12)
    yield from until(lambda: region('HUD').height > 100)
    picture("redo")
    first = bpy.context.scene.polycube.result.patches[1]
    for kind, strategy in (('WHEELDOWNMOUSE', 'paper'), ('WHEELUPMOUSE', 'best')):
        yield from choose(kind, strategy)
        assert keys() == ["Basis", "Polycube", "Simplified"], keys()
        assert bpy.context.scene.polycube.result.patches[1] >= first
    assert bpy.context.scene.polycube.result.patches[1] == first


def choose(wheel, strategy):
    """Turns the wheel over the first row of the redo panel until it says so."""
    for nudge in range(40):
        hud = region('HUD')
        x, y = hud.x + hud.width * 3 // 4 + nudge, hud.y + hud.height - 42
        # Blender needs time to see that the mouse is there, and repeats the operator before anything else happens.
        window().event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y)
        yield LATER
        window().event_simulate(type=wheel, value='PRESS', x=x, y=y, ctrl=True)
        yield LATER
        if bpy.context.window_manager.operators[-1].strategy == strategy:
            return
    raise AssertionError("the redo panel does nothing")


def facing(obj):
    """A face that looks to where the pictures are taken from."""
    direction = Euler((1.1, 0.0, 0.7)).to_matrix().col[2]
    return max(obj.data.polygons, key=lambda polygon: polygon.normal.dot(direction))


def work():
    """One session of a user. Gives the seconds to wait before the next step."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    view().spaces.active.overlay.show_floor = False
    with override():
        bpy.ops.screen.screen_full_area()
    yield LATER
    yield from open_panel()
    press("add_example")
    bpy.context.scene.polycube.colour = 'label'
    bpy.ops.ed.undo_push(message="example")
    obj = bpy.context.object
    obj.data.shape_keys.key_blocks["Polycube"].value = 1.0
    yield from look()
    assert press("check") == {'FINISHED'}
    yield LATER
    picture("before")

    # Esc cancels and changes nothing.
    assert press("simplify", steps=100_000) == {'RUNNING_MODAL'}
    yield 2 * LATER
    assert not bpy.ops.polycube.simplify.poll(), "a second job can be started"
    picture("running")
    key('ESC')
    yield from finished()
    assert keys() == ["Basis", "Polycube"], keys()

    assert press("simplify") == {'RUNNING_MODAL'}
    yield from finished()
    assert keys() == ["Basis", "Polycube", "Simplified"], keys()
    picture("after")
    yield from redo_panel()

    # One step to undo, and one to redo.
    key('Z', ctrl=True)
    yield LATER
    assert keys() == ["Basis", "Polycube"], keys()
    key('Z', ctrl=True, shift=True)
    yield LATER
    assert keys() == ["Basis", "Polycube", "Simplified"], keys()

    settings = bpy.context.scene.polycube
    fewest = settings.result.padded[1]
    settings.simplicity = 0.0
    yield LATER
    assert settings.result.padded[1] > fewest
    picture("slider")
    settings.simplicity = 1.0
    yield SOON
    assert settings.result.padded[1] == fewest

    settings.colour = 'block_id'
    assert press("show_layout") == {'RUNNING_MODAL'}
    yield from finished()
    yield from look()
    picture("layout")
    bpy.context.object.hide_set(True)
    assert press("quad_remesh") == {'RUNNING_MODAL'}
    yield from finished()
    settings.colour = 'scaled_jacobian'
    yield LATER
    picture("quads")
    settings.colour = 'block_id'
    assert press("hex_mesh") == {'RUNNING_MODAL'}
    yield from finished()
    bpy.ops.object.select_all(action='DESELECT')
    yield LATER
    picture("hexes")
    shown = len(bpy.context.object.data.polygons)
    settings.cut = 0.3
    yield LATER
    assert len(bpy.context.object.data.polygons) != shown
    # As the file browser does it, once a name is chosen.
    path = os.path.join(FOLDER, "hexes.vtu")
    with override():
        bpy.ops.polycube.export_hexes('EXEC_DEFAULT', filepath=path)
    assert sys.modules[f"{MODULE}.jobs"].running()
    yield from finished()
    assert os.path.getsize(path) > 10_000

    # A mesh with a hole is shown in edit mode.
    bpy.ops.object.select_all(action='DESELECT')
    broken = bpy.data.objects["Cube with Spikes"]
    broken.hide_set(False)
    bpy.context.view_layer.objects.active = broken
    with override():
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.select_all(action='DESELECT')
        bpy.ops.object.mode_set(mode='OBJECT')
        facing(broken).select = True
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.delete(type='ONLY_FACE')
        bpy.ops.object.mode_set(mode='OBJECT')
    try:
        press("check")
        raise AssertionError("a mesh with a hole passes")
    except RuntimeError as error:
        assert "open" in str(error), error
    yield LATER
    assert window().scene and bpy.context.object.mode == 'EDIT'
    yield from look(6.0)
    picture("fault")
    yield from leave()


def leave():
    """Starts anew, and then quits, while a job is at work: Blender must neither hang nor wait for it forever."""
    for _ in range(2):
        bpy.ops.wm.read_homefile(use_factory_startup=True)
        yield LATER
        assert not sys.modules[f"{MODULE}.jobs"].running()
        press("add_example")
        assert press("simplify", steps=100_000) == {'RUNNING_MODAL'}
        yield LATER


def finish(name, text=""):
    with open(os.path.join(FOLDER, name), "w", encoding="utf-8") as file:
        file.write(text)
    bpy.ops.wm.quit_blender()


def drive(steps=None):
    """Called by Blender's timer: one step of the session."""
    drive.steps = drive.steps or work()
    try:
        return next(drive.steps)
    except StopIteration:
        finish("done")
    except Exception:
        picture("failed")
        finish("failed", traceback.format_exc())
    return None


drive.steps = None
bpy.context.preferences.view.show_splash = False
bpy.ops.preferences.addon_enable(module=MODULE)
bpy.app.timers.register(drive, first_interval=LATER, persistent=True)
