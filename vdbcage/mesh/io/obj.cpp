// Based on: Wavefront, "Object Files (.obj)", the polygonal part of version 3.0.
// Differs: statements without polygons are skipped unread, unknown ones included, since programs add their own, and so
// are remarks without a sign; a face of one or two corners is ignored, except at the end of a file that was cut off
// within it; the header of an OFF file may come first.

#include <vdbcage/mesh/io/formats.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/mesh/io/obj_syntax.h>
#include <vdbcage/mesh/io/output_buffer.h>
#include <vdbcage/mesh/io/polygon_soup.h>
#include <vdbcage/mesh/io/text_cursor.h>
#include <vdbcage/mesh/io/utf16.h>

namespace vdbcage::detail {

namespace {

/// Returns whether a keyword is that of geometry other than faces.
bool isOtherElement(std::string_view keyword)
{
    return keyword == "p" || keyword == "l" || keyword == "curv" || keyword == "curv2" || keyword == "surf";
}

class ObjParser {
public:
    ObjParser(std::string_view bytes, const std::string& name, Warnings& warnings)
        : in_(bytes, name, objSyntax, &warnings), name_(name), warnings_(warnings),
          endsWithinLine_(!bytes.empty() && bytes.back() != '\n' && bytes.back() != '\r')
    {
    }

    MeshFile parse()
    {
        skipOffHeader();
        while (in_.skipToWord()) statement();
        for (const Reference& reference : ahead_) {
            if (reference.index >= soup_.points.size()) failOutOfRange(reference.where, soup_.points.size());
        }
        if (offHeader_) requireCounts();
        if (remark_ && soup_.points.empty()) failOther(remark_);
        if (endsWithinLine_) requireAllUsed();
        return toMesh(std::move(soup_), name_, warnings_);
    }

private:
    /// A reference of a corner to a point that has not come yet.
    struct Reference {
        std::uint64_t index;
        const char* where;
    };

    /// Skips a line "OFF" and a line of two or three counts, or the counts alone.
    void skipOffHeader()
    {
        in_.skipToWord();
        TextCursor ahead = in_;
        if (ahead.skipWord("OFF") && !ahead.skipToWord()) return;
        const char* where = ahead.position();
        std::vector<std::int64_t> counts;
        for (std::string_view word = ahead.word(); !word.empty(); word = ahead.word()) {
            constexpr std::size_t mostDigits = 18; // fit in 64 bits
            const bool isCount = word.find_first_not_of("0123456789") == std::string_view::npos;
            if (!isCount || word.size() > mostDigits || counts.size() == 3) return;
            counts.push_back(0);
            for (const char digit : word) counts.back() = 10 * counts.back() + (digit - '0');
        }
        if (counts.size() < 2 || counts[0] < 3 || counts[1] < 1) return; // not the counts of a mesh
        in_.warn(in_.position(), "the header of an OFF file comes before the OBJ file; it is passed over");
        in_ = ahead;
        offHeader_ = {where, std::size_t(counts[0]), std::size_t(counts[1])};
    }

    /// Requires that the counts are right: then the header was meant as such, and no line is missing.
    void requireCounts() const
    {
        if (soup_.points.size() == offHeader_->points && faces_ == offHeader_->faces) return;
        in_.fail(offHeader_->where, "the counts before the OBJ file are " + std::to_string(offHeader_->points) +
                                        " points and " + std::to_string(offHeader_->faces) + " faces, but there are " +
                                        std::to_string(soup_.points.size()) + " and " + std::to_string(faces_) +
                                        "; delete this line if the file is whole");
    }

    void statement()
    {
        const char* start = in_.position();
        const std::string_view keyword = in_.word();
        if (keyword == "v") {
            point();
        } else if (isObjFace(keyword)) {
            face(start);
        } else {
            if (isOtherElement(keyword)) ++soup_.ignoredElements;
            if (!isObjKeyword(keyword)) remark(start, keyword);
            if (endsWithLine(keyword)) {
                in_.nextLine();
            } else {
                in_.nextStatement();
            }
        }
    }

    void remark(const char* start, std::string_view word)
    {
        if (!mayBeginRemark(word)) failOther(start);
        in_.warn(start, remarkWarning);
        if (!remark_) remark_ = start;
    }

    /// Throws that the file is of another format, or damaged.
    [[noreturn]] void failOther(const char* start) const
    {
        const char* remedy = offHeader_ ? "; if this is an OFF file, let its name end in .off"
                                        : "; lines begin with a keyword, like v or f";
        in_.fail(start, "a line cannot begin with " + in_.quoted(start) + " in an OBJ file" + remedy);
    }

