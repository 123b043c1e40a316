#include <vdbcage/mesh/io/ply_header.h>

#include <algorithm>
#include <array>

#include <vdbcage/mesh/io/text_cursor.h>

namespace vdbcage::detail {

namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

// The original names, those with sizes, and the two of 64 bits that some programs add.
constexpr std::array<TypeName, 18> typeNames{{{"char", PlyType::int8},
                                              {"int8", PlyType::int8},
                                              {"uchar", PlyType::uint8},
                                              {"uint8", PlyType::uint8},
                                              {"short", PlyType::int16},
                                              {"int16", PlyType::int16},
                                              {"ushort", PlyType::uint16},
                                              {"uint16", PlyType::uint16},
                                              {"int", PlyType::int32},
                                              {"int32", PlyType::int32},
                                              {"uint", PlyType::uint32},
                                              {"uint32", PlyType::uint32},
                                              {"int64", PlyType::int64},
                                              {"uint64", PlyType::uint64},
                                              {"float", PlyType::float32},
                                              {"float32", PlyType::float32},
                                              {"double", PlyType::float64},
                                              {"float64", PlyType::float64}}};

class HeaderParser {
public:
    HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), in_(bytes, name) {}

    PlyHeader parse()
    {
        if (!in_.skipWord("ply") || !in_.atLineEnd()) in_.fail("a PLY file begins with a line \"ply\"");
        const char* lineEnd = in_.position();
        in_.nextLine();
        const std::size_t lineEndSize = static_cast<std::size_t>(in_.position() - lineEnd);
        bool hasFormat = false;
        for (;;) {
            if (!in_.skipToWord()) in_.fail("the file ends within its header");
            const char* start = in_.position();
            const std::string_view keyword = in_.word();
            if (keyword == "end_header") break;
            if (keyword == "comment" || keyword == "obj_info") {
                in_.nextLine();
                continue;
            }
            if (keyword == "format") {
                format();
                hasFormat = true;
            } else if (keyword == "element") {
                element();
            } else if (keyword == "property") {
                property(start);
            } else {
                in_.fail(start, in_.quoted(start) + " is not a line of a PLY header");
            }
            if (!in_.atLineEnd()) in_.fail(in_.quoted(in_.position()) + " is not understood here");
        }
        if (!hasFormat) in_.fail("the header does not tell the format");
        // Not nextLine: the first byte of a binary body may look like the second of a line end.
        if (!in_.atLineEnd()) in_.fail(in_.quoted(in_.position()) + " is not understood here");
        header_.size = bytes_.size() - in_.bytesLeft() + std::min(lineEndSize, in_.bytesLeft());
        return header_;
    }

private:
    void format()
    {
        if (in_.skipWord("ascii")) {
            header_.format = PlyFormat::ascii;
        } else if (in_.skipWord("binary_little_endian")) {
            header_.format = PlyFormat::binaryLittleEndian;
        } else if (in_.skipWord("binary_big_endian")) {
            header_.format = PlyFormat::binaryBigEndian;
        } else {
            in_.atLineEnd();
            in_.fail("the format is " + in_.quoted(in_.position()) +
                     "; it must be ascii, binary_little_endian or binary_big_endian");
        }
        if (!in_.skipWord("1.0")) {
            in_.atLineEnd();
            in_.fail("the version of the format is " + in_.quoted(in_.position()) + "; it must be 1.0");
        }
    }

    void element()
    {
        PlyElement element;
        element.name = in_.word();
        in_.atLineEnd();
        const char* where = in_.position();
        const std::int64_t count = in_.integer("the number of elements");
        if (count < 0) in_.fail(where, "the number of elements is " + in_.quoted(where) + ", which is below 0");
        element.count = static_cast<std::uint64_t>(count);
        element.line = in_.lineOf(where);
        header_.elements.push_back(std::move(element));
    }

    void property(const char* start)
    {
        if (header_.elements.empty()) in_.fail(start, "a property stands before the first element");
        PlyProperty property;
        property.isList = in_.skipWord("list");
        if (property.isList) {
            property.countType = type();
            if (property.countType == PlyType::float32 || property.countType == PlyType::float64) {
                in_.fail(start, "the length of a list must be of an integer type");
            }
        }
        property.type = type();
        property.name = in_.word();
        if (property.name.empty()) in_.fail(start, "a property has no name");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type()
    {
        in_.atLineEnd();
        const char* where = in_.position();
        const std::string_view name = in_.word();
        for (const TypeName& candidate : typeNames) {
            if (candidate.name == name) return candidate.type;
        }
        in_.fail(where, in_.quoted(where) + " is not a type of PLY");
    }

    std::string_view bytes_;
    TextCursor in_;
    PlyHeader header_;
};

} // namespace

std::size_t sizeOf(PlyType type)
{
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
        return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64:
        return 8;
    }
    return 0;
}

PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name)
{
    return HeaderParser(bytes, name).parse();
}

} // namespace vdbcage::detail
