# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Pose: vdbcage's own coordinates move the models, also Green's, which Blender does not have."""

import hashlib
import os
import pathlib

import bpy
import numpy

from . import files, geometry, links
from .command import CommandError
from .families import FAMILIES  # the build writes it
from .folders import folder, stored
from .make import still_there
from .running import CommandOperator, command, take


class Settings(bpy.types.PropertyGroup):
    """What the panel shows."""

    coordinates: bpy.props.EnumProperty(name="Coordinates", default="green", items=FAMILIES)
    target: bpy.props.EnumProperty(
        name="Into",
        items=(("SHAPE_KEY", "Shape Key", "The cage as it is now poses the mesh, below all modifiers"),
               ("POINT_CACHE", "Point Cache", "The cage's animation poses the model as it is seen. The points go to a "
                                              "file that a Mesh Cache modifier reads")))
    directory: bpy.props.StringProperty(
        name="Folder", subtype="DIR_PATH",
        description="Where point caches are kept. If this is empty, it is a folder beside the .blend")


class VDBCAGE_OT_pose(CommandOperator, bpy.types.Operator):
    """Pose the models as their cage is posed, by vdbcage's coordinates"""

    bl_idname = "vdbcage.pose"
    bl_label = "Pose"

    coordinates: Settings.__annotations__["coordinates"]
    target: Settings.__annotations__["target"]
    directory: Settings.__annotations__["directory"]
    frame_start: bpy.props.IntProperty(name="First Frame", default=1)
    frame_end: bpy.props.IntProperty(name="Last Frame", default=250)

    def take_settings(self, context):
        take(self, context.scene.vdbcage_pose, Settings.__annotations__)
        take(self, context.scene, ("frame_start", "frame_end"))

    def prepare(self, context, job):
        program = command(context)
        pairs = links.pairs(context)
        self._frames = [context.scene.frame_current]
        if self.target == "POINT_CACHE":
            if self.frame_end < self.frame_start:
                raise CommandError(f"The last frame, {self.frame_end}, is before the first, {self.frame_start}")
            self._frames = list(range(self.frame_start, self.frame_end + 1))
            self._caches = folder(self.directory, "vdbcage_cache", "Point caches are files")
        self._poses, commands = [], []
        for i, (model, cage) in enumerate(pairs):
            pose = _Pose(context, model, cage, job.folder / str(i), self.target, self.coordinates)
            self._poses.append(pose)
        _write_frames(context, self._poses, self._frames)
        for pose in self._poses:
            commands += pose.commands(program)
        return commands

    def finish(self, context, job):
        things = [still_there(context, [pose.model, pose.cage]) for pose in self._poses]
        # All that can fail comes before the scene changes.
        for model, _ in things:
            geometry.require_object_mode(model)
        if self.target == "SHAPE_KEY":
            results = [pose.result(0) for pose in self._poses]
            for (model, _), points in zip(things, results):
                if len(points) != len(model.data.vertices):
                    raise CommandError(f"{model.name} has {len(model.data.vertices)} points now, and had {len(points)}")
        else:
            results = [self._write_cache(pose) for pose in self._poses]
        for (model, cage), result in zip(things, results):
            if self.target == "SHAPE_KEY":
                mover = _set_shape_key(model, cage, result)
            else:
                mover = _set_cache(context, model, cage, result, self.frame_start)
            links.only(model, mover)
        names = ", ".join(pose.model for pose in self._poses)
        count = len(self._frames)
        frames = f"{count} frame{'s' if count > 1 else ''} of " if self.target == "POINT_CACHE" else ""
        self.report({"INFO"}, f"Posed {frames}{names}")

    def _write_cache(self, pose):
        """Writes the point cache of a model; its path."""
        os.makedirs(self._caches, exist_ok=True)
        path = os.path.join(self._caches, f"{files.file_name(pose.model)}.pc2")
        with files.PointCache(path, pose.points, self.frame_start, len(self._frames)) as cache:
            for frame in range(len(self._frames)):
                cache.add(pose.result(frame))
        return path


