"""Fit Cage."""

import os

import bpy
import numpy
from mathutils import Matrix
from support import BISHOP, CREATURE, Case, load, positions, select, set_positions, size


def coordinates(collection, attribute="co", width=3):
    array = numpy.empty(width * len(collection), numpy.float32)
    collection.foreach_get(attribute, array)
    return array.reshape(-1, width)


def integers(collection, attribute):
    array = numpy.empty(len(collection), numpy.int32)
    collection.foreach_get(attribute, array)
    return array.tolist()


def new_object(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, point)) for point in points], [], faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def damaged(cage):
    """Pulls a third of the cage's points deep into its model; whether each was pulled."""
    points = positions(cage, world=False)
    middle, is_pulled = points.mean(axis=0), numpy.arange(len(points)) % 3 == 0
    points[is_pulled] += 0.3 * (middle - points[is_pulled])
    set_positions(cage, points)
    return is_pulled


def everything_but_points(cage):
    """All of a cage that a fit leaves alone."""
    mesh = cage.data
    keys = mesh.shape_keys
    basis = coordinates(mesh.vertices)
    return {
        "names": (cage.name, mesh.name), "materials": [one.name for one in mesh.materials],
        "matrix": [list(row) for row in cage.matrix_world],
        "corners": integers(mesh.loops, "vertex_index"), "faces": integers(mesh.polygons, "loop_total"),
        "edges": [tuple(edge.vertices) for edge in mesh.edges],
        "material": integers(mesh.polygons, "material_index"),
        "smooth": [face.use_smooth for face in mesh.polygons],
        "uvs": [(layer.name, coordinates(layer.data, "uv", 2).tolist()) for layer in mesh.uv_layers],
        "groups": [(group.name, [(one.group, one.weight) for vertex in mesh.vertices for one in vertex.groups])
                   for group in cage.vertex_groups],
        "modifiers": [(one.name, one.type, one.show_viewport) for one in cage.modifiers],
        "keys": [(key.name, key.value, numpy.round(coordinates(key.data) - basis, 4).tolist())
                 for key in keys.key_blocks] if keys else [],
    }


