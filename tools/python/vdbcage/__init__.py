"""Coarse cages that are certified to bound a model, and posing by them.

    import vdbcage
    model = vdbcage.Mesh.read("model.obj")
    cage = vdbcage.make_cage(model, faces=400)
    cage.write("cage.obj")

Points are in world space, as files have them. Indices of points begin with 0. Faces are counter-clockwise seen from
outside.

Functions that can take long have an argument `progress`: a function that is called 20 times a second, in the thread of
the caller, with the name of the stage (str) and how far the whole call is, in percent (int, 0 to 99, never less than
before). Where it returns False the work ends with Cancelled. An exception that it raises ends the work too, and so does
Ctrl-C. Several threads may work at once.
"""

from __future__ import annotations

import contextlib
import dataclasses
import difflib
import math
import numbers
import operator
import os
import re
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal

import numpy

__all__ = ["Binding", "Cage", "CageCheck", "Cancelled", "DeviceError", "Elasticity", "Error", "Family", "InputError",
           "IoError", "Mask", "Mesh", "Pipeline", "check_cage", "close_mask", "coordinate_families", "fit_cage",
           "make_cage", "posed_points", "predicted_memory", "read_vdb", "voxelize", "write_vdb"]

if TYPE_CHECKING:
    import numpy.typing as npt

    _Path = str | bytes | os.PathLike[str] | os.PathLike[bytes]
    _Progress = Callable[[str, int], object] | None
    _Option = bool | float | str | os.PathLike[str] | None
    _Points = npt.NDArray[numpy.float64]


class Error(Exception):
    """Base of the exceptions that vdbcage raises. The text is one line."""


class InputError(Error, ValueError):
    """An argument is not acceptable. The text names it, its value and the allowed values. Raised before any work."""


class IoError(Error, OSError):
    """A file could not be read or written. The text begins with its path."""


class DeviceError(Error):
    """A device, such as an OpenGL context, is missing or failed."""


class Cancelled(Error):
    """`progress` returned False. Nothing was written and there is no partial result."""


from . import _arguments, _vdbcage  # type: ignore[attr-defined]  # noqa: E402 (they raise the exceptions above)

__version__ = _vdbcage.version


def _mask(name, value):
    if not isinstance(value, Mask):
        raise InputError(f"{name}: a {type(value).__name__} is not allowed; it must be a vdbcage.Mask")
    return value._mask


def _mesh(name, value):
    if not isinstance(value, Mesh):
        raise InputError(f"{name}: a {type(value).__name__} is not allowed; it must be a vdbcage.Mesh")
    return value._mesh


def _option_text(name, value, allowed):
    """Returns an option's value as the command takes it. `allowed` is as in its help: "auto|N", "on|off"."""
    names = allowed.split("|")
    if value is None:
        return "auto" if "auto" in names else "none" if name in ("scale_field", "density", "joints") else "None"
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


@contextlib.contextmanager
def _names_of_python():
    """Puts the names that options have here into messages: close_radius for --close-radius."""
    try:
        yield
    except InputError as error:
        names = "|".join(name for name, allowed in _vdbcage.options())
        text = re.sub(rf"(^| )--({names})(?=:| |$)", lambda found: found[1] + found[2].replace("-", "_"), str(error))
        raise InputError(text) from None


