"""Pose and Set Rest."""

import os
import struct

import bpy
import numpy
from support import BISHOP, Case, command, load, positions, select, set_positions, size, write_obj


def bent(points):
    """A pose: turned about x, more the further a point is along z."""
    low, high = points[:, 2].min(), points[:, 2].max()
    angle = 0.8 * (points[:, 2] - low) / (high - low)
    sine, cosine = numpy.sin(angle), numpy.cos(angle)
    y, z = points[:, 1] - points[:, 1].mean(), points[:, 2] - low
    return numpy.stack([points[:, 0], y * cosine - z * sine, y * sine + z * cosine], axis=1)


def key(model):
    """The points of the shape key that holds the pose."""
    return numpy.array([point.co for point in model.data.shape_keys.key_blocks[-1].data])


def curves(action):
    """The curves of an action; from Blender 5.0 on they are in its layers."""
    if hasattr(action, "fcurves"):
        return action.fcurves
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]


class Pose(Case):
    def by_hand(self, family, cage, model, rest, posed):
        """The points that the command's deform gives, in the world: `rest` and `posed` are points of the cage."""
        set_positions(cage, rest)
        write_obj(self.folder / "cage.obj", cage)
        set_positions(cage, posed)
        write_obj(self.folder / "posed.obj", cage)
        command("deform", self.folder / "cage.obj", self.folder / "posed.obj", write_obj(self.folder / "m.obj", model),
                "-o", self.folder / "result.obj", "--coordinates", family)
        lines = (self.folder / "result.obj").read_text().splitlines()
        return numpy.array([line.split()[1:] for line in lines if line.startswith("v ")], float)

    def test_a_shape_key_is_what_the_command_gives_in_the_world(self):
        """In the world: where a scale differs from axis to axis, Green coordinates keep the shapes that are seen."""
        model = load(BISHOP)
        model.scale = (1, 2, 0.7)
        model.rotation_euler = (1, 0.2, 3)
        model.location = (3, 1, 2)
        bpy.context.view_layer.update()
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        cage = model.vdbcage.cage
        rest = positions(cage, world=False)
        families = bpy.ops.vdbcage.pose.get_rna_type().properties["coordinates"].enum_items.keys()
        self.assertIn("green", families)
        for family in families:
            if model.data.shape_keys:
                model.data.shape_keys.key_blocks[-1].value = 0
            expected = self.by_hand(family, cage, model, rest, bent(rest))
            bpy.ops.vdbcage.pose(coordinates=family)
            self.assertEqual([block.name for block in model.data.shape_keys.key_blocks],
                             ["Basis", "Posed by bishop Cage"])
            self.assertNear(positions(model), expected, 2e-6 * size(expected))

    def test_where_objects_go_after_they_were_at_rest_is_of_no_matter(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        rest = positions(cage, world=False)
        set_positions(cage, bent(rest))
        bpy.ops.vdbcage.pose()
        posed = key(model)
        model.location, cage.location, cage.scale = (1, 2, 3), (5, 5, 5), (2, 2, 2)
        bpy.ops.vdbcage.pose()
        self.assertNear(key(model), posed, 1e-7)

    def test_the_pose_is_taken_in_edit_mode_too(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        rest = positions(cage, world=False)
        select(cage)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.translate(value=(0, 0, 1))
        bpy.ops.vdbcage.pose(coordinates="mvc")
        bpy.ops.object.mode_set(mode="OBJECT")
        move = positions(cage, world=False) - rest
        self.assertGreater(numpy.abs(move).max(), 0.9)
        self.assertNear(key(model), positions_at_rest(model) + move[0], 2e-6 * size(rest))

    def test_an_animation_becomes_a_point_cache(self):
        model = load(BISHOP)
        model.modifiers.new("subdivided", "SUBSURF").levels = 1
        model.rotation_euler = (1, 0.2, 3)
        bpy.context.view_layer.update()
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        cage = model.vdbcage.cage
        rest, at_rest = positions(cage, world=False), positions(model)
        cage.shape_key_add(name="Basis")
        pose = cage.shape_key_add(name="bent")
        pose.data.foreach_set("co", bent(rest).astype(numpy.float32).ravel())
        pose.value = 0
        pose.keyframe_insert("value", frame=3)
        pose.value = 1
        pose.keyframe_insert("value", frame=6)
        for curve in curves(cage.data.shape_keys.animation_data.action):
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
        scene = bpy.context.scene
        scene.frame_set(5)
        bpy.ops.vdbcage.pose(coordinates="green", target="POINT_CACHE", frame_start=3, frame_end=6,
                             directory=str(self.folder))
        self.assertEqual(scene.frame_current, 5)
        self.assertEqual([modifier.type for modifier in model.modifiers], ["SUBSURF", "MESH_CACHE"])
        header = (self.folder / "bishop.pc2").read_bytes()[:32]
        self.assertEqual(struct.unpack("<12siiffi", header), (b"POINTCACHE2\0", 1, len(at_rest), 3, 1, 4))
        self.assertEqual(os.listdir(self.folder), ["bishop.pc2"])

        seen = {}
        for frame in (1, 3, 4, 6, 8):
            scene.frame_set(frame)
            seen[frame] = positions(model)
        self.assertNear(seen[3], at_rest, 1e-5 * size(at_rest))
        self.assertNear(seen[1], seen[3], 0)
        self.assertNear(seen[8], seen[6], 0)
        modifier = model.modifiers[-1]
        modifier.show_viewport = False
        cage.shape_key_clear()
        for frame, part in ((4, 1 / 3), (6, 1)):
            expected = self.by_hand("green", cage, model, rest, rest + part * (bent(rest) - rest))
            self.assertNear(seen[frame], expected, 1e-5 * size(expected))

    def test_two_models_of_one_cage(self):
        body, clothes = load(BISHOP), load(BISHOP)
        body.name, clothes.name = "Körper/a", "Körper:a"  # both are files for a while
        clothes.location = (0.4, 0, 0)
        bpy.context.view_layer.update()
        select(body, clothes)
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        cage = body.vdbcage.cage
        shape = positions(cage, world=False)
        set_positions(cage, shape + [0, 2, 0])
        select(cage)
        bpy.ops.vdbcage.pose(coordinates="mvc")
        for model in (body, clothes):
            self.assertNear(key(model), positions_at_rest(model) + [0, 2, 0], 2e-6 * size(shape))

    def test_what_is_bound_and_what_is_posed_take_turns(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        bpy.ops.vdbcage.bind()
        shape = positions(cage, world=False)
        rest = positions(model, world=False)
        set_positions(cage, shape + [0, 2, 0])
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(positions(model, world=False), rest + [0, 2, 0], 1e-5 * size(shape))
        set_positions(cage, shape + [0, 3, 0])
        bpy.ops.vdbcage.pose(coordinates="mvc", target="POINT_CACHE", frame_start=1, frame_end=1,
                             directory=str(self.folder))
        self.assertNear(positions(model, world=False), rest + [0, 3, 0], 1e-5 * size(shape))
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(positions(model, world=False), rest + [0, 3, 0], 1e-5 * size(shape))
        set_positions(cage, shape)
        bpy.ops.vdbcage.bind()
        self.assertNear(positions(model, world=False), rest, 1e-5 * size(shape))
        set_positions(cage, shape + [0, 2, 0])
        self.assertNear(positions(model, world=False), rest + [0, 2, 0], 1e-5 * size(shape))

    def test_names_are_of_no_matter(self):
        """A cage that is renamed, a copy, and a name that Blender makes shorter: the pose stays one."""
        model = load(BISHOP)
        model.name = "\u043c" * 28
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        shape, rest = positions(cage, world=False), positions(model, world=False)
        set_positions(cage, shape + [0, 1, 0])
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(positions(model, world=False), rest + [0, 1, 0], 1e-5 * size(shape))
        cage.name = "renamed"
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertEqual(len(model.data.shape_keys.key_blocks), 2)
        self.assertNear(positions(model, world=False), rest + [0, 1, 0], 1e-5 * size(shape))
        select(model, cage)
        bpy.ops.object.duplicate()
        copy = next(thing for thing in bpy.context.selected_objects if thing.vdbcage.cage is not None)
        self.assertNotIn(copy.vdbcage.cage, (None, cage))
        select(copy)
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertEqual(len(copy.data.shape_keys.key_blocks), 2)
        self.assertNear(positions(copy, world=False), rest + [0, 1, 0], 1e-5 * size(shape))

    def test_each_model_has_a_rest_of_its_own(self):
        body, clothes = load(BISHOP), load(BISHOP)
        clothes.location = (0.4, 0, 0)
        bpy.context.view_layer.update()
        select(body, clothes)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = body.vdbcage.cage
        set_positions(cage, positions(cage, world=False) + [0, 1, 0])
        select(body)
        bpy.ops.vdbcage.set_rest()
        select(cage)
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(key(body), positions_at_rest(body), 1e-5 * size(key(body)))
        self.assertNear(key(clothes), positions_at_rest(clothes) + [0, 1, 0], 1e-5 * size(key(body)))

    def test_the_cache_is_on_top_of_all_modifiers(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        options = {"coordinates": "mvc", "target": "POINT_CACHE", "frame_start": 1, "frame_end": 1,
                   "directory": str(self.folder)}
        bpy.ops.vdbcage.pose(**options)
        model.modifiers.new("subdivided", "SUBSURF").levels = 1
        rest = positions(model, world=False)
        set_positions(cage, positions(cage, world=False) + [0, 1, 0])
        bpy.ops.vdbcage.pose(**options)
        self.assertEqual([modifier.type for modifier in model.modifiers], ["SUBSURF", "MESH_CACHE"])
        self.assertNear(positions(model, world=False), rest + [0, 1, 0], 1e-5 * size(rest))

    def test_set_rest(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        set_positions(cage, 1.2 * positions(cage, world=False))
        bpy.ops.vdbcage.set_rest()
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(key(model), positions_at_rest(model), 2e-6 * size(key(model)))

    def test_weights_are_kept_until_something_changes(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")

        def kept():
            return [name for name in os.listdir(bpy.app.tempdir) if name.startswith("vdbcage_weights_bishop_")]

        bpy.ops.vdbcage.pose(coordinates="mvc")
        first = kept()
        self.assertEqual(len(first), 1)
        made = os.stat(os.path.join(bpy.app.tempdir, first[0])).st_mtime_ns
        set_positions(model.vdbcage.cage, 1.2 * positions(model.vdbcage.cage, world=False))
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertEqual(kept(), first)
        self.assertEqual(os.stat(os.path.join(bpy.app.tempdir, first[0])).st_mtime_ns, made)
        posed = key(model)
        bpy.ops.vdbcage.set_rest()
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertEqual(len(kept()), 1)
        self.assertNotEqual(kept(), first)
        self.assertGreater(numpy.abs(key(model) - posed).max(), 0.1)

    def test_files_are_beside_the_blend(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        blend = self.folder / "scene.blend"
        self.fails("Point caches are files beside the .blend. Save it first", bpy.ops.vdbcage.pose,
                   target="POINT_CACHE", frame_start=1, frame_end=2)
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        try:
            bpy.ops.vdbcage.pose(target="POINT_CACHE", frame_start=1, frame_end=2)
            self.assertTrue((self.folder / "vdbcage_cache" / "bishop.pc2").exists())
            self.assertEqual(model.modifiers[0].filepath, "//vdbcage_cache/bishop.pc2")
        finally:
            bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)

    def test_points_in_another_order_are_put_into_order_by_the_faces(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        set_positions(cage, bent(positions(cage, world=False)))
        bpy.ops.vdbcage.pose(coordinates="mvc")
        posed, before = key(model), positions(cage, world=False)
        select(cage)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.sort_elements(type="RANDOMIZE", elements={"VERT", "FACE"}, seed=1)
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertGreater(numpy.abs(positions(cage, world=False) - before).max(), 0)
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertTrue(numpy.array_equal(key(model), posed))
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        cage.data.polygons[0].select = True
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.delete(type="ONLY_FACE")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.fails("Error: bishop Cage, posed/0000.ply: it has ", bpy.ops.vdbcage.pose, coordinates="mvc")

    def test_wrong_input_changes_nothing(self):
        pose = bpy.ops.vdbcage.pose
        self.fails("Select a model that has a cage, or its cage", pose)
        model = load(BISHOP)
        bpy.ops.mesh.primitive_cube_add(size=1)
        cube = bpy.context.object
        model.vdbcage.cage = cube
        self.fails("bishop has no shape at rest. Press Set Rest", pose)
        bpy.ops.vdbcage.set_rest()
        self.fails("Error: bishop.ply: green coordinates are not defined", pose, coordinates="green")
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.subdivide()
        bpy.ops.object.mode_set(mode="OBJECT")
        self.fails("Cube has 26 points, and had 8 at rest", pose)
        bpy.ops.vdbcage.set_rest()
        cube.modifiers.new("subdivided", "SUBSURF")
        self.fails("Cube has modifiers that change its number of points", pose)
        self.fails("The last frame, 1, is before the first, 2", pose, target="POINT_CACHE", frame_start=2, frame_end=1)
        cube.modifiers.clear()
        select(model)
        cube.hide_viewport = True
        self.fails("Cube is disabled or excluded in this view layer. Show it first", pose)
        cube.hide_viewport = False
        collection = bpy.data.collections.new("apart")
        bpy.context.scene.collection.children.link(collection)
        cube.users_collection[0].objects.unlink(cube)
        collection.objects.link(cube)
        for disable in (True, False):
            collection.hide_viewport = disable
            bpy.context.view_layer.layer_collection.children["apart"].exclude = not disable
            self.fails("Cube is disabled or excluded in this view layer. Show it first", pose)
        bpy.context.view_layer.layer_collection.children["apart"].exclude = False
        other = bpy.data.objects.new("other", cube.data)
        bpy.context.scene.collection.objects.link(other)
        select(model)
        model.vdbcage.cage = other
        self.fails("bishop has no shape at rest. Press Set Rest", pose)
        bpy.ops.vdbcage.set_rest()
        model.data.use_fake_user = True
        self.assertEqual(pose(coordinates="mvc"), {"FINISHED"})
        twin = bpy.data.objects.new("twin", model.data)
        self.fails("bishop shares its mesh with other objects", pose)
        bpy.data.objects.remove(twin)
        bpy.ops.object.mode_set(mode="EDIT")
        self.fails("bishop is in Edit Mode", pose)


def positions_at_rest(model):
    return numpy.array([point.co for point in model.data.shape_keys.reference_key.data])
