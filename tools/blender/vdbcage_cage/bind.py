# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Bind and Rebind: Blender's own modifiers, Mesh Deform and Surface Deform, let a cage move its models."""

import contextlib

import bpy
import numpy

from . import geometry, links
from .command import CommandError
from .files import Polygons
from .running import take


class _Kind:
    """What is said of a modifier that binds: its name, and what a cage must be."""

    def __init__(self, name, operator, needs):
        self.name, self.operator, self.needs = name, operator, needs


_kinds = {
    "MESH_DEFORM": _Kind("Mesh Deform", bpy.ops.object.meshdeform_bind, "the cage must be closed and face outward"),
    "SURFACE_DEFORM": _Kind("Surface Deform", bpy.ops.object.surfacedeform_bind,
                            "the cage's faces must be convex, and its edges have two faces"),
}


class Settings(bpy.types.PropertyGroup):
    """What the panel shows."""

    method: bpy.props.EnumProperty(
        name="Method",
        items=(("MESH_DEFORM", "Mesh Deform", "The cage moves what is inside it, smoothly"),
               ("SURFACE_DEFORM", "Surface Deform", "The model follows the cage's nearest faces. Quick to bind")))
    precision: bpy.props.IntProperty(
        name="Precision", default=5, min=2, max=10,
        description="Of Mesh Deform. One more takes some ten times as long: for a cage of 400 faces half a second "
                    "at 5, four seconds at 6, a minute at 7. Loose cages take much longer, and gigabytes")


def _unbind(context, model, modifier):
    with context.temp_override(object=model, active_object=model):
        if modifier.is_bound:
            _kinds[modifier.type].operator(modifier=modifier.name)


def _bind(context, model, modifier):
    """Binds to the cage as it is now. Raises CommandError."""
    kind = _kinds[modifier.type]
    _unbind(context, model, modifier)
    try:
        with context.temp_override(object=model, active_object=model):
            kind.operator(modifier=modifier.name)
        reason = kind.needs
    except RuntimeError as error:  # what the operator reports
        reason = str(error).strip()
    if not modifier.is_bound:
        raise CommandError(f"{model.name}: {kind.name} could not be bound: {reason}")


@contextlib.contextmanager
def _stand_in(context, modifier, points, matrix):
    """For a while the modifier takes an object for the cage that has its faces, and these points in its own space."""
    target = links.TARGETS[modifier.type]
    cage = links.target_of(modifier)
    shape = geometry.rest(cage)
    mesh = geometry.new_mesh("stand-in", Polygons(points, shape.counts, shape.corners))
    thing = bpy.data.objects.new("stand-in", mesh)
    thing.matrix_world = matrix
    context.scene.collection.objects.link(thing)
    setattr(modifier, target, thing)
    context.view_layer.update()
    try:
        yield
    finally:
        setattr(modifier, target, cage)
        bpy.data.objects.remove(thing)
        bpy.data.meshes.remove(mesh)


def not_following(context, model, modifier, points, matrix):
    """How many points of the model do not follow, and how many there are.

    The cage is moved aside for a moment: whatever `is_bound` says, that alone shows it. `points` are those of the cage
    that the modifier was bound to, in its own space; `matrix` is its world matrix then.
    """
    behind = list(model.modifiers)[list(model.modifiers).index(modifier) + 1:]
    size = numpy.ptp(points, axis=0).max()
    move = numpy.array([0.3, -0.2, 0.5]) * size
    to_model = numpy.linalg.inv(geometry.matrix(model.matrix_world)) @ geometry.matrix(matrix)
    expected = to_model[:3, :3] @ move
    at = []
    for shift in (0 * move, move):
        with _stand_in(context, modifier, points + shift, matrix), geometry.muted(behind):
            at.append(geometry.evaluated(context, model).points)
    off = numpy.linalg.norm(at[1] - at[0] - expected, axis=1)
    rounding = 1e-6 * max(numpy.abs(at[1]).max(initial=0), numpy.abs(points).max())
    return int((off > 1e-5 * numpy.linalg.norm(expected) + rounding).sum()), len(off)


