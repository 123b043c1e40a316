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

/// The counts of all that a reader met beside plain triangles and quads. They are for reports, never needed to use the
/// mesh.
struct ReadSummary {
    std::size_t polygons = 0;        ///< faces with more than four corners, split into triangles
    std::size_t degenerateFaces = 0; ///< faces that repeat a corner or have zero area (kept: they are geometry)
    std::size_t ignoredElements = 0; ///< lines, points, curves and other elements that are not faces
    /// Faces of up to N corners, where N is this number, have triangles of all these splits in Mesh::alternatives: any
    /// split up to 8 corners, the fans around each corner beyond. It is 64, or 4 to 63 where these would be more than
    /// 2^24 triangles. Faces of more corners are there as the fan around their first corner and as clipping ears splits
    /// them.
    std::size_t alternateCorners = 64;
    /// Deviations of the file from its format, one sentence a kind, with the line where it is first: "line 7: a number
    /// has ... (3 times)". They quote nothing of the file.
    std::vector<std::string> warnings;
};

/// The contents of a file.
struct MeshFile {
    Mesh mesh;           ///< points in the order of the file; faces by kind, each in its order
    ReadSummary summary; ///< counts of the rest, and warnings
};

/// Returns the extensions of all formats, in lower case with the dot: ".obj" and so on.
VDBCAGE_API const std::vector<std::string>& meshExtensions();

/// Reads a model or cage. The \ref mesh "page of this room" says which formats and deviations from them are read.
///
/// Points keep their order and exact values. Corners of an STL with the same coordinates become one point. Faces with
/// more than four corners and concave quads are split into triangles.
/// \param path OBJ, OFF, PLY or STL; its extension, in any case, decides on the format
/// \throw IoError naming the path, the line or byte, and the value, when the file cannot be read, has an unknown
/// extension, is truncated or malformed, or has a coordinate that is not finite, an index out of range, no face, or
/// only degenerate faces
/// Cost: one pass over the file, held in memory; about 200 MB a second.
VDBCAGE_API MeshFile readMeshFile(const std::filesystem::path& path);

/// Reads a model or cage as readMeshFile() does, and returns its mesh alone.
/// \param path as for readMeshFile()
/// \throw IoError as readMeshFile()
VDBCAGE_API Mesh readMesh(const std::filesystem::path& path);

/// Returns the numbers that files of this name hold when they are written: float32 for STL, float64 for the others.
///
/// A cage that is to go into such a file is made with this CageOptions::precision: it is then certified as the file has
/// it.
/// \param path only its extension counts; the file need not exist
/// \throw IoError when the extension is unknown
VDBCAGE_API Precision precisionOf(const std::filesystem::path& path);

/// Returns the mesh with its points as a file of this name has them when it is written. A verdict on the file is one on
/// this mesh.
/// \param mesh any mesh
/// \param path only its extension counts; the file need not exist
/// \throw IoError when the extension is unknown, or a coordinate does not fit STL's floats
VDBCAGE_API Mesh asWritten(Mesh mesh, const std::filesystem::path& path);

/// Writes a mesh in the format of the file name's extension: OBJ, OFF, PLY (binary little endian, doubles) or STL
/// (binary: float coordinates, quads as two triangles).
///
/// OBJ, OFF and PLY read back bit-equal, triangles first, then quads; only concave quads come back as triangles. The
/// file appears whole or not at all: it is written under a temporary name in the same folder, then renamed.
/// \param mesh any usable polygon soup; its alternatives are not written
/// \param path .obj, .off, .ply or .stl, in any case; a file there is replaced
/// \throw IoError naming the path, when its extension is unknown, it cannot be written, or a coordinate does not fit
/// STL's floats
/// \throw InputError when requireUsable() refuses the mesh, or one of its points is not finite
VDBCAGE_API void writeMesh(const Mesh& mesh, const std::filesystem::path& path);

/// As writeMesh() to a file, but to a stream, whose state tells whether it took all; `path` is for format and errors.
VDBCAGE_API void writeMesh(const Mesh& mesh, std::ostream& out, const std::filesystem::path& path);

/// The colour of a point: red, green and blue, each 0 to 255.
using PointColour = std::array<std::uint8_t, 3>;

/// Writes a binary PLY with a colour for each point (red, green, blue, uchar), which Blender and MeshLab show.
/// \param mesh as for writeMesh()
/// \param colours one a point
/// \param out its state tells whether it took all
/// \param path the name in errors
/// \throw InputError when writeMesh() would throw it, or there are not as many colours as points
VDBCAGE_API void writeColouredPly(const Mesh& mesh, const std::vector<PointColour>& colours, std::ostream& out,
                                  const std::filesystem::path& path);

/// Returns the numbers of the coordinates that writeMoved() writes: float32 if they are floats, else float64.
///
/// From PLY to PLY they are as in the original: float32 if x, y or z is a float there. Otherwise it is
/// precisionOf(path).
/// \param original the model's file; it is read if both are PLY
/// \param path only its extension counts; the file need not exist
/// \throw IoError when an extension is unknown, or the PLY cannot be read or has a malformed header
VDBCAGE_API Precision movedPrecision(const std::filesystem::path& original, const std::filesystem::path& path);

/// Writes a model file again with other positions of its points.
///
/// In the format of the original all else stays byte by byte, as the \ref mesh "page of this room" says: polygons of
/// any size, comments, colours, texture coordinates, groups and other elements. In an OBJ normals turn with the faces
/// around them, in an STL they are computed; those of OFF and PLY stay. Points equal to those of the original leave its
/// bytes. Another format, or a PLY whose coordinates are integers, gets the points and faces that readMesh() finds. The
/// file appears whole or not at all.
/// \param original the model's file, as for readMesh()
/// \param points the new positions, world units, in the order of readMesh(); where movedPrecision() is float32, those
/// that move are rounded to it
/// \param path the file that is written, as for writeMesh()
/// \throw InputError when `points` are not as many as the model's, or not finite; as writeMesh() in another format
/// \throw IoError as readMesh() and writeMesh(), and when a coordinate does not fit floats of the file
VDBCAGE_API void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points,
                            const std::filesystem::path& path);

/// As writeMoved() to a file, but to a stream, whose state tells whether it took all; `path` is for format and errors.
VDBCAGE_API void writeMoved(const std::filesystem::path& original, const std::vector<openvdb::Vec3d>& points,
                            std::ostream& out, const std::filesystem::path& path);

} // namespace vdbcage
