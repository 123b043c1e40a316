"""What the tests have in common."""

import importlib
import os
import pathlib
import subprocess
import tempfile
import unittest

import addon_utils
import bpy
import numpy

SOURCE = pathlib.Path(os.environ["VDBCAGE_SOURCE"])
COMMAND = os.environ["VDBCAGE_COMMAND"]
ADDON = os.environ["VDBCAGE_ADDON"]
CREATURE = SOURCE / "data" / "creature.obj"
BISHOP = SOURCE / "data" / "bishop.obj"


# The zip is installed as users do it, into the folders that BLENDER_USER_EXTENSIONS and BLENDER_USER_SCRIPTS name.
IS_EXTENSION = bpy.app.version >= (4, 2, 0)
MODULE = "bl_ext.user_default.vdbcage_cage" if IS_EXTENSION else "vdbcage_cage"
if not addon_utils.check(MODULE)[1]:
    if IS_EXTENSION:
        bpy.ops.extensions.package_install_files(filepath=ADDON, repo="user_default", overwrite=True)
    else:
        bpy.ops.preferences.addon_install(filepath=ADDON, overwrite=True)
    bpy.ops.preferences.addon_enable(module=MODULE)


def part(name):
    """A module of the add-on."""
    return importlib.import_module(f"{MODULE}.{name}")


def preferences():
    """The add-on's own."""
    return bpy.context.preferences.addons[MODULE].preferences


def command(*words, status=0):
    """Runs the command vdbcage, which is to end with this status; what it printed."""
    done = subprocess.run([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != status:
        raise AssertionError(f"status {done.returncode}: {words}: {done.stderr}")
    return done.stdout + done.stderr


def load(path):
    """Imports an OBJ as Blender does by itself, with its quarter turn about X."""
    bpy.ops.wm.obj_import(filepath=str(path))
    return bpy.context.object


def select(*things):
    """Selects these and nothing else; the first is active."""
    for thing in bpy.context.scene.objects:
        thing.select_set(thing in things)
    bpy.context.view_layer.objects.active = things[0] if things else None


def positions(thing, world=True):
    """The points of an object as it is seen, (n, 3)."""
    bpy.context.view_layer.update()
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    array = numpy.empty(3 * len(shown.data.vertices), numpy.float32)
    shown.data.vertices.foreach_get("co", array)
    points = array.reshape(-1, 3).astype(float)
    if not world:
        return points
    matrix = numpy.array(thing.matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def set_positions(thing, points):
    """Moves the points of an object's mesh, in its own space."""
    thing.data.vertices.foreach_set("co", numpy.asarray(points, numpy.float32).ravel())
    thing.data.update()


def write_obj(path, thing, space=None):
    """Writes an object as it is seen as OBJ, in the world, or in the space of another object. The tests' own writer."""
    points = positions(thing, world=thing != space)
    if space not in (None, thing):
        matrix = numpy.linalg.inv(numpy.array(space.matrix_world))
        points = points @ matrix[:3, :3].T + matrix[:3, 3]
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    with open(path, "w") as file:
        for point in points:
            file.write("v {!r} {!r} {!r}\n".format(*map(float, point)))
        for polygon in mesh.polygons:
            file.write("f " + " ".join(str(corner + 1) for corner in polygon.vertices) + "\n")
    return path


def size(points):
    """The longest side of the points' box."""
    return numpy.ptp(points, axis=0).max()


class Case(unittest.TestCase):
    """An empty scene, the add-on, and a folder."""

    def setUp(self):
        preferences().command = COMMAND
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.volumes, bpy.data.collections):
            bpy.data.batch_remove(list(kind))
        bpy.context.scene.frame_set(1)

    def fails(self, text, operator, **options):
        """The operator reports an error with this text, and changes nothing; no file is left."""
        def state():
            kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.volumes)
            data = [sorted(part.name for part in kind) for kind in kinds]
            modifiers = [(thing.name, [m.name for m in thing.modifiers]) for thing in bpy.data.objects]
            keys = [(mesh.name, mesh.shape_keys is None) for mesh in bpy.data.meshes]
            return data, modifiers, keys, sorted(name for name in os.listdir(bpy.app.tempdir)
                                                   if not name.startswith("vdbcage_weights_"))

        before = state()
        with self.assertRaises(RuntimeError) as caught:
            operator(**options)
        self.assertIn(text, str(caught.exception))
        self.assertEqual(state(), before)

    def certified(self, cage, *models, status=0):
        """The command says that the cage bounds these models, in the cage's space; with status 2 that it does not."""
        path = write_obj(self.folder / "checked_cage.obj", cage, cage)
        for i, model in enumerate(models):
            command("check", path, write_obj(self.folder / f"checked_{i}.obj", model, cage), status=status)

    def assertNear(self, a, b, tolerance):
        self.assertEqual(numpy.shape(a), numpy.shape(b))
        self.assertLessEqual(numpy.abs(numpy.subtract(a, b)).max(), tolerance)
