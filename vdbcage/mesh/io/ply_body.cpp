// Based on: Turk, "The PLY Polygon File Format" (1994).
// Differs: elements and properties other than the points' coordinates and the faces' (or strips') corners are skipped;
// 64 bit integers are known. Data after the last element is an error, as in OFF, except for blanks and zero bytes.

#include <vdbcage/mesh/io/formats.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/moved_bytes.h>
#include <vdbcage/mesh/io/output_buffer.h>
#include <vdbcage/mesh/io/ply_header.h>
#include <vdbcage/mesh/io/polygon_soup.h>
#include <vdbcage/mesh/io/text_cursor.h>
#include <vdbcage/mesh/io/utf16.h>

namespace vdbcage::detail {

namespace {

constexpr const char* coordinateNames[3] = {"the x coordinate", "the y coordinate", "the z coordinate"};

bool isFloating(PlyType type)
{
    return type == PlyType::float32 || type == PlyType::float64;
}

/// Returns whether a property of "vertex" is x, y or z.
bool isCoordinate(const PlyProperty& property)
{
    return property.name == "x" || property.name == "y" || property.name == "z";
}

std::string ordinal(const PlyElement& element, std::uint64_t i)
{
    return "element " + quote(element.name) + " " + std::to_string(i + 1) + " of " + std::to_string(element.count);
}

/// The body of an ascii file: one line for each element.
class AsciiSource {
public:
    AsciiSource(std::string_view bytes, std::size_t headerSize, const std::string& name, Warnings& warnings)
        : in_(bytes, name, {}, &warnings)
    {
        while (bytes.size() - in_.bytesLeft() < headerSize) in_.nextLine();
    }

    /// Returns the fewest bytes of a value: a digit and a blank.
    static std::size_t leastSize(PlyType) { return 2; }
    /// Returns the bytes left, and one more: the last line may lack its end.
    std::uint64_t room() const { return std::uint64_t(in_.bytesLeft()) + 1; }

    void beginElement(const PlyElement& element, std::uint64_t i)
    {
        if (!in_.skipToWord()) in_.fail("the file ends before " + ordinal(element, i) + "; copy or export it again");
    }
    void endElement(const PlyElement& element, std::uint64_t i)
    {
        // MeshLab has written texture coordinates of corners that are not in its header.
        bool hasMore = false;
        while (element.name == "face" && !in_.atLineEnd() && in_.skipNumber()) hasMore = true;
        if (!in_.atLineEnd()) {
            in_.fail(in_.quoted(in_.position()) + " follows the properties of " + ordinal(element, i) +
                     "; the header must have a property for each value");
        }
        if (hasMore) {
            in_.warn(in_.position(), "the line of a face has more values than the header says; they are not used");
        }
        in_.nextLine();
    }
    double coordinate(PlyType, int axis)
    {
        mark();
        return in_.coordinate(coordinateNames[axis], &coordinate_);
    }
    /// Returns the piece of the file that is the coordinate read last.
    std::string_view lastCoordinate() const { return coordinate_; }
    /// Returns a coordinate as the file has it. The digits of a float read back as that value, whether as a float or as
    /// a double.
    static std::string written(PlyType type, double value)
    {
        return numberText(type == PlyType::float32 ? double(float(value)) : value);
    }
    std::int64_t integer(PlyType type, const char* what)
    {
        mark();
        if (!isFloating(type)) return in_.integer(what);
        const double value = in_.coordinate(what);
        if (std::abs(value) > 1e15 || std::nearbyint(value) != value) {
            fail(std::string(what) + " is " + in_.quoted(marked_) + ", which is not an integer; write a whole number");
        }
        return static_cast<std::int64_t>(value);
    }
    void skip(PlyType, std::uint64_t count)
    {
        mark();
        for (; count > 0; --count) {
            if (in_.word().empty()) {
                in_.fail("the line ends before the element is complete; each property needs a value");
            }
        }
    }
    void finish()
    {
        if (in_.skipToWord()) {
            in_.fail(in_.quoted(in_.position()) + " follows the last element; correct the counts of the header");
        }
    }
    /// \throw IoError for the value read last
    [[noreturn]] void fail(const std::string& problem) const { in_.fail(marked_, problem); }

private:
    void mark()
    {
        in_.atLineEnd(); // to the start of the word
        marked_ = in_.position();
    }

