#pragma once

#include <cstring>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <vdbcage/mesh/io/formats.h>

namespace vdbcage::test {

using Parse = MeshFile (*)(std::string_view, const std::string&);
using Write = void (*)(const Mesh&, const std::string&, std::ostream&);

/// The bytes of a file of each kind.
struct Sample {
    const char* kind;
    const char* extension;
    Parse parse;
    std::string bytes;
};

template <typename Value>
std::string littleEndian(Value value)
{
    std::string bytes(sizeof(Value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(Value));
    return bytes;
}

template <typename Value>
std::string bigEndian(Value value)
{
    const std::string bytes = littleEndian(value);
    return {bytes.rbegin(), bytes.rend()};
}

inline std::string write(Write writer, const Mesh& mesh)
{
    std::ostringstream out;
    writer(mesh, "mesh", out);
    return out.str();
}

/// A pyramid on a square: four triangles and a quad.
inline Mesh pyramid()
{
    Mesh mesh;
    mesh.points = {{0.5, 0.5, 0.75}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 1, 0}};
    mesh.quads = {{4, 3, 2, 1}};
    return mesh;
}

inline const std::string& asciiPlyPyramid()
{
    static const std::string bytes = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 5\n"
                                     "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                                     "element face 5\nproperty list uchar int vertex_indices\nend_header\n"
                                     "0.5 0.5 0.75 255\n0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0 255\n"
                                     "3 1 2 0\n3 2 3 0\n3 3 4 0\n3 4 1 0\n4 4 3 2 1\n";
    return bytes;
}

inline std::string bigEndianPlyPyramid()
{
    std::string bytes = "ply\r\nformat binary_big_endian 1.0\r\nelement face 5\r\nproperty uchar flags\r\n"
                        "property list uint16 uint32 vertex_index\r\nelement vertex 5\r\nproperty double z\r\n"
                        "property list uchar short extra\r\nproperty float y\r\nproperty double x\r\nend_header\r\n";
    const Mesh mesh = pyramid();
    const auto face = [&](const auto& corners, int count) {
        bytes += '\7' + bigEndian(std::uint16_t(count));
        for (int i = 0; i < count; ++i) bytes += bigEndian(std::uint32_t(corners[i]));
    };
    for (const auto& triangle : mesh.triangles) face(triangle, 3);
    for (const auto& quad : mesh.quads) face(quad, 4);
    for (const auto& p : mesh.points) {
        bytes += bigEndian(p.z()) + '\2' + bigEndian(std::int16_t(-1)) + bigEndian(std::int16_t(5)) +
                 bigEndian(float(p.y())) + bigEndian(p.x());
    }
    return bytes;
}

inline std::string asciiStlPyramid()
{
    std::string bytes = "solid pyramid of stone\n";
    const Mesh mesh = pyramid();
    for (const openvdb::Vec3I& triangle : triangulate(mesh)) {
        bytes += "  facet normal nan 0 -1\n    outer loop\n";
        for (int i = 0; i < 3; ++i) {
            std::ostringstream line;
            line.imbue(std::locale::classic());
            const openvdb::Vec3d& p = mesh.points[triangle[i]];
            line << "      vertex " << p.x() << " " << p.y() << " " << p.z() << "\n";
            bytes += line.str();
        }
        bytes += "    endloop\n  endfacet\n";
    }
    return bytes + "endsolid pyramid\n";
}

inline const std::vector<Sample>& samples()
{
    static const std::vector<Sample> list = {
        {"obj", ".obj", detail::parseObj, write(detail::writeObj, pyramid())},
        {"obj with textures and normals", ".obj", detail::parseObj,
         "v .5 .5 .75\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
         "f 2/1/1 3/1/1 1/2/1\nf 3/1/1 4/2/1 1/1/1\nf 4/1/1 5/2/1 1/2/1\nf 5/1/1 2/1/1 1/2/1\n"
         "f 5/1/1 4/2/1 3/2/1 2/2/1\n"},
        {"off", ".off", detail::parseOff, write(detail::writeOff, pyramid())},
        {"ascii ply", ".ply", detail::parsePly, asciiPlyPyramid()},
        {"little endian ply", ".ply", detail::parsePly, write(detail::writePly, pyramid())},
        {"big endian ply", ".ply", detail::parsePly, bigEndianPlyPyramid()},
        {"ascii stl", ".stl", detail::parseStl, asciiStlPyramid()},
        {"binary stl", ".stl", detail::parseStl, write(detail::writeStl, pyramid())},
    };
    return list;
}

/// Equal to the last bit, so that 0 and -0 differ.
inline bool sameBits(const Mesh& a, const Mesh& b)
{
    return a.points.size() == b.points.size() && a.triangles == b.triangles && a.quads == b.quads &&
           (a.points.empty() ||
            std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(openvdb::Vec3d)) == 0);
}

/// `text` with `by` for each `what`.
inline std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
        text.replace(at, what.size(), by);
    }
    return text;
}

} // namespace vdbcage::test