class _Pose:
    """One model that is posed: its files in the job's folder.

    The command gets points as they were in the world at rest: Green coordinates keep shapes, so it matters how a model
    is scaled. Where the objects have gone since then is of no matter, as with Blender's modifiers.
    """

    def __init__(self, context, model, cage, place, target, coordinates):
        """`place` is a folder that there is not yet."""
        self.model, self.cage = model.name, cage.name
        self._folder, self._coordinates = place, coordinates
        self._model_file = place / f"{files.file_name(model.name)}.ply"  # messages of the command have this name
        rest = links.rest_of(model, cage)
        geometry.require_object_mode(model)
        if target == "SHAPE_KEY" and model.data.users - model.data.use_fake_user > 1:
            raise CommandError(f"{model.name} shares its mesh with other objects, which a shape key would pose too. "
                               "Make it a single user first")
        if target == "SHAPE_KEY":
            mesh = geometry.rest(model)
        else:
            mesh = links.unmoved(context, model)
        self.points = len(mesh.points)
        self._model_to_world, self._cage_to_world = rest.model_matrix, rest.cage_matrix
        cage_name = files.file_name(cage.name)  # no name of a model has a comma there
        self._rest_file, self._posed = place / f"{cage_name}, at rest.ply", place / f"{cage_name}, posed"
        self._cage_points = len(rest.mesh.points)
        self._posed.mkdir(parents=True)
        files.write_ply(self._model_file, mesh.moved(self._model_to_world))
        self._write_cage(self._rest_file, rest.mesh)
        self._weights = self._weights_file()

    def write_frame(self, number, mesh):
        """Writes the posed cage, in its own space, as a frame. Raises CommandError.

        By its faces the command sees whether its points are in another order than at rest.
        """
        if len(mesh.points) != self._cage_points:
            raise CommandError(f"{self.cage} has modifiers that change its number of points. Apply them first")
        self._write_cage(self._posed / f"{number:04d}.ply", mesh)

    def commands(self, program):
        """The commands that leave the posed model in the folder."""
        cage, model = self._rest_file, self._model_file
        bind = [program, "bind", cage, model, "-o", self._weights, "--coordinates", self._coordinates, "-v"]
        deform = [program, "deform", cage, self._posed / "%04d.ply", model, "-o",
                  self._folder / "result.%04d.ply", "--weights", self._weights, "-v"]
        return [deform] if self._weights.exists() else [bind, deform]

    def result(self, number):
        """The points of a frame, in the model's space."""
        points = files.read_ply_points(self._folder / f"result.{number:04d}.ply")
        world = numpy.linalg.inv(self._model_to_world)
        return points @ world[:3, :3].T + world[:3, 3]

    def _write_cage(self, path, mesh):
        files.write_ply(path, mesh.moved(self._cage_to_world))

    def _weights_file(self):
        """Where the weights of this model and cage are kept until Blender ends: they take longer than a pose."""
        content = hashlib.sha256(self._coordinates.encode())
        for file in (self._rest_file, self._model_file):
            content.update(file.read_bytes())
        start = f"vdbcage_weights_{files.file_name(self.model)}_"
        path = pathlib.Path(bpy.app.tempdir) / f"{start}{content.hexdigest()[:32]}.npy"
        for old in path.parent.glob(f"{start}{'?' * 32}.npy"):
            if old != path:
                old.unlink()
        return path


def _write_frames(context, poses, frames):
    """Writes the posed cages of these frames, and goes back to the frame that is seen."""
    current = context.scene.frame_current
    try:
        for number, frame in enumerate(frames):
            if frame != context.scene.frame_current:
                context.scene.frame_set(frame)
            for pose in poses:
                cage = context.scene.objects[pose.cage]
                pose.write_frame(number, geometry.evaluated(context, cage))
    finally:
        if context.scene.frame_current != current:
            context.scene.frame_set(current)


def _set_shape_key(model, cage, points):
    """Sets the shape key that holds poses by this cage, and returns it."""
    if model.data.shape_keys is None:
        model.shape_key_add(name="Basis", from_mix=False)
    _, keys = links.moved_by(model)
    key = keys[0] if keys else model.shape_key_add(name=f"Posed by {cage.name}", from_mix=False)
    model.vdbcage.pose_key = key.name  # Blender may have made it shorter or another one
    key.data.foreach_set("co", points.astype(numpy.float32).ravel())
    model.data.update()
    return key


def _set_cache(context, model, cage, path, first_frame):
    """Lets a Mesh Cache modifier on top of all others read the points, and returns it."""
    modifiers = [modifier for modifier in links.moved_by(model)[0] if modifier.type == "MESH_CACHE"]
    modifier = modifiers[0] if modifiers else model.modifiers.new(f"Posed by {cage.name}", "MESH_CACHE")
    model.vdbcage.pose_cache = modifier.name
    geometry.move_modifier(context, model, modifier, len(model.modifiers) - 1)
    modifier.cache_format = "PC2"
    modifier.filepath = stored(path)
    modifier.frame_start = first_frame
    return modifier


class VDBCAGE_OT_set_rest(bpy.types.Operator):
    """Take the cage as it is now for the shape in which its models are at rest"""

    bl_idname = "vdbcage.set_rest"
    bl_label = "Set Rest"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            # All that can fail comes before anything changes.
            rests = [(model, cage, links.seen_rest(context, model, cage)) for model, cage in links.pairs(context)]
        except CommandError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for model, cage, rest in rests:
            links.set_rest(model, cage, rest)
        return {"FINISHED"}


CLASSES = (Settings, VDBCAGE_OT_pose, VDBCAGE_OT_set_rest)
PROPERTIES = ((bpy.types.Scene, "vdbcage_pose", bpy.props.PointerProperty(type=Settings)),)