class Mesh:
    """Points, and faces of three or four corners. It never changes.

    points: array-like of numbers, shape (n, 3): world space, finite
    triangles: array-like of whole numbers, shape (n, 3): indices of points; None for no triangles
    quads: array-like of whole numbers, shape (n, 4): indices of points; None for no quads
    Raises InputError, which names the argument, the row and the value.
    """

    __slots__ = ("_mesh",)

    def __init__(self, points: npt.ArrayLike, triangles: npt.ArrayLike | None = None,
                 quads: npt.ArrayLike | None = None) -> None:
        places = _arguments.points("points", points)
        self._mesh = _vdbcage.Mesh(places, _arguments.indices("triangles", triangles, 3, len(places)),
                                   _arguments.indices("quads", quads, 4, len(places)))

    @classmethod
    def _of(cls, mesh):
        """Returns a mesh that the core made."""
        self = cls.__new__(cls)
        self._mesh = mesh
        return self

    @classmethod
    def read(cls, path: _Path) -> Mesh:
        """Reads an OBJ, OFF, PLY or STL file.

        Faces of more than four corners are split. Cages bound them under their other splits too, as another program may
        split them. A mesh that is made again from these arrays does not know the other splits.

        path: .obj, .off, .ply or .stl
        Warns (UserWarning) of deviations of the file from its format. Raises IoError.
        """
        mesh, told = _vdbcage.read_mesh(_arguments.path(path))
        for warning in told:
            warnings.warn(f"{os.fsdecode(path)}: {warning}", stacklevel=2)
        return Mesh._of(mesh)

    def write(self, path: _Path) -> None:
        """Writes an OBJ, OFF, PLY or STL file. It appears whole or not at all.

        path: .obj, .off, .ply or .stl
        Raises IoError; InputError if the mesh has no usable face.
        """
        _vdbcage.write_mesh(self._mesh, _arguments.path(path))

    @property
    def points(self) -> _Points:
        """The points: float64, shape (n, 3), read-only, world space. No copy."""
        return self._mesh.points

    @property
    def triangles(self) -> npt.NDArray[numpy.uint32]:
        """The triangles: uint32, shape (n, 3), read-only, indices of points. No copy."""
        return self._mesh.triangles

    @property
    def quads(self) -> npt.NDArray[numpy.uint32]:
        """The quads: uint32, shape (n, 4), read-only, indices of points. No copy."""
        return self._mesh.quads

    @property
    def loose_points(self) -> npt.NDArray[numpy.uint32]:
        """The indices of the points that no face uses, ascending: uint32, shape (n,). These points bound nothing."""
        return _vdbcage.loose_points(self._mesh)

    def __len__(self) -> int:
        """Returns the number of faces."""
        return len(self.triangles) + len(self.quads)

    def __bool__(self) -> bool:
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
    loose_points: int  # of the model, that no face uses; the verdict is not about them
    loose_points_outside: int
    bad_faces: tuple[int, ...]
    longest_side: float  # of the model's bounding box, world units
    diagonal: float  # of the same
    mean_distance: float
    max_distance: float
    min_distance: float
    cage_volume: float  # world units cubed
    volume_ratio: float  # of the cage to the model
    min_angle_degrees: float
    angle_1st_percentile_degrees: float
    median_angle_degrees: float


class Cage(Mesh):
    """A mesh that make_cage, Pipeline.run or fit_cage made, with its verdict and its report."""

    __slots__ = ("_check", "_report")
    _check: CageCheck
    _report: dict[str, Any]

    def __init__(self, *args: object, **kwargs: object) -> None:
        raise TypeError("a vdbcage.Cage comes from make_cage or fit_cage")

    @classmethod
    def _made(cls, mesh, check, report):
        self = cls._of(mesh)
        self._check = CageCheck(**check)
        self._report = report
        return self

    def write(self, path: _Path) -> None:
        """Writes the cage as Mesh.write() does, but only to a file that holds its points as they were certified.

        path: .obj, .off or .ply; .stl, which holds float32, for cages of make_cage(..., precision="float32")
        Raises InputError where the points would be rounded; IoError.
        """
        path = _arguments.path(path)
        if not _vdbcage.is_held(self._mesh, path):
            raise InputError(f"{os.fsdecode(path)}: its file would hold float32, and the cage was certified in float64; write .obj, "
                             ".off or .ply, or make it with precision='float32'")
        super().write(path)

    @property
    def check(self) -> CageCheck:
        """The CageCheck of this cage against its model."""
        return self._check

    @property
    def report(self) -> dict[str, Any]:
        """The account of how the cage came about, a dict.

        options: every option as asked for; seconds: wall clock; stages: the seconds of each stage; and all that
        `vdbcage make --report` has under "result": resolution, close_radius, start, float_safe and more.
        """
        return self._report


