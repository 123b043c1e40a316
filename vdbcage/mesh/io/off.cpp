// Based on: the OFF format of Geomview's manual, its ascii form in three dimensions.
// Differs: the word OFF may be missing or directly before the counts (as in ModelNet's files), and the letters before
// it in any order (MeshLab's NCOFF); the count of edges may be missing; the rest of a line after the coordinates or
// corners (normals, colours) is skipped, so that each point and each face begins a line. Data after the last face is an
// error: the counts would silently lose a part of the model.

#include <vdbcage/mesh/io/formats.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/mesh/io/moved_bytes.h>
#include <vdbcage/mesh/io/output_buffer.h>
#include <vdbcage/mesh/io/polygon_soup.h>
#include <vdbcage/mesh/io/text_cursor.h>
#include <vdbcage/mesh/io/utf16.h>

namespace vdbcage::detail {

namespace {

class OffParser {
public:
    /// Replaces the coordinates in `moved`, unless that is null.
    OffParser(std::string_view bytes, const std::string& name, Warnings& warnings, MovedBytes* moved = nullptr)
        : in_(bytes, name, TextSyntax{'#'}, &warnings), moved_(moved)
    {
    }

    PolygonSoup parse()
    {
        if (!in_.skipToWord()) in_.fail("the file ends before a header; the first line must be OFF");
        header();
        in_.skipToWord();
        const char* counts = in_.position();
        points_ = count("the number of points");
        faces_ = count("the number of faces");
        if (!in_.atLineEnd()) in_.integer("the number of edges");
        if (!in_.atLineEnd()) {
            in_.fail(in_.quoted(in_.position()) +
                     " behind the counts is not understood; they are those of points, faces and edges");
        }
        // "0 0 0" and "0" are the shortest point and face; the last line may lack its end.
        if (points_ > (in_.bytesLeft() + 1) / 6 || faces_ > (in_.bytesLeft() + 1 - 6 * points_) / 2) {
            in_.fail(counts, "the header announces " + std::to_string(points_) + " points and " +
                                 std::to_string(faces_) + " faces, which cannot fit in the " +
                                 std::to_string(in_.bytesLeft()) + " bytes that follow; copy or export the file again");
        }
        soup_.points.reserve(points_);
        for (std::uint64_t i = 0; i < points_; ++i) point(i);
        soup_.triangles.reserve(std::min<std::uint64_t>(faces_, in_.bytesLeft() / 8));
        for (std::uint64_t i = 0; i < faces_; ++i) face(i);
        if (in_.skipToWord()) {
            in_.fail(in_.quoted(in_.position()) + " follows the last of the " + std::to_string(faces_) +
                     " faces that the header announces; correct the header");
        }
        return std::move(soup_);
    }

private:
    void header()
    {
        const char* start = in_.position();
        const auto take = [&](char c) { return in_.skipCharacter(c); };
        const auto fail = [&](const std::string& problem) { in_.fail(start, in_.quoted(start) + problem); };
        const std::string_view word = TextCursor(in_).word();
        if (word.find_first_not_of("+-0123456789") == std::string_view::npos) return; // the counts
        bool otherDimension = false;
        for (;;) {
            if (take('4') || take('n')) {
                otherDimension = true;
            } else if (!take('C') && !take('N') && !(take('S') && take('T'))) {
                break;
            }
        }
        if (!take('O') || !take('F') || !take('F'))
            fail(" is not the header of an OFF file; the first line must be OFF, or the counts");
        if (otherDimension) fail(" is of another dimension; only three-dimensional OFF files are supported");
        if (in_.skipWord("BINARY")) in_.fail("binary OFF files are not supported; only ascii ones are");
    }

    std::uint64_t count(const char* what)
    {
        in_.skipToWord();
        const char* where = in_.position();
        const std::int64_t value = in_.integer(what);
        if (value < 0)
            in_.fail(where,
                     std::string(what) + " is " + in_.quoted(where) + ", which is below 0; it must be 0 or more");
        return static_cast<std::uint64_t>(value);
    }

