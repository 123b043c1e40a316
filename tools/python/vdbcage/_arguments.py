"""Arguments as the module _vdbcage takes them: each function checks one and raises InputError, naming it."""

import numbers
import operator
import os

import numpy

from . import InputError


def matrix(name, value, columns, kinds, content):
    """Returns `value` as an array of shape (n, columns) whose dtype is of one of `kinds`; None is n = 0."""
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


def points(name, value, count=None, owner=""):
    """Returns finite points as an array of shape (n, 3); n is `count`, which `owner` has, if that is given."""
    array = matrix(name, value, 3, "fiu", "numbers")
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


def indices(name, value, corners, count):
    """Returns faces as an array of shape (n, corners) of indices below `count`."""
    array = matrix(name, value, corners, "iu", "whole numbers")
    outside = (array < 0) | (array >= count)
    if outside.any():
        row, column = numpy.argwhere(outside)[0]
        allowed = f"it must be 0 to {count - 1}" if count else "there are no points"
        raise InputError(f"{name}: row {row} has the index {array[row, column]}; {allowed}")
    return array


def places(name, value, count):
    """Returns indices below `count` as a list."""
    rows = numpy.asarray(() if value is None else value)
    if rows.ndim != 1:
        raise InputError(f"{name}: an array of shape {rows.shape} is not allowed; it must be (n,)")
    return indices(name, rows.reshape(-1, 1), 1, count)[:, 0].tolist()


def path(value):
    """Returns the bytes of a path."""
    try:
        path = os.fsencode(value)
    except (TypeError, UnicodeError):
        raise InputError(f"path: {value!r} is not a path") from None
    if b"\0" in path:
        raise InputError(f"path: {value!r} has a null character")
    return path


def number(name, value, least, most):
    """Returns `value` as a float within these bounds."""
    if isinstance(value, numbers.Real) and not isinstance(value, (bool, numpy.bool_)) and least <= value <= most:
        return float(value)
    raise InputError(f"{name}: {value!r} is not allowed; it must be a number, {least:g} to {most:g}")


def whole(name, value, least, most):
    """Returns `value` as an int within these bounds."""
    if isinstance(value, numbers.Integral) and not isinstance(value, bool) and least <= value <= most:
        return operator.index(value)
    raise InputError(f"{name}: {value!r} is not allowed; it must be a whole number, {least} to {most}")


def rows(name, value, shape, kinds, content):
    """Returns `value` as a small array of this shape and finite entries."""
    try:
        array = numpy.asarray(value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    if array.shape != shape or array.dtype.kind not in kinds or not numpy.isfinite(array).all():
        raise InputError(f"{name}: {value!r} is not allowed; it must be {content}")
    return array


def voxels(name, value):
    """Returns indices of voxels as an array of shape (n, 3)."""
    array = matrix(name, value, 3, "iu", "whole numbers")
    outside = (array < -2**30) | (array >= 2**30)
    if outside.any():
        row, column = numpy.argwhere(outside)[0]
        raise InputError(f"{name}: row {row} has the index {array[row, column]}; it must be -2**30 to 2**30 - 1")
    return array


def callback(value):
    if value is not None and not callable(value):
        raise InputError(f"progress: {value!r} is not allowed; it must be None or a function of (stage, percent)")
    return value