    TextCursor in_;
    const char* marked_ = nullptr;
    std::string_view coordinate_;
};

/// The body of a binary file.
class BinarySource {
public:
    BinarySource(std::string_view bytes, std::size_t headerSize, const std::string& name, bool reversed)
        : bytes_(bytes), at_(headerSize), marked_(headerSize), name_(name), reversed_(reversed)
    {
    }

    static std::size_t leastSize(PlyType type) { return sizeOf(type); }
    std::uint64_t room() const { return bytes_.size() - at_; }

    void beginElement(const PlyElement& element, std::uint64_t i)
    {
        element_ = &element;
        index_ = i;
    }
    void endElement(const PlyElement&, std::uint64_t) {}
    double coordinate(PlyType type, int axis)
    {
        const double value = isFloating(type) ? floating(type) : static_cast<double>(whole(type));
        if (!std::isfinite(value)) {
            fail(coordinateNames[axis] + std::string(" of ") + ordinal(*element_, index_) + " is " + numberText(value) +
                 "; coordinates must be finite");
        }
        return value;
    }
    std::string_view lastCoordinate() const { return bytes_.substr(marked_, at_ - marked_); }
    std::string written(PlyType type, double value) const
    {
        return type == PlyType::float32 ? store(float(value)) : store(value);
    }
    std::int64_t integer(PlyType type, const char* what)
    {
        if (!isFloating(type)) return whole(type);
        const double value = floating(type);
        if (!(std::abs(value) <= 1e15) || std::nearbyint(value) != value) {
            fail(std::string(what) + " is " + numberText(value) + ", which is not an integer; write a whole number");
        }
        return static_cast<std::int64_t>(value);
    }
    void skip(PlyType type, std::uint64_t count)
    {
        const std::size_t size = sizeOf(type);
        if (count > room() / size) failEnd();
        at_ += static_cast<std::size_t>(count) * size;
    }
    void finish()
    {
        marked_ = at_;
        const auto isPadding = [](char c) { return c == '\0' || c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
        if (!std::all_of(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), bytes_.end(), isPadding)) {
            fail("the last element ends here, but " + std::to_string(room()) +
                 " bytes follow; copy or export the file again");
        }
    }
    /// \throw IoError for the value read last
    [[noreturn]] void fail(const std::string& problem) const
    {
        throw IoError(name_ + ": byte " + std::to_string(marked_) + ": " + problem);
    }

private:
    [[noreturn]] void failEnd()
    {
        marked_ = bytes_.size();
        fail("the file ends within " + ordinal(*element_, index_) + "; copy or export it again");
    }

    template <typename Value>
    Value load()
    {
        if (room() < sizeof(Value)) failEnd();
        marked_ = at_;
        char raw[sizeof(Value)];
        std::memcpy(raw, bytes_.data() + at_, sizeof(Value));
        if (reversed_) std::reverse(raw, raw + sizeof(Value));
        at_ += sizeof(Value);
        Value value;
        std::memcpy(&value, raw, sizeof(Value));
        return value;
    }
    template <typename Value>
    std::string store(Value value) const
    {
        std::string raw(sizeof(Value), '\0');
        std::memcpy(raw.data(), &value, sizeof(Value));
        if (reversed_) std::reverse(raw.begin(), raw.end());
        return raw;
    }
    double floating(PlyType type) { return type == PlyType::float32 ? double(load<float>()) : load<double>(); }
    std::int64_t whole(PlyType type)
    {
        switch (type) {
        case PlyType::int8:
            return load<std::int8_t>();
        case PlyType::uint8:
            return load<std::uint8_t>();
        case PlyType::int16:
            return load<std::int16_t>();
        case PlyType::uint16:
            return load<std::uint16_t>();
        case PlyType::int32:
            return load<std::int32_t>();
        case PlyType::uint32:
            return load<std::uint32_t>();
        case PlyType::int64:
            return load<std::int64_t>();
        default:
            break;
        }
        const std::uint64_t value = load<std::uint64_t>();
        return static_cast<std::int64_t>(std::min<std::uint64_t>(value, std::numeric_limits<std::int64_t>::max()));
    }

