# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work off the main thread: an operator that shows progress, can be cancelled, and makes one undo step."""

import bpy
import polycube

from . import faults, source

# Seconds between two looks at a running job.
TICK = 0.05


class _Running:
    """The one job that may run at a time."""

    job = None


def running():
    """Whether a job is at work."""
    return _Running.job is not None


@bpy.app.handlers.persistent
def stop(*_):
    """Cancels the job at work: another file is loaded, or the extension is switched off."""
    if _Running.job is not None:
        _Running.job.cancel()


def status():
    """What the job at work is doing: the name of the stage and the part done, 0 to 1."""
    return _Running.job.progress if running() else ("", 0.0)


class Idle:
    """Mix-in for operators that must not run beside a job."""

    @classmethod
    def poll(cls, context):
        if running():
            cls.poll_message_set("Another Polycube job is running; press Esc to cancel it")
            return False
        return context.scene is not None


class JobOperator(Idle):
    """Mix-in for operators that start a job of the core and make something of its result.

    A class says what to do in `begin`, which reads the scene and gives a `polycube.Job`, and in `finish`, which changes
    the scene; both run on the main thread and may raise `faults.Refused` or `polycube.PolycubeError`. Pressed in the
    panel the job runs while Blender stays usable; from scripts and the redo panel the operator waits for it.
    """

    bl_options = {'REGISTER', 'UNDO'}

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        answer = self._start(context)
        if answer is None:
            self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
            context.window_manager.modal_handler_add(self)
            return {'RUNNING_MODAL'}
        return answer

    def execute(self, context):
        answer = self._start(context)
        if answer is not None:
            return answer
        while not self._job.wait(TICK):
            self._show(context)
        return self._end(context)

    def modal(self, context, event):
        if event.type == 'ESC' and event.value == 'PRESS':
            self._job.cancel()
            return {'RUNNING_MODAL'}
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        if not self._job.done:
            self._show(context)
            return {'PASS_THROUGH'}
        return self._end(context)

    def cancel(self, context):
        """Called by Blender when the window goes away."""
        self._job.cancel()
        self._job.wait()
        self._clean_up(context)

    def _start(self, context):
        """Starts the job; gives an answer only if there is none to wait for."""
        self.settle(context.scene.polycube)
        self._source = None
        try:
            leave_edit_mode(context)
            self._source = source.read(context)
            self._job = _Running.job = self.begin(context, self._source)
        except (faults.Refused, polycube.PolycubeError) as error:
            return faults.report(self, context, error, self._source)
        context.window_manager.progress_begin(0.0, 100.0)
        return None

    def _end(self, context):
        self._clean_up(context)
        try:
            result = self._job.result()
            leave_edit_mode(context)
            if not self._source.unchanged(context):
                raise faults.Refused("shape or polycube were changed meanwhile", "start again")
            self.finish(context, self._source, result)
        except (faults.Refused, polycube.PolycubeError) as error:
            return faults.report(self, context, error, self._source)
        return {'FINISHED'}

    def _show(self, context):
        stage, part = self._job.progress
        context.window_manager.progress_update(100.0 * part)
        context.workspace.status_text_set(f"Polycube: {stage}, {100.0 * part:.0f} %.  Esc to cancel")
        _redraw(context)

    def _clean_up(self, context):
        _Running.job = None
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        timer = getattr(self, "_timer", None)
        if timer is not None:
            context.window_manager.event_timer_remove(timer)
            self._timer = None
        _redraw(context)


def leave_edit_mode(context):
    """Back to object mode, so that what was edited counts."""
    if context.view_layer.objects.active and context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')


def _redraw(context):
    areas = (area for window in context.window_manager.windows for area in window.screen.areas)
    for area in (a for a in areas if a.type == 'VIEW_3D'):
        area.tag_redraw()
