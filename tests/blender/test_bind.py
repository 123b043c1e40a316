"""Bind and Rebind."""

import bpy
import numpy
from support import BISHOP, CREATURE, Case, load, part, positions, select, set_positions, size

bind, links = part("bind"), part("links")


def bound_bishop():
    """A model that is bound to its cage."""
    model = load(BISHOP)
    bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
    bpy.ops.vdbcage.bind()
    return model


class Bind(Case):
    def follows(self, cage, *models):
        """All points follow the cage's."""
        rest = {model: positions(model) for model in models}
        shape = positions(cage, world=False)
        step = 0.3 * size(shape)
        move = numpy.array(cage.matrix_world.to_3x3()) @ [step, -step, 2 * step]
        set_positions(cage, shape + [step, -step, 2 * step])
        for model, before in rest.items():
            self.assertNear(positions(model), before + move, 1e-5 * size(positions(cage)))
        set_positions(cage, shape)
        for model, before in rest.items():
            self.assertNear(positions(model), before, 1e-5 * size(before))

    def follows_in_part(self, cage, *models):
        """All points follow the cage's, and one of these alone moves some and not all."""
        self.follows(cage, *models)
        rest = {model: positions(model) for model in models}
        shape = positions(cage, world=False)
        one = shape.copy()
        one[0] += 0.3 * size(shape)
        set_positions(cage, one)
        moved = sum((numpy.abs(positions(model) - before).max(axis=1) > 1e-4 * size(before)).sum()
                    for model, before in rest.items())
        self.assertGreater(moved, 0)
        self.assertLess(moved, sum(len(before) for before in rest.values()))
        set_positions(cage, shape)

    def test_the_model_follows_its_cage(self):
        model = load(CREATURE)
        bpy.ops.vdbcage.make_cage(faces=400, effort="fast")
        for method in ("MESH_DEFORM", "SURFACE_DEFORM", "MESH_DEFORM"):
            bpy.ops.vdbcage.bind(method=method)
            self.assertEqual([modifier.type for modifier in model.modifiers], [method])
            self.follows_in_part(model.vdbcage.cage, model)

    def test_objects_that_are_turned_and_scaled_follow(self):
        for scale in ((2, 0.5, 1), (-1, 1, 3)):
            model = load(BISHOP)
            model.rotation_euler = (0.3, 1, -2)
            model.location = (5, 1, -2)
            model.scale = scale
            bpy.context.view_layer.update()
            bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
            for method in ("MESH_DEFORM", "SURFACE_DEFORM"):
                bpy.ops.vdbcage.bind(method=method)
                self.follows_in_part(model.vdbcage.cage, model)

    def test_two_objects_follow_one_cage(self):
        body, clothes = load(BISHOP), load(BISHOP)
        clothes.location = (0.4, 0, 0)
        clothes.scale = (1.2, 1, 0.9)
        bpy.context.view_layer.update()
        select(body, clothes)
        bpy.ops.vdbcage.make_cage(faces=300, effort="fast")
        select(body.vdbcage.cage)
        for method in ("MESH_DEFORM", "SURFACE_DEFORM"):
            bpy.ops.vdbcage.bind(method=method)
            self.follows_in_part(body.vdbcage.cage, body, clothes)

    def test_a_cage_that_was_drawn_by_hand(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
        model = bpy.context.object
        bpy.ops.mesh.primitive_cube_add(size=3)
        model.vdbcage.cage = bpy.context.object
        bpy.ops.vdbcage.bind()
        self.follows(model.vdbcage.cage, model)

    def test_it_finds_the_points_that_do_not_follow(self):
        """Blender says is_bound all the same."""
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        cage = model.vdbcage.cage
        out = positions(model, world=False)
        out[::100] += 3 * size(out)
        set_positions(model, out)
        bpy.ops.vdbcage.bind()
        modifier = model.modifiers[0]
        self.assertTrue(modifier.is_bound)
        found = bind.not_following(bpy.context, model, modifier, links.rest_of(model, cage).mesh.points,
                                   cage.matrix_world)
        self.assertEqual(found, (len(out[::100]), len(out)))

    def test_precision_2_moves_nothing(self):
        model = load(CREATURE)
        bpy.ops.vdbcage.make_cage(faces=400, effort="fast")
        self.fails("None of the 18530 points of creature would follow", bpy.ops.vdbcage.bind, precision=2)
        modifier = model.modifiers.new("plain", "MESH_DEFORM")
        modifier.object = model.vdbcage.cage
        modifier.precision = 2
        bpy.ops.object.meshdeform_bind(modifier=modifier.name)
        self.assertTrue(modifier.is_bound)

    def test_a_cage_around_the_mesh_without_modifiers_is_bound_below_them(self):
        model = load(BISHOP)
        model.modifiers.new("subdivided", "SUBSURF")
        bpy.ops.vdbcage.make_cage(faces=200, surface="REST", effort="fast")
        bpy.ops.vdbcage.bind()
        self.assertEqual([modifier.type for modifier in model.modifiers], ["MESH_DEFORM", "SUBSURF"])
        self.follows(model.vdbcage.cage, model)

    def test_rebind_when_a_modifier_changed_the_number_of_points(self):
        model = load(BISHOP)
        array = model.modifiers.new("array", "ARRAY")
        array.count = 1
        bpy.ops.vdbcage.make_cage(faces=200, effort="fast")
        for method in ("MESH_DEFORM", "SURFACE_DEFORM"):
            array.count = 1
            bpy.ops.vdbcage.bind(method=method)
            cage = model.vdbcage.cage
            shape = positions(cage, world=False)
            rest = positions(model)
            set_positions(cage, shape * [1, 1, 1.5])
            posed = positions(model)
            array.count = 2
            array.use_relative_offset = False
            array.use_constant_offset = True
            array.constant_offset_displace = (0, 0, 0)
            self.assertNear(positions(model)[:len(rest)], rest, 1e-5 * size(rest))  # Blender lets go
            bpy.ops.vdbcage.rebind()
            # The cage is posed, and what was posed before is posed as before: it was bound at rest.
            self.assertNear(positions(model)[:len(rest)], posed, 1e-4 * size(rest))
            self.assertNear(positions(model)[len(rest):], posed, 1e-4 * size(rest))
            set_positions(cage, shape)
            self.follows(cage, model)

    def test_a_binding_that_fails_leaves_the_one_before(self):
        model = bound_bishop()
        cage = model.vdbcage.cage
        shape = positions(cage, world=False)
        set_positions(cage, shape + [0, 0, 1])
        moved = positions(model)
        self.fails("would follow", bpy.ops.vdbcage.bind, precision=2)
        self.assertNear(positions(model), moved, 1e-6)
        self.assertNear(links.rest_of(model, cage).mesh.points, shape, 1e-6)
        self.assertEqual([modifier.precision for modifier in model.modifiers], [5])

    def test_a_second_cage_takes_the_place_of_the_first(self):
        model = bound_bishop()
        rest = positions(model)
        first = model.vdbcage.cage
        set_positions(first, 1.5 * positions(first, world=False))
        bpy.ops.object.select_all(action="SELECT")  # a cage is no model
        bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
        cage = model.vdbcage.cage
        self.assertNotEqual(cage, first)
        self.assertIsNone(first.vdbcage.cage)
        self.assertNear(positions(model), rest, 1e-5 * size(rest))  # as the new cage bounds it
        bpy.ops.vdbcage.bind()
        self.assertEqual([modifier.object for modifier in model.modifiers], [cage])
        self.follows(cage, model)

    def test_rebind_keeps_what_holds_the_model(self):
        model = bound_bishop()
        cage = model.vdbcage.cage
        set_positions(cage, positions(cage, world=False) * [1, 1, 1.3])
        bpy.ops.vdbcage.pose()
        posed = positions(model)
        bpy.ops.vdbcage.rebind()
        self.assertNear(positions(model), posed, 1e-6)
        self.assertFalse(model.modifiers[0].show_viewport)

    def test_rebind_leaves_what_cannot_be_seen_and_goes_on(self):
        hidden, model = load(BISHOP), load(BISHOP)
        for one in (hidden, model):
            select(one)
            bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
            bpy.ops.vdbcage.bind()
        hidden.hide_viewport = True
        array = model.modifiers.new("array", "ARRAY")
        bpy.context.view_layer.objects.active = model
        bpy.ops.object.modifier_move_to_index(modifier="array", index=0)
        array.count = 2
        array.constant_offset_displace = (0, 0, 0)
        array.use_relative_offset, array.use_constant_offset = False, True
        with self.assertRaisesRegex(RuntimeError, "bishop is disabled or excluded in this view layer"):
            bpy.ops.vdbcage.rebind()
        self.assertTrue(hidden.modifiers[0].is_bound)
        self.follows(model.vdbcage.cage, model)

    def test_wrong_input_changes_nothing(self):
        model = load(BISHOP)
        self.fails("Select a model that has a cage, or its cage", bpy.ops.vdbcage.bind)
        self.fails("No model is bound to a cage", bpy.ops.vdbcage.rebind)
        bpy.ops.mesh.primitive_plane_add(size=5)
        plane = bpy.context.object
        model.vdbcage.cage = plane
        select(model)
        self.fails("None of the 8157 points of bishop would follow: the cage must be closed", bpy.ops.vdbcage.bind)
        self.assertEqual(list(model.modifiers), [])
        by_hand = model.modifiers.new("by hand", "MESH_DEFORM")
        by_hand.object = plane
        self.fails("bishop has no shape at rest. Press Set Rest", bpy.ops.vdbcage.rebind)
        model.modifiers.remove(by_hand)
        bpy.data.objects.remove(plane)
        self.fails("Select a model that has a cage, or its cage", bpy.ops.vdbcage.bind)
        bpy.ops.vdbcage.make_cage(faces=100, effort="fast")
        cage = model.vdbcage.cage
        cage.modifiers.new("subdivided", "SUBSURF")
        self.fails("bishop Cage has modifiers that change its number of points", bpy.ops.vdbcage.bind)
        cage.users_collection[0].objects.unlink(cage)  # as Delete does: the model still points to it
        self.fails("Select a model that has a cage, or its cage", bpy.ops.vdbcage.bind)