    std::string_view bytes_;
    std::size_t at_, marked_;
    const std::string& name_;
    bool reversed_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};

/// The use of a property.
enum class Use { x, y, z, face, strips, none };

template <typename Source>
class BodyParser {
public:
    /// Replaces the coordinates in `moved`, unless that is null.
    BodyParser(const PlyHeader& header, const std::string& name, Source source, MovedBytes* moved)
        : header_(header), name_(name), in_(std::move(source)), moved_(moved)
    {
    }

    PolygonSoup parse()
    {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") points_ = element.count;
        }
        for (const PlyElement& element : header_.elements) read(element);
        in_.finish();
        return std::move(soup_);
    }

private:
    void read(const PlyElement& element)
    {
        const bool hasPoints = element.name == "vertex";
        const bool hasFaces = element.name == "face";
        const bool hasStrips = element.name == "tristrips";
        if (!hasPoints && !hasFaces && !hasStrips) soup_.ignoredElements += static_cast<std::size_t>(element.count);
        if (element.properties.empty()) return;

        uses_.clear();
        std::uint64_t least = 0;
        for (const PlyProperty& property : element.properties) {
            Use use = Use::none;
            const std::string& name = property.name;
            if (hasPoints && isCoordinate(property)) use = Use(name[0] - 'x');
            if (name == "vertex_indices" || name == "vertex_index") {
                if (hasFaces) use = Use::face;
                if (hasStrips) use = Use::strips;
            }
            uses_.push_back(use);
            least += Source::leastSize(property.isList ? property.countType : property.type);
        }
        // Checked before anything is stored: a header can announce more than any memory holds.
        if (element.count > in_.room() / least) {
            throw IoError(name_ + ": line " + std::to_string(element.line) + ": the header announces " +
                          std::to_string(element.count) + " elements " + quote(element.name) + " of at least " +
                          std::to_string(least) + " bytes, but only " + std::to_string(in_.room()) +
                          " bytes are left; copy or export the file again");
        }
        const std::size_t count = static_cast<std::size_t>(element.count);
        if (hasPoints) soup_.points.reserve(count);
        if (hasFaces) soup_.triangles.reserve(std::min<std::size_t>(count, in_.room() / 8));
        for (std::size_t i = 0; i < count; ++i) {
            in_.beginElement(element, i);
            openvdb::Vec3d point(0, 0, 0);
            for (std::size_t j = 0; j < element.properties.size(); ++j) {
                const PlyProperty& property = element.properties[j];
                if (uses_[j] <= Use::z) {
                    const int axis = int(uses_[j]);
                    point[axis] = in_.coordinate(property.type, axis);
                    if (moved_) move(property.type, point[axis], moved_->point(i)[axis]);
                } else if (property.isList) {
                    list(property, uses_[j]);
                } else {
                    in_.skip(property.type, 1);
                }
            }
            in_.endElement(element, i);
            if (hasPoints) soup_.points.push_back(point);
        }
    }

    void move(PlyType type, double from, double to)
    {
        if (!sameBits(from, to)) moved_->replace(in_.lastCoordinate(), in_.written(type, to));
    }

    void list(const PlyProperty& property, Use use)
    {
        const std::int64_t count = in_.integer(property.countType, "the length of a list");
        if (count < 0) {
            in_.fail("the length of a list is " + std::to_string(count) + ", which is below 0; it must be 0 or more");
        }
        if (std::uint64_t(count) > in_.room() / Source::leastSize(property.type)) {
            in_.fail("a list of " + std::to_string(count) + " values cannot fit in the " + std::to_string(in_.room()) +
                     " bytes that are left; copy or export the file again");
        }
        if (use == Use::none) {
            in_.skip(property.type, std::uint64_t(count));
            return;
        }
        face_.clear();
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t index = in_.integer(property.type, "the index of a corner");
            if (use == Use::strips && index == -1) { // begins a new strip
                addStrip();
                continue;
            }
            if (index < 0 || std::uint64_t(index) >= points_) {
                in_.fail("the corner " + std::to_string(index) + " is out of range; there are " +
                         std::to_string(points_) + " points, counted from 0");
            }
            face_.push_back(static_cast<openvdb::Index32>(index));
        }
        if (use == Use::strips) {
            addStrip();
        } else {
            soup_.addFace(face_.data(), face_.size());
        }
    }

