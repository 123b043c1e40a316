# blender --background --factory-startup --python stages.py -- STAGES_DIR SOLID_VOLUME STAGE...
# Opens every stage .vdb, finds its grid `density`, meshes it with Volume to Mesh and compares volume and place.
# Blender draws voxel ijk as the cell [ijk, ijk + 1] of the transform: half a voxel off OpenVDB's cell-centred place.
import json
import sys

import bmesh
import bpy

folder, facts = sys.argv[sys.argv.index("--") + 1:]
facts = json.load(open(facts))

failures = []


def check(ok, text):
    print(("ok: " if ok else "FAILED: ") + text)
    if not ok:
        failures.append(text)


for stage, expected in facts.items():
    bpy.ops.object.volume_import(filepath=f"{folder}/{stage}.vdb")
    volume = bpy.context.object
    volume.rotation_euler = (0, 0, 0)
    volume.data.grids.load()
    names = [grid.name for grid in volume.data.grids]
    check(names == ["density"], f"{stage}: grids {names}")

    mesh = bpy.data.meshes.new(stage)
    holder = bpy.data.objects.new(stage, mesh)
    bpy.context.collection.objects.link(holder)
    modifier = holder.modifiers.new("mesh", "VOLUME_TO_MESH")
    modifier.object = volume
    modifier.resolution_mode = "GRID"
    modifier.threshold = 0.5
    bpy.context.view_layer.update()
    made = holder.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    solid = bmesh.new()
    solid.from_mesh(made)
    found = abs(solid.calc_volume())
    low = [min(v.co[i] for v in solid.verts) for i in range(3)]
    high = [max(v.co[i] for v in solid.verts) for i in range(3)]
    if "volume" in expected:
        check(abs(found - expected["volume"]) <= 0.02 * expected["volume"],
              f"{stage}: volume {found:.6g}, of the voxels {expected['volume']:.6g}")
    reach = max(abs(a - b) for a, b in zip(low + high, expected["low"] + expected["high"]))
    check(reach <= expected["voxel"] * 1.001, f"{stage}: {reach / expected['voxel']:.3f} voxels off its place")
    solid.free()
    bpy.data.objects.remove(holder)
    bpy.data.objects.remove(volume)

sys.exit(1 if failures else 0)
