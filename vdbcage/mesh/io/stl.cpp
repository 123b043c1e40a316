// Based on: 3D Systems, "StereoLithography Interface Specification" (1989).
// Differs: normals and attributes are not read, and coordinates may be negative; the content of the file decides
// between the two forms, since many binary files begin with the word "solid"; lines of other words may stand between
// facets.

#include <vdbcage/mesh/io/formats.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/moved_bytes.h>
#include <vdbcage/mesh/io/output_buffer.h>
#include <vdbcage/mesh/io/polygon_soup.h>
#include <vdbcage/mesh/io/text_cursor.h>
#include <vdbcage/mesh/io/utf16.h>

namespace vdbcage::detail {

namespace {

constexpr std::size_t headerSize = 84; // 80 bytes of anything and the number of triangles
constexpr std::size_t facetSize = 50;  // a normal, three corners, two bytes of attributes

constexpr const char* coordinateNames[3] = {"the x coordinate", "the y coordinate", "the z coordinate"};

/// A map of corners with the same coordinates (-0 being 0) to the same index: a hash table with open addressing.
class PointMerger {
public:
    explicit PointMerger(std::vector<openvdb::Vec3d>& points) : points_(points), buckets_(1024, empty) {}

    openvdb::Index32 index(const openvdb::Vec3d& p)
    {
        if (2 * points_.size() >= buckets_.size()) grow();
        openvdb::Index32& bucket = buckets_[find(p)];
        if (bucket == empty) {
            bucket = static_cast<openvdb::Index32>(points_.size());
            points_.push_back(p);
        }
        return bucket;
    }

private:
    static constexpr openvdb::Index32 empty = std::numeric_limits<openvdb::Index32>::max();

    static std::uint64_t hash(const openvdb::Vec3d& p)
    {
        std::uint64_t h = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double value = p[axis] + 0.0; // turns -0 into 0
            std::uint64_t bits = 0;
            std::memcpy(&bits, &value, sizeof(bits));
            h = (h ^ bits) * 0x9E3779B97F4A7C15U;
            h ^= h >> 29U;
        }
        return h;
    }
    /// Returns the bucket of `p`, or the empty one where it belongs.
    std::size_t find(const openvdb::Vec3d& p) const
    {
        std::size_t bucket = hash(p) & (buckets_.size() - 1);
        while (buckets_[bucket] != empty && points_[buckets_[bucket]] != p)
            bucket = (bucket + 1) & (buckets_.size() - 1);
        return bucket;
    }
    void grow()
    {
        buckets_.assign(2 * buckets_.size(), empty);
        for (std::size_t i = 0; i < points_.size(); ++i) buckets_[find(points_[i])] = static_cast<openvdb::Index32>(i);
    }

    std::vector<openvdb::Vec3d>& points_;
    std::vector<openvdb::Index32> buckets_; // a power of two of buckets, at most half full
};

template <typename Value>
Value loadLittleEndian(const char* bytes)
{
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "reverse the bytes here");
    Value value;
    std::memcpy(&value, bytes, sizeof(Value));
    return value;
}

/// Returns the normal of a facet, of length 1; zero if it has no area.
openvdb::Vec3s normalOf(const openvdb::Vec3s (&corners)[3])
{
    const openvdb::Vec3d first(corners[0]);
    openvdb::Vec3d normal = (openvdb::Vec3d(corners[1]) - first).cross(openvdb::Vec3d(corners[2]) - first);
    const double length = normal.length();
    if (length > 0) normal /= length;
    return openvdb::Vec3s(normal);
}

/// The pieces of the file that are the numbers of a facet.
struct FacetNumbers {
    std::string_view normal[3];
    std::string_view corners[3][3]; ///< x, y and z of each
};

/// Replaces the numbers of a facet if one of its corners moves. `points` are those read so far, `written(float)` is a
/// number as the file has it.
template <typename Written>
void moveFacet(const FacetNumbers& numbers, const openvdb::Vec3I& triangle, const std::vector<openvdb::Vec3d>& points,
               MovedBytes& moved, const Written& written)
{
    bool isMoved = false;
    openvdb::Vec3s corners[3];
    for (int corner = 0; corner < 3; ++corner) {
        const openvdb::Vec3d& to = moved.point(triangle[corner]);
        isMoved = isMoved || !sameBits(points[triangle[corner]], to);
        corners[corner] = openvdb::Vec3s(to);
    }
    if (!isMoved) return;
    const openvdb::Vec3s normal = normalOf(corners);
    for (int axis = 0; axis < 3; ++axis) moved.replace(numbers.normal[axis], written(normal[axis]));
    for (int corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            if (sameBits(points[triangle[corner]][axis], moved.point(triangle[corner])[axis])) continue;
            moved.replace(numbers.corners[corner][axis], written(corners[corner][axis]));
        }
    }
}

