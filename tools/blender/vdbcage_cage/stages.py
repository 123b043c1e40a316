# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Show Stages: the volumes from which the cage of the selected objects is made."""

import hashlib
import os

import bpy
from mathutils import Matrix, Vector

from .command import CommandError
from .files import file_name
from .folders import folder, stored
from .make import MakingOperator

_names = ("solid", "dilated", "closed", "contour")
_folder = "vdbcage_folder"  # a custom property of the collection: where its volumes are
DIRECTORY = bpy.props.StringProperty(
    name="Folder", subtype="DIR_PATH",
    description="Where the volumes are kept. If this is empty, it is a folder beside the .blend")


def named_by_content(path):
    """Renames a file so that another content has another name; the name. From 4.2 on Blender reads a volume of a name
    once, whatever becomes of the file."""
    with open(path, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    stem, extension = os.path.splitext(path)
    named = f"{stem}_{digest[:8]}{extension}"
    os.replace(path, named)
    return named


def drawn_aside(thing, grid):
    """How far from its place in the file Blender draws a volume, in its own space; its grid is loaded. Voxel ijk is
    centred at ijk. Blender 3.4 and 4.3 draw it from ijk to ijk + 1; 5.2 centres it, and there the box that it gives for
    an object ends half a voxel beside a whole one."""
    corner = grid.matrix_object.inverted() @ Vector(thing.bound_box[0])
    is_centred = round(2 * corner.x) % 2 == 1
    return Vector([0 if is_centred else axis.length / 2 for axis in grid.matrix_object.to_3x3().col])


class VDBCAGE_OT_show_stages(MakingOperator, bpy.types.Operator):
    """Show the volumes from which the cage of the selected objects is made"""

    bl_idname = "vdbcage.show_stages"
    bl_label = "Show Stages"

    directory: DIRECTORY

    def take_settings(self, context):
        super().take_settings(context)
        if not self.properties.is_property_set("directory"):
            self.directory = context.scene.vdbcage_stages

    def prepare(self, context, job):
        words = self.prepare_cage(context, job)
        default = f"{file_name(self._models[0])}_stages"
        self._directory = folder(self.directory, default, "Volumes are files")
        return [words + ["--stages", self._directory]]

    def finish(self, context, job):
        first = self.models(context)[0]
        shown = self._shown(context)
        volumes = self._volumes(context, first)
        collection = shown or self._new_collection(context, first)
        for name, volume in volumes.items():
            thing = bpy.data.objects.new(f"{first.name} {name}", volume)
            collection.objects.link(thing)
            context.view_layer.update()
            moved = drawn_aside(thing, volume.grids[0])
            thing.matrix_world = first.matrix_world @ Matrix.Translation(-moved)
            volume.grids.unload()

    def _volumes(self, context, first):
        """The volumes by their stages, loaded. Raises CommandError."""
        volumes = {}
        for name in _names:
            path = named_by_content(os.path.join(self._directory, f"{name}.vdb"))
            volume = volumes[name] = bpy.data.volumes.new(f"{first.name} {name}")
            volume.filepath = stored(path)
            if not volume.grids.load():
                error = volume.grids.error_message
                bpy.data.batch_remove(volumes.values())
                raise CommandError(f"{path}: {error}")
        return volumes

    def _shown(self, context):
        """The collection of an earlier run that showed the same files, emptied of them; or None."""
        for collection in context.scene.collection.children_recursive:
            if collection.get(_folder) == self._directory:
                for thing in list(collection.objects):
                    if thing.type == "VOLUME":
                        bpy.data.volumes.remove(thing.data)
                return collection
        return None

    def _new_collection(self, context, first):
        collection = bpy.data.collections.new(f"{first.name} Stages")
        collection[_folder] = self._directory
        context.scene.collection.children.link(collection)
        return collection


CLASSES = (VDBCAGE_OT_show_stages,)
PROPERTIES = ((bpy.types.Scene, "vdbcage_stages", DIRECTORY),)
