#include <vdbcage/mesh/io/formats.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/mesh/io/moved_bytes.h>
#include <vdbcage/mesh/io/obj_syntax.h>
#include <vdbcage/mesh/io/utf16.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

/// Three numbers of the file and their places.
struct Triple {
    const char *begin, *end;
    Vec3d value;
};

struct Corner {
    std::size_t point, normal;
};
constexpr std::size_t none = ~std::size_t(0);

struct Statements {
    std::vector<Triple> points, normals;
    std::vector<std::vector<Corner>> faces;
};

Statements read(std::string_view bytes, const std::string& name, Warnings& warnings)
{
    TextCursor in(bytes, name, objSyntax, &warnings);
    Statements statements;
    const auto triple = [&](std::vector<Triple>& to) {
        in.atLineEnd(); // skips blanks
        const char* begin = in.position();
        Vec3d value;
        for (int axis = 0; axis < 3; ++axis) {
            const std::optional<double> number = in.finiteNumber();
            if (!number) { // a normal, which the reader of meshes does not look at; without a direction it stays
                to.push_back({begin, begin, Vec3d(0)});
                return;
            }
            value[axis] = *number;
        }
        to.push_back({begin, in.position(), value});
    };
    const auto resolved = [](std::int64_t index, std::size_t count) {
        return index > 0 ? static_cast<std::size_t>(index - 1) : count - static_cast<std::size_t>(-index);
    };
    while (in.skipToWord()) {
        const std::string_view keyword = in.word();
        if (keyword == "v") {
            triple(statements.points);
        } else if (keyword == "vn") {
            triple(statements.normals);
        } else if (isObjFace(keyword)) {
            std::vector<Corner> face;
            while (!in.atLineEnd()) {
                ObjCorner corner;
                if (!readObjCorner(in, corner)) break; // not in a file that was read before
                face.push_back({resolved(corner.point, statements.points.size()),
                                corner.normal == 0 ? none : resolved(corner.normal, statements.normals.size())});
            }
            statements.faces.push_back(std::move(face));
        } else if (endsWithLine(keyword)) {
            in.nextLine();
            continue;
        }
        in.nextStatement();
    }
    return statements;
}

/// Returns the area vector of a polygon.
template <typename Position>
Vec3d areaOf(const std::vector<Corner>& face, const Position& position)
{
    Vec3d area(0);
    for (std::size_t i = 2; i < face.size(); ++i) {
        const Vec3d first = position(face[0].point);
        area += 0.5 * (position(face[i - 1].point) - first).cross(position(face[i].point) - first);
    }
    return area;
}

/// Returns `v` turned by the smallest rotation from `from` to `to`, both of length 1.
Vec3d turned(const Vec3d& v, const Vec3d& from, const Vec3d& to)
{
    const Vec3d axis = from.cross(to);
    const double cosine = from.dot(to);
    if (cosine < -0.999999) return v - 2 * from.dot(v) * from;
    return cosine * v + axis.cross(v) + axis.dot(v) / (1 + cosine) * axis;
}

/// Returns each normal turned by the mean rotation of the faces that use it, by their area; zero where none has an
/// area, and where no point of them moves.
std::vector<Vec3d> turnedNormals(const Statements& statements, const std::vector<Vec3d>& points)
{
    std::vector<Vec3d> normals(statements.normals.size(), Vec3d(0));
    std::vector<bool> turns(normals.size(), false);
    const auto moves = [&](const Corner& corner) {
        return !sameBits(statements.points[corner.point].value, points[corner.point]);
    };
    for (const std::vector<Corner>& face : statements.faces) {
        const Vec3d before = areaOf(face, [&](std::size_t i) { return statements.points[i].value; });
        const Vec3d after = areaOf(face, [&](std::size_t i) { return points[i]; });
        const double area = before.length(), posedArea = after.length();
        if (!(area > 0 && posedArea > 0)) continue;
        const bool isMoved = std::any_of(face.begin(), face.end(), moves);
        for (const Corner& corner : face) {
            if (corner.normal >= normals.size()) continue;
            if (isMoved) turns[corner.normal] = true;
            normals[corner.normal] +=
                area * turned(statements.normals[corner.normal].value, before / area, after / posedArea);
        }
    }
    for (std::size_t n = 0; n < normals.size(); ++n) {
        if (!turns[n]) normals[n] = Vec3d(0);
    }
    return normals;
}

} // namespace

std::string movedObj(std::string_view original, const std::string& name, const std::vector<Vec3d>& points)
{
    Warnings warnings; // the same as when it was read as a mesh
    std::string storage;
    const std::string_view bytes = asUtf8(original, name, storage, warnings);
    const Statements statements = read(bytes, name, warnings);
    const std::vector<Vec3d> normals = turnedNormals(statements, points);
    MovedBytes moved(bytes, points);
    const auto replace = [&](const Triple& old, const Vec3d& value) {
        TextCursor in({old.begin, static_cast<std::size_t>(old.end - old.begin)}, name, objSyntax, &warnings);
        for (int axis = 0; axis < 3; ++axis) {
            std::string_view number;
            in.coordinate("", &number);
            if (!sameBits(value[axis], old.value[axis])) moved.replace(number, numberText(value[axis]));
        }
    };
    for (std::size_t p = 0, n = 0; p < points.size() || n < normals.size();) {
        const bool isPoint =
            n == normals.size() || (p < points.size() && statements.points[p].begin < statements.normals[n].begin);
        if (isPoint) {
            replace(statements.points[p], points[p]);
            ++p;
        } else {
            const double length = normals[n].length();
            if (length > 0) replace(statements.normals[n], normals[n] / length);
            ++n;
        }
    }
    return moved.finish();
}

} // namespace vdbcage::detail