def _bind_to(context, model, modifier, points, matrix):
    """Binds a modifier to its cage with these points, in its own space, and this world matrix; nothing else of cages
    moves the model meanwhile. As `not_following`. Raises CommandError."""
    modifiers, keys = links.moved_by(model)
    was_shown, modifier.show_viewport = modifier.show_viewport, True
    try:
        with geometry.muted([other for other in modifiers if other != modifier], keys):
            with _stand_in(context, modifier, points, matrix):
                _bind(context, model, modifier)
            stay, number = not_following(context, model, modifier, points, matrix)
    finally:
        modifier.show_viewport = was_shown
    if stay == number:
        needs = _kinds[modifier.type].needs
        needs += ", and the precision high enough" if modifier.type == "MESH_DEFORM" else ""
        raise CommandError(f"None of the {number} points of {model.name} would follow: {needs}")
    return stay, number


def _report(operator, bound):
    """Says how many points follow. `bound` has a model's name, how many of its points do not follow, and all."""
    failed = [f"{stay} of {all_points} points of {name} do not follow" for name, stay, all_points in bound if stay]
    if failed:
        operator.report({"WARNING"}, "; ".join(failed) + ": they are outside the cage, or the precision is too low")
    else:
        names = ", ".join(name for name, _, _ in bound)
        operator.report({"INFO"}, f"All {sum(n for _, _, n in bound)} points of {names} follow")


class VDBCAGE_OT_bind(bpy.types.Operator):
    """Let the cage move its models. As they are now is at rest"""

    bl_idname = "vdbcage.bind"
    bl_label = "Bind"
    bl_options = {"REGISTER", "UNDO"}

    method: Settings.__annotations__["method"]
    precision: Settings.__annotations__["precision"]

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def invoke(self, context, _event):
        take(self, context.scene.vdbcage_bind, Settings.__annotations__)
        return self.execute(context)

    def execute(self, context):
        bound = []
        try:
            for model, cage in links.pairs(context):
                bound.append((model.name, *self._bind(context, model, cage)))
        except CommandError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"} if not bound else {"FINISHED"}
        _report(self, bound)
        return {"FINISHED"}

    def _bind(self, context, model, cage):
        """Binds a new modifier; those before go only if that succeeds. As `not_following`. Raises CommandError."""
        rest = links.seen_rest(context, model, cage)
        before = links.bound_by(model)
        places = [list(model.modifiers).index(modifier) for modifier in before]
        modifier = model.modifiers.new(cage.name, self.method)
        setattr(modifier, links.TARGETS[self.method], cage)
        if before or model.vdbcage.surface == "REST":  # in their place, or else below what the cage does not bound
            geometry.move_modifier(context, model, modifier, min(places, default=0))
        if self.method == "MESH_DEFORM":
            modifier.precision = self.precision
        name = modifier.name
        try:
            found = _bind_to(context, model, modifier, rest.mesh.points, cage.matrix_world)
        except CommandError:
            model.modifiers.remove(modifier)
            raise
        links.set_rest(model, cage, rest)
        for other in links.bound_by(model):
            if other.name != name:
                model.modifiers.remove(other)
        links.only(model, model.modifiers[name])
        return found


class VDBCAGE_OT_rebind(bpy.types.Operator):
    """Bind all models anew that were bound before, to their cages as they were at rest: say after a modifier changed
    how many points a model has"""

    bl_idname = "vdbcage.rebind"
    bl_label = "Rebind All"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def execute(self, context):
        bound, failures = [], []
        for model in context.scene.objects:
            cage = links.cage_of(context, model) if model.type == "MESH" else None
            for modifier in links.bound_by(model):
                if cage is None or links.target_of(modifier) != cage:
                    continue
                try:
                    geometry.evaluated(context, model)  # one that cannot be seen is not unbound
                    rest = links.rest_of(model, cage)
                    if not rest.mesh.has_faces_of(geometry.rest(cage)):  # and so maybe its points in another order
                        raise CommandError(f"{cage.name} has other faces than at rest. Press Set Rest while it is as "
                                           f"{model.name} is")
                    matrix = links.cage_matrix_now(model, rest)
                    bound.append((model.name, *_bind_to(context, model, modifier, rest.mesh.points, matrix)))
                except CommandError as error:
                    failures.append(str(error))
        if failures:
            self.report({"ERROR"}, "; ".join(failures))
        elif not bound:
            self.report({"ERROR"}, "No model is bound to a cage")
        else:
            _report(self, bound)
        return {"FINISHED"} if bound or failures else {"CANCELLED"}


CLASSES = (Settings, VDBCAGE_OT_bind, VDBCAGE_OT_rebind)
PROPERTIES = ((bpy.types.Scene, "vdbcage_bind", bpy.props.PointerProperty(type=Settings)),)
