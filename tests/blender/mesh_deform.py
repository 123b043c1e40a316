# blender --background --factory-startup --python mesh_deform.py -- MODEL.obj CAGE.obj
# Binds the Mesh Deform modifier to the model with the cage, moves the cage and looks whether all of the model follows.
import sys

import bpy
from mathutils import Vector


def load(path):
    bpy.ops.wm.obj_import(filepath=path)
    return bpy.context.object


def positions(thing):
    bpy.context.view_layer.update()
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [thing.matrix_world @ vertex.co for vertex in evaluated.data.vertices]


model, cage = [load(path) for path in sys.argv[sys.argv.index("--") + 1:]]
rest = positions(model)
size = max(max(p[i] for p in rest) - min(p[i] for p in rest) for i in range(3))

modifier = model.modifiers.new("cage", "MESH_DEFORM")
modifier.object = cage
bpy.context.view_layer.objects.active = model
bpy.ops.object.meshdeform_bind(modifier=modifier.name)
print("is_bound:", modifier.is_bound)

move = Vector((0.3, -0.2, 0.5)) * size
to_cage = cage.matrix_world.to_3x3().inverted()
for vertex in cage.data.vertices:
    vertex.co += to_cage @ move
off = max((now - before - move).length for now, before in zip(positions(model), rest)) / size
print(f"vertices off their place by at most {off:.3g} of the model's size")
sys.exit(0 if modifier.is_bound and off <= 1e-3 else 1)
