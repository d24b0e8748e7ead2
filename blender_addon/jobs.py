# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work off the main thread: an operator that shows progress, can be cancelled, and makes one undo step."""

import bpy
import polycube

from . import faults, live, source

# Seconds between two looks at a running job.
TICK = 0.05
# The part of all that making a polycube takes in the progress that is shown.
MAKING = 0.25


class _Running:
    """The one job that may run at a time."""

    job = None
    span = (0.0, 1.0)
    """Where in all that is to be done the job begins and ends."""

    @classmethod
    def start(cls, job, low, high):
        cls.job, cls.span = job, (low, high)


def running():
    """Whether a job is at work."""
    return _Running.job is not None


@bpy.app.handlers.persistent
def stop(*_):
    """Cancels the job at work: another file is loaded, or the extension is switched off."""
    if _Running.job is not None:
        _Running.job.cancel()
        _Running.job = None


def status():
    """What the job at work is doing: the name of the stage and the part done of all, 0 to 1."""
    if not running():
        return "", 0.0
    (stage, part), (low, high) = _Running.job.progress, _Running.span
    return stage, low + (high - low) * part


class Idle:
    """Mix-in for operators that must not run beside a job."""

    @classmethod
    def poll(cls, context):
        if running():
            cls.poll_message_set("Another Polycube job is running; press Esc to cancel it")
            return False
        return context.scene is not None


class NeedsMesh(Idle):
    """Mix-in for operators that need an object to work on."""

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if source.chosen(context) is None:
            cls.poll_message_set("Select a mesh object, choose one in the panel, or add an example")
            return False
        return True


class JobOperator(NeedsMesh):
    """Mix-in for operators that start a job of the core and make something of its result.

    A class says what to do in `begin`, which is given what `read` took from the scene and gives a `polycube.Job`, and
    in `finish`, which changes the scene; both run on the main thread and may raise `faults.Refused` or
    `polycube.PolycubeError`. For a plain shape a job that makes the polycube goes first. Pressed in the panel the jobs
    run while Blender stays usable; from scripts and the redo panel the operator waits for them.
    """

    bl_options = {'REGISTER', 'UNDO'}
    _making = False
    """Whether the job at work makes a polycube for one that comes after it."""

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
        while answer is None:
            while not self._job.wait(TICK):
                self._show(context)
            answer = self._go_on(context)
        return answer

    def modal(self, context, event):
        if event.type == 'ESC' and event.value == 'PRESS':
            self._job.cancel()
            return {'RUNNING_MODAL'}
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        if not self._job.done:
            self._show(context)
            return {'PASS_THROUGH'}
        return self._go_on(context) or {'PASS_THROUGH'}

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
            self._source = self.read(context)
            self.admit(self._source)
            self._next(context)
        except (faults.Refused, polycube.PolycubeError) as error:
            return faults.report(self, context, error, self._source)
        context.window_manager.progress_begin(0.0, 100.0)
        return None

    def read(self, context):
        """What the job is about."""
        return source.read(context)

    def admit(self, read):
        """Refuses, before anything is made of a plain shape, options that do not go with it."""
        if read.plain:
            source.locked_cells(read, self, None)

    def next_job(self, context, read):
        """Starts to make the polycube of a plain shape, or what comes after that."""
        kept = live.made_of(read, self.making()) if read.plain else None
        if kept is not None:
            read.take(kept)
        self._making = read.polycube is None
        return polycube.Job.make(read.shape, **self.making()) if self._making else self.begin(context, read)

    def _next(self, context):
        low = 0.0 if _Running.job is None else MAKING
        self._job = self.next_job(context, self._source)
        _Running.start(self._job, low, MAKING if self._making else 1.0)

    def _go_on(self, context):
        """After a job that is done: the next one, or the end, which gives an answer."""
        if not self._making:
            return self._end(context)
        try:
            live.keep_made(self._source, self.making(), self._job.result())
            self._next(context)
        except (faults.Refused, polycube.PolycubeError) as error:
            self._clean_up(context)
            return faults.report(self, context, error, self._source)
        return None

    def _end(self, context):
        self._clean_up(context)
        try:
            result = self._job.result()
            leave_edit_mode(context)
            if not self._source.unchanged(context):
                raise faults.Refused("shape or polycube were changed meanwhile", "start again")
            self.finish(context, self._source, result)
            faults.report_folds(self, self._source)
        except (faults.Refused, polycube.PolycubeError) as error:
            return faults.report(self, context, error, self._source)
        return {'FINISHED'}

    def _show(self, context):
        stage, part = status()
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
