"""Coarse cages that are certified to bound a model, and posing by them.

    import vdbcage
    model = vdbcage.Mesh.read("model.obj")
    cage = vdbcage.make_cage(model, faces=400)
    cage.write("cage.obj")

Points are in world space, as files have them. Indices of points begin with 0. Faces are counter-clockwise seen from
outside.

Functions that can take long have an argument `progress`: a function that is called 20 times a second, in the thread of
the caller, with the name of the stage (str) and its percentage (int, 0 where it is not known). Where it returns False
the work ends with Cancelled; what it raises ends the work too, and so does Ctrl-C. Several threads may work at once.
"""

import dataclasses
import difflib
import numbers
import operator
import os
import re

import numpy

__all__ = ["Binding", "Cage", "CageCheck", "Cancelled", "DeviceError", "Error", "InputError", "IoError", "Mesh",
           "Pipeline", "check_cage", "make_cage"]


class Error(Exception):
    """Base of the exceptions that vdbcage raises. The text is one line."""


class InputError(Error, ValueError):
    """An argument is not acceptable. The text names it, its value and what is allowed. Raised before any work."""


class IoError(Error, OSError):
    """A file could not be read or written. The text begins with its path."""


class DeviceError(Error):
    """A device, such as an OpenGL context, is missing or failed."""


class Cancelled(Error):
    """`progress` returned False. Nothing was written and there is no partial result."""


from . import _vdbcage  # noqa: E402 (it raises the exceptions above)

__version__ = _vdbcage.version


