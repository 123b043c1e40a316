"""docs/user/blender.md, from its first line to its last."""

import os

import bpy
import numpy
from documented import Documented
from support import Case, positions, size
from test_stages import meshed


class Docs(Case):
    def test_every_step(self):
        here = os.getcwd()
        try:
            self._steps(Documented(self.folder))
        finally:
            os.chdir(here)
            bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)

    def _steps(self, docs):
        docs.run_until("obj_import")
        model = bpy.data.objects["creature"]
        rest = positions(model)
        docs.run_until("vdbcage.bind")
        cage = model.vdbcage.cage
        self.assertTrue(cage["vdbcage_report"]["check"]["bounding"])
        self.assertNear(positions(model), rest, 1e-5 * size(rest))
        docs.run_until("turn @ vertex.co")
        moved = numpy.abs(positions(model) - rest).max(axis=1) > 0.01 * size(rest)
        self.assertTrue(0.1 < moved.mean() < 0.9, moved.mean())
        docs.run_until("SHAPE_KEY")
        self.assertFalse(model.modifiers[0].show_viewport)
        self.assertEqual(len(model.data.shape_keys.key_blocks), 2)
        again = numpy.abs(positions(model) - rest).max(axis=1) > 0.01 * size(rest)
        self.assertGreater((again == moved).mean(), 0.95)
        docs.run_until("POINT_CACHE")
        self.assertTrue((self.folder / "vdbcage_cache" / "creature.pc2").exists())
        docs.run_until("show_stages")
        self.assertEqual(len(bpy.data.collections["creature Stages"].objects), 4)
        docs.run_until("fit_cage")
        self.assertEqual(cage["vdbcage_report"]["kind"], "fit")
        self.assertFalse(cage["vdbcage_report"]["before"]["bounding"])

        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        docs.run_until("meshdeform_bind")
        model, cage = bpy.data.objects["creature"], bpy.data.objects["cage"]
        self.assertNear(positions(model), rest, 1e-5 * size(rest))
        docs.run_until("posed_creature.obj\")")
        by_hand = positions(bpy.context.object)
        self.assertGreater(numpy.abs(by_hand - rest).max(), 9)
        # Blender's own binding and Green coordinates agree on the whole.
        self.assertLess(numpy.abs(by_hand - positions(model)).mean(), 0.02 * size(rest))

        docs.run_until("volume.location")
        self.assertEqual(len(docs), 0)
        surface, _ = meshed(bpy.context.object)
        voxel = bpy.context.object.data.grids[0].matrix_object[0][0]
        wider = [rest.min(axis=0) - 0.5 * voxel, rest.max(axis=0) + 0.5 * voxel]
        self.assertNear([surface.min(axis=0), surface.max(axis=0)], wider, 0.5 * voxel)
