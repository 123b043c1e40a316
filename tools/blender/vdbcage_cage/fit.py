# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Fit Cage: the points of a cage that somebody drew or edited move until it bounds its models."""

import json
import re

import bpy

from . import files, geometry, links
from .command import CommandError
from .make import joined_models, keep_report, still_there
from .running import CommandOperator, command, take


class Settings(bpy.types.PropertyGroup):
    """What the panel shows."""

    tight: bpy.props.FloatProperty(
        name="Tightness", default=0.5, min=0, max=1, subtype="FACTOR",
        description="0: only points move that have to, no farther than they have to. 1: the tightest. Between them the "
                    "cage gives up distance to stay as it was drawn")
    keep: bpy.props.StringProperty(
        name="Keep", description="A vertex group of the cage: points with a weight above 0 stay where they are")


class VDBCAGE_OT_fit_cage(CommandOperator, bpy.types.Operator):
    """Move the points of a drawn cage until it is certified to bound its models without the cage's own modifiers"""

    bl_idname = "vdbcage.fit_cage"
    bl_label = "Fit Cage"

    tight: Settings.__annotations__["tight"]
    keep: Settings.__annotations__["keep"]
    surface: links.SURFACE

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def take_settings(self, context):
        take(self, context.scene.vdbcage_fit, Settings.__annotations__)
        take(self, context.scene.vdbcage, ("surface",))

    def prepare(self, context, job):
        cage, models = _chosen(context)
        self._cage, self._models = cage.name, [model.name for model in models]
        # In the cage's own space, and of floats as Blender's: so the points that the command certifies come back as
        # they are. Messages have the names of the files.
        self._drawn, self._model = geometry.rest(cage), joined_models(context, models, self.surface, cage)
        cage_file = job.folder / "cage" / f"{files.file_name(cage.name)}.ply"
        model_file = job.folder / "models" / f"{files.file_name(models[0].name)}.ply"
        words = [command(context), "fit", cage_file, model_file, "-o", job.folder / "fitted.ply", "-v",
                 "--report", job.folder / "report.json", "--tight", f"{self.tight:.6g}"]
        if self.keep:
            points = geometry.points_of_group(cage, self.keep)
            (job.folder / "keep.txt").write_text("\n".join(map(str, points)))
            words += ["--keep", job.folder / "keep.txt"]
        for file in (cage_file, model_file):
            file.parent.mkdir()
        files.write_ply(cage_file, self._drawn, "float")
        files.write_ply(model_file, self._model)
        return [words]

    def finish(self, context, job):
        cage, *models = still_there(context, [self._cage, *self._models])
        geometry.require_object_mode(cage)
        if not (geometry.rest(cage).equals(self._drawn) and
                joined_models(context, models, self.surface, cage).equals(self._model)):
            raise CommandError(f"{', '.join([self._cage, *self._models])} changed while the command ran. Run it again")
        geometry.set_rest(cage, files.read_ply_points(job.folder / "fitted.ply"))
        report = keep_report(cage, job.folder / "report.json")
        fitted, cage_matrix = geometry.rest(cage), geometry.matrix(cage.matrix_world)
        for model in models:
            links.set_rest(model, cage, links.Rest(fitted, geometry.matrix(model.matrix_world), cage_matrix))
            model.vdbcage.surface = self.surface
            links.only(model, None)  # the cage bounds it unmoved
        self.report({"INFO"}, f"{cage.name}: {report['moved_points']} of {len(fitted.points)} points moved, certified "
                              f"to bound {', '.join(model.name for model in models)}")

    def failure(self, context, job, error):
        """Selects the faces that hold the cage back, if the command names any, and says so instead of their numbers:
        the command counts faces in another way than Blender. Options of the command that it names go, too."""
        report = job.folder / "report.json"
        if not report.exists():
            return error
        held = json.loads(report.read_text(encoding="utf-8"))["held_faces"]
        cage = context.scene.objects.get(self._cage)
        if not held or cage is None or cage.mode == "EDIT" or not geometry.rest(cage).equals(self._drawn):
            return error
        geometry.select_faces(cage, files.polygons_of_faces(self._drawn)[held])
        line = re.sub(r" \(faces? [^()]*\).*$", "", str(error))
        return CommandError(f"{line}. The faces that hold it back are selected: see them in Edit Mode")


def _chosen(context):
    """The cage that is selected, or that a selected model has, and all models that have it. Raises CommandError."""
    cages = {cage for _, cage in links.pairs(context)}
    if len(cages) > 1:
        names = ", ".join(sorted(cage.name for cage in cages))
        raise CommandError(f"Select one cage, or models of one: {names} are several")
    cage, = cages
    models = [thing for thing in context.scene.objects
              if thing.type == "MESH" and links.cage_of(context, thing) == cage]
    for thing in (cage, cage.data, *models):
        if thing.library is not None:
            raise CommandError(f"{thing.name} is linked from another file. Make it local first")
    if cage.data.users - cage.data.use_fake_user > 1:
        raise CommandError(f"{cage.name} shares its mesh with other objects, which would change too. Make it a single "
                           "user first")
    return cage, models


CLASSES = (Settings, VDBCAGE_OT_fit_cage)
PROPERTIES = ((bpy.types.Scene, "vdbcage_fit", bpy.props.PointerProperty(type=Settings)),)
