#include <vdbcage/mesh/io/ply_header.h>

#include <algorithm>
#include <array>
#include <optional>

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

std::optional<PlyType> typeNamed(std::string_view name)
{
    for (const TypeName& candidate : typeNames) {
        if (candidate.name == name) return candidate.type;
    }
    return std::nullopt;
}

class HeaderParser {
public:
    HeaderParser(std::string_view bytes, const std::string& name, Warnings& warnings)
        : bytes_(bytes), in_(bytes, name, {}, &warnings)
    {
    }

    PlyHeader parse()
    {
        if (!in_.skipWord("ply") || !in_.atLineEnd()) {
            in_.fail("the first line is not that of a PLY file; it must be \"ply\"");
        }
        const std::string_view firstEnd = lineEnd();
        in_.nextLine();
        bool hasFormat = false;
        for (;;) {
            if (!in_.skipToWord()) in_.fail("the file ends within its header; it must end with a line \"end_header\"");
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
                freeText(start);
                continue;
            }
            requireLineEnd();
        }
        if (!hasFormat) in_.fail("the header does not tell the format; it needs a line like \"format ascii 1.0\"");
        requireLineEnd();
        // The first byte of a binary body may look like the second of a line end: if lines end in CR, this one does.
        const std::string_view lastEnd = firstEnd == "\r" ? lineEnd().substr(0, 1) : lineEnd();
        header_.size = bytes_.size() - in_.bytesLeft() + lastEnd.size();
        header_.endLine = in_.lineOf(in_.position());
        if (header_.format != PlyFormat::ascii && lastEnd != "\n") {
            in_.warn(in_.position(),
                     "the header ends in CR LF or CR before binary data, which are taken to begin behind it");
        }
        return header_;
    }

private:
    /// Returns the end of the line here: LF, CR LF or CR; nothing at the end of the file.
    std::string_view lineEnd() const
    {
        const std::string_view left = bytes_.substr(bytes_.size() - in_.bytesLeft());
        return left.substr(0, left.substr(0, 2) == "\r\n" ? 2 : 1);
    }

    void requireLineEnd()
    {
        if (in_.atLineEnd()) return;
        in_.fail(in_.quoted(in_.position()) + " is not understood here; the line must end before it");
    }

    /// Reads a line in the place of comments that lacks the keyword and has nothing about the data. Blender 2.47 has
    /// written such lines.
    void freeText(const char* start)
    {
        std::vector<std::string_view> words{{start, static_cast<std::size_t>(in_.position() - start)}};
        while (!in_.atLineEnd()) words.push_back(in_.word());
        const std::string_view line(start, static_cast<std::size_t>(in_.position() - start));
        const auto isControl = [](char c) { return (c >= 0 && c < ' ' && c != '\t') || c == '\x7F'; };
        // A line may have a mistyped keyword. It is not skipped where the rest looks like that of a known line.
        const bool isFormat = words.size() > 1 && (words[1] == "ascii" || words[1].substr(0, 7) == "binary_");
        const bool isElement = words.size() == 3 && words[2].find_first_not_of("0123456789") == std::string_view::npos;
        const bool isProperty = words.size() > 1 && (words[1] == "list" || typeNamed(words[1]));
        if (!header_.elements.empty() || isFormat || isElement || isProperty ||
            std::any_of(line.begin(), line.end(), isControl)) {
            in_.fail(start, in_.quoted(start) + " is not a line of a PLY header; it must begin with format, comment, "
                                                "obj_info, element, property or end_header");
        }
        in_.warn(start, "a line of the header has no keyword; it is taken for a comment");
        in_.nextLine();
    }

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
        if (count < 0) {
            in_.fail(where,
                     "the number of elements is " + in_.quoted(where) + ", which is below 0; it must be 0 or more");
        }
        element.count = static_cast<std::uint64_t>(count);
        element.line = in_.lineOf(where);
        header_.elements.push_back(std::move(element));
    }

    void property(const char* start)
    {
        if (header_.elements.empty()) {
            in_.fail(start, "a property stands before the first element; a line like \"element vertex 8\" comes first");
        }
        PlyProperty property;
        property.isList = in_.skipWord("list");
        if (property.isList) {
            property.countType = type();
            if (property.countType == PlyType::float32 || property.countType == PlyType::float64) {
                in_.fail(start, "the length of a list is not of an integer type; it must be, like uchar or int");
            }
        }
        property.type = type();
        property.name = in_.word();
        if (property.name.empty()) in_.fail(start, "a property has no name; it must follow the type");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type()
    {
        in_.atLineEnd();
        const char* where = in_.position();
        const std::string_view name = in_.word();
        if (const std::optional<PlyType> type = typeNamed(name)) return *type;
        in_.fail(where, in_.quoted(where) + " is not a type of PLY; there are char, uchar, short, ushort, int, uint, "
                                            "float and double");
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

PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name, Warnings& warnings)
{
    return HeaderParser(bytes, name, warnings).parse();
}

} // namespace vdbcage::detail