def _array(name, value, columns, kinds, content):
    """`value` as an array of shape (n, columns) whose dtype is of one of `kinds`; nothing at all is n = 0."""
    try:
        array = numpy.asarray(() if value is None else value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    if array.ndim in (1, 2) and array.shape[0] == 0:
        return numpy.empty((0, columns), numpy.float64 if "f" in kinds else numpy.uint32)
    if array.ndim != 2 or array.shape[1] != columns:
        raise InputError(f"{name}: an array of shape {array.shape} is not allowed; it must be (n, {columns})")
    if array.dtype.kind not in kinds:
        raise InputError(f"{name}: an array of {array.dtype} is not allowed; it must be {content}")
    return array


def _points(name, value, count=None, owner=""):
    """Finite points as an array of shape (n, 3); n is `count`, which `owner` has, if that is given."""
    array = _array(name, value, 3, "fiu", "numbers")
    if count is not None and len(array) != count:
        raise InputError(f"{name}: it has {len(array)} rows; {owner} has {count} points")
    if array.dtype.kind == "f":
        if array.dtype.itemsize > 8:
            with numpy.errstate(over="ignore"):  # what is too large is infinite, and refused below
                array = array.astype(numpy.float64)
        finite = numpy.isfinite(array)
        if not finite.all():
            row, column = numpy.argwhere(~finite)[0]
            raise InputError(f"{name}: row {row} has the coordinate {array[row, column]}; it must be finite")
    return array


def _indices(name, value, corners, count):
    """Faces as an array of shape (n, corners) of indices below `count`."""
    array = _array(name, value, corners, "iu", "whole numbers")
    outside = (array < 0) | (array >= count)
    if outside.any():
        row, column = numpy.argwhere(outside)[0]
        allowed = f"it must be 0 to {count - 1}" if count else "there are no points"
        raise InputError(f"{name}: row {row} has the index {array[row, column]}; {allowed}")
    return array


def _path(value):
    """The bytes of a path."""
    try:
        path = os.fsencode(value)
    except (TypeError, UnicodeError):
        raise InputError(f"path: {value!r} is not a path") from None
    if b"\0" in path:
        raise InputError(f"path: {value!r} has a null character")
    return path


def _mesh(name, value):
    if not isinstance(value, Mesh):
        raise InputError(f"{name}: a {type(value).__name__} is not allowed; it must be a vdbcage.Mesh")
    return value._mesh


def _callback(value):
    if value is not None and not callable(value):
        raise InputError(f"progress: {value!r} is not allowed; it must be None or a function of (stage, percent)")
    return value


def _option_text(name, value, allowed):
    """An option's value as the command takes it. `allowed` is as in its help: "auto|N", "on|off"."""
    names = allowed.split("|")
    if value is None:
        return "auto" if "auto" in names else "none" if name == "scale_field" else "None"
    if isinstance(value, (bool, numpy.bool_)):
        return ("on" if value else "off") if "on" in names else str(value)
    if isinstance(value, numbers.Integral):
        return str(operator.index(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return os.fsdecode(value)
    raise InputError(f"{name}: {value!r} is not allowed; it must be a number, a string, True, False or None")


def _option_texts(options):
    known = {name.replace("-", "_"): (name, allowed) for name, allowed in _vdbcage.options()}
    texts = []
    for name, value in options.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            hint = f"did you mean {near[0]}?" if near else f"there are: {', '.join(known)}"
            raise InputError(f"{name}: there is no such option; {hint}")
        texts.append((known[name][0], _option_text(name, value, known[name][1])))
    return texts


def _in_python(text):
    """A message with the names that options have here: close_radius for --close-radius."""
    names = "|".join(name for name, allowed in _vdbcage.options())
    return re.sub(rf"(^| )--({names})(?=:| |$)", lambda found: found[1] + found[2].replace("-", "_"), text)


class Mesh:
    """Points, and faces of three or four corners. It never changes.

    points: array-like of numbers, shape (n, 3): world space, finite
    triangles, quads: array-likes of whole numbers, shapes (n, 3) and (n, 4): indices of points
    Raises InputError with the argument, the row and the value.
    """

    __slots__ = ("_mesh",)

    def __init__(self, points, triangles=None, quads=None):
        points = _points("points", points)
        self._mesh = _vdbcage.Mesh(points, _indices("triangles", triangles, 3, len(points)),
                                   _indices("quads", quads, 4, len(points)))

    @classmethod
    def _of(cls, mesh):
        """What the core made."""
        self = cls.__new__(cls)
        self._mesh = mesh
        return self

    @classmethod
    def read(cls, path):
        """Reads an OBJ, OFF, PLY or STL file.

        Faces of more than four corners are split. Cages bound them in every way they can be split, also where another
        program splits them otherwise. A mesh that is made anew from these arrays does not know these other ways.
        Raises IoError.
        """
        return Mesh._of(_vdbcage.read_mesh(_path(path)))

    def write(self, path):
        """Writes an OBJ, OFF, PLY or STL file; the extension says which. It appears whole or not at all.

        Raises IoError; InputError if the mesh has no usable face.
        """
        _vdbcage.write_mesh(self._mesh, _path(path))

    @property
    def points(self):
        """float64, shape (n, 3), read-only: world space. No copy."""
        return self._mesh.points

    @property
    def triangles(self):
        """uint32, shape (n, 3), read-only: indices of points. No copy."""
        return self._mesh.triangles

    @property
    def quads(self):
        """uint32, shape (n, 4), read-only: indices of points. No copy."""
        return self._mesh.quads

    def __len__(self):
        """The number of faces."""
        return len(self.triangles) + len(self.quads)

    def __bool__(self):
        return True

    def __repr__(self):
        return (f"<vdbcage.{type(self).__name__}: {len(self.points)} points, {len(self.triangles)} triangles, "
                f"{len(self.quads)} quads>")


@dataclasses.dataclass(frozen=True)
class CageCheck:
    """The verdict on a cage. Answers and counts are exact, measures are rounded.

    Lengths are fractions of the longest side of the model's bounding box. Faces are numbered triangles first.
    vdbcage/check/check.h says more of each field.
    """

    valid: bool  # closed, manifold, oriented, without degenerate faces and self-intersections
    bounding: bool  # valid, no contact with the model, every vertex of the model strictly inside
    closed: bool
    manifold: bool
    oriented: bool
    points: int
    triangles: int
    quads: int
    components: int
    genus: int
    boundary_edges: int
    non_manifold_edges: int
    non_manifold_vertices: int
    misoriented_edges: int
    inward_components: int
    degenerate_faces: int
    self_intersections: int
    contact_faces: int
    model_vertices_outside: int
    bad_faces: tuple
    diagonal: float  # of the model's bounding box
    mean_distance: float
    max_distance: float
    min_distance: float
    cage_volume: float  # world units cubed
    volume_ratio: float  # of the cage to the model
    min_angle_degrees: float
    angle_1st_percentile_degrees: float
    median_angle_degrees: float


class Cage(Mesh):
    """A mesh that make_cage or Pipeline.run made, with its verdict and its report."""

    __slots__ = ("_check", "_report")

    def __init__(self, *args, **kwargs):
        raise TypeError("a vdbcage.Cage comes from make_cage")

    @classmethod
    def _made(cls, mesh, check, report):
        self = cls._of(mesh)
        self._check = CageCheck(**check)
        self._report = report
        return self

    @property
    def check(self):
        """The CageCheck of this cage against its model."""
        return self._check

    @property
    def report(self):
        """How the cage came about, a dict.

        options: every option, as text; seconds: wall clock; stages: the seconds of each stage; and what
        `vdbcage make --report` has under "result": resolution, close_radius, start, float_safe and more.
        """
        return self._report


def make_cage(model, /, *, progress=None, **options):
    """Makes a cage around a model, certified to bound it, and returns it as a Cage.

    model: a Mesh of any kind: open, self-intersecting, badly oriented, in many parts
    progress: see the help of vdbcage
    options: those of `vdbcage make`, with underscores: faces=400, close_radius=0.02, mesh="triquad", bounding=False.
        None stands for auto. Lengths are fractions of the model's longest side. docs/OPTIONS.md has all of them.
    Raises InputError, DeviceError, Cancelled.
    """
    texts, progress = _option_texts(options), _callback(progress)
    return _run(_vdbcage.Pipeline(_mesh("model", model)), texts, progress)


def _run(pipeline, texts, progress):
    try:
        mesh, check, report = pipeline.run(texts, progress)
    except InputError as error:
        raise InputError(_in_python(str(error))) from None
    report["options"] = {name.replace("-", "_"): text for name, text in report["options"].items()}
    return Cage._made(mesh, check, report)


class Pipeline:
    """Makes one cage after another around a model, and keeps what is between them.

    A run begins with the first stage that its options touch: another face count needs no new voxels. One thread at a
    time can use a pipeline.

    model: a Mesh, as for make_cage
    """

    __slots__ = ("_model", "_pipeline")

    def __init__(self, model):
        self._pipeline = _vdbcage.Pipeline(_mesh("model", model))
        self._model = model

    def run(self, *, progress=None, **options):
        """The Cage for these options, as make_cage gives it.

        A run that raises leaves the surfaces and masks of the last one that did not.
        """
        texts, progress = _option_texts(options), _callback(progress)
        return _run(self._pipeline, texts, progress)

    @property
    def model(self):
        """The Mesh that the pipeline was made with."""
        return self._model

    @property
    def surface(self):
        """What the last cage was made from, a Mesh of quads; None before the first run."""
        return self._stage("surface")

    @property
    def smoothed(self):
        """Without bounding: the surface, smoothed; else the surface. None before the first run."""
        return self._stage("smoothed")

    @property
    def decimated(self):
        """The last cage before it was tightened, a Mesh; None before the first run."""
        return self._stage("decimated")

    def _stage(self, name):
        mesh = self._pipeline.mesh(name)
        return None if mesh is None else Mesh._of(mesh)


def check_cage(cage, model, *, as_floats=False, measure=True, samples=20000, progress=None):
    """Examines any mesh as a cage of any model and returns a CageCheck.

    cage, model: Mesh
    as_floats: both meshes are examined with their points rounded to float
    measure: False leaves the measures at 0, which is faster
    samples: points on the cage for the distances, 1 to 10**9
    Raises InputError, Cancelled.
    """
    try:
        samples = operator.index(samples)
    except TypeError:
        samples = repr(samples)
    if isinstance(samples, str) or not 1 <= samples <= 10**9:
        raise InputError(f"samples: {samples} is not allowed; it must be a whole number, 1 to 1000000000")
    return CageCheck(**_vdbcage.check_cage(_mesh("cage", cage), _mesh("model", model), bool(as_floats), bool(measure),
                                           samples, _callback(progress)))


class Binding:
    """Points bound to a cage, which moves them.

    cage: a Mesh, closed and facing outward
    points: array-like, shape (n, 3): world space
    coordinates: "mvc" (mean value), "green" or "mlc" (maximum likelihood); see docs/DEFORMING.md
    Raises InputError; Cancelled.
    """

    __slots__ = ("_binding", "_cage")

    def __init__(self, cage, points, coordinates="mvc", *, progress=None):
        if not isinstance(coordinates, str):
            raise InputError(f"coordinates: {coordinates!r} is not allowed; it must be a string")
        self._binding = _vdbcage.Binding(_mesh("cage", cage), _points("points", points), coordinates,
                                         _callback(progress))
        self._cage = cage

    @classmethod
    def read(cls, path, cage, points):
        """Reads weights of `vdbcage bind` or write() for the same cage and points, or a matrix made elsewhere.

        path: .npy, or .dmat of libigl
        A matrix has a row a point and a column a point of the cage; its coordinates are "given".
        Raises IoError, also where the file was made for another cage or other points.
        """
        self = cls.__new__(cls)
        self._binding = _vdbcage.read_binding(_path(path), _mesh("cage", cage), _points("points", points))
        self._cage = cage
        return self

    def write(self, path, *, progress=None):
        """Writes the file that `vdbcage bind` writes. The weights are computed for it, as by weights().

        Raises IoError; InputError for given weights; Cancelled.
        """
        path = _path(path)
        self._require_computed()
        self._binding.write(path, _callback(progress))

    def weights(self, *, progress=None):
        """float32, shape (points, handles): how much each handle moves each point.

        The binding holds them compressed, so they are computed anew, which takes as long as binding. The handles are
        the cage's points; for "green" normals follow, one a triangle and four a quad.
        Raises InputError for given weights; Cancelled.
        """
        self._require_computed()
        return self._binding.weights(_callback(progress))

    def pose(self, cage_points):
        """Where the points are when those of the cage are at `cage_points`: float64, shape (n, 3).

        cage_points: array-like, shape (points of the cage, 3)
        Raises InputError.
        """
        return self._binding.pose(self._cage_points("cage_points", cage_points))

    def update(self, posed, before, after):
        """Where points that the cage at `before` posed are when it is at `after`: float64, shape (n, 3).

        This is faster than pose() where few points of the cage moved. Each update rounds to 1e-7 of the motion.

        posed: array-like, shape (n, 3), from pose() or update(); it stays as it is
        before, after: array-likes, shape (points of the cage, 3)
        Raises InputError.
        """
        return self._binding.update(_points("posed", posed, len(self.points), "the binding"),
                                    self._cage_points("before", before), self._cage_points("after", after))

    @property
    def cage(self):
        """The Mesh that moves the points."""
        return self._cage

    @property
    def points(self):
        """The points at rest: float64, shape (n, 3), read-only. No copy."""
        return self._binding.points

    @property
    def coordinates(self):
        """The family: "mvc", "green", "mlc" or "given"."""
        return self._binding.coordinates

    @property
    def handles(self):
        """The number of weights a point."""
        return self._binding.handles

    def _cage_points(self, name, value):
        return _points(name, value, len(self._cage.points), "the cage")

    def _require_computed(self):
        if self.coordinates == "given":
            raise InputError("weights: those of this binding were made elsewhere and are kept compressed; "
                             "their file has them")

    def __repr__(self):
        return f"<vdbcage.Binding: {len(self.points)} points, {self.handles} handles, {self.coordinates}>"
