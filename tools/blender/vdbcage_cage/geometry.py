# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Arrays of Blender's meshes."""

import contextlib

import bpy
import numpy

from .command import CommandError
from .files import Polygons


def _positions(collection, attribute="co"):
    array = numpy.empty(3 * len(collection), numpy.float32)
    collection.foreach_get(attribute, array)
    return array.reshape(-1, 3).astype(numpy.float64)


def _integers(collection, attribute):
    array = numpy.empty(len(collection), numpy.int32)
    collection.foreach_get(attribute, array)
    return array.astype(numpy.int64)


def _polygons(mesh, points):
    counts, starts = _integers(mesh.polygons, "loop_total"), _integers(mesh.polygons, "loop_start")
    ends = numpy.cumsum(counts)
    # Faces need not lie one after the other in Blender 3.
    order = numpy.repeat(starts - (ends - counts), counts) + numpy.arange(ends[-1] if len(ends) else 0)
    return Polygons(points, counts, _integers(mesh.loops, "vertex_index")[order])


def _flush(thing):
    if thing.mode == "EDIT":
        thing.update_from_editmode()


def rest(thing):
    """The mesh of an object as it was modelled: without modifiers, and without shape keys but the basis."""
    _flush(thing)
    keys = thing.data.shape_keys
    points = _positions(keys.reference_key.data if keys else thing.data.vertices)
    return _polygons(thing.data, points)


def set_rest(thing, points):
    """Moves the points of an object's mesh as it was modelled. Every shape key keeps its offsets from the basis."""
    mesh = thing.data
    keys = mesh.shape_keys
    if keys:
        moves = points - _positions(keys.reference_key.data)
        for key in keys.key_blocks:
            shape = points if key == keys.reference_key else _positions(key.data) + moves
            key.data.foreach_set("co", shape.astype(numpy.float32).ravel())
    mesh.vertices.foreach_set("co", points.astype(numpy.float32).ravel())
    mesh.update()


def points_of_group(thing, name):
    """The points that have a weight above 0 in a vertex group. Raises CommandError."""
    group = thing.vertex_groups.get(name)
    if group is None:
        raise CommandError(f"{thing.name} has no vertex group {name}")
    points = [vertex.index for vertex in thing.data.vertices
              if any(one.group == group.index and one.weight > 0 for one in vertex.groups)]
    if not points:
        raise CommandError(f"{thing.name}: no point has a weight above 0 in the vertex group {name}")
    return points


def select_faces(thing, faces):
    """Selects these faces of an object's mesh, and nothing else of it."""
    mesh = thing.data
    for collection, chosen in ((mesh.vertices, []), (mesh.edges, []), (mesh.polygons, faces)):
        is_selected = numpy.zeros(len(collection), bool)
        is_selected[chosen] = True
        collection.foreach_set("select", is_selected)
    mesh.update()


def require_object_mode(thing):
    """Raises CommandError: what is set beside the mesh in Edit Mode is lost."""
    if thing.mode == "EDIT":
        raise CommandError(f"{thing.name} is in Edit Mode. Leave it first")


@contextlib.contextmanager
def muted(modifiers, keys=()):
    """For a while these modifiers and shape keys do nothing."""
    shown = [modifier for modifier in modifiers if modifier.show_viewport]
    heard = [key for key in keys if not key.mute]
    for modifier in shown:
        modifier.show_viewport = False
    for key in heard:
        key.mute = True
    try:
        yield
    finally:
        for modifier in shown:
            modifier.show_viewport = True
        for key in heard:
            key.mute = False


def _is_enabled(view_layer, thing):
    """Whether Blender works out modifiers and animation of an object. It does where only the eye is shut."""
    if thing.hide_viewport:
        return False
    collections = [view_layer.layer_collection]
    while collections:
        one = collections.pop()
        if not one.exclude and not one.collection.hide_viewport:
            if one.collection.objects.get(thing.name) == thing:
                return True
            collections.extend(one.children)
    return False


def evaluated(context, thing):
    """The mesh of an object as it is seen in this frame. Raises CommandError."""
    if not _is_enabled(context.view_layer, thing):
        raise CommandError(f"{thing.name} is disabled or excluded in this view layer. Show it first")
    _flush(thing)
    context.view_layer.update()
    shown = thing.evaluated_get(context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    try:
        return _polygons(mesh, _positions(mesh.vertices))
    finally:
        shown.to_mesh_clear()


def move_modifier(context, thing, modifier, index):
    """Gives a modifier this place in the stack."""
    with context.temp_override(object=thing, active_object=thing):
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=index)


def matrix(blender):
    """A 4 x 4 matrix as an array."""
    return numpy.array(blender, numpy.float64)


def inverse(name, blender):
    """The inverse of the matrix of the object `name`. Raises CommandError."""
    array = matrix(blender)
    scales = numpy.linalg.norm(array[:3, :3], axis=0)
    if not (scales > 0).all() or abs(numpy.linalg.det(array[:3, :3] / scales)) < 1e-6:
        raise CommandError(f"{name} is flat: its scale is 0 along an axis")
    return numpy.linalg.inv(array)


def new_mesh(name, polygons):
    """A mesh of Blender."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(polygons.points.tolist(), [], polygons.faces())
    mesh.update()
    return mesh
