# SPDX-License-Identifier: Apache-2.0
"""Which cage a model has, and how both were at rest."""

import bpy
import numpy
from mathutils import Matrix

from . import geometry
from .command import CommandError

_rest = "vdbcage_rest"  # a custom property of cages: x, y, z of all points at rest, in the cage's own space


class Link(bpy.types.PropertyGroup):
    """What a model knows of its cage."""

    cage: bpy.props.PointerProperty(
        name="Cage", type=bpy.types.Object, poll=lambda self, thing: thing.type == "MESH" and thing != self.id_data,
        description="The cage that moves this model; any closed mesh around it")
    surface: bpy.props.EnumProperty(
        name="Mesh", items=(("EVALUATED", "With Modifiers", "The model as it is seen, with its modifiers"),
                            ("REST", "Without Modifiers", "The mesh as it was modelled")))
    is_at_rest: bpy.props.BoolProperty()  # whether the two below are known
    model_matrix: bpy.props.FloatVectorProperty(size=16)
    cage_matrix: bpy.props.FloatVectorProperty(size=16)

    def matrices(self):
        """The world matrices of model and cage at rest, (4, 4)."""
        return (numpy.array(self.model_matrix, numpy.float64).reshape(4, 4),
                numpy.array(self.cage_matrix, numpy.float64).reshape(4, 4))


def in_scene(context, thing):
    """Whether an object is still there: what is deleted stays in the file while something points to it."""
    return thing is not None and context.scene.objects.get(thing.name) == thing


def cage_of(context, model):
    """The cage of a model, or None."""
    cage = model.vdbcage.cage
    return cage if in_scene(context, cage) else None


def pairs(context):
    """The selected models, and the models of the selected cages, each with its cage. Raises CommandError."""
    selected = set(context.selected_objects)
    if context.mode != "OBJECT" and context.object is not None:
        selected.add(context.object)
    found = []
    for model in context.scene.objects:
        cage = cage_of(context, model) if model.type == "MESH" else None
        if cage is not None and (model in selected or cage in selected):
            found.append((model, cage))
    if not found:
        raise CommandError("Select a model that has a cage, or its cage")
    return found


def set_rest(context, model, cage, surface=None):
    """From now on the model is at rest where the cage is as it is now. Raises CommandError."""
    shape = geometry.evaluated(context, cage)
    if len(shape.points) != len(cage.data.vertices):
        raise CommandError(f"{cage.name} has modifiers that change its number of points. Apply them first")
    geometry.inverse(cage.name, cage.matrix_world)
    geometry.inverse(model.name, model.matrix_world)
    cage[_rest] = shape.points.ravel().tolist()
    link = model.vdbcage
    link.cage = cage
    if surface is not None:
        link.surface = surface
    link.model_matrix = geometry.matrix(model.matrix_world).ravel()
    link.cage_matrix = geometry.matrix(cage.matrix_world).ravel()
    link.is_at_rest = True


def rest_points(cage):
    """The points of a cage at rest, in its own space, (n, 3). Raises CommandError."""
    if _rest not in cage:
        raise CommandError(f"{cage.name} has no shape at rest. Press Set Rest while it is as the model is")
    points = numpy.array(cage[_rest], numpy.float64).reshape(-1, 3)
    if len(points) != len(cage.data.vertices):
        raise CommandError(f"{cage.name} has {len(cage.data.vertices)} points, and had {len(points)} at rest. Press "
                           "Set Rest while it is as the model is")
    return points


def driven_by(model, cage):
    """The modifiers by which a cage moves a model."""
    return [modifier for modifier in model.modifiers
            if (modifier.type == "MESH_DEFORM" and modifier.object == cage)
            or (modifier.type == "SURFACE_DEFORM" and modifier.target == cage)
            or (modifier.type == "MESH_CACHE" and modifier.name == pose_name(cage))]


def cage_matrix_now(model):
    """The world matrix that the cage had if it had moved along with the model since both were at rest.

    Blender's modifiers do not look at where a cage's object is either: only its points move a model.
    """
    at_rest, cage = model.vdbcage.matrices()
    relation = numpy.linalg.inv(at_rest) @ cage
    return model.matrix_world @ Matrix(relation.tolist())


def pose_keys(model, cage):
    """The shape key that holds a pose by the cage, if there is one."""
    keys = model.data.shape_keys
    return [key for key in keys.key_blocks if key.name == pose_name(cage)] if keys else []


def only(model, cage, mover):
    """From now on nothing of the cage moves the model but `mover`, a modifier or a shape key."""
    for modifier in driven_by(model, cage):
        modifier.show_viewport = modifier.show_render = modifier == mover
    for key in pose_keys(model, cage):
        key.value = key == mover


def unmoved(context, model):
    """The mesh of a model as it is seen, but for what its cage moves."""
    cage = cage_of(context, model)
    if cage is None:
        return geometry.evaluated(context, model)
    with geometry.muted(driven_by(model, cage), pose_keys(model, cage)):
        return geometry.evaluated(context, model)


def pose_name(cage):
    """The name of the shape key or modifier that holds the pose by a cage."""
    return f"Posed by {cage.name}"[:63]


def register():
    bpy.utils.register_class(Link)
    bpy.types.Object.vdbcage = bpy.props.PointerProperty(type=Link)


def unregister():
    del bpy.types.Object.vdbcage
    bpy.utils.unregister_class(Link)