def make_cage(model: Mesh, /, *, progress: _Progress = None, **options: _Option) -> Cage:
    """Makes a cage around a model, certified to bound it, and returns it as a Cage.

    model: a Mesh of any kind: open, self-intersecting, badly oriented, in many parts
    progress: see the help of vdbcage
    options: those of `vdbcage make`, with underscores: faces=400, close_radius=0.02, mesh="triquad", bounding=False.
        None stands for auto. Lengths are fractions of the model's longest side. OPTIONS.md has all of them. With
        bounding=False the cage is not certified.
    Raises InputError, DeviceError, Cancelled; IoError for a file that an option names.
    """
    texts, progress = _option_texts(options), _arguments.callback(progress)
    return _run(_vdbcage.Pipeline(_mesh("model", model)), texts, progress)


def predicted_memory(model: Mesh, /, *, progress: _Progress = None, **options: _Option) -> int:
    """Returns about the most bytes that the command takes to make this cage, before it is made.

    A program takes as much on top of its own memory, or a little less.

    model: as for make_cage
    progress: as for make_cage
    options: as for make_cage
    Raises InputError, Cancelled; IoError for a file that an option names.
    """
    texts, progress = _option_texts(options), _arguments.callback(progress)
    with _names_of_python():
        return _vdbcage.predicted_memory(_mesh("model", model), texts, progress)


def _run(pipeline, texts, progress):
    with _names_of_python():
        mesh, check, report = pipeline.run(texts, progress)
    report["options"] = {name.replace("-", "_"): text for name, text in report["options"].items()}
    return Cage._made(mesh, check, report)


class Pipeline:
    """A pipeline that makes one cage after another around a model, and keeps the stages between.

    A run begins with the first stage that its options touch: another face count needs no new voxels. One thread at a
    time can use a pipeline.

    model: a Mesh, as for make_cage
    Raises InputError if it has no usable face.
    """

    __slots__ = ("_model", "_pipeline")

    def __init__(self, model: Mesh) -> None:
        self._pipeline = _vdbcage.Pipeline(_mesh("model", model))
        self._model = model

    def run(self, *, progress: _Progress = None, **options: _Option) -> Cage:
        """Makes the cage for some options and returns it as a Cage, as make_cage does.

        A run that raises leaves the surfaces and masks of the last one that did not.

        progress: as for make_cage
        options: as for make_cage
        Raises the exceptions of make_cage; Error if another call is running this pipeline.
        """
        texts, progress = _option_texts(options), _arguments.callback(progress)
        return _run(self._pipeline, texts, progress)

    @property
    def model(self) -> Mesh:
        """The Mesh that the pipeline was made with."""
        return self._model

    @property
    def solid(self) -> Mask | None:
        """The voxels of the model, a Mask; None before the first run."""
        return self._mask("solid")

    @property
    def closed(self) -> Mask | None:
        """Their closing, with cavities filled, a Mask; None before the first run."""
        return self._mask("closed")

    @property
    def surface(self) -> Mesh | None:
        """The surface that the last cage was made from, a Mesh; None before the first run.

        It has quads, or the triangles of a tetrahedron or of a box.
        """
        return self._stage("surface")

    @property
    def smoothed(self) -> Mesh | None:
        """The last cage, smoothed; without bounding the smoothed surface. A Mesh; None before the first run."""
        return self._stage("smoothed")

    @property
    def decimated(self) -> Mesh | None:
        """The surface with fewer faces, a Mesh; None before the first run.

        It is the last cage before it was tightened, or for loops before smoothing.
        """
        return self._stage("decimated")

    def _mask(self, name):
        mask = self._pipeline.mask(name)
        return None if mask is None else Mask._of(mask)

    def _stage(self, name):
        mesh = self._pipeline.mesh(name)
        return None if mesh is None else Mesh._of(mesh)


