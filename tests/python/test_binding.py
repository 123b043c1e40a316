import numpy

import vdbcage
from support import SHELL, Case, command
from vdbcage import Binding, Elasticity, InputError, IoError, Mesh, coordinate_families, make_cage, posed_points


class BindingTest(Case):
    @classmethod
    def setUpClass(cls):
        cls.model = Mesh.read(SHELL)
        cls.cages = {mesh: make_cage(cls.model, faces=60, mesh=mesh, effort="fast") for mesh in ("triangles", "quads")}
        cls.cage = cls.cages["triangles"]

    def test_weights_are_those_of_the_command(self):
        for mesh, cage in self.cages.items():
            for family in [family.name for family in coordinate_families()]:
                with self.subTest(f"{family} of {mesh}"):
                    cage.write(self.folder / "cage.ply")
                    command("bind", self.folder / "cage.ply", SHELL, "-q", "--coordinates", family, "-o",
                            self.folder / "command.npy")
                    binding = Binding(cage, self.model.points, family)
                    weights = binding.weights()
                    self.assertEqual(weights.dtype, numpy.float32)
                    self.assertEqual(weights.shape, (len(self.model.points), binding.handles))
                    self.assertEqual(binding.coordinates, family)
                    self.assertTrue(numpy.array_equal(weights, numpy.load(self.folder / "command.npy")["weights"]))
                    binding.write(self.folder / "python.npy")
                    self.assertEqual((self.folder / "python.npy").read_bytes(),
                                     (self.folder / "command.npy").read_bytes())

    def test_poses_are_those_of_the_command(self):
        posed = Mesh(self.cage.points * [1, 1.5, 0.8] + [0, 0, 3], self.cage.triangles)
        for name, mesh in {"cage.ply": self.cage, "posed.ply": posed}.items():
            mesh.write(self.folder / name)
        command("deform", self.folder / "cage.ply", self.folder / "posed.ply", SHELL, "-q", "-o",
                self.folder / "model.ply")
        points = Binding(self.cage, self.model.points).pose(posed.points)
        self.assertTrue(numpy.array_equal(points, Mesh.read(self.folder / "model.ply").points))

    def test_the_rest_pose_is_exact_and_an_update_is_a_pose(self):
        binding = Binding(self.cage, self.model.points)
        self.assertTrue(numpy.array_equal(binding.pose(self.cage.points), self.model.points))
        self.assertTrue(numpy.array_equal(binding.points, self.model.points))
        self.assertFalse(binding.points.flags.writeable)
        self.assertIs(binding.cage, self.cage)
        size = numpy.ptp(self.model.points, axis=0).max()
        moved = self.cage.points.copy()
        moved[3] += 0.1 * size
        rest = binding.points.copy()
        updated = binding.update(rest, self.cage.points, moved)
        self.assertTrue(numpy.array_equal(rest, binding.points))
        numpy.testing.assert_allclose(updated, binding.pose(moved), rtol=0, atol=1e-6 * size)
        updated[0] = 0  # the caller's own

    def test_a_file_is_read_for_the_same_cage_and_points(self):
        binding, path = Binding(self.cage, self.model.points, "green"), self.folder / "weights.npy"
        binding.write(path)
        moved = self.cage.points * 1.1
        back = Binding.read(path, self.cage, self.model.points)
        self.assertTrue(numpy.array_equal(back.pose(moved), binding.pose(moved)))
        self.assertTrue(numpy.array_equal(back.weights(), binding.weights()))
        self.assertEqual(back.coordinates, "green")
        self.refuses("weights.npy: ", Binding.read, path, self.cages["quads"], self.model.points, error=IoError)
        self.refuses("weights.npy: ", Binding.read, path, self.cage, self.model.points[1:], error=IoError)
        self.refuses("missing.npy: ", Binding.read, self.folder / "missing.npy", self.cage, [], error=IoError)

    def test_weights_made_elsewhere_pose(self):
        binding, path = Binding(self.cage, self.model.points), self.folder / "given.npy"
        numpy.save(path, binding.weights())
        given = Binding.read(path, self.cage, self.model.points)
        self.assertEqual(given.coordinates, "given")
        moved = self.cage.points * 1.1
        self.assertTrue(numpy.allclose(given.pose(moved), binding.pose(moved), rtol=1e-4))
        self.refuses("weights: ", given.weights)
        self.refuses("weights: ", given.write, self.folder / "other.npy")

    def test_harmonic_weights_are_of_the_resolution_asked_for(self):
        inside = self.model.points[:4]
        usual = Binding(self.cage, inside, "harmonic").weights()
        for resolution, same in ((64, True), (8, False)):
            weights = Binding(self.cage, inside, "harmonic", resolution=resolution).weights()
            self.assertEqual(numpy.array_equal(weights, usual), same)

    def test_families_are_those_of_the_library(self):
        families = coordinate_families()
        self.assertEqual(families[0].name, "mvc")
        self.assertTrue(families[0].everywhere)
        self.assertIn("Ju, Schaefer, Warren 2005", families[0].paper)
        self.assertEqual([family.name for family in families if family.title == "Somigliana"], ["somigliana"])
        self.assertEqual([family.name for family in families if family.resolution], ["harmonic"])
        self.assertEqual([family.name for family in families if family.elasticity], ["somigliana"])

    def test_elasticity_acts_in_poses(self):
        inside = self.model.points[::50]
        posed = self.cage.points.copy()
        posed[posed[:, 2] > posed[:, 2].mean()] *= [1.5, 1.2, 1.3]
        usual = Binding(self.cage, inside, "somigliana")
        self.assertEqual(usual.elasticity, Elasticity())
        for elasticity in (Elasticity(nu=0.3), Elasticity(rotations="local"), Elasticity(local_bulging=50),
                           Elasticity(global_bulging=50)):
            with self.subTest(str(elasticity)):
                other = usual.with_elasticity(elasticity)
                self.assertEqual(other.elasticity, elasticity)
                self.assertTrue(numpy.array_equal(other.pose(self.cage.points), inside))
                self.assertFalse(numpy.allclose(other.pose(posed), usual.pose(posed), rtol=0, atol=1e-5))
                anew = Binding(self.cage, inside, "somigliana", elasticity=elasticity)
                self.assertTrue(numpy.array_equal(other.pose(posed), anew.pose(posed)))
        self.refuses("nu: 0.5 is not allowed", usual.with_elasticity, Elasticity(nu=0.5))
        self.refuses("nu: 'soft' is not allowed", usual.with_elasticity, Elasticity(nu="soft"))
        self.refuses("rotations: 'both' is not allowed", usual.with_elasticity, Elasticity(rotations="both"))
        self.refuses("rotations: 1 is not allowed", usual.with_elasticity, Elasticity(rotations=1))
        self.refuses("global_bulging: -1 is not allowed", usual.with_elasticity, Elasticity(global_bulging=-1))
        self.refuses("elasticity: 0.3 is not allowed", usual.with_elasticity, 0.3)
        self.refuses("elasticity: only somigliana coordinates", Binding, self.cage, inside, elasticity=Elasticity())
        self.refuses("elasticity: only somigliana coordinates", Binding(self.cage, inside).with_elasticity,
                     Elasticity())

    def test_loose_points_ride_along_or_stay(self):
        model = Mesh(numpy.vstack([self.model.points, [[1e3, 0, 0]]]), self.model.triangles, self.model.quads)
        self.assertEqual(model.loose_points.tolist(), [len(model.points) - 1])
        self.assertEqual(vdbcage.check_cage(self.cage, model).loose_points_outside, 1)
        posed = self.cage.points + [0, 0, 2]
        with self.assertRaises(vdbcage.InputError):
            Binding(self.cage, model.points, "green")
        for motion, at in (("ride", [1e3, 0, 2]), ("stay", [1e3, 0, 0])):
            binding = Binding(self.cage, model.points, "green", loose=model.loose_points, loose_motion=motion)
            numpy.testing.assert_allclose(binding.pose(posed)[-1], at, rtol=1e-5, atol=1e-3)
            self.assertEqual(binding.weights().shape[0], len(model.points))
        self.refuses("loose: row 0 has the index", Binding, self.cage, model.points, loose=[len(model.points)])
        self.refuses("loose_motion: 3 is not allowed", Binding, self.cage, model.points, loose_motion=3)
        self.refuses("it must be ride or stay", Binding, self.cage, model.points, loose_motion="fly")

    def test_the_faces_of_a_posed_cage_tell_the_order_of_its_points(self):
        random = numpy.random.default_rng(1)
        for cage in self.cages.values():
            moved = cage.points * [1, 1.5, 0.8]
            order = random.permutation(len(cage.points))
            now = numpy.argsort(order)  # of each point its new number
            other = Mesh(moved[order], random.permutation(now[cage.triangles]), random.permutation(now[cage.quads]))
            for posed in (Mesh(moved, cage.triangles, cage.quads), other):
                self.assertTrue(numpy.array_equal(posed_points(cage, posed), moved))
            with self.assertRaisesRegex(InputError, "^posed cage: [0-9]+ of its [0-9]+ faces are not the cage's"):
                posed_points(cage, Mesh(moved, cage.triangles[:, ::-1], cage.quads[:, ::-1]))
        with self.assertRaisesRegex(InputError, "^posed: a ndarray is not allowed"):
            posed_points(cage, moved)

    def test_bad_arguments_are_refused(self):
        inside = self.model.points[:5]
        far = [[1e6, 0, 0]]
        self.refuses("coordinates: 'cotangent' is not a family", Binding, self.cage, inside, "cotangent")
        self.refuses("coordinates: 5 is not allowed", Binding, self.cage, inside, 5)
        self.refuses("cage: a str is not allowed", Binding, "cage.obj", inside)
        self.refuses("resolution: 3 is not allowed", Binding, self.cage, inside, "harmonic", resolution=3)
        self.refuses("resolution: only harmonic coordinates", Binding, self.cage, inside, "mvc", resolution=64)
        self.refuses("points: row 0 has the coordinate nan", Binding, self.cage, [[numpy.nan, 0, 0]])
        self.refuses("points: an array of shape (2, 2)", Binding, self.cage, [[1, 2], [3, 4]])
        self.refuses("points: green coordinates are not defined at 1 of 1 points", Binding, self.cage, far, "green")
        self.refuses("cage: it is not closed", Binding, Mesh(inside, [[0, 1, 2]]), inside)
        self.refuses("cage: it faces inward", Binding, Mesh(self.cage.points, self.cage.triangles[:, ::-1]), inside)
        binding = Binding(self.cage, inside)
        rest = self.cage.points
        broken = rest.copy()
        broken[7, 1] = numpy.inf
        self.refuses("cage_points: it has 5 rows; the cage has", binding.pose, inside)
        self.refuses("cage_points: row 7 has the coordinate inf", binding.pose, broken)
        self.refuses("posed: it has 4 rows; the binding has 5", binding.update, inside[:4], rest, rest)
        self.refuses("before: row 7", binding.update, inside, broken, rest)
        self.refuses("after: it has 1 rows", binding.update, inside, rest, rest[:1])
        self.assertIn("5 points", repr(binding))
        self.assertEqual(Binding(self.cage, []).weights().shape, (0, binding.handles))
