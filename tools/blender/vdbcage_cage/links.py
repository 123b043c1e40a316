# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Which cage a model has, how both were at rest, and by what cages move a model."""

import bpy
import numpy
from mathutils import Matrix

from . import geometry
from .command import CommandError
from .files import Polygons

# Custom properties of models: of the cage at rest x, y, z of its points, in its own space; how many corners each face
# has; and the points at these corners. A model that was linked by an older add-on has the first alone.
_rest, _rest_counts, _rest_corners = "vdbcage_rest", "vdbcage_rest_counts", "vdbcage_rest_corners"


SURFACE = bpy.props.EnumProperty(
    name="Around", items=(("EVALUATED", "With Modifiers", "The model as it is seen, with its modifiers"),
                          ("REST", "Without Modifiers", "The mesh as it was modelled")))


def _forget_rest(self, _context):
    self.is_at_rest = False


class Link(bpy.types.PropertyGroup):
    """What an object knows as a model, and whether it is a cage."""

    cage: bpy.props.PointerProperty(
        name="Cage", type=bpy.types.Object, poll=lambda self, thing: thing.type == "MESH" and thing != self.id_data,
        update=_forget_rest, description="The cage that moves this model; any closed mesh around it")
    is_cage: bpy.props.BoolProperty()
    surface: SURFACE  # what of the model its cage was made around
    is_at_rest: bpy.props.BoolProperty()  # whether the two below and the points of the cage are known
    model_matrix: bpy.props.FloatVectorProperty(size=16)
    cage_matrix: bpy.props.FloatVectorProperty(size=16)
    pose_key: bpy.props.StringProperty()  # the shape key that holds a pose, or nothing
    pose_cache: bpy.props.StringProperty()  # the Mesh Cache modifier that holds poses, or nothing


class Rest:
    """A model and its cage at rest: the cage's mesh in its own space, and both world matrices, (4, 4)."""

    def __init__(self, mesh, model_matrix, cage_matrix):
        self.mesh, self.model_matrix, self.cage_matrix = mesh, model_matrix, cage_matrix


def in_scene(context, thing):
    """Whether an object is still there: what is deleted stays in the file while something points to it."""
    return thing is not None and context.scene.objects.get(thing.name) == thing


def cage_of(context, model):
    """The cage of a model, or None."""
    cage = model.vdbcage.cage
    return cage if in_scene(context, cage) else None


def active_cage(context):
    """The cage that the active object has, or else is itself; or None."""
    thing = context.object
    if thing is None:
        return None
    cage = cage_of(context, thing)
    if cage is None and any(cage_of(context, model) == thing for model in context.scene.objects):
        return thing
    return cage


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


def seen_rest(context, model, cage):
    """Both as they are now. Raises CommandError."""
    shape = geometry.evaluated(context, cage)
    if len(shape.points) != len(cage.data.vertices):
        raise CommandError(f"{cage.name} has modifiers that change its number of points. Apply them first")
    geometry.inverse(cage.name, cage.matrix_world)
    geometry.inverse(model.name, model.matrix_world)
    return Rest(shape, geometry.matrix(model.matrix_world), geometry.matrix(cage.matrix_world))


def set_rest(model, cage, rest):
    """From now on this is how the model and its cage are at rest."""
    link = model.vdbcage
    link.cage = cage
    cage.vdbcage.is_cage = True
    model[_rest] = rest.mesh.points.ravel().tolist()
    model[_rest_counts], model[_rest_corners] = rest.mesh.counts.tolist(), rest.mesh.corners.tolist()
    link.model_matrix, link.cage_matrix = rest.model_matrix.ravel(), rest.cage_matrix.ravel()
    link.is_at_rest = True


def rest_of(model, cage):
    """How the model and its cage are at rest. Raises CommandError."""
    link = model.vdbcage
    if not link.is_at_rest or _rest not in model:
        raise CommandError(f"{model.name} has no shape at rest. Press Set Rest while {cage.name} is as it is")
    points = numpy.array(model[_rest], numpy.float64).reshape(-1, 3)
    if len(points) != len(cage.data.vertices):
        raise CommandError(f"{cage.name} has {len(cage.data.vertices)} points, and had {len(points)} at rest. Press "
                           "Set Rest while it is as the model is")
    mesh = geometry.rest(cage)
    faces = [numpy.array(model[name], int) for name in (_rest_counts, _rest_corners) if name in model]
    counts, corners = faces or (mesh.counts, mesh.corners)
    return Rest(Polygons(points, counts, corners), numpy.array(link.model_matrix, numpy.float64).reshape(4, 4),
                numpy.array(link.cage_matrix, numpy.float64).reshape(4, 4))


def cage_matrix_now(model, rest):
    """The world matrix that the cage had if it had moved along with the model since both were at rest.

    Blender's modifiers do not look at where a cage's object is either: only its points move a model.
    """
    relation = numpy.linalg.inv(rest.model_matrix) @ rest.cage_matrix
    return model.matrix_world @ Matrix(relation.tolist())


TARGETS = {"MESH_DEFORM": "object", "SURFACE_DEFORM": "target"}  # modifiers that bind, and which property has the cage


def target_of(modifier):
    """The object that a modifier is bound to, or None."""
    return getattr(modifier, TARGETS[modifier.type]) if modifier.type in TARGETS else None


def bound_by(model):
    """The modifiers by which cages move a model at once."""
    targets = [(modifier, target_of(modifier)) for modifier in model.modifiers]
    return [modifier for modifier, target in targets
            if target is not None and (target == model.vdbcage.cage or target.vdbcage.is_cage)]


def moved_by(model):
    """The modifiers and the shape keys by which cages move a model."""
    link, keys = model.vdbcage, model.data.shape_keys
    modifiers = bound_by(model) + [modifier for modifier in model.modifiers
                                   if modifier.type == "MESH_CACHE" and modifier.name == link.pose_cache]
    return modifiers, [key for key in keys.key_blocks if key.name == link.pose_key] if keys else []


def only(model, mover):
    """From now on nothing of cages moves the model but `mover`, a modifier or a shape key, or None."""
    modifiers, keys = moved_by(model)
    for modifier in modifiers:
        modifier.show_viewport = modifier.show_render = modifier == mover
    for key in keys:
        key.value = key == mover


def unmoved(context, model):
    """The mesh of a model as it is seen, but for what cages move. Raises CommandError."""
    with geometry.muted(*moved_by(model)):
        return geometry.evaluated(context, model)


CLASSES = (Link,)
PROPERTIES = ((bpy.types.Object, "vdbcage", bpy.props.PointerProperty(type=Link)),)
