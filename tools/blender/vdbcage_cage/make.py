# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Make Cage: a cage around the selected objects."""

import json
import shlex

import bpy
import numpy

from . import files, geometry, links
from .command import CommandError
from .running import CommandOperator, command, take

_automatic = "Off: vdbcage chooses it"


class Options:
    """The options of `vdbcage make`, for the panel and for operators."""

    faces: bpy.props.IntProperty(name="Faces", default=400, min=4, max=1000000, soft_max=5000,
                                 description="Faces of the cage, at most")
    mesh: bpy.props.EnumProperty(
        name="Mesh", default="triangles",
        items=(("triangles", "Triangles", "The tightest"),
               ("triquad", "Mixed", "Triangles and quads; more than half are quads"),
               ("quads", "Quads", "Nine of ten faces are quads"),
               ("loops", "Loops", "Quads only, in rings around limbs, as drawn by hand. Looser, and slower to make")))
    effort: bpy.props.EnumProperty(
        name="Effort", default="fair",
        items=(("fast", "Fast", "A second or less"), ("fair", "Fair", "A few seconds"),
               ("best", "Best", "The tightest")))
    symmetry: bpy.props.EnumProperty(
        name="Symmetry", default="off",
        items=(("off", "Off", "No symmetry"), ("auto", "Automatic", "If the model is symmetric"),
               ("x", "X", "Across the plane of x, in the object's space"),
               ("y", "Y", "Across the plane of y, in the object's space"),
               ("z", "Z", "Across the plane of z, in the object's space")))
    smooth: bpy.props.IntProperty(name="Smooth", default=0, min=0, max=100,
                                  description="Rounds the cage off; 0 is the tightest")
    use_resolution: bpy.props.BoolProperty(name="Resolution", description=_automatic)
    resolution: bpy.props.IntProperty(name="Resolution", default=64, min=8, max=2048,
                                      description="Voxels along the longest side")
    use_close_radius: bpy.props.BoolProperty(name="Close Radius", description=_automatic)
    close_radius: bpy.props.FloatProperty(name="Close Radius", default=0.03, min=0, max=0.25, step=1, precision=3,
                                          description="Gaps up to twice it are bridged; a part of the longest side")
    more: bpy.props.StringProperty(name="More", description="Other options of vdbcage make, as --parts merge")
    surface: links.SURFACE


class Settings(Options, bpy.types.PropertyGroup):
    """What the panel shows."""


def option_words(options):
    """The options as words of the command. Raises CommandError."""
    words = ["--faces", str(options.faces), "--mesh", options.mesh, "--effort", options.effort,
             "--symmetry", options.symmetry, "--smooth", str(options.smooth)]
    if options.use_resolution:
        words += ["--resolution", str(options.resolution)]
    if options.use_close_radius:
        words += ["--close-radius", f"{options.close_radius:.6g}"]
    try:
        return words + shlex.split(options.more)
    except ValueError as error:
        raise CommandError(f"More: {error}") from None


def selected_models(context):
    """The selected meshes that are no cages; the active one first, if it is one of them. Raises CommandError."""
    cages = {links.cage_of(context, thing) for thing in context.scene.objects}
    models = [thing for thing in context.selected_objects
              if thing.type == "MESH" and not thing.vdbcage.is_cage and thing not in cages]
    if not models:
        raise CommandError("Select the meshes that the cage is to bound")
    for model in models:
        if model.library is not None:
            raise CommandError(f"{model.name} is linked from another file. Make it local first")
    return sorted(models, key=lambda thing: thing != context.object)


def joined_models(context, models, surface, space):
    """The models as one mesh, in the space of an object. Raises CommandError."""
    world = geometry.inverse(space.name, space.matrix_world)
    meshes = []
    for model in models:
        if surface == "REST":
            mesh = geometry.rest(model)
        else:
            mesh = links.unmoved(context, model)
        if len(mesh.counts) == 0:
            raise CommandError(f"{model.name} has no faces")
        if not numpy.isfinite(mesh.points).all():
            raise CommandError(f"{model.name} has a point that is not finite")
        if model != space:
            geometry.inverse(model.name, model.matrix_world)
            mesh = mesh.moved(world @ geometry.matrix(model.matrix_world))
        meshes.append(mesh)
    return files.joined(meshes)