    /// Makes a triangle of each corner from the third on with the two before it, every second one reversed. A repeated
    /// corner only steers the strip: its triangle is not part of the surface.
    void addStrip()
    {
        for (std::size_t i = 2; i < face_.size(); ++i) {
            const openvdb::Index32 a = face_[i - 2], b = face_[i - 1], c = face_[i];
            if (a == b || b == c || c == a) continue;
            if (i % 2 == 0) {
                soup_.triangles.emplace_back(a, b, c);
            } else {
                soup_.triangles.emplace_back(b, a, c);
            }
        }
        face_.clear();
    }

    const PlyHeader& header_;
    const std::string& name_;
    Source in_;
    MovedBytes* moved_;
    PolygonSoup soup_;
    std::uint64_t points_ = 0;
    std::vector<Use> uses_;
    std::vector<openvdb::Index32> face_;
};

/// Returns whether these are the points of Gaussian splats (Kerbl et al., "3D Gaussian Splatting for Real-Time Radiance
/// Field Rendering", 2023), as the training writes them or as SuperSplat packs them.
bool areSplats(const PlyElement& points)
{
    const auto hasAll = [&](std::initializer_list<std::string_view> names) {
        return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
            return std::any_of(points.properties.begin(), points.properties.end(),
                               [&](const PlyProperty& property) { return property.name == name; });
        });
    };
    return hasAll({"opacity", "scale_0", "rot_0"}) || hasAll({"packed_position", "packed_scale", "packed_rotation"});
}

void requireGeometry(const PlyHeader& header, const std::string& name)
{
    const auto fail = [&](std::size_t line, const std::string& problem) {
        throw IoError(name + ": line " + std::to_string(line) + ": the PLY header " + problem);
    };
    const bool hasFaces = std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
        return element.count > 0 && (element.name == "face" || element.name == "tristrips");
    });
    int points = 0;
    for (const PlyElement& element : header.elements) {
        if (element.name != "vertex") continue;
        if (!hasFaces && areSplats(element)) {
            fail(element.line, "is that of Gaussian splats, which have no faces; make a mesh of them first");
        }
        if (++points == 2) fail(element.line, "has two elements \"vertex\"; there must be one");
        for (const char* axis : {"x", "y", "z"}) {
            const auto isAxis = [&](const PlyProperty& property) { return property.name == axis; };
            const auto found = std::find_if(element.properties.begin(), element.properties.end(), isAxis);
            const std::string property = std::string(" property \"") + axis + "\" of \"vertex\"";
            if (found == element.properties.end()) fail(element.line, "has no" + property + "; points have x, y and z");
            if (std::count_if(element.properties.begin(), element.properties.end(), isAxis) != 1) {
                fail(element.line, "has more than one" + property + "; there must be one");
            }
            if (found->isList) fail(element.line, "makes the" + property + " a list; it must be a number");
        }
    }
    if (points == 0) fail(header.endLine, "has no element \"vertex\"; there must be one, with x, y and z");
    for (const PlyElement& element : header.elements) {
        if (element.name != "face" && element.name != "tristrips") continue;
        const auto isCorners = [](const PlyProperty& p) {
            return p.name == "vertex_indices" || p.name == "vertex_index";
        };
        const auto found = std::find_if(element.properties.begin(), element.properties.end(), isCorners);
        if (element.count > 0 && found == element.properties.end()) {
            fail(element.line,
                 "has no property \"vertex_indices\" of \"" + element.name + "\"; it must have that list");
        }
        if (found != element.properties.end() && !found->isList) {
            fail(element.line,
                 "makes the property \"" + found->name + "\" of \"" + element.name + "\" no list; it must be a list");
        }
    }
}

/// The text of a header and what it says.
struct CheckedHeader {
    std::string_view bytes; ///< of the file, as UTF-8
    PlyHeader header;
};

