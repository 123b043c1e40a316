"""Make Cage."""

import math
import os
import unittest.mock

import bpy
import numpy
from support import BISHOP, COMMAND, CREATURE, Case, command, load, part, positions, preferences, select, write_obj

files = part("files")


class Make(Case):
    def test_the_cage_is_the_certified_one_of_the_command(self):
        model = load(CREATURE)
        selected = list(bpy.context.selected_objects)
        bpy.ops.vdbcage.make_cage(faces=300, mesh="triquad")
        cage = model.vdbcage.cage
        self.assertEqual(cage.name, "creature Cage")
        self.assertEqual((cage.display_type, cage.hide_render), ("WIRE", True))
        self.assertEqual(cage.matrix_world, model.matrix_world)
        self.assertEqual(cage.users_collection, model.users_collection)
        self.assertEqual(bpy.context.selected_objects, selected)
        self.assertLessEqual(len(cage.data.polygons), 300)
        self.assertTrue(cage["vdbcage_report"]["check"]["bounding"])
        self.assertEqual(cage["vdbcage_report"]["options"]["faces"], 300)
        self.certified(cage, model)

        command("make", write_obj(self.folder / "model.obj", model, model), "-o", self.folder / "cage.obj", "--faces",
                300, "--mesh", "triquad", "-q")
        lines = (self.folder / "cage.obj").read_text().splitlines()
        expected = [line.split()[1:] for line in lines if line.startswith("v ")]
        self.assertNear(positions(cage, world=False), numpy.array(expected, float), 1e-5)
        self.assertEqual(os.listdir(bpy.app.tempdir), [])

    def test_every_kind_of_mesh(self):
        model = load(BISHOP)
        for kind in ("triangles", "triquad", "quads", "loops"):
            bpy.ops.vdbcage.make_cage(faces=60, mesh=kind, effort="fast")
            cage = model.vdbcage.cage
            self.assertEqual(cage["vdbcage_report"]["options"]["mesh"], kind)
            self.certified(cage, model)

    def test_objects_that_are_turned_scaled_mirrored_and_have_a_parent(self):
        parent = bpy.data.objects.new("parent", None)
        bpy.context.scene.collection.objects.link(parent)
        parent.location = (5, -3, 2)
        for scale in ((2, 0.5, 1), (-1, 1, 3)):
            model = load(BISHOP)
            model.parent = parent
            model.rotation_euler = (0.3, 1, -2)
            model.scale = scale
            bpy.context.view_layer.update()
            bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
            cage = model.vdbcage.cage
            self.assertEqual(cage.parent, parent)
            self.assertNear(cage.matrix_world, model.matrix_world, 1e-5)
            self.certified(cage, model)

    def test_several_objects_get_one_cage_in_common(self):
        body, clothes, other = load(BISHOP), load(BISHOP), load(BISHOP)
        clothes.location = (0.4, 0, 0)
        clothes.scale = (-1.2, 1, 0.9)
        bpy.context.view_layer.update()
        select(body, clothes)
        bpy.ops.vdbcage.make_cage(faces=300, effort="fast")
        cage = body.vdbcage.cage
        self.assertEqual(clothes.vdbcage.cage, cage)
        self.assertIsNone(other.vdbcage.cage)
        self.assertEqual(cage.matrix_world, body.matrix_world)
        self.certified(cage, body, clothes)

    def test_faces_stay_outward_where_a_matrix_mirrors(self):
        mesh = files.Polygons(numpy.eye(4)[:, :3] + 1, numpy.array([3, 4]), numpy.array([0, 1, 2, 0, 3, 2, 1]))
        self.assertEqual(mesh.moved(numpy.diag([2, 1, -1, 1])).faces(), [[2, 1, 0], [1, 2, 3, 0]])
        self.assertEqual(mesh.moved(numpy.diag([2, -1, -1, 1])).faces(), mesh.faces())

    def test_a_cage_bounds_the_model_with_its_modifiers_or_without(self):
        model = load(BISHOP)
        modifier = model.modifiers.new("array", "ARRAY")
        modifier.count = 2
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        self.certified(model.vdbcage.cage, model)
        both = numpy.ptp(positions(model.vdbcage.cage), axis=0)[0]
        bpy.ops.vdbcage.make_cage(faces=200, surface="REST", effort="fast")
        self.assertEqual(model.vdbcage.surface, "REST")
        self.assertTrue(modifier.show_viewport)
        cage = model.vdbcage.cage
        modifier.show_viewport = False
        self.certified(cage, model)
        self.assertLess(numpy.ptp(positions(cage), axis=0)[0], 0.7 * both)

    def test_a_model_that_its_cage_moves_gets_the_next_cage_around_its_shape_at_rest(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
        rest = positions(model.vdbcage.cage)
        bpy.ops.vdbcage.bind()
        first = model.vdbcage.cage
        for vertex in first.data.vertices:
            vertex.co *= 2
        bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
        self.assertNotEqual(model.vdbcage.cage, first)
        self.assertNear(positions(model.vdbcage.cage), rest, 1e-6)

    def test_wrong_input_adds_nothing(self):
        make = bpy.ops.vdbcage.make_cage
        self.fails("Select the meshes that the cage is to bound", make)
        model = load(BISHOP)
        self.fails("there is no option '--fcaes'", make, more="--fcaes 3")
        self.fails("No closing quotation", make, more="'")
        self.fails("close radius", make, more="--erode-radius 0.2")
        bpy.data.libraries.write(str(self.folder / "library.blend"), {model})
        with bpy.data.libraries.load(str(self.folder / "library.blend"), link=True) as (there, here):
            here.objects = there.objects
        linked = here.objects[0]
        bpy.context.scene.collection.objects.link(linked)
        select(linked)
        self.fails("bishop is linked from another file. Make it local first", make)
        bpy.data.libraries.remove(linked.library)
        select(model)
        model.scale = (1, 0, 1)
        bpy.context.view_layer.update()
        self.fails("bishop is flat: its scale is 0 along an axis", make)
        points = bpy.data.objects.new("points", bpy.data.meshes.new("points"))
        points.data.from_pydata([(0, 0, 0), (1, 0, 0)], [], [])
        bpy.context.scene.collection.objects.link(points)
        select(points)
        self.fails("points has no faces", make)
        points.data.clear_geometry()
        points.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, math.nan, 0)], [], [(0, 1, 2)])
        self.fails("points has a point that is not finite", make)

    def test_the_command_is_that_of_the_preferences_or_of_path(self):
        load(BISHOP)
        make, own = bpy.ops.vdbcage.make_cage, preferences()
        own.command = "/no/such/program"
        self.fails("/no/such/program is not a program", make)
        own.command = str(BISHOP)
        self.fails("is not a program", make)
        own.command = ""
        with unittest.mock.patch.dict(os.environ, PATH=str(self.folder)):
            self.fails("There is no command vdbcage in PATH", make)
            os.symlink(COMMAND, self.folder / "vdbcage")
            self.assertEqual(make(faces=100), {"FINISHED"})

    def test_a_command_in_the_add_on_is_taken_before_path_and_after_the_preferences(self):
        found = part("command").found
        own, program = self.folder / "bin" / "vdbcage", self.folder / "lib" / "vdbcage" / "vdbcage"
        for file in (own, program):
            file.parent.mkdir(parents=True)
            file.touch(mode=0o644)  # so Blender unpacks them
        self.assertEqual(found(COMMAND, own), COMMAND)
        self.assertEqual(found("", own), str(own))
        for file in (own, program):
            self.assertTrue(os.access(file, os.X_OK), file)
