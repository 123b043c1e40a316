# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Operators that run the command. The window stays alive meanwhile: a timer looks at the process ten times a second."""

import contextlib

import bpy

from .command import CommandError, Job, found


class Running(bpy.types.PropertyGroup):
    """What the panel shows of the command that runs."""

    is_active: bpy.props.BoolProperty()
    is_cancelled: bpy.props.BoolProperty()
    label: bpy.props.StringProperty()
    percent: bpy.props.IntProperty(subtype="PERCENTAGE", min=0, max=100, name="Progress")


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="Command", subtype="FILE_PATH",
        description="The command vdbcage. If this is empty, it is the add-on's own, or else looked for in PATH")

    def draw(self, context):
        self.layout.prop(self, "command")


def command(context):
    """The command, as the preferences say. Raises CommandError."""
    addon = context.preferences.addons.get(__package__)
    return found(bpy.path.abspath(addon.preferences.command) if addon else "")


def take(operator, settings, names):
    """Gives the properties of these names of an operator the values of the settings, unless its caller set them."""
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(settings, name))


_failures = (CommandError, OSError)  # a full disk, a folder that cannot be written


class CommandOperator:
    """Base of operators that run the command: in a window without stopping it, in a script until it is done.

    `prepare(context, job)` writes files into the job's folder and returns the commands. `finish(context, job)` takes
    what they wrote. Both raise CommandError for what is wrong; then nothing was added to the scene.
    """

    bl_options = {"UNDO"}  # not REGISTER: Adjust Last Operation would run it again with the window standing still
    _running = None  # the job and the timer of what runs, so that they end with the add-on

    def execute(self, context):
        try:
            with Job(bpy.app.tempdir) as job:
                job.start(self.prepare(context, job))
                with self._explained(context, job):
                    job.wait()
                self.finish(context, job)
        except _failures as error:
            return self._failed(error)
        return {"FINISHED"}

    def invoke(self, context, _event):
        running = context.window_manager.vdbcage
        if running.is_active:
            return self._failed("A command of vdbcage still runs")
        self.take_settings(context)
        self._job = Job(bpy.app.tempdir)
        try:
            self._job.start(self.prepare(context, self._job))
        except _failures as error:
            self._job.close()
            return self._failed(error)
        except Exception:
            self._job.close()
            raise
        running.is_active, running.is_cancelled = True, False
        running.label, running.percent = self.bl_label, 0
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        CommandOperator._running = self._job, self._timer
        return {"RUNNING_MODAL"}

    def take_settings(self, context):
        """Before a run from the panel: takes what the panel shows, unless the caller said otherwise."""

    def failure(self, context, job, error):
        """The error to report when a command ended with `error`; its files are still there."""
        return error

    @contextlib.contextmanager
    def _explained(self, context, job):
        try:
            yield
        except CommandError as error:
            raise self.failure(context, job, error) from None

    def _failed(self, error):
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def modal(self, context, event):
        running = context.window_manager.vdbcage
        # The press alone: whatever else Esc ends, such as a menu, leaves its release.
        if running.is_cancelled or (event.type == "ESC" and event.value == "PRESS"):
            self.cancel(context)
            self.report({"INFO"}, f"{self.bl_label}: cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            with self._explained(context, self._job):
                has_ended = self._job.poll()
            if not has_ended:
                running.label, running.percent = f"{self.bl_label}: {self._job.stage}", self._job.percent
                _redraw(context)
                return {"PASS_THROUGH"}
            self.finish(context, self._job)
        except _failures as error:
            self.cancel(context)
            return self._failed(error)
        except Exception:
            self.cancel(context)
            raise
        self.cancel(context)
        return {"FINISHED"}

    def cancel(self, context):
        """Ends the process and removes its files; Blender calls it too, when it closes."""
        end(context)


def end(context):
    """Ends what runs."""
    if CommandOperator._running is not None:
        job, timer = CommandOperator._running
        CommandOperator._running = None
        context.window_manager.event_timer_remove(timer)
        context.window_manager.vdbcage.is_active = False
        job.close()
        _redraw(context)


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


class VDBCAGE_OT_cancel(bpy.types.Operator):
    """End the command that runs"""

    bl_idname = "vdbcage.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return context.window_manager.vdbcage.is_active

    def execute(self, context):
        context.window_manager.vdbcage.is_cancelled = True
        return {"FINISHED"}


CLASSES = (Running, Preferences, VDBCAGE_OT_cancel)
PROPERTIES = ((bpy.types.WindowManager, "vdbcage", bpy.props.PointerProperty(type=Running)),)