/// Reads the header and checks that the file has points and faces. `storage` is that of asUtf8().
CheckedHeader checkedHeader(std::string_view given, const std::string& name, std::string& storage, Warnings& warnings)
{
    const std::string_view bytes = asUtf8(given, name, storage, warnings);
    CheckedHeader checked{bytes, parsePlyHeader(bytes, name, warnings)};
    requireGeometry(checked.header, name);
    if (checked.header.format != PlyFormat::ascii && bytes.data() != given.data()) {
        throw IoError(name + ": line " + std::to_string(checked.header.endLine) +
                      ": binary data follow text of UTF-16; export the file again, as ascii or as binary");
    }
    return checked;
}

/// Reads what follows the header, and replaces the coordinates in `moved`, unless that is null.
PolygonSoup parseBody(const CheckedHeader& checked, const std::string& name, Warnings& warnings,
                      MovedBytes* moved = nullptr)
{
    const auto& [bytes, header] = checked;
    if (header.format == PlyFormat::ascii) {
        return BodyParser(header, name, AsciiSource(bytes, header.size, name, warnings), moved).parse();
    }
    const bool reversed = header.format == PlyFormat::binaryBigEndian;
    return BodyParser(header, name, BinarySource(bytes, header.size, name, reversed), moved).parse();
}

template <typename Face>
void writeFace(OutputBuffer& buffer, const Face& face)
{
    buffer.binary(std::uint8_t(Face::size));
    for (int i = 0; i < Face::size; ++i) buffer.binary(std::uint32_t(face[i]));
}

} // namespace

MeshFile parsePly(std::string_view bytes, const std::string& name)
{
    Warnings warnings;
    std::string storage;
    const CheckedHeader checked = checkedHeader(bytes, name, storage, warnings);
    PolygonSoup soup = parseBody(checked, name, warnings);
    return toMesh(std::move(soup), name, warnings);
}

std::optional<Precision> plyPrecision(std::string_view bytes, const std::string& name)
{
    Warnings warnings; // the same as when it is read as a mesh
    std::string storage;
    Precision precision = Precision::float64;
    for (const PlyElement& element : checkedHeader(bytes, name, storage, warnings).header.elements) {
        if (element.name != "vertex") continue;
        for (const PlyProperty& property : element.properties) {
            if (!isCoordinate(property)) continue;
            if (!isFloating(property.type)) return std::nullopt;
            if (property.type == PlyType::float32) precision = Precision::float32;
        }
    }
    return precision;
}

std::string movedPly(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points)
{
    Warnings warnings; // the same as when it was read as a mesh
    std::string storage;
    const CheckedHeader checked = checkedHeader(bytes, name, storage, warnings);
    MovedBytes moved(checked.bytes, points);
    parseBody(checked, name, warnings, &moved);
    return moved.finish();
}

void writePly(const Mesh& mesh, const std::string&, std::ostream& out)
{
    writePly(mesh, nullptr, out);
}

void writePly(const Mesh& mesh, const std::vector<PointColour>* colours, std::ostream& out)
{
    OutputBuffer buffer(out);
    buffer.text("ply\nformat binary_little_endian 1.0\nelement vertex ");
    buffer.number(mesh.points.size());
    buffer.text("\nproperty double x\nproperty double y\nproperty double z\n");
    if (colours) buffer.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
    buffer.text("element face ");
    buffer.number(faceCount(mesh));
    // Most programs write and read signed indices; they suffice for all but the largest meshes.
    const bool isHuge = mesh.points.size() > std::size_t(std::numeric_limits<std::int32_t>::max());
    buffer.text(isHuge ? "\nproperty list uchar uint vertex_indices\nend_header\n"
                       : "\nproperty list uchar int vertex_indices\nend_header\n");
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) buffer.binary(mesh.points[i][axis]);
        if (!colours) continue;
        for (const std::uint8_t channel : (*colours)[i]) buffer.binary(channel);
    }
    for (const openvdb::Vec3I& triangle : mesh.triangles) writeFace(buffer, triangle);
    for (const openvdb::Vec4I& quad : mesh.quads) writeFace(buffer, quad);
    buffer.flush();
}

} // namespace vdbcage::detail
