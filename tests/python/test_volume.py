import numpy
try:
    import pyopenvdb
except ModuleNotFoundError:
    import openvdb as pyopenvdb  # its name since OpenVDB 12

import vdbcage
from support import BISHOP, Case, command
from vdbcage import IoError, Mask, Mesh, close_mask, read_vdb, voxelize, write_vdb


class VolumeTest(Case):
    def same(self, mask, other):
        self.assertTrue(numpy.array_equal(mask.voxels(), other.voxels()))
        # Files hold a voxel size that is rounded once more.
        numpy.testing.assert_allclose(mask.matrix, other.matrix, rtol=1e-14, atol=0)

    def test_voxels_come_back_in_order_and_once(self):
        mask = Mask([[1, 0, 0], [-9, 5, 2**30 - 1], [0, 0, -2**30], [1, 0, 0]], 0.5, (1, 2, 3))
        self.assertEqual(mask.voxels().tolist(), [[-9, 5, 2**30 - 1], [0, 0, -2**30], [1, 0, 0]])
        self.assertEqual(mask.voxels().dtype, numpy.int32)
        self.assertEqual((len(mask), mask.voxel_size, mask.origin.tolist()), (3, 0.5, [1, 2, 3]))
        self.assertEqual(mask.matrix.tolist(), [[0.5, 0, 0, 1], [0, 0.5, 0, 2], [0, 0, 0.5, 3], [0, 0, 0, 1]])
        self.assertEqual(len(Mask([])), 0)
        self.assertEqual(repr(mask), "<vdbcage.Mask: 3 voxels>")

    def test_a_dense_box_goes_in_and_out(self):
        array = numpy.random.default_rng(1).random((20, 9, 33)) < 0.5
        array[0, 0, 0] = array[-1, -1, -1] = True
        mask = Mask.from_dense(array, (-5, 0, 7), 2, (0, 0, 1))
        back, corner = mask.dense()
        self.assertTrue(numpy.array_equal(back, array))
        self.assertEqual(corner.tolist(), [-5, 0, 7])
        self.assertEqual(len(mask), array.sum())
        self.assertEqual(Mask.from_dense(numpy.ones((64, 64, 64), "uint8")).voxels()[-1].tolist(), [63, 63, 63])
        self.assertEqual(Mask([]).dense()[0].shape, (0, 0, 0))

    def test_masks_of_any_size_of_voxel(self):
        for size in (1e-90, 1e-7, 0.1, 1e90):
            mask = Mask([[0, 0, 0]], size, (size, 1, 1e9))
            self.assertEqual((mask.voxel_size, mask.origin.tolist()), (size, [size, 1, 1e9]))

    def test_voxels_and_closing_are_those_of_the_command(self):
        model = Mesh.read(BISHOP)
        stages = self.folder / "stages"
        command("make", BISHOP, "-q", "-o", self.folder / "cage.obj", "--resolution", 40, "--close-radius", 0.1,
                "--faces", 100, "--stages", stages)
        solid = voxelize(model, 40)
        self.same(solid, read_vdb(stages / "solid.vdb"))
        pipeline = vdbcage.Pipeline(model)
        self.assertIsNone(pipeline.solid)
        pipeline.run(resolution=40, close_radius=0.1, faces=100)
        self.same(pipeline.solid, solid)
        self.same(pipeline.closed, read_vdb(stages / "closed.vdb"))
        self.same(close_mask(solid, 4), pipeline.closed)  # which has no cavities to fill
        self.same(voxelize(model, 40, voxelizer="cpu", box=[model.points.min(0), model.points.max(0)]), solid)

    def test_a_bowl_is_filled_or_its_wall(self):
        bowl = Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
                    quads=[[0, 3, 2, 1], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
        solid, shell = voxelize(bowl, 20), voxelize(bowl, 20, interior="shell")
        self.same(voxelize(bowl, 20, interior="solid"), solid)
        self.same(voxelize(bowl, 20, interior=None), solid)
        self.assertLess(len(shell), len(solid) / 2)
        self.refuses("interior: 'hollow' is not allowed; it must be one of auto|solid|shell", voxelize, bowl,
                     interior="hollow")

    def test_closing_takes_its_options(self):
        two = Mask([[0, 0, 0], [0, 0, 6]])
        self.assertEqual(len(close_mask(two, 2)), 2)
        self.assertEqual(len(close_mask(two, 3, element="cube")), 7)
        self.assertEqual(len(close_mask(two, 2, 0)), 2 * 33)
        plates = numpy.zeros((21, 21, 7), bool)
        plates[:, :, [0, 6]] = True
        plates = Mask.from_dense(plates)
        self.assertGreater(len(close_mask(plates, 4)), len(plates))
        self.assertEqual(len(close_mask(plates, 4, scale_field="sphere:10,10,3,100,0")), len(plates))

    def test_files_keep_voxels_and_transform(self):
        mask = Mask.from_dense(numpy.ones((30, 20, 10), bool), (1, 2, 3), 0.25, (4, 5, 6))
        write_vdb(mask, self.folder / "mask.vdb", {"source": "test"})
        self.same(read_vdb(self.folder / "mask.vdb"), mask)

    def test_pyopenvdb_takes_and_gives_masks_by_files_and_arrays(self):
        mask = voxelize(Mesh.read(BISHOP), 30)
        path = str(self.folder / "mask.vdb")
        write_vdb(mask, path, {"source": "test"})
        grid = pyopenvdb.read(path, "density")
        self.assertEqual(grid.activeVoxelCount(), len(mask))
        self.assertEqual(grid.metadata["vdbcage_source"], "test")
        array, corner = mask.dense()
        copied = numpy.zeros(array.shape, "float32")
        grid.copyToArray(copied, ijk=tuple(map(int, corner)))
        self.assertTrue(numpy.array_equal(copied == 1, array))
        for kind in (pyopenvdb.BoolGrid, pyopenvdb.FloatGrid):
            other = kind()
            other.name = "density"
            other.copyFromArray(array if kind is pyopenvdb.BoolGrid else array.astype("float32"),
                                ijk=tuple(map(int, corner)))
            other.transform = pyopenvdb.createLinearTransform(voxelSize=mask.voxel_size)
            pyopenvdb.write(path, grids=[other])
            self.assertTrue(numpy.array_equal(read_vdb(path).voxels(), mask.voxels()))
            self.assertEqual(read_vdb(path).voxel_size, mask.voxel_size)

    def test_voxels_of_files_that_are_no_cubes_have_a_matrix(self):
        grid = pyopenvdb.BoolGrid()
        grid.fill((0, 0, 0), (1, 1, 1), True)
        matrix = [[0, 2, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [5, 6, 7, 1]]  # of rows, as OpenVDB has it
        grid.transform = pyopenvdb.createLinearTransform(matrix)
        pyopenvdb.write(str(self.folder / "turned.vdb"), grids=[grid])
        mask = read_vdb(self.folder / "turned.vdb")
        self.assertEqual(mask.matrix.tolist(), numpy.transpose(matrix).tolist())
        self.assertEqual(mask.origin.tolist(), [5, 6, 7])
        self.refuses("voxel_size: the voxels of this mask are no upright cubes", getattr, mask, "voxel_size")

    def test_huge_masks_are_no_arrays(self):
        grid = pyopenvdb.BoolGrid()
        grid.fill((0, 0, 0), (4095, 4095, 4095), True)
        pyopenvdb.write(str(self.folder / "huge.vdb"), grids=[grid])
        mask = read_vdb(self.folder / "huge.vdb")
        self.assertEqual(len(mask), 4096**3)
        self.refuses("mask: it has 68719476736 active voxels", mask.voxels)
        self.refuses("mask: its box is of (4096, 4096, 4096) voxels", mask.dense)

    def test_a_call_can_be_cancelled(self):
        solid = voxelize(Mesh.read(BISHOP), 2048)
        with self.assertRaises(vdbcage.Cancelled):  # closing goes on for sixty times as long as until it is asked
            close_mask(solid, 400, progress=lambda stage, percent: False)

    def test_bad_arguments_are_refused(self):
        model, mask, nan = Mesh.read(BISHOP), Mask([[0, 0, 0]]), float("nan")
        for text, function, *arguments in (
                ("voxels: an array of shape (3,)", Mask, [1, 2, 3]),
                ("voxels: an array of float64", Mask, [[0.5, 0, 0]]),
                ("voxels: row 1 has the index 1073741824", Mask, [[0, 0, 0], [0, 2**30, 0]]),
                ("voxel_size: 0 is not allowed", Mask, [], 0),
                ("voxel_size: nan is not allowed", Mask, [], nan),
                ("voxel_size: True is not allowed", Mask, [], True),
                ("origin: (0, 0) is not allowed", Mask, [], 1, (0, 0)),
                ("origin: (0, 0, nan) is not allowed", Mask, [], 1, (0, 0, nan)),
                ("array: shape (2, 2) of float64", Mask.from_dense, numpy.zeros((2, 2))),
                ("corner: (0, 0, 0.5) is not allowed", Mask.from_dense, numpy.ones((1, 1, 1), bool), (0, 0, 0.5)),
                ("corner: row 0 has the index 1073741824", Mask.from_dense, numpy.ones((1, 1, 1), bool), (2**30, 0, 0)),
                ("voxels: row 1 has the index 1073741824", Mask.from_dense, numpy.ones((2, 1, 1), bool),
                 (2**30 - 1, 0, 0)),
                ("model: a Mask is not allowed", voxelize, mask),
                ("model: it has no faces", voxelize, Mesh([])),
                ("resolution: 0 is not allowed; it must be a whole number, 1 to 4096", voxelize, model, 0),
                ("resolution: 64.0 is not allowed", voxelize, model, 64.0),
                ("mask: a Mesh is not allowed", close_mask, model, 1),
                ("close_radius: 513 is not allowed", close_mask, mask, 513),
                ("close_radius: nan is not allowed", close_mask, mask, nan),
                ("close_radius: 'auto' is not allowed", close_mask, mask, "auto"),
                ("erode_radius: 5 is not allowed; it must be a number, 0 to 4", close_mask, mask, 4, 5),
                ("mask: a str is not allowed", write_vdb, "mask", "a.vdb"),
                ("metadata: {'a': 1} is not allowed", write_vdb, mask, "a.vdb", {"a": 1}),
                ("path: 5 is not a path", read_vdb, 5)):
            with self.subTest(text):
                self.refuses(text, function, *arguments)
        self.refuses("box: [1, 2] is not allowed", voxelize, model, box=[1, 2])
        self.refuses("model: its bounding box is not within the box", voxelize, model, box=[[0, 0, 0], [1, 1, 1]])
        self.refuses("voxelizer: 'gpu' is not allowed; it must be one of auto|cpu|gl|cgal", voxelize, model,
                     voxelizer="gpu")
        self.refuses("element: 'ball' is not allowed; it must be one of sphere|cube", close_mask, mask, 1,
                     element="ball")
        self.refuses("missing.vdb: ", read_vdb, self.folder / "missing.vdb", error=IoError)
        self.refuses("folder", write_vdb, mask, self.folder / "missing" / "mask.vdb", error=IoError)
