# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""The files that go between Blender and the command, and Blender's point caches. Nothing here knows Blender."""

import os
import re
import struct

import numpy


def file_name(name):
    """A name that a file can have; different names give different ones."""
    return re.sub(r"[^\w .-]", lambda found: f"%{ord(found[0]):x}%", name)


class Polygons:
    """A mesh as arrays: points (n, 3), the number of corners of each face, and all corners, face after face."""

    def __init__(self, points, counts, corners):
        self.points, self.counts, self.corners = points, counts, corners

    def moved(self, matrix):
        """The mesh moved by a matrix, (4, 4). Faces stay outward where it mirrors."""
        points = self.points @ matrix[:3, :3].T + matrix[:3, 3]
        if numpy.linalg.det(matrix[:3, :3]) >= 0:
            return Polygons(points, self.counts, self.corners)
        ends = numpy.cumsum(self.counts)
        first = numpy.repeat(ends - self.counts, self.counts)
        last = numpy.repeat(ends - 1, self.counts)
        return Polygons(points, self.counts, self.corners[first + last - numpy.arange(len(self.corners))])

    def has_faces_of(self, other):
        """Whether both have the same faces, in the same order."""
        return numpy.array_equal(self.counts, other.counts) and numpy.array_equal(self.corners, other.corners)

    def equals(self, other):
        """Whether both have the same points and faces."""
        return numpy.array_equal(self.points, other.points) and self.has_faces_of(other)

    def faces(self):
        """A list of corners a face."""
        ends = numpy.cumsum(self.counts)
        return [self.corners[end - count:end].tolist() for end, count in zip(ends, self.counts)]


def joined(meshes):
    """Several meshes as one."""
    before = numpy.cumsum([0] + [len(mesh.points) for mesh in meshes])
    return Polygons(numpy.concatenate([mesh.points for mesh in meshes]),
                    numpy.concatenate([mesh.counts for mesh in meshes]),
                    numpy.concatenate([mesh.corners + start for mesh, start in zip(meshes, before)]))


_numbers = {"float": "<f4", "double": "<f8"}  # of coordinates, by their names in a PLY


def write_ply(path, mesh, number="double"):
    """Writes a binary PLY: points of `number`, float or double, and faces of any number of corners."""
    starts = numpy.cumsum(mesh.counts) - mesh.counts
    faces = numpy.insert(mesh.corners, starts, mesh.counts).astype("<i4")  # the count before each face's corners
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(mesh.points)}\n"
              f"property {number} x\nproperty {number} y\nproperty {number} z\n"
              f"element face {len(mesh.counts)}\nproperty list int int vertex_indices\nend_header\n")
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(numpy.ascontiguousarray(mesh.points, _numbers[number]).tobytes())
        file.write(faces.tobytes())


def _ply(path):
    """A PLY of the command: its points, (n, 3) doubles, the number of its faces, and the bytes of these."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    words = data[:end].decode().split()
    counts = {words[i + 1]: int(words[i + 2]) for i, word in enumerate(words) if word == "element"}
    number = numpy.dtype(_numbers[words[words.index("x") - 1]])
    coordinates = 3 * counts["vertex"]
    points = numpy.frombuffer(data, number, coordinates, end).reshape(-1, 3).astype(numpy.float64)
    return points, counts["face"], data[end + coordinates * number.itemsize:]


def read_ply_points(path):
    """The points of a PLY that the command wrote, (n, 3) doubles."""
    return _ply(path)[0]


def read_ply(path):
    """A PLY that the command wrote."""
    points, faces, body = _ply(path)
    at = 0
    counts, corners = [], []
    for _ in range(faces):
        count = body[at]
        counts.append(count)
        corners.extend(struct.unpack_from(f"<{count}i", body, at + 1))
        at += 1 + 4 * count
    return Polygons(points, numpy.array(counts, int), numpy.array(corners, int))


def polygons_of_faces(mesh):
    """The polygon that each face of the command is, or is a part of.

    The command counts triangles first, then quads. It splits concave quads and larger polygons; their triangles come
    behind the others, in the order of the polygons.
    """
    starts = numpy.cumsum(mesh.counts) - mesh.counts
    is_quad = mesh.counts == 4
    corners = mesh.points[mesh.corners[starts[is_quad, None] + numpy.arange(4)]]
    before, after = corners - numpy.roll(corners, 1, axis=1), numpy.roll(corners, -1, axis=1) - corners
    normals = numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])[:, None]
    # A corner that cuts off next to nothing keeps no orientation: as in PolygonSplitter::splitQuad.
    keeps = (normals * numpy.cross(before, after)).sum(axis=2) > 1e-10 * (normals * normals).sum(axis=2)
    is_concave = numpy.zeros(len(mesh.counts), bool)
    is_concave[is_quad] = (keeps[:, 0] & keeps[:, 2]) != (keeps[:, 1] & keeps[:, 3])
    is_whole = is_quad & ~is_concave
    larger = numpy.flatnonzero((mesh.counts > 3) & ~is_whole)
    return numpy.concatenate([numpy.flatnonzero(mesh.counts == 3), numpy.repeat(larger, mesh.counts[larger] - 2),
                              numpy.flatnonzero(is_whole)])


class PointCache:
    """Writes a .pc2 file: positions of the same points at frames that follow each other. It appears whole or not at
    all.

        with PointCache(path, points, first_frame, frames) as cache:
            cache.add(positions)  # (points, 3), once a frame
    """

    def __init__(self, path, points, first_frame, frames):
        self._path, self._partial = path, f"{path}.part"
        self._file = open(self._partial, "wb")
        self._file.write(struct.pack("<12siiffi", b"POINTCACHE2", 1, points, first_frame, 1, frames))

    def add(self, positions):
        self._file.write(numpy.ascontiguousarray(positions, "<f4").tobytes())

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        try:
            self._file.close()  # a full disk may show only now
            if kind is None:
                os.replace(self._partial, self._path)
        finally:
            if os.path.exists(self._partial):
                os.remove(self._partial)
