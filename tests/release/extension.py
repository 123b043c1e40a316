"""Called by user.sh in Blender, with no preference set: makes a cage. Blender 3 installs the add-on first."""

import sys

import addon_utils
import bpy

if bpy.app.version < (4, 2, 0):
    bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
    addon_utils.enable("vdbcage_cage")
cube = bpy.data.objects["Cube"]
cube.select_set(True)
bpy.context.view_layer.objects.active = cube
print(bpy.ops.vdbcage.make_cage(faces=100))
cage = cube.vdbcage.cage
print(cage.name, len(cage.data.polygons), cage["vdbcage_report"]["check"]["bounding"])
assert cage["vdbcage_report"]["check"]["bounding"]