def check_cage(cage: Mesh, model: Mesh, *, least_part: float = 0, as_floats: bool = False, measure: bool = True,
               samples: int = 20000, progress: _Progress = None) -> CageCheck:
    """Examines any mesh as a cage of any model and returns a CageCheck.

    cage: a Mesh
    model: a Mesh
    least_part: leaves out parts of the model smaller than so much of the largest, 0 to 1, as make_cage does
    as_floats: both meshes are examined with their points rounded to float
    measure: False leaves the measures at 0, which is faster
    samples: points on the cage for the distances, 1 to 10**9
    progress: see the help of vdbcage
    Raises InputError, Cancelled.
    """
    samples = _arguments.whole("samples", samples, 1, 10**9)
    least_part = _arguments.number("least_part", least_part, 0, 1)
    return CageCheck(**_vdbcage.check_cage(_mesh("cage", cage), _mesh("model", model), least_part, bool(as_floats),
                                           bool(measure), samples, _arguments.callback(progress)))


def fit_cage(cage: Mesh, model: Mesh, /, *, tight: float = 0.5, keep: npt.ArrayLike | None = None,
             most: float = math.inf, place: Literal["box", "turn"] | None = None, progress: _Progress = None) -> Cage:
    """Moves the points of a cage that somebody drew until it is certified to bound a model, and returns it as a Cage.

    It has the points and faces of the cage in their order; only positions differ. Its report has the way of each point
    in world units, "ways", and their number, "moved_points".

    cage: a Mesh, closed and 2-manifold once its seams are closed; it may cut the model and cross itself
    model: a Mesh, as for make_cage
    tight: 0 moves only points that have to move, 1 is tightest; between them distance is traded against the drawn shape
    keep: indices of points that stay where they are, an array of shape (n,)
    most: no point goes farther, as a share of the longest side of the model's box, 0 or more
    place: "box" first scales and moves the cage into the model's box; "turn" turns it by multiples of 90 degrees, too
    progress: see the help of vdbcage
    Raises InputError if the cage is no closed 2-manifold, or no place was found where it bounds; Cancelled.
    """
    tight = _arguments.number("tight", tight, 0, 1)
    mesh = _mesh("cage", cage)
    keep = _arguments.places("keep", keep, len(cage.points))
    most = _arguments.number("most", most, 0, math.inf)
    if place not in (None, "box", "turn"):
        raise InputError(f"place: {place!r} is not allowed; it must be 'box' or 'turn'")
    with _names_of_python():
        fitted, check = _vdbcage.fit_cage(mesh, _mesh("model", model), tight, keep, most, place or "",
                                          _arguments.callback(progress))
    ways = numpy.linalg.norm(fitted.points - cage.points, axis=1)
    return Cage._made(fitted, check, {"ways": ways.tolist(), "moved_points": int((ways > 0).sum())})


@dataclasses.dataclass(frozen=True)
class Family:
    """Facts about a family of coordinates: one of coordinate_families()."""

    name: str  #: as Binding takes it
    title: str
    what: str  #: its effect on the model
    paper: str
    everywhere: bool  #: else the points must be inside the cage or on it
    resolution: bool  #: whether Binding takes one for it
    elasticity: bool  #: whether Binding takes one for it


def coordinate_families() -> list[Family]:
    """Returns the families of coordinates that can be computed: a list of Family."""
    return [Family(*values) for values in _vdbcage.coordinate_families()]


def _require_fact(fact, coordinates):
    names = [family.name for family in coordinate_families() if getattr(family, fact)]
    if coordinates not in names:
        raise InputError(f"{fact}: only {', '.join(names)} coordinates have it; these are {coordinates}")


