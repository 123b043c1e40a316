"""Show Stages, and the volumes of --stages."""

import bmesh
import bpy
import numpy
try:
    import pyopenvdb
except ModuleNotFoundError:
    import openvdb as pyopenvdb  # its name since OpenVDB 12
from support import BISHOP, Case, load, positions, select

STAGES = ("solid", "dilated", "closed", "contour")


def meshed(volume):
    """The points of a volume's surface in the world, and what is inside it in its own space."""
    bpy.context.view_layer.update()
    mesh = bpy.data.meshes.new("surface")
    holder = bpy.data.objects.new("surface", mesh)
    bpy.context.scene.collection.objects.link(holder)
    holder.matrix_world = volume.matrix_world
    modifier = holder.modifiers.new("mesh", "VOLUME_TO_MESH")
    modifier.object = volume
    modifier.resolution_mode = "GRID"
    modifier.threshold = 0.5
    points = positions(holder)
    surface = bmesh.new()
    surface.from_mesh(holder.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)
    inside = abs(surface.calc_volume())
    surface.free()
    bpy.data.objects.remove(holder)
    return points, inside


def voxels(path):
    """Of the voxels of a file: their number, the length of one, and the box that they fill, (2, 3)."""
    grid = pyopenvdb.read(str(path), "density")
    low, high = grid.evalActiveVoxelBoundingBox()
    corners = [numpy.subtract(low, 0.5), numpy.add(high, 0.5)]
    box = [grid.transform.indexToWorld(tuple(map(float, corner))) for corner in corners]
    return grid.activeVoxelCount(), grid.transform.voxelSize()[0], numpy.array(box)


class Stages(Case):
    def shown(self, model, **options):
        """Shows the stages; the objects by their stages."""
        bpy.ops.vdbcage.show_stages(directory=str(self.folder / "stages"), resolution=64, use_resolution=True,
                                   effort="fast", **options)
        collection = bpy.data.collections[f"{model.name} Stages"]
        self.assertEqual([thing.name for thing in collection.objects],
                         [f"{model.name} {stage}" for stage in STAGES])
        return {stage: bpy.data.objects[f"{model.name} {stage}"] for stage in STAGES}

    def test_every_stage_lies_on_the_model(self):
        for moved in (False, True):
            model = load(BISHOP)
            if moved:
                model.scale, model.rotation_euler, model.location = (2, 2, 2), (0.3, 1, -2), (5, 1, -2)
                bpy.context.view_layer.update()
            volumes = self.shown(model)
            for stage, volume in volumes.items():
                count, voxel, box = voxels(bpy.path.abspath(volume.data.filepath))
                surface, inside = meshed(volume)
                if stage != "contour":  # a shell of one voxel is thinner where it is slanted
                    self.assertAlmostEqual(inside / (count * voxel**3), 1, delta=0.02)
                inverse = numpy.linalg.inv(numpy.array(model.matrix_world))
                own = surface @ inverse[:3, :3].T + inverse[:3, 3]
                rest = positions(model, world=False)
                self.assertNear([own.min(axis=0), own.max(axis=0)], box, 0.02 * voxel)
                if stage != "dilated":  # the box of the voxels that the model meets is at most one wider than its own
                    wider = [rest.min(axis=0) - 0.5 * voxel, rest.max(axis=0) + 0.5 * voxel]
                    self.assertNear([own.min(axis=0), own.max(axis=0)], wider, 0.5 * voxel)
            for collection in list(bpy.data.collections):
                bpy.data.collections.remove(collection)

    def test_a_second_run_takes_the_place_of_the_first(self):
        model = load(BISHOP)
        coarse, _ = meshed(self.shown(model, use_close_radius=True, close_radius=0)["closed"])
        select(model)
        fine, _ = meshed(self.shown(model, use_close_radius=True, close_radius=0.1)["closed"])
        self.assertEqual(len(bpy.data.volumes), 4)
        self.assertNotEqual(len(coarse), len(fine))

    def test_wrong_input_adds_nothing(self):
        stages = bpy.ops.vdbcage.show_stages
        self.fails("Select the meshes", stages)
        load(BISHOP)
        self.fails("Volumes are files beside the .blend. Save it first, or choose a folder", stages)
        (self.folder / "file").write_text("")
        self.fails("file", stages, directory=str(self.folder / "file"))