class Fit(Case):
    def setUp(self):
        super().setUp()
        bpy.data.batch_remove(list(bpy.data.materials))

    def dressed(self, cage):
        """Gives a cage all that an artist may have put on it, but for what it is to keep."""
        mesh = cage.data
        for name in ("skin", "horn"):
            mesh.materials.append(bpy.data.materials.new(name))
        for face in mesh.polygons:
            face.material_index, face.use_smooth = face.index % 2, face.index % 3 == 0
        layer = mesh.uv_layers.new(name="painted")
        for i, corner in enumerate(layer.data):
            corner.uv = (i / len(layer.data), (i % 7) / 7)
        group = cage.vertex_groups.new(name="arm")
        for vertex in mesh.vertices:
            if vertex.index % 2 == 0:
                group.add([vertex.index], vertex.index / len(mesh.vertices), "REPLACE")
        cage.modifiers.new("smoother", "SUBSURF").show_viewport = False
        cage.shape_key_add(name="Basis", from_mix=False)
        key = cage.shape_key_add(name="wide", from_mix=False)
        points = coordinates(key.data)
        points[::5] *= [1.25, 1, 1]
        key.data.foreach_set("co", points.ravel())
        key.value = 0

    def test_an_edited_cage_bounds_again_and_all_else_of_it_stays(self):
        model = load(CREATURE)
        bpy.ops.vdbcage.make_cage(faces=300, mesh="triquad", effort="fast")
        cage = model.vdbcage.cage
        is_pulled = damaged(cage)
        self.certified(cage, model, status=2)
        self.dressed(cage)
        # These stayed where the cage was certified, and lie apart from what was pulled.
        corners = [face.vertices for face in cage.data.polygons]
        beside = {i for face in corners if is_pulled[list(face)].any() for i in face}
        pinned = [i for i in range(len(is_pulled)) if i not in beside][:12] or [int(numpy.flatnonzero(~is_pulled)[0])]
        group = cage.vertex_groups.new(name="pinned")
        group.add(pinned, 1, "REPLACE")
        group.add([int(i) for i in numpy.flatnonzero(is_pulled)], 0, "REPLACE")  # a weight of 0 keeps nothing
        before, drawn = everything_but_points(cage), coordinates(cage.data.vertices)
        bpy.ops.ed.undo_push(message="Edited")
        self.assertEqual(bpy.ops.vdbcage.fit_cage("EXEC_DEFAULT", True, tight=0.3, keep="pinned"), {"FINISHED"})

        fitted = coordinates(cage.data.vertices)
        self.certified(cage, model)
        self.assertEqual(everything_but_points(cage), before)
        self.assertTrue((coordinates(cage.data.shape_keys.reference_key.data) == fitted).all())
        self.assertTrue((fitted[pinned] == drawn[pinned]).all())
        self.assertGreater(numpy.abs(fitted - drawn)[is_pulled].max(), 0.01 * size(drawn))
        self.assertEqual(cage["vdbcage_report"]["kind"], "fit")
        self.assertTrue(cage["vdbcage_report"]["check"]["bounding"])
        left = [name for name in os.listdir(bpy.app.tempdir) if not name.startswith("vdbcage_weights_")]
        self.assertEqual(left, [])

        # Without the group these points move: it is what held them.
        bpy.ops.ed.undo()
        cage = bpy.data.objects["creature Cage"]
        self.assertTrue((coordinates(cage.data.vertices) == drawn).all())
        self.assertEqual(everything_but_points(cage), before)
        self.assertEqual(cage["vdbcage_report"]["kind"], "make")
        bpy.ops.vdbcage.fit_cage(tight=0.3)
        self.assertFalse((coordinates(cage.data.vertices)[pinned] == drawn[pinned]).any())

    def test_a_cage_that_was_drawn_by_hand(self):
        """It has another place than its models, which are turned, scaled and mirrored; it is stretched, too."""
        bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8, radius=0.4)
        cage = bpy.context.object
        cage.name = "drawn"
        cage.location, cage.rotation_euler, cage.scale = (0.1, 0.2, 0.3), (0.4, 0, 1), (1, -1.5, 2)
        body, clothes = load(BISHOP), load(BISHOP)
        clothes.location, clothes.rotation_euler, clothes.scale = (0.4, 0, 0), (0.3, 1, -2), (-1, 1, 0.9)
        bpy.context.view_layer.update()
        for model in (body, clothes):
            model.vdbcage.cage = cage
        self.certified(cage, body, status=2)
        places = [Matrix(thing.matrix_world) for thing in (cage, body, clothes)]
        for chosen in (cage, body):  # the cage, and one of its models: it stays the cage of both
            select(chosen)
            bpy.ops.vdbcage.fit_cage(tight=0)
            self.certified(cage, body, clothes)
        self.assertEqual([thing.matrix_world for thing in (cage, body, clothes)], places)
        self.assertEqual([len(face.vertices) for face in cage.data.polygons].count(4), 72)
        bpy.ops.vdbcage.bind()
        self.assertEqual([modifier.object for modifier in clothes.modifiers], [])
        self.assertEqual([modifier.object for modifier in body.modifiers], [cage])

    def test_it_bounds_the_model_with_its_modifiers_or_without(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=150, surface="REST", effort="fast")
        cage = model.vdbcage.cage
        solidify = model.modifiers.new("thick", "SOLIDIFY")
        solidify.thickness, solidify.offset = 0.05 * size(positions(model)), 1
        self.certified(cage, model, status=2)
        drawn = positions(cage)
        bpy.ops.vdbcage.fit_cage(tight=0, surface="REST")
        self.assertNear(positions(cage), drawn, 0)
        bpy.ops.vdbcage.fit_cage(tight=0)
        self.certified(cage, model)
        self.assertEqual(model.vdbcage.surface, "EVALUATED")

    def test_tightness(self):
        model = load(BISHOP)
        bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
        cage = model.vdbcage.cage
        made = positions(cage, world=False)
        distances = []
        for tight in (0, 1):
            set_positions(cage, 1.3 * made)
            bpy.ops.vdbcage.fit_cage(tight=tight)
            distances.append(cage["vdbcage_report"]["check"]["mean_distance"])
        self.assertGreater(distances[0], 1.1 * distances[1])

    def test_models_are_at_rest_in_the_fitted_cage(self):
        model = load(BISHOP)
        rest = positions(model)
        bpy.ops.vdbcage.make_cage(faces=150, effort="fast")
        bpy.ops.vdbcage.bind()
        cage = model.vdbcage.cage
        damaged(cage)
        self.assertGreater(numpy.abs(positions(model) - rest).max(), 0.01 * size(rest))
        bpy.ops.vdbcage.fit_cage()
        self.assertNear(positions(model), rest, 1e-5 * size(rest))
        self.certified(cage, model)
        bpy.ops.vdbcage.pose(coordinates="mvc")
        self.assertNear(positions(model), rest, 1e-5 * size(rest))
        bpy.ops.vdbcage.bind()
        self.assertNear(positions(model), rest, 1e-5 * size(rest))
        # Modifiers of the cage are left out, also those that change its number of points.
        damaged(cage)
        cage.modifiers.new("smoother", "SUBSURF")
        bpy.ops.vdbcage.fit_cage(tight=0)
        cage.modifiers.clear()
        self.certified(cage, model)

    def test_faces_that_hold_it_back_are_selected(self):
        """Each polygon in turn: triangles, quads, a concave one, and larger ones, in no order."""
        outline = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
        points = [(x, y, z) for z in (0, 4) for x, y in outline] + [(2.6, 0, 1.4)]
        sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
        a, b, c, d = sides[0]
        middle = 12  # on the side, and within its half a, b, c
        x, y, z, w = sides[2]
        faces = [sides[3], list(range(6, 12)), [a, b, c, middle], sides[1], [x, y, z], [a, middle, c, d], [x, z, w],
                 sides[4], list(range(5, -1, -1)), sides[5]]
        on = [(2, 3, 2), (1, 1, 4), (3.4, 0, 1), (4, 1, 2), (2.6, 2, 1), (1, 0, 2.5), (3.4, 2, 3), (1, 4, 2),
              (1, 1, 0), (0, 2, 2)]
        cage = new_object("drawn", points, faces)
        cage.vertex_groups.new(name="all").add(list(range(len(points))), 1, "REPLACE")
        bpy.ops.mesh.primitive_ico_sphere_add(radius=0.2)
        model = bpy.context.object
        model.vdbcage.cage = cage
        before = everything_but_points(cage), coordinates(cage.data.vertices).tolist()
        for number, place in enumerate(on):
            with self.subTest(face=number):
                model.location = place
                bpy.context.view_layer.update()
                self.fails("drawn.ply: no place was found where it does not cut the model. The faces that hold it back "
                           "are selected: see them in Edit Mode", bpy.ops.vdbcage.fit_cage, keep="all")
                self.assertEqual([face.index for face in cage.data.polygons if face.select], [number])
                select(cage)
                for kind in ("VERT", "FACE"):
                    bpy.ops.object.mode_set(mode="EDIT")
                    bpy.ops.mesh.select_mode(type=kind)
                    bpy.ops.object.mode_set(mode="OBJECT")
                    self.assertTrue(cage.data.polygons[number].select)
                    self.assertEqual(sum(vertex.select for vertex in cage.data.vertices), len(faces[number]))
        self.assertEqual((everything_but_points(cage), coordinates(cage.data.vertices).tolist()), before)

    def test_wrong_input_changes_nothing(self):
        fit = bpy.ops.vdbcage.fit_cage
        model = load(BISHOP)
        self.fails("Select a model that has a cage, or its cage", fit)
        bpy.ops.mesh.primitive_plane_add(size=5)
        plane = bpy.context.object
        plane.name = "plane"
        model.vdbcage.cage = plane
        select(model)
        self.fails("plane.ply: it is not a closed, oriented 2-manifold (4 boundary edges", fit)
        plane.data.clear_geometry()
        self.fails("plane.ply: it has no faces", fit)
        bpy.data.objects.remove(plane)

        bpy.ops.mesh.primitive_cube_add(size=5)
        cage = bpy.context.object
        cage.name = "cube"
        model.vdbcage.cage = cage
        drawn = positions(cage)
        cage.data.flip_normals()
        self.fails("cube.ply: it faces inward; turn its faces around", fit)
        cage.data.flip_normals()
        self.fails("cube has no vertex group hands", fit, keep="hands")
        cage.vertex_groups.new(name="hands").add([0], 0, "REPLACE")
        self.fails("cube: no point has a weight above 0 in the vertex group hands", fit, keep="hands")
        twin = bpy.data.objects.new("twin", cage.data)
        self.fails("cube shares its mesh with other objects, which would change too. Make it a single user first", fit)
        bpy.data.objects.remove(twin)
        cage.scale = (1, 0, 1)
        bpy.context.view_layer.update()
        self.fails("cube is flat: its scale is 0 along an axis", fit)
        cage.scale = (1, 1, 1)
        other = load(BISHOP)
        other.hide_viewport = True
        other.vdbcage.cage = cage
        select(model)
        self.fails("is disabled or excluded in this view layer. Show it first", fit)
        bpy.ops.mesh.primitive_cube_add(size=6)
        other.vdbcage.cage = bpy.context.object
        bpy.context.object.name = "second"
        select(model, bpy.context.object)
        self.fails("Select one cage, or models of one: cube, second are several", fit)
        self.assertNear(positions(cage), drawn, 0)
        self.assertNotIn("vdbcage_report", cage)
        select(cage)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertFalse(fit.poll())