@dataclasses.dataclass(frozen=True)
class Elasticity:
    """The material of Somigliana coordinates. It acts in poses, not in weights.

    nu: Poisson's ratio, above -1 and below 0.5: how much it gets thinner where it is stretched
    rotations: "global", or "local" where parts turn by more than a quarter turn from the mean
    local_bulging: how much it bulges where the cage's normals come to spread more, 0 to 100
    global_bulging: how much it bulges where the cage moves outward, 0 to 100
    """

    nu: float = 0.0
    rotations: str = "global"
    local_bulging: float = 0.0
    global_bulging: float = 0.0

    def _values(self):
        if not isinstance(self.rotations, str):
            raise InputError(f"rotations: {self.rotations!r} is not allowed; it must be a string")
        return (_arguments.number("nu", self.nu, -1, 0.5), self.rotations,
                _arguments.number("local_bulging", self.local_bulging, 0, 100),
                _arguments.number("global_bulging", self.global_bulging, 0, 100))


def _elasticity(value):
    if not isinstance(value, Elasticity):
        raise InputError(f"elasticity: {value!r} is not allowed; it must be an Elasticity")
    return value._values()


class Binding:
    """Points bound to a cage, which moves them.

    cage: a Mesh, closed and facing outward
    points: array-like, shape (n, 3): world space
    coordinates: the name of one of coordinate_families(); see DEFORMING.md
    resolution: voxels along the cage, 4 to 256; only of harmonic coordinates; None for 64
    elasticity: an Elasticity; only of Somigliana coordinates; None for Elasticity()
    loose: indices of points that need no coordinates of the family, such as a model's loose_points; None for none
    loose_motion: "ride": by mean value coordinates where the family is not defined; "stay": not at all
    progress: see the help of vdbcage
    Raises InputError, Cancelled.
    """

    __slots__ = ("_binding", "_cage")

    def __init__(self, cage: Mesh, points: npt.ArrayLike, coordinates: str = "mvc", *, resolution: int | None = None,
                 elasticity: Elasticity | None = None, loose: npt.ArrayLike | None = None, loose_motion: str = "ride",
                 progress: _Progress = None) -> None:
        if not isinstance(coordinates, str):
            raise InputError(f"coordinates: {coordinates!r} is not allowed; it must be a string")
        for fact, value in (("resolution", resolution), ("elasticity", elasticity)):
            if value is not None:
                _require_fact(fact, coordinates)
        if not isinstance(loose_motion, str):
            raise InputError(f"loose_motion: {loose_motion!r} is not allowed; it must be a string")
        places = _arguments.points("points", points)
        self._binding = _vdbcage.Binding(_mesh("cage", cage), places, coordinates,
                                         _arguments.whole("resolution", 64 if resolution is None else resolution,
                                                          4, 256),
                                         _elasticity(Elasticity() if elasticity is None else elasticity),
                                         _arguments.places("loose", loose, len(places)), loose_motion,
                                         _arguments.callback(progress))
        self._cage = cage

    @classmethod
    def read(cls, path: _Path, cage: Mesh, points: npt.ArrayLike) -> Binding:
        """Reads weights of `vdbcage bind` or write(), or a matrix made elsewhere, and returns a Binding.

        path: .npy, or .dmat of libigl; a matrix has a row a point and a column a point of the cage, and its coordinates
            are "given"
        cage: the Mesh that the file was made for
        points: array-like, shape (n, 3): those that the file was made for
        Raises IoError, also where the file was made for another cage or other points; InputError.
        """
        self = cls.__new__(cls)
        self._binding = _vdbcage.read_binding(_arguments.path(path), _mesh("cage", cage),
                                              _arguments.points("points", points))
        self._cage = cage
        return self

    def with_elasticity(self, elasticity: Elasticity) -> Binding:
        """Returns this Binding with another material; no weights are computed.

        elasticity: an Elasticity
        Raises InputError, also for other than Somigliana coordinates.
        """
        _require_fact("elasticity", self.coordinates)
        other = type(self).__new__(type(self))
        other._binding = self._binding.with_elasticity(_elasticity(elasticity))
        other._cage = self._cage
        return other

    def write(self, path: _Path, *, progress: _Progress = None) -> None:
        """Writes the file that `vdbcage bind` writes. The weights are computed for it, as by weights().

        path: .npy
        progress: see the help of vdbcage
        Raises IoError; InputError for given weights; Cancelled.
        """
        path = _arguments.path(path)
        self._require_computed()
        self._binding.write(path, _arguments.callback(progress))

    def weights(self, *, progress: _Progress = None) -> npt.NDArray[numpy.float32]:
        """Computes how much each handle moves each point: float32, shape (points, handles).

        The binding holds them compressed, so they are computed again, which takes as long as binding. The handles are
        the cage's points. For "green" normals follow, one a triangle and four a quad; for "biharmonic" one a triangle
        and two a quad; for "somigliana" six numbers a triangle and twelve a quad.

        progress: see the help of vdbcage
        Raises InputError for given weights; Cancelled.
        """
        self._require_computed()
        return self._binding.weights(_arguments.callback(progress))

    def pose(self, cage_points: npt.ArrayLike) -> _Points:
        """Returns the points posed by the cage: float64, shape (n, 3).

        cage_points: array-like, shape (points of the cage, 3): where the cage's points are in the pose
        Raises InputError.
        """
        return self._binding.pose(self._cage_points("cage_points", cage_points))

    def update(self, posed: npt.ArrayLike, before: npt.ArrayLike, after: npt.ArrayLike) -> _Points:
        """Returns posed points moved to another pose of the cage: float64, shape (n, 3).

        This is faster than pose() where few points of the cage moved. Each update rounds to about 1e-7 of the motion.

        posed: array-like, shape (n, 3), from pose() or update(); it stays as it is
        before: array-like, shape (points of the cage, 3): the pose that `posed` is of
        after: array-like, shape (points of the cage, 3): the pose to move to
        Raises InputError.
        """
        return self._binding.update(_arguments.points("posed", posed, len(self.points), "the binding"),
                                    self._cage_points("before", before), self._cage_points("after", after))

    @property
    def cage(self) -> Mesh:
        """The Mesh that moves the points."""
        return self._cage

    @property
    def points(self) -> _Points:
        """The points at rest: float64, shape (n, 3), read-only. No copy."""
        return self._binding.points

    @property
    def coordinates(self) -> str:
        """The name of the family, one of coordinate_families() or "given"."""
        return self._binding.coordinates

    @property
    def elasticity(self) -> Elasticity:
        """The Elasticity, which acts if the coordinates are Somigliana's."""
        return Elasticity(*self._binding.elasticity)

    @property
    def handles(self) -> int:
        """The number of weights a point."""
        return self._binding.handles

    def _cage_points(self, name, value):
        return _arguments.points(name, value, len(self._cage.points), "the cage")

    def _require_computed(self):
        if self.coordinates == "given":
            raise InputError("weights: those of this binding were made elsewhere and are kept compressed; "
                             "their file has them")

    def __repr__(self):
        return f"<vdbcage.Binding: {len(self.points)} points, {self.handles} handles, {self.coordinates}>"


