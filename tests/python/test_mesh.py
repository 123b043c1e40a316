import gc
import resource

import numpy

import vdbcage
from support import BISHOP, Case
from vdbcage import InputError, IoError, Mesh

CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]


class MeshTest(Case):
    def test_arrays_come_back(self):
        mesh = Mesh(CORNERS, FACES, [[0, 1, 2, 3]])
        self.assertEqual(mesh.points.tolist(), CORNERS)
        self.assertEqual(mesh.triangles.tolist(), FACES)
        self.assertEqual(mesh.quads.tolist(), [[0, 1, 2, 3]])
        self.assertEqual((mesh.points.dtype, mesh.triangles.dtype, mesh.quads.dtype), ("float64", "uint32", "uint32"))
        self.assertEqual(len(mesh), 5)
        self.assertEqual(repr(mesh), "<vdbcage.Mesh: 4 points, 4 triangles, 1 quads>")

    def test_any_number_type_and_layout_is_taken(self):
        for kind in ("float64", "float32", "float16", "longdouble", ">f8", "int8", "uint64"):
            self.assertEqual(Mesh(numpy.array(CORNERS, kind)).points.tolist(), CORNERS, kind)
        for kind in ("int64", "uint8", ">i4", "uint64"):
            self.assertEqual(Mesh(CORNERS, numpy.array(FACES, kind)).triangles.tolist(), FACES, kind)
        wide = numpy.zeros((8, 6))
        wide[::2, ::-2] = CORNERS
        self.assertEqual(Mesh(wide[::2, ::-2]).points.tolist(), CORNERS)
        self.assertEqual(Mesh(numpy.asfortranarray(CORNERS), numpy.asfortranarray(FACES)).triangles.tolist(), FACES)
        for nothing in (None, [], (), numpy.empty((0, 3))):
            self.assertEqual(Mesh(CORNERS, nothing, nothing).quads.shape, (0, 4))

    def test_arrays_are_copied_in_and_not_out(self):
        corners = numpy.array(CORNERS, float)
        mesh = Mesh(corners, FACES, [[0, 1, 2, 3]])
        corners[0] = 7
        self.assertEqual(mesh.points[0].tolist(), [0, 0, 0])
        self.assertTrue(numpy.shares_memory(mesh.points, mesh.points))
        for array in (mesh.points, mesh.triangles, mesh.quads):
            self.assertFalse(array.flags.owndata)
            with self.assertRaises(ValueError):
                array[...] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True
        with self.assertRaises(AttributeError):
            mesh.points = corners

    def test_arrays_outlive_the_mesh(self):
        points = Mesh(CORNERS, FACES).points
        gc.collect()
        self.assertEqual(points.tolist(), CORNERS)

    def test_no_memory_is_lost(self):
        points = numpy.zeros((1000000, 3))
        Mesh(points)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(20):  # of 24 MB
            Mesh(points).points
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        self.assertLess(grown, 200 * 1024)

    def test_bad_arrays_are_refused(self):
        nan, inf = float("nan"), float("inf")
        for text, arguments in {
            "points: row 1 has the coordinate nan": ([[0, 0, 0], [0, nan, 0]],),
            "points: row 0 has the coordinate -inf": ([[0, 0, -inf]],),
            "points: an array of shape (3,)": ([1, 2, 3],),
            "points: an array of shape (1, 2)": ([[1, 2]],),
            "points: an array of shape ()": (5,),
            "points: an array of shape (1, 1, 3)": ([[[1, 2, 3]]],),
            "points: an array of complex128": ([[1, 2, 3j]],),
            "points: an array of <U1": ([["1", "2", "3"]],),
            "points: an array of bool": ([[True, True, True]],),
            "points: an array of object": ([[1, 2, None]],),
            "points: setting an array element": ([[1, 2, 3], [4]],),
            "triangles: row 1 has the index 4; it must be 0 to 3": (CORNERS, [[0, 1, 2], [0, 4, 2]]),
            "triangles: row 0 has the index -1": (CORNERS, [[0, 1, -1]]),
            "triangles: row 0 has the index 4294967296": (CORNERS, [[0, 1, 2**32]]),
            "triangles: row 0 has the index 18446744073709551615": (CORNERS, numpy.array([[0, 1, 2**64 - 1]], "uint64")),
            "triangles: row 0 has the index 0; there are no points": ([], [[0, 0, 0]]),
            "triangles: an array of float64": (CORNERS, [[0, 1, 2.5]]),
            "triangles: an array of shape (1, 4)": (CORNERS, [[0, 1, 2, 3]]),
            "quads: row 0 has the index 9": (CORNERS, None, [[0, 1, 2, 9]]),
            "quads: an array of shape (1, 3)": (CORNERS, None, [[0, 1, 2]]),
        }.items():
            with self.subTest(text):
                self.refuses(text, Mesh, *arguments)
        self.refuses("points: row 0 has the coordinate inf", Mesh, numpy.array([["1e400", 0, 0]], "longdouble"))

    def test_files_are_read_and_written(self):
        mesh = Mesh(numpy.array(CORNERS) / 3, FACES)
        for name in ("a.obj", "a.off", "a.ply", "ä b.OBJ"):
            for path in (self.folder / name, str(self.folder / name), bytes(self.folder / name)):
                mesh.write(path)
                back = Mesh.read(path)
                self.assertTrue(numpy.array_equal(back.points, mesh.points))
                self.assertTrue(numpy.array_equal(back.triangles, mesh.triangles))
        self.assertGreater(len(Mesh.read(BISHOP)), 1000)

    def test_odd_files_are_read_with_a_warning(self):
        path = self.folder / "odd.obj"
        path.write_text("v 0 0 0\nv 1d0 0 0\nv 0 1+e0 0\nf 1 2 3\n")
        with self.assertWarns(UserWarning) as warned:
            mesh = Mesh.read(path)
        self.assertEqual(mesh.points.tolist(), CORNERS[:3])
        self.assertEqual(str(warned.warnings[0].message),
                         f"{path}: line 2: a number has an exponent of Fortran, like 1.5d3, which is read as 1.5e3")
        self.assertEqual((len(warned.warnings), warned.filename), (2, __file__))

    def test_bad_files_are_refused(self):
        missing = self.folder / "missing.obj"
        self.refuses(f"{missing}: cannot be read", Mesh.read, missing, error=IoError)
        self.refuses("cannot be read", Mesh.read, b"/tmp/vdbcage-\xff.obj", error=IoError)
        self.refuses("the formats are known by", Mesh(CORNERS, FACES).write, self.folder / "a.txt", error=IoError)
        self.refuses("no faces", Mesh(CORNERS).write, self.folder / "a.obj")
        self.refuses("path: 5 is not a path", Mesh.read, 5)
        self.refuses("null character", Mesh.read, "a\0b.obj")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_exceptions_are_also_those_of_python(self):
        self.assertTrue(issubclass(InputError, vdbcage.Error) and issubclass(InputError, ValueError))
        self.assertTrue(issubclass(IoError, vdbcage.Error) and issubclass(IoError, OSError))
        for error in (vdbcage.DeviceError, vdbcage.Cancelled):
            self.assertTrue(issubclass(error, vdbcage.Error))