std::string_view lowerCase(std::string_view word, char (&buffer)[16])
{
    const std::size_t length = std::min(word.size(), sizeof(buffer));
    std::transform(word.begin(), word.begin() + std::ptrdiff_t(length), buffer,
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return {buffer, length};
}

class AsciiParser {
public:
    /// Replaces the numbers of facets in `moved`, unless that is null.
    AsciiParser(std::string_view bytes, const std::string& name, Warnings& warnings, MovedBytes* moved = nullptr)
        : in_(bytes, name, {}, &warnings), merger_(soup_.points), moved_(moved)
    {
    }

    PolygonSoup parse()
    {
        do {
            expect("solid");
            in_.nextLine(); // the rest is a name
            passRemarks();
            while (!next("endsolid")) {
                facet();
                if (in_.atLineEnd()) passRemarks();
            }
            in_.nextLine();
        } while (in_.skipToWord()); // some files hold several solids
        return std::move(soup_);
    }

private:
    void facet()
    {
        FacetNumbers numbers;
        expect("facet");
        expect("normal");
        // The corners determine the normal; that of a face without area is often written as "nan".
        for (std::string_view& number : numbers.normal) {
            number = in_.word();
            if (number.empty()) in_.fail("the facet's normal is missing; it has three numbers");
        }
        expect("outer");
        expect("loop");
        openvdb::Vec3I triangle;
        for (int corner = 0; corner < 3; ++corner) {
            expect("vertex");
            openvdb::Vec3d p;
            for (int axis = 0; axis < 3; ++axis) {
                p[axis] = in_.coordinate(coordinateNames[axis], &numbers.corners[corner][axis]);
            }
            triangle[corner] = merger_.index(p);
        }
        expect("endloop");
        expect("endfacet");
        soup_.triangles.push_back(triangle);
        // The digits of a float read back as that value, whether as a float or as a double.
        const auto written = [](float value) { return numberText(double(value)); };
        if (moved_) moveFacet(numbers, triangle, soup_.points, *moved_, written);
    }

    /// Skips whole lines: remarks, or additions of programs such as colours. A line with a word of the format may be a
    /// mistyped part of a facet and is not skipped, unless its first word marks a remark.
    void passRemarks()
    {
        constexpr std::array<std::string_view, 9> keywords{"facet",  "endsolid", "normal",   "outer", "loop",
                                                           "vertex", "endloop",  "endfacet", "solid"};
        constexpr std::string_view signs = "#$%&!*/;-"; // of remarks in other formats
        while (in_.skipToWord()) {
            TextCursor ahead = in_;
            const std::string_view first = ahead.word();
            const bool isSigned = signs.find(first.front()) != std::string_view::npos;
            char buffer[16];
            for (std::string_view word = first; !isSigned && !word.empty(); word = ahead.word()) {
                const auto found = std::find(keywords.begin(), keywords.end(), lowerCase(word, buffer));
                if (found != keywords.end()) return;
            }
            if (!mayBeginRemark(first)) return;
            in_.warn(in_.position(), remarkWarning);
            in_.nextLine();
        }
    }

    /// Skips the next word, on this line or a later one, if it is `keyword`.
    bool next(const char* keyword)
    {
        if (!in_.skipToWord()) in_.fail("the file ends before \"endsolid\"; copy or export it again");
        TextCursor ahead = in_;
        char buffer[16];
        if (lowerCase(ahead.word(), buffer) != keyword) return false;
        in_.word();
        return true;
    }
    void expect(const char* keyword)
    {
        if (!next(keyword)) in_.fail(in_.quoted(in_.position()) + " stands here; it must be \"" + keyword + "\"");
    }

    TextCursor in_;
    PolygonSoup soup_;
    PointMerger merger_;
    MovedBytes* moved_;
};

FacetNumbers binaryNumbers(std::string_view facet)
{
    FacetNumbers numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        numbers.normal[axis] = facet.substr(4 * axis, 4);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            numbers.corners[corner][axis] = facet.substr(12 * (corner + 1) + 4 * axis, 4);
        }
    }
    return numbers;
}

std::string littleEndian(float value)
{
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "reverse the bytes here");
    std::string bytes(sizeof(value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(value));
    return bytes;
}