def keep_report(cage, path):
    """Makes a report of the command a custom property of the cage; the report."""
    report = json.loads(path.read_text(encoding="utf-8"))
    cage["vdbcage_report"] = _property(report)
    return report


def still_there(context, names):
    """The objects of these names. Raises CommandError if one was deleted."""
    for name in names:
        if name not in context.scene.objects:
            raise CommandError(f"{name} was deleted meanwhile")
    return [context.scene.objects[name] for name in names]


class MakingOperator(Options, CommandOperator):
    """Base of operators that run `vdbcage make` on the selected models."""

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def take_settings(self, context):
        take(self, context.scene.vdbcage, Options.__annotations__)

    def prepare_cage(self, context, job):
        """Writes the models; the words of the command, which writes cage.ply."""
        models = selected_models(context)
        self._models = [model.name for model in models]
        file = job.folder / "models" / f"{files.file_name(models[0].name)}.ply"  # messages have this name
        words = [command(context), "make", file, "-o", job.folder / "cage.ply", "-v",
                 "--precision", "float32",  # Blender holds no other
                 *option_words(self)]
        file.parent.mkdir()
        self._written = joined_models(context, models, self.surface, models[0])
        files.write_ply(file, self._written)
        return words

    def models(self, context):
        """The models, after the command has ended. Raises CommandError if they are not what they were."""
        models = still_there(context, self._models)
        if not joined_models(context, models, self.surface, models[0]).equals(self._written):
            raise CommandError(f"{', '.join(self._models)} changed while the command ran. Run it again")
        return models


class VDBCAGE_OT_make_cage(MakingOperator, bpy.types.Operator):
    """Make a cage around the selected objects. It is certified to bound them"""

    bl_idname = "vdbcage.make_cage"
    bl_label = "Make Cage"

    def prepare(self, context, job):
        return [self.prepare_cage(context, job) + ["--report", job.folder / "report.json"]]

    def finish(self, context, job):
        models = self.models(context)
        polygons = files.read_ply(job.folder / "cage.ply")
        first = models[0]
        name = f"{first.name} Cage"
        cage = bpy.data.objects.new(name, geometry.new_mesh(name, polygons))
        report = keep_report(cage, job.folder / "report.json")
        cage.display_type = "WIRE"
        cage.hide_render = True
        own = [collection for collection in first.users_collection
               if collection.library is None and collection.override_library is None]
        for collection in own or [context.scene.collection]:
            collection.objects.link(cage)
        cage.parent, cage.parent_type, cage.parent_bone = first.parent, first.parent_type, first.parent_bone
        cage.matrix_parent_inverse = first.matrix_parent_inverse
        cage.rotation_mode = first.rotation_mode
        cage.matrix_world = first.matrix_world
        for model in models:
            links.set_rest(model, cage, links.seen_rest(context, model, cage))
            model.vdbcage.surface = self.surface
            links.only(model, None)  # the cage bounds it unmoved
        check = report["check"]
        faces = check["triangles"] + check["quads"]
        certified = "certified to bound" if check["bounding"] else "NOT certified to bound"
        self.report({"INFO"}, f"{cage.name}: {faces} faces, {certified} {', '.join(model.name for model in models)}")


def _property(value):
    """A value of JSON as a custom property can hold it: without null, and without what exceeds 32 bits."""
    if isinstance(value, dict):
        return {key: _property(part) for key, part in value.items() if part is not None}
    if isinstance(value, list):
        return [_property(part) for part in value]
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) >= 2**31:
        return float(value)
    return value


CLASSES = (Settings, VDBCAGE_OT_make_cage)
PROPERTIES = ((bpy.types.Scene, "vdbcage", bpy.props.PointerProperty(type=Settings)),)