    void requireMore(const char* what, std::uint64_t done, std::uint64_t total)
    {
        if (in_.skipToWord()) return;
        in_.fail("the file ends within " + std::string(what) + " " + std::to_string(done + 1) + " of " +
                 std::to_string(total) + "; copy or export it again");
    }

    void point(std::uint64_t i)
    {
        openvdb::Vec3d p;
        constexpr const char* names[3] = {"the x coordinate", "the y coordinate", "the z coordinate"};
        for (int axis = 0; axis < 3; ++axis) {
            requireMore("point", i, points_);
            std::string_view number;
            p[axis] = in_.coordinate(names[axis], &number);
            if (!moved_) continue;
            const double value = moved_->point(i)[axis];
            if (!sameBits(value, p[axis])) moved_->replace(number, numberText(value));
        }
        soup_.points.push_back(p);
        in_.nextLine();
    }

    void face(std::uint64_t i)
    {
        requireMore("face", i, faces_);
        const char* where = in_.position();
        const std::uint64_t corners = count("the number of corners");
        // Checked before anything is stored, like the counts of the header.
        if (corners > in_.bytesLeft() / 2) {
            in_.fail(where, "a face with " + std::to_string(corners) + " corners cannot fit in the " +
                                std::to_string(in_.bytesLeft()) +
                                " bytes that follow; a face begins with the number of its corners");
        }
        face_.clear();
        for (std::uint64_t j = 0; j < corners; ++j) {
            requireMore("face", i, faces_);
            where = in_.position();
            const std::int64_t index = in_.integer("the index of a corner");
            if (index < 0 || std::uint64_t(index) >= points_) {
                in_.fail(where, "the corner " + in_.quoted(where) + " is out of range; there are " +
                                    std::to_string(points_) + " points, counted from 0");
            }
            face_.push_back(static_cast<openvdb::Index32>(index));
        }
        soup_.addFace(face_.data(), face_.size());
        in_.nextLine();
    }

    TextCursor in_;
    MovedBytes* moved_;
    PolygonSoup soup_;
    std::vector<openvdb::Index32> face_;
    std::uint64_t points_ = 0, faces_ = 0;
};

template <typename Face>
void writeFace(OutputBuffer& buffer, const Face& face)
{
    buffer.number(int(Face::size));
    for (int i = 0; i < Face::size; ++i) {
        buffer.text(" ");
        buffer.number(face[i]);
    }
    buffer.text("\n");
}

} // namespace

MeshFile parseOff(std::string_view bytes, const std::string& name)
{
    Warnings warnings;
    std::string storage;
    PolygonSoup soup = OffParser(asUtf8(bytes, name, storage, warnings), name, warnings).parse();
    return toMesh(std::move(soup), name, warnings);
}

std::string movedOff(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points)
{
    Warnings warnings; // the same as when it was read as a mesh
    std::string storage;
    const std::string_view text = asUtf8(bytes, name, storage, warnings);
    MovedBytes moved(text, points);
    OffParser(text, name, warnings, &moved).parse();
    return moved.finish();
}

void writeOff(const Mesh& mesh, const std::string&, std::ostream& out)
{
    OutputBuffer buffer(out);
    buffer.text("OFF\n");
    buffer.number(mesh.points.size());
    buffer.text(" ");
    buffer.number(faceCount(mesh));
    buffer.text(" 0\n");
    for (const openvdb::Vec3d& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) {
            buffer.number(p[axis]);
            buffer.text(axis < 2 ? " " : "\n");
        }
    }
    for (const openvdb::Vec3I& triangle : mesh.triangles) writeFace(buffer, triangle);
    for (const openvdb::Vec4I& quad : mesh.quads) writeFace(buffer, quad);
    buffer.flush();
}

} // namespace vdbcage::detail
