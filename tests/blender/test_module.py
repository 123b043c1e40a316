"""The Python module in Blender, beside Debian's pyopenvdb and Blender's own OpenVDB."""

import os
import sys

import bpy
import numpy
from support import BISHOP, Case, load, positions

sys.path.insert(0, os.environ["VDBCAGE_MODULE"])
try:
    import pyopenvdb  # noqa: E402
except ModuleNotFoundError:
    import openvdb as pyopenvdb  # noqa: E402; its name since OpenVDB 12
import vdbcage  # noqa: E402


class Module(Case):
    def test_a_cage_of_a_mesh_of_blender(self):
        thing = load(BISHOP)
        mesh = thing.data
        mesh.calc_loop_triangles()
        triangles = numpy.empty(3 * len(mesh.loop_triangles), numpy.int32)
        mesh.loop_triangles.foreach_get("vertices", triangles)
        model = vdbcage.Mesh(positions(thing, world=False), triangles.reshape(-1, 3))
        cage = vdbcage.make_cage(model, faces=150)
        self.assertTrue(cage.check.bounding)

    def test_volumes_go_to_blender_and_to_pyopenvdb(self):
        solid = vdbcage.voxelize(vdbcage.Mesh.read(BISHOP), resolution=64)
        path = self.folder / "solid.vdb"
        vdbcage.write_vdb(solid, path)
        volume = bpy.data.volumes.new("solid")
        volume.filepath = str(path)
        self.assertTrue(volume.grids.load())
        self.assertEqual([grid.name for grid in volume.grids], ["density"])
        grid = pyopenvdb.read(str(path), "density")
        self.assertEqual(grid.activeVoxelCount(), len(solid.voxels()))
        array, corner = solid.dense()
        copy = pyopenvdb.BoolGrid()
        copy.copyFromArray(array, ijk=tuple(int(c) for c in corner))
        self.assertEqual(copy.activeVoxelCount(), len(solid.voxels()))
