#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Counts what a reader met beside plain triangles and quads: for reports, never needed to use the mesh.
struct ReadSummary {
    std::size_t polygons = 0;        ///< faces with more than four corners, split into triangles
    std::size_t degenerateFaces = 0; ///< faces that repeat a corner or have zero area (kept: they are geometry)
    std::size_t ignoredElements = 0; ///< lines, points, curves and other elements that are not faces
    /// Faces of up to so many corners have triangles of all these splits in Mesh::alternatives: of any split up to 8
    /// corners, of the fans around each corner beyond. 64, or 4 to 63 where these would be more than 2^24 triangles.
    /// Faces of more corners are there as the fan around their first corner and as clipping ears splits them.
    std::size_t alternateCorners = 64;
    /// Deviations of the file from its format, one sentence a kind, with the line where it is first: "line 7: a
    /// number has ... (3 times)". Nothing of the file itself is in them.
    std::vector<std::string> warnings;
};

/// The contents of a file.
struct MeshFile {
    Mesh mesh;           ///< points in the order of the file; faces by kind, each in its order
    ReadSummary summary; ///< what else was there
};

/// Returns the extensions of all formats, in lower case with the dot: ".obj" and so on.
VDBCAGE_API const std::vector<std::string>& meshExtensions();

/// Reads a model or cage.
///
/// The formats, told apart by the file name's extension in any case: OBJ; OFF (also COFF, NOFF, STOFF; ascii); PLY
/// (ascii, binary of both byte orders; faces or strips); STL (ascii, binary). Points keep their order and exact values.
/// Corners of an STL with the same coordinates become one point. Faces with more than four corners are split into
/// triangles. So are concave quads: those that only one diagonal divides into two triangles of their orientation. The
/// reader does not depend on the locale.
///
/// Deviations of some programs are read where their meaning is plain, with a warning in ReadSummary. These are text
/// of UTF-16 with a byte order mark; numbers like 3.1+e2 and 1.5d3, which are 310 and 1500; the header of an OFF file
/// before an OBJ, if its counts are right; in an OBJ, and in an ascii STL between facets, lines that begin with a word
/// that the format does not have, passed over; in a PLY a line of the header without the word comment, more values in
/// the line of a face than the header says, and lines that end in CR LF or CR before binary data.
///
/// An OBJ has no mark of its end. One whose last line has no end, and that has points which no face uses, is taken for
/// truncated. One that was cut off at the end of a line is read as what is left of it.
/// \throw IoError naming the path, the line or byte, and the value: the file cannot be read, is truncated or
///        malformed, has a coordinate that is not finite, an index out of range, no face, or only degenerate faces
/// Cost: one pass over the file, held in memory; about 200 MB a second.
VDBCAGE_API MeshFile readMeshFile(const std::filesystem::path& path);

/// The mesh of readMeshFile.
/// \throw IoError as readMeshFile
VDBCAGE_API Mesh readMesh(const std::filesystem::path& path);

/// The numbers that files of this name hold when they are written: float32 of STL, float64 of the others.
///
/// A cage that is to go into such a file is made with this CageOptions::precision: it is then certified as the file has
/// it.
/// \throw IoError unknown extension
VDBCAGE_API Precision precisionOf(const std::filesystem::path& path);

/// The mesh with its points as a file of this name has them when it is written. A verdict on the file is one on this.
/// \throw IoError unknown extension; a coordinate does not fit STL's floats
VDBCAGE_API Mesh asWritten(Mesh mesh, const std::filesystem::path& path);

/// Writes `mesh` to `path` in the format of its extension: OBJ, OFF, PLY (binary little endian, doubles) or STL
/// (binary: float coordinates, quads as two triangles).
///
/// OBJ, OFF and PLY read back bit-equal, triangles first, then quads. Concave quads alone come back as triangles. The
/// file appears whole or not at all: it is written under a temporary name in the same folder, then renamed.
/// \throw IoError naming the path: unknown extension, it cannot be written, a coordinate does not fit STL's floats
/// \throw InputError the mesh is not usable (see requireUsable), or one of its points is not finite
VDBCAGE_API void writeMesh(const Mesh& mesh, const std::filesystem::path& path);

/// writeMesh() to a stream, whose state tells whether it took all; `path` gives the format, and the name in errors.
/// \throw IoError unknown extension; a coordinate does not fit STL's floats
/// \throw InputError as to a path
VDBCAGE_API void writeMesh(const Mesh& mesh, std::ostream& out, const std::filesystem::path& path);

/// Red, green and blue, each 0 to 255.
using PointColour = std::array<std::uint8_t, 3>;

/// Writes a binary PLY with a colour for each point (red, green, blue, uchar), which Blender and MeshLab show.
///
/// The stream's state tells whether it took all; `path` is the name in errors.
/// \throw InputError as writeMesh; not as many colours as points
VDBCAGE_API void writeColouredPly(const Mesh& mesh, const std::vector<PointColour>& colours, std::ostream& out,
                                  const std::filesystem::path& path);

/// Writes the model file `original` to `path` with its points at `points`, in the order of readMesh.
///
/// From OBJ to OBJ all else stays byte by byte: polygons of any size, texture coordinates, groups, materials, comments,
/// what stands behind the coordinates of a point. Only normals are turned, as the faces around them turn. Other formats
/// get what readMesh finds in `original`: points and faces. The file appears whole or not at all.
/// \throw InputError `points` are not as many as the model's, or not finite
/// \throw IoError as readMesh and writeMesh
VDBCAGE_API void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points,
                            const std::filesystem::path& path);

/// writeMoved() to a stream, whose state tells whether it took all; `path` gives the format, and the name in errors.
/// \throw InputError as to a path
/// \throw IoError as readMesh
VDBCAGE_API void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points,
                            std::ostream& out, const std::filesystem::path& path);

} // namespace vdbcage