/// Replaces the numbers of facets in `moved`, unless that is null.
PolygonSoup parseBinary(std::string_view bytes, const std::string& name, MovedBytes* moved = nullptr)
{
    const auto fail = [&](std::size_t byte, const std::string& problem) {
        throw IoError(name + ": byte " + std::to_string(byte) + ": " + problem);
    };
    if (bytes.size() < headerSize) {
        fail(bytes.size(), "the file ends within the header of a binary STL (84 bytes); copy or export it again");
    }
    const std::uint64_t count = loadLittleEndian<std::uint32_t>(bytes.data() + 80);
    const std::uint64_t end = headerSize + count * facetSize;
    if (bytes.size() < end) {
        fail(80, "the header announces " + std::to_string(count) + " triangles, which take " + std::to_string(end) +
                     " bytes, but the file has " + std::to_string(bytes.size()) + "; copy or export it again");
    }
    if (bytes.substr(end).find_first_not_of('\0') != std::string_view::npos) {
        fail(end, "the last of " + std::to_string(count) + " triangles ends here, but " +
                      std::to_string(bytes.size() - end) + " bytes follow; copy or export the file again");
    }
    PolygonSoup soup;
    soup.triangles.reserve(count);
    PointMerger merger(soup.points);
    for (std::size_t facet = headerSize; facet < end; facet += facetSize) {
        openvdb::Vec3I triangle;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            openvdb::Vec3d p;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t at = facet + 12 * (corner + 1) + 4 * axis;
                const float value = loadLittleEndian<float>(bytes.data() + at);
                if (!std::isfinite(value)) {
                    fail(at, coordinateNames[axis] + std::string(" of triangle ") +
                                 std::to_string((facet - headerSize) / facetSize + 1) + " is " +
                                 numberText(double(value)) + "; coordinates must be finite");
                }
                p[int(axis)] = double(value);
            }
            triangle[int(corner)] = merger.index(p);
        }
        soup.triangles.push_back(triangle);
        if (moved) moveFacet(binaryNumbers(bytes.substr(facet)), triangle, soup.points, *moved, littleEndian);
    }
    return soup;
}

/// Returns whether the size is the one that the header of a binary file announces.
bool hasBinarySize(std::string_view bytes)
{
    if (bytes.size() < headerSize) return false;
    return bytes.size() == headerSize + facetSize * loadLittleEndian<std::uint32_t>(bytes.data() + 80);
}

/// Returns whether a file without the size of a binary one (it may be a cut-off binary file) is ascii: it begins with
/// "solid" and has no zero byte near its start. In a binary file the number of triangles, if below 2^24, and the
/// attributes have zero bytes.
bool looksAscii(std::string_view bytes)
{
    if (bytes.substr(0, 256).find('\0') != std::string_view::npos) return false;
    const std::string noName;
    TextCursor in(bytes, noName);
    char buffer[16];
    return in.skipToWord() && lowerCase(in.word(), buffer) == "solid";
}

/// Returns the text of an ascii file, and nothing of a binary one. `storage` is that of asUtf8().
std::optional<std::string_view> asciiText(std::string_view bytes, const std::string& name, std::string& storage,
                                          Warnings& warnings)
{
    if (hasBinarySize(bytes)) return std::nullopt;
    const std::string_view text = asUtf8(bytes, name, storage, warnings);
    if (looksAscii(text)) return text;
    warnings = {};
    return std::nullopt;
}

} // namespace

MeshFile parseStl(std::string_view bytes, const std::string& name)
{
    Warnings warnings;
    std::string storage;
    const std::optional<std::string_view> text = asciiText(bytes, name, storage, warnings);
    PolygonSoup soup = text ? AsciiParser(*text, name, warnings).parse() : parseBinary(bytes, name);
    return toMesh(std::move(soup), name, warnings);
}

std::string movedStl(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points)
{
    Warnings warnings; // the same as when it was read as a mesh
    std::string storage;
    const std::optional<std::string_view> text = asciiText(bytes, name, storage, warnings);
    MovedBytes moved(text.value_or(bytes), points);
    if (text) {
        AsciiParser(*text, name, warnings, &moved).parse();
    } else {
        parseBinary(bytes, name, &moved);
    }
    return moved.finish();
}

void writeStl(const Mesh& mesh, const std::string& name, std::ostream& out)
{
    const std::vector<openvdb::Vec3I> triangles = triangulate(mesh);
    if (triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw IoError(name + ": an STL file cannot hold " + std::to_string(triangles.size()) + " triangles");
    }
    OutputBuffer buffer(out);
    constexpr std::string_view header = "binary STL"; // not "solid", which some readers take for ascii
    buffer.text(header);
    buffer.text(std::string(80 - header.size(), '\0'));
    buffer.binary(static_cast<std::uint32_t>(triangles.size()));
    for (const openvdb::Vec3I& triangle : triangles) {
        openvdb::Vec3s corners[3];
        for (int corner = 0; corner < 3; ++corner) corners[corner] = openvdb::Vec3s(mesh.points[triangle[corner]]);
        const openvdb::Vec3s normal = normalOf(corners);
        for (int axis = 0; axis < 3; ++axis) buffer.binary(normal[axis]);
        for (const openvdb::Vec3s& p : corners) {
            for (int axis = 0; axis < 3; ++axis) buffer.binary(p[axis]);
        }
        buffer.binary(std::uint16_t(0));
    }
    buffer.flush();
}

} // namespace vdbcage::detail