def posed_points(cage: Mesh, posed: Mesh) -> _Points:
    """Returns the points of a posed cage that another program wrote, in the cage's order: float64, shape (n, 3).

    The faces tell the order of the points. Arrays have no faces, so Binding.pose() and Binding.update() trust the order
    of theirs.

    cage: the Mesh at rest
    posed: a Mesh with the cage's faces, in any order; its points may be in another order too
    Raises InputError where the faces are not the cage's, or points in another order fit in several ways.
    """
    return _vdbcage.posed_points(_mesh("cage", cage), _mesh("posed", posed))


class Mask:
    """A set of voxels, sparse, and where they are in the world. It never changes.

    voxels: array-like of whole numbers, shape (n, 3): indices i, j, k of the active voxels, -2**30 to 2**30 - 1
    voxel_size: world units, 1e-100 to 1e100
    origin: array-like, shape (3,): world position of the centre of the voxel 0, 0, 0
    Raises InputError.
    """

    __slots__ = ("_mask",)

    def __init__(self, voxels: npt.ArrayLike, voxel_size: float = 1.0,
                 origin: npt.ArrayLike = (0.0, 0.0, 0.0)) -> None:
        self._mask = _vdbcage.Mask(_arguments.voxels("voxels", voxels),
                                   _arguments.number("voxel_size", voxel_size, 1e-100, 1e100),
                                   _arguments.rows("origin", origin, (3,), "fiu", "three finite numbers").tolist())

    @classmethod
    def _of(cls, mask):
        """Returns a mask that the core made."""
        self = cls.__new__(cls)
        self._mask = mask
        return self

    @classmethod
    def from_dense(cls, array: npt.ArrayLike, corner: npt.ArrayLike = (0, 0, 0), voxel_size: float = 1.0,
                   origin: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Mask:
        """Returns the Mask of those voxels of a box that are true or not 0.

        array: array-like of bool or whole numbers, shape (x, y, z)
        corner: array-like of whole numbers, shape (3,): the indices of its first voxel
        voxel_size: as for Mask
        origin: as for Mask
        Raises InputError.
        """
        try:
            dense = numpy.asarray(array)
        except (TypeError, ValueError) as error:
            raise InputError(f"array: {error}") from None
        if dense.ndim != 3 or dense.dtype.kind not in "biu":
            raise InputError(f"array: shape {dense.shape} of {dense.dtype} is not allowed; it must be (x, y, z), of bool "
                             "or whole numbers")
        first = _arguments.voxels("corner", [_arguments.rows("corner", corner, (3,), "iu", "three whole numbers")])[0]
        return Mask(numpy.argwhere(dense) + first.astype(numpy.int64), voxel_size, origin)

    def voxels(self) -> npt.NDArray[numpy.int32]:
        """Returns the active voxels: int32, shape (n, 3), in the order of i, then j, then k.

        Raises InputError for more than 2**30 of them.
        """
        return self._mask.voxels()

    def dense(self) -> tuple[npt.NDArray[numpy.bool_], npt.NDArray[numpy.int32]]:
        """Returns the box around the active voxels: (bool array, shape (x, y, z), int32 indices of its first voxel).

        Raises InputError for more than 2**32 voxels in it.
        """
        if not len(self):
            return numpy.zeros((0, 0, 0), bool), numpy.zeros(3, numpy.int32)
        low, high = self._mask.box()
        shape = tuple(int(size) + 1 for size in high.astype(numpy.int64) - low)
        if shape[0] * shape[1] * shape[2] > 2**32:
            raise InputError(f"mask: its box is of {shape} voxels; an array can have 2**32")
        array = numpy.zeros(shape, bool)
        array[tuple((self.voxels() - low).T)] = True
        return array, low

    @property
    def matrix(self) -> npt.NDArray[numpy.float64]:
        """The transform from indices to the world: float64, shape (4, 4), for columns (i, j, k, 1)."""
        return self._mask.matrix()

    @property
    def voxel_size(self) -> float:
        """The side of a voxel, world units.

        Raises InputError for a mask of a file whose voxels are no upright cubes; see matrix.
        """
        matrix = self.matrix[:3, :3]
        if matrix[0, 0] <= 0 or not numpy.array_equal(matrix, matrix[0, 0] * numpy.eye(3)):
            raise InputError("voxel_size: the voxels of this mask are no upright cubes; matrix says what they are")
        return float(matrix[0, 0])

    @property
    def origin(self) -> npt.NDArray[numpy.float64]:
        """The world position of the centre of the voxel 0, 0, 0: float64, shape (3,)."""
        return self.matrix[:3, 3].copy()

    def __len__(self) -> int:
        """Returns the number of active voxels."""
        return self._mask.count

    def __bool__(self) -> bool:
        return True

    def __repr__(self):
        return f"<vdbcage.Mask: {len(self)} voxels>"


def voxelize(model: Mesh, resolution: int = 128, *, voxelizer: str | None = None, interior: str | None = "solid",
             box: npt.ArrayLike | None = None, progress: _Progress = None) -> Mask:
    """Returns the voxels that a face of the model touches, and those inside, as a Mask. It has no cavities.

    model: a Mesh of any kind
    resolution: voxels along the model's longest side, 1 to 4096
    voxelizer: None (auto), "cpu", "gl" or "cgal"; all make the same voxels
    interior: "solid", "shell" or None (auto), the inside of a model with holes
    box: array-like, shape (2, 3): lower and upper corner; the voxels are laid out as for a model with this bounding box
    progress: see the help of vdbcage
    Raises InputError, DeviceError, Cancelled.
    """
    resolution = _arguments.whole("resolution", resolution, 1, 4096)
    if box is not None:
        rows = _arguments.rows("box", box, (2, 3), "fiu", "two rows of three finite numbers")
        box = rows.astype(float).ravel().tolist()
    voxelizer = _option_text("voxelizer", voxelizer, "auto")
    interior = _option_text("interior", interior, "auto")
    with _names_of_python():
        return Mask._of(_vdbcage.voxelize(_mesh("model", model), resolution, voxelizer, interior, box,
                                          _arguments.callback(progress)))


def close_mask(mask: Mask, close_radius: float, erode_radius: float | None = None, *, element: str = "sphere",
               scale_field: str | os.PathLike[str] | None = None, progress: _Progress = None) -> Mask:
    """Returns the closing of a mask, as a Mask: its dilation by the close radius, eroded by the erode radius.

    mask: a Mask
    close_radius: voxels, 0 to 512
    erode_radius: voxels, 0 to the close radius, which None stands for
    element: "sphere" or "cube"
    scale_field: None, or the factors of the radii in places, as in VOLUMES.md
    progress: see the help of vdbcage
    Raises InputError, IoError for the file of a scale field, Cancelled.
    """
    mask = _mask("mask", mask)
    close_radius = _arguments.number("close_radius", close_radius, 0, 512)
    erode_radius = close_radius if erode_radius is None else erode_radius
    erode_radius = _arguments.number("erode_radius", erode_radius, 0, close_radius)
    element = _option_text("element", element, "")
    scale_field = _option_text("scale_field", scale_field, "")
    with _names_of_python():
        return Mask._of(_vdbcage.close_mask(mask, close_radius, erode_radius, element, scale_field,
                                            _arguments.callback(progress)))


def read_vdb(path: _Path) -> Mask:
    """Reads a Mask from a .vdb: its first grid named density, or else its only grid, of floats, doubles or booleans.

    Active are voxels above 0.5, below 0 in a level set, or true.

    path: of the .vdb, which need not be trusted
    Raises IoError.
    """
    return Mask._of(_vdbcage.read_vdb(_arguments.path(path)))


def write_vdb(mask: Mask, path: _Path, metadata: dict[str, str] | None = None) -> None:
    """Writes a Mask as a .vdb with one FloatGrid named density, a fog volume of 1 in the active voxels.

    mask: a Mask
    path: of the .vdb
    metadata: a dict of strings; each becomes a string of the grid named vdbcage_KEY; None for none
    Raises IoError, InputError.
    """
    metadata = {} if metadata is None else metadata
    if not isinstance(metadata, dict) or not all(isinstance(text, str) for item in metadata.items() for text in item):
        raise InputError(f"metadata: {metadata!r} is not allowed; it must be a dict of strings")
    _vdbcage.write_vdb(_mask("mask", mask), _arguments.path(path), metadata)
