import dataclasses
import json
import subprocess

import numpy

import vdbcage
from support import BISHOP, CREATURE, Case, command
from vdbcage import Mesh, make_cage


class CageTest(Case):
    def same_as_command(self, *words, **options):
        make_cage(Mesh.read(CREATURE), **options).write(self.folder / "python.obj")
        command("make", CREATURE, "-q", "-o", self.folder / "command.obj", *words)
        self.assertEqual((self.folder / "python.obj").read_bytes(), (self.folder / "command.obj").read_bytes())

    def test_a_cage_is_that_of_the_command(self):
        self.same_as_command("--faces", 400, faces=400)

    def test_a_triquad_cage_is_that_of_the_command(self):
        self.same_as_command("--faces", 200, "--mesh", "triquad", faces=200, mesh="triquad")

    def test_every_option_has_its_name_with_underscores(self):
        self.same_as_command("--faces", 150, "--resolution", 48, "--close-radius", 0.04, "--erode-radius", 0.035,
                             "--smooth", 2, "--parts", "merge", "--symmetry", "auto", "--clearance", 1e-4,
                             "--min-angle", 5, "--effort", "fast", "--scale-field", "sphere:0,0,0,1,2",
                             faces=numpy.int64(150), resolution="48", close_radius=0.04,
                             erode_radius=numpy.float64(0.035), smooth=2, parts="merge", symmetry="auto",
                             clearance=1e-4, min_angle=5, effort="fast", scale_field="sphere:0,0,0,1,2",
                             merge_angle=None, element="sphere", voxelizer=None, bounding=True, mesh="triangles")

    def test_booleans_are_on_and_off(self):
        cage = make_cage(Mesh.read(BISHOP), faces=100, bounding=False, effort="fast")
        self.assertEqual(cage.report["options"]["bounding"], False)

    def test_a_cage_has_its_verdict_and_its_report(self):
        model = Mesh.read(BISHOP)
        cage = make_cage(model, faces=100)
        self.assertIsInstance(cage, Mesh)
        self.assertTrue(cage.check.bounding)
        self.assertEqual(cage.check.triangles, len(cage))
        self.assertEqual(cage.report["options"]["faces"], 100)
        self.assertEqual(cage.report["options"]["close_radius"], "auto")
        self.assertEqual(cage.report["start"], "closing")
        self.assertIn("voxelize", cage.report["stages"])
        self.assertGreater(cage.report["seconds"], 0)
        self.assertEqual(vdbcage.check_cage(cage, model), cage.check)
        json.dumps(cage.report)  # plain values

    def test_a_drawn_cage_is_fitted(self):
        model = Mesh.read(BISHOP)
        made = make_cage(model, faces=100, mesh="quads", effort="fast")
        drawn = Mesh(made.points * 0.97, made.triangles, made.quads)
        cages = [vdbcage.fit_cage(drawn, model, tight=tight) for tight in (0, 1)]
        for cage in cages:
            self.assertTrue(cage.check.bounding)
            self.assertEqual(vdbcage.check_cage(cage, model), cage.check)
            numpy.testing.assert_array_equal(cage.quads, drawn.quads)
            numpy.testing.assert_array_equal(cage.triangles, drawn.triangles)
            ways = numpy.linalg.norm(cage.points - drawn.points, axis=1)
            numpy.testing.assert_allclose(cage.report["ways"], ways)
            self.assertEqual(cage.report["moved_points"], (ways > 0).sum())
            json.dumps(cage.report)
        self.assertLess(cages[1].check.mean_distance, cages[0].check.mean_distance)
        kept = vdbcage.fit_cage(made, model, keep=[0, 5])
        numpy.testing.assert_array_equal(kept.points[[0, 5]], made.points[[0, 5]])
        near = vdbcage.fit_cage(made, model, tight=1, most=0.01)
        side = numpy.ptp(model.points, axis=0).max()
        self.assertTrue(0 < max(near.report["ways"]) <= 0.01 * side)
        far = Mesh(100 * made.points[:, [1, 2, 0]] + 5, made.triangles, made.quads)  # turned, in other units
        self.assertTrue(vdbcage.fit_cage(far, model, place="turn").check.bounding)
        self.refuses("place: 'x' is not allowed; it must be 'box' or 'turn'", vdbcage.fit_cage, made, model, place="x")
        self.refuses("most: -1 is not allowed", vdbcage.fit_cage, made, model, most=-1)
        self.refuses("cage: no place was found where it does not cut the model", vdbcage.fit_cage, drawn, model,
                     keep=range(len(drawn.points)))
        self.refuses("tight: 2 is not allowed", vdbcage.fit_cage, drawn, model, tight=2)
        self.refuses("keep: row 0 has the index 999", vdbcage.fit_cage, drawn, model, keep=[999])
        self.refuses("cage: it is not a closed, oriented 2-manifold", vdbcage.fit_cage,
                     Mesh(drawn.points, drawn.triangles, drawn.quads[1:]), model)

    def test_a_file_holds_the_cage_that_was_certified(self):
        shift = [20000, 0, 0]
        bishop = Mesh.read(BISHOP)
        model = Mesh(bishop.points / numpy.ptp(bishop.points, axis=0).max() + shift, bishop.triangles, bishop.quads)
        path = self.folder / "cage.stl"
        cage = make_cage(model, faces=50, effort="fast")
        self.assertFalse(cage.report["float_safe"])
        self.refuses("cage.stl: its file would hold float32", cage.write, path)
        self.assertFalse(path.exists())
        self.refuses("model: it is so far from the origin", make_cage, model, precision="float32")
        model = Mesh(model.points - [18000, 0, 0], model.triangles, model.quads)
        make_cage(model, faces=50, effort="fast", precision="float32").write(path)
        self.assertTrue(vdbcage.check_cage(Mesh.read(path), model).bounding)

    def test_memory_is_predicted_as_the_command_does(self):
        bishop = Mesh.read(BISHOP)
        usual, fine = vdbcage.predicted_memory(bishop), vdbcage.predicted_memory(bishop, resolution=1024)
        self.assertIsInstance(fine, int)
        self.assertGreater(fine, 10 * usual)
        words = "make", BISHOP, "-q", "-o", self.folder / "c.obj", "--memory"
        command(*words, usual)
        with self.assertRaises(subprocess.CalledProcessError):
            command(*words, usual - 1)
        self.refuses("resolution: '7' is not allowed", vdbcage.predicted_memory, bishop, resolution=7)

    def test_a_check_says_what_the_command_says(self):
        cage, model = self.folder / "cage.obj", Mesh.read(BISHOP)
        box = Mesh(*[array for array in self.box_of(model.points, 0.3)])
        box.write(cage)  # it cuts the model
        report = self.folder / "report.json"
        with self.assertRaises(Exception):
            command("check", cage, BISHOP, "--report", report)
        expected = json.loads(report.read_text())
        expected = expected.get("check", expected)
        fields = dataclasses.asdict(vdbcage.check_cage(box, model))
        self.assertFalse(fields["bounding"])
        self.assertTrue(fields["valid"])
        self.assertEqual(len(fields["bad_faces"]), fields["contact_faces"])
        for name, value in fields.items():
            if name != "bad_faces":
                self.assertEqual(value, expected[f"model_{name}" if name in ("diagonal", "longest_side") else name], name)

    def test_a_check_takes_its_options(self):
        model = Mesh.read(BISHOP)
        box = Mesh(*self.box_of(model.points, 2))
        self.assertEqual(vdbcage.check_cage(box, model, measure=False).mean_distance, 0)
        self.assertNotEqual(vdbcage.check_cage(box, model, samples=10), vdbcage.check_cage(box, model))
        self.assertTrue(vdbcage.check_cage(box, model, as_floats=True).bounding)
        for samples in (0, -1, 1.5, None, 10**10):
            self.refuses("samples: ", vdbcage.check_cage, box, model, samples=samples)

    def test_a_pipeline_gives_the_same_cages_and_keeps_its_stages(self):
        model = Mesh.read(BISHOP)
        pipeline = vdbcage.Pipeline(model)
        self.assertIs(pipeline.model, model)
        self.assertIsNone(pipeline.surface)
        first = pipeline.run(faces=100, resolution=40, close_radius=0.02)
        second = pipeline.run(faces=60, resolution=40, close_radius=0.02)
        self.assertTrue(numpy.array_equal(
            second.points, make_cage(model, faces=60, resolution=40, close_radius=0.02).points))
        self.assertIn("voxelize", first.report["stages"])
        self.assertNotIn("voxelize", second.report["stages"])
        self.assertGreater(len(pipeline.surface.quads), 0)
        self.assertEqual(len(pipeline.smoothed), 60)
        self.assertEqual(len(pipeline.decimated), 60)
        with self.assertRaises(vdbcage.InputError):
            pipeline.run(faces=1)
        self.assertEqual(len(pipeline.decimated), 60)

    def test_a_pipeline_is_for_one_call_at_a_time(self):
        pipeline = vdbcage.Pipeline(Mesh.read(CREATURE))

        def again(stage, percent):
            pipeline.run(faces=100)

        self.refuses("another call is running it", pipeline.run, effort="best", progress=again, error=vdbcage.Error)
        self.assertTrue(pipeline.run(faces=100, effort="fast").check.bounding)

    def test_bad_options_are_refused(self):
        model = Mesh.read(BISHOP)
        for text, options in {
            "face: there is no such option; did you mean faces?": {"face": 100},
            "colour: there is no such option; there are: faces, resolution, close_radius": {"colour": 1},
            "close-radius: there is no such option": {"close-radius": 0.1},
            "faces: '3' is not allowed; it must be 4 to 1000000": {"faces": 3},
            "faces: 'True' is not allowed": {"faces": True},
            "faces: 'None' is not allowed": {"faces": None},
            "faces: '100.5' is not allowed": {"faces": 100.5},
            "faces: [100] is not allowed": {"faces": [100]},
            "faces: '1" + "0" * 30 + "' is not allowed": {"faces": 10**30},
            "close_radius: 'nan' is not allowed": {"close_radius": float("nan")},
            "close_radius: 'wide' is not allowed; it must be auto or a number": {"close_radius": "wide"},
            "erode_radius: '0.1' is not allowed": {"erode_radius": 0.1},
            "min_angle: '31' is not allowed": {"min_angle": 31},
            "mesh: 'hexagons' is not allowed; it must be one of triangles|triquad|quads": {"mesh": "hexagons"},
            "symmetry: 'x' is not allowed with bounding off": {"symmetry": "x", "bounding": False},
            "scale_field: 'sphere:1' is not a scale field": {"scale_field": "sphere:1"},
        }.items():
            with self.subTest(text):
                self.refuses(text, make_cage, model, **options)
                self.refuses(text, vdbcage.Pipeline(model).run, **options)
        self.refuses("missing.vdb: cannot be read", make_cage, model, scale_field=self.folder / "missing.vdb",
                     error=vdbcage.IoError)

    def test_bad_meshes_are_refused(self):
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        self.refuses("model: a str is not allowed; it must be a vdbcage.Mesh", make_cage, "model.obj")
        self.refuses("model: a ndarray is not allowed", make_cage, numpy.zeros((3, 3)))
        self.refuses("model: it has no faces", make_cage, Mesh(corners))
        self.refuses("model: ", make_cage, Mesh(corners, [[0, 1, 1]]))
        self.refuses("cage: a NoneType is not allowed", vdbcage.check_cage, None, Mesh(corners, [[0, 1, 2]]))
        self.refuses("model: it has no faces", vdbcage.check_cage, Mesh(corners, [[0, 1, 2]]), Mesh(corners))
        self.refuses("model: a list is not allowed", vdbcage.Pipeline, corners)
        with self.assertRaises(TypeError):
            vdbcage.Cage(corners)

    @staticmethod
    def box_of(points, scale):
        """Points, no triangles, and quads of the points' bounding box, scaled about its middle."""
        middle, half = (points.max(0) + points.min(0)) / 2, (points.max(0) - points.min(0)) / 2 * scale
        corners = numpy.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        return middle + corners * half, None, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                                               [1, 5, 7, 3]]