    void point()
    {
        const double x = in_.coordinate("the x coordinate");
        const double y = in_.coordinate("the y coordinate");
        const double z = in_.coordinate("the z coordinate");
        soup_.points.emplace_back(x, y, z);
        while (!in_.atLineEnd()) { // a weight or a colour: not used, but a number
            if (!in_.skipNumber()) {
                in_.fail(in_.quoted(in_.position()) +
                         " behind the coordinates is not a number; only numbers may be there");
            }
        }
        in_.nextLine();
    }

    void face(const char* start)
    {
        ++faces_;
        face_.clear();
        int firstForm = 0;
        bool sameForm = true;
        while (!in_.atLineEnd()) {
            const int form = corner();
            if (face_.size() == 1) firstForm = form;
            sameForm = sameForm && form == firstForm;
        }
        // The last line may be cut off anywhere if it has no end; the rest of its last corner may still look whole.
        if (in_.atEnd() && (face_.size() < 3 || !sameForm)) {
            in_.fail(start, "the file ends within a face; copy or export it again");
        }
        soup_.addFace(face_.data(), face_.size());
        in_.nextLine();
    }

    /// Returns the corner's form.
    int corner()
    {
        const char* where = in_.position();
        ObjCorner read;
        if (!readObjCorner(in_, read) || !in_.atWordEnd()) {
            in_.fail(where,
                     "the corner " + in_.quoted(where) + " is not understood; it must be v, v/vt, v//vn or v/vt/vn");
        }
        const std::int64_t index = read.point;
        const std::uint64_t points = soup_.points.size();
        if (index == 0) in_.fail(where, "the corner " + in_.quoted(where) + " has index 0; points count from 1");
        if (index < 0 && std::uint64_t(-(index + 1)) >= points) failOutOfRange(where, points);
        const std::uint64_t at = index > 0 ? std::uint64_t(index - 1) : points - std::uint64_t(-(index + 1)) - 1;
        // Only the highest so far is kept: it is the first to be out of range for some number of points.
        if (at >= points && (ahead_.empty() || at > ahead_.back().index)) ahead_.push_back({at, where});
        face_.push_back(static_cast<openvdb::Index32>(at));
        return read.form;
    }

    /// Requires that all points are used. A file whose last line has no end may be whole or cut off: unused points show
    /// that it was cut off. Otherwise a cut-off file would silently become a part of its model.
    void requireAllUsed() const
    {
        if (soup_.ignoredElements > 0 || (soup_.triangles.empty() && soup_.ends.empty())) return;
        std::vector<bool> used(soup_.points.size(), false);
        for (const openvdb::Vec3I& triangle : soup_.triangles) {
            for (int i = 0; i < 3; ++i) used[triangle[i]] = true;
        }
        for (const openvdb::Index32 corner : soup_.corners) used[corner] = true;
        const auto unused = std::find(used.begin(), used.end(), false);
        if (unused == used.end()) return;
        in_.fail("the file ends within a line, and no face uses point " + std::to_string(unused - used.begin() + 1) +
                 ": it seems to be cut off; if it is whole, end its last line");
    }

    [[noreturn]] void failOutOfRange(const char* where, std::uint64_t points) const
    {
        const char* there = *where == '-' ? " points before it" : " points";
        in_.fail(where,
                 "the corner " + in_.quoted(where) + " is out of range; there are " + std::to_string(points) + there);
    }

    struct OffHeader {
        const char* where;
        std::size_t points, faces;
    };

    TextCursor in_;
    const std::string& name_;
    Warnings& warnings_;
    bool endsWithinLine_;
    std::optional<OffHeader> offHeader_;
    const char* remark_ = nullptr; // the first
    PolygonSoup soup_;
    std::size_t faces_ = 0; // including the ignored ones
    std::vector<openvdb::Index32> face_;
    std::vector<Reference> ahead_; // with growing index
};

template <typename Face>
void writeFace(OutputBuffer& buffer, const Face& face)
{
    buffer.text("f");
    for (int i = 0; i < Face::size; ++i) {
        buffer.text(" ");
        buffer.number(std::uint64_t(face[i]) + 1);
    }
    buffer.text("\n");
}

} // namespace

MeshFile parseObj(std::string_view bytes, const std::string& name)
{
    Warnings warnings;
    std::string storage;
    return ObjParser(asUtf8(bytes, name, storage, warnings), name, warnings).parse();
}

void writeObj(const Mesh& mesh, const std::string&, std::ostream& out)
{
    OutputBuffer buffer(out);
    for (const openvdb::Vec3d& p : mesh.points) {
        buffer.text("v");
        for (int axis = 0; axis < 3; ++axis) {
            buffer.text(" ");
            buffer.number(p[axis]);
        }
        buffer.text("\n");
    }
    for (const openvdb::Vec3I& triangle : mesh.triangles) writeFace(buffer, triangle);
    for (const openvdb::Vec4I& quad : mesh.quads) writeFace(buffer, quad);
    buffer.flush();
}

} // namespace vdbcage::detail
