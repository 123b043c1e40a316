// Based on: NumPy Enhancement Proposal 1 with numpy.lib.format for the versions 2.0 and 3.0;
// libigl.github.io/file-formats/dmat.

#include <vdbcage/deform/detail/given_weights.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/text_cursor.h>

namespace vdbcage::detail {

namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "reverse the bytes here");

// Rows rounded to floats, or to six decimals in a cage of 2000 points or fewer, stay within this tolerance.
constexpr double sumTolerance = 1e-3;

[[noreturn]] void fail(const std::string& name, const std::string& problem)
{
    throw IoError(name + ": " + problem);
}

std::string counted(std::size_t count, const char* what)
{
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

/// \throw IoError unless a matrix of this size has points x cage points
void requireShape(std::size_t rows, std::size_t columns, const std::string& name, std::size_t points,
                  std::size_t cagePoints)
{
    if (rows == points && columns == cagePoints) return;
    if (rows == cagePoints && columns == points) {
        fail(name, "it is transposed: it has " + counted(rows, "row") + " and " + counted(columns, "column") +
                       "; rows are the model's " + counted(points, "point") + ", columns the cage's " +
                       std::to_string(cagePoints));
    }
    if (rows != points) {
        fail(name, "it has " + counted(rows, "row") + "; rows: the model has " + counted(points, "point"));
    }
    fail(name, "it has " + counted(columns, "column") + "; columns: the cage has " + counted(cagePoints, "point"));
}

/// Returns numbers of a file as floats, row after row; in the file they are column after column if `byColumns`.
template <typename Number>
std::vector<float> takeNumbers(std::string_view data, const std::string& name, std::size_t rows, std::size_t columns,
                               bool byColumns)
{
    const std::size_t needed = rows * columns * sizeof(Number);
    if (data.size() < needed) {
        fail(name, "it is truncated: " + counted(rows, "row") + " of " + counted(columns, "column") + " need " +
                       std::to_string(needed) + " bytes; it has " + std::to_string(data.size()));
    }
    if (data.size() > needed) {
        fail(name, "it has " + std::to_string(data.size() - needed) + " bytes behind the weights; it should end there");
    }
    std::vector<float> weights(rows * columns);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        Number number;
        std::memcpy(&number, data.data() + i * sizeof number, sizeof number);
        weights[byColumns ? i % rows * columns + i / rows : i] = static_cast<float>(number);
    }
    return weights;
}

/// The contents of a .npy file's header.
struct NpyHeader {
    std::string_view type;
    bool fortranOrder = false;
    std::vector<std::size_t> shape;
};

/// A parser of a header, which is the text of a Python dictionary.
class NpyHeaderParser {
public:
    NpyHeaderParser(std::string_view text, const std::string& name) : text_(text), left_(text), name_(name) {}

    NpyHeader parse()
    {
        NpyHeader header;
        std::array<bool, 3> has{};
        expect('{');
        while (!skip('}')) {
            const std::string_view key = string();
            expect(':');
            if (key == "descr") {
                if (next() == '[') fail(name_, "it holds records; weights are plain numbers, '<f4' or '<f8'");
                header.type = string();
                has[0] = true;
            } else if (key == "fortran_order") {
                header.fortranOrder = boolean();
                has[1] = true;
            } else if (key == "shape") {
                header.shape = tuple();
                has[2] = true;
            } else {
                failParsing();
            }
            if (!skip(',') && next() != '}') failParsing();
        }
        if (next() != '\0' || !has[0] || !has[1] || !has[2]) failParsing();
        return header;
    }

private:
    [[noreturn]] void failParsing() const { fail(name_, "it has no header of a NumPy array, but " + quote(text_)); }

    /// Returns the next character that is not blank, 0 at the end.
    char next()
    {
        const std::size_t blanks = left_.find_first_not_of(" \n");
        left_.remove_prefix(blanks == std::string_view::npos ? left_.size() : blanks);
        return left_.empty() ? '\0' : left_.front();
    }
    bool skip(char c)
    {
        if (next() != c || left_.empty()) return false;
        left_.remove_prefix(1);
        return true;
    }
    void expect(char c)
    {
        if (!skip(c)) failParsing();
    }
    std::string_view string()
    {
        const char mark = next();
        if (mark != '\'' && mark != '"') failParsing();
        const std::size_t end = left_.find(mark, 1);
        if (end == std::string_view::npos) failParsing();
        const std::string_view inside = left_.substr(1, end - 1);
        left_.remove_prefix(end + 1);
        return inside;
    }
    bool boolean()
    {
        next();
        for (const std::string_view word : {"True", "False"}) {
            if (left_.substr(0, word.size()) != word) continue;
            left_.remove_prefix(word.size());
            return word == "True";
        }
        failParsing();
    }
    std::vector<std::size_t> tuple()
    {
        std::vector<std::size_t> numbers;
        expect('(');
        while (!skip(')')) {
            next();
            std::size_t number = 0;
            const auto result = std::from_chars(left_.data(), left_.data() + left_.size(), number);
            if (result.ec != std::errc()) failParsing();
            left_.remove_prefix(static_cast<std::size_t>(result.ptr - left_.data()));
            skip('L'); // in Python 2
            numbers.push_back(number);
            if (!skip(',') && next() != ')') failParsing();
        }
        return numbers;
    }

    std::string_view text_, left_;
    const std::string& name_;
};

std::string shapeText(const std::vector<std::size_t>& shape)
{
    return shape.empty() ? "no" : joined(shape, " x ", [](std::size_t number) { return std::to_string(number); });
}

/// Reads a number of rows or columns in a .dmat file.
std::size_t dmatCount(TextCursor& cursor, const char* what)
{
    const char* const start = cursor.position();
    const std::int64_t count = cursor.integer(what);
    if (count < 0) cursor.fail(start, std::string(what) + " is " + std::to_string(count) + "; it must not be negative");
    return static_cast<std::size_t>(count);
}

struct DmatSize {
    std::size_t columns, rows;
};

DmatSize dmatSize(TextCursor& cursor)
{
    const std::size_t columns = dmatCount(cursor, "the number of columns");
    return {columns, dmatCount(cursor, "the number of rows")};
}

} // namespace

std::vector<float> parseNpy(std::string_view bytes, const std::string& name, std::size_t points, std::size_t cagePoints)
{
    constexpr std::string_view magic = "\x93NUMPY";
    const auto byteAt = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    if (bytes.substr(0, magic.size()) != magic) fail(name, "it is not a NumPy file");
    const std::size_t afterMagic = magic.size() + 2;
    if (bytes.size() < afterMagic) fail(name, "it is truncated");
    const std::size_t major = byteAt(magic.size()), minor = byteAt(magic.size() + 1);
    if (major < 1 || major > 3 || minor != 0) {
        fail(name, "it is a NumPy file of version " + std::to_string(major) + '.' + std::to_string(minor) +
                       "; 1.0, 2.0 and 3.0 are read");
    }
    const std::size_t lengthBytes = major == 1 ? 2 : 4, begin = afterMagic + lengthBytes;
    if (bytes.size() < begin) fail(name, "it is truncated");
    std::size_t length = 0;
    for (std::size_t i = 0; i < lengthBytes; ++i) length += byteAt(afterMagic + i) << (8 * i);
    if (bytes.size() - begin < length) fail(name, "it is truncated");
    const NpyHeader header = NpyHeaderParser(bytes.substr(begin, length), name).parse();
    if (header.type != "<f4" && header.type != "<f8") {
        fail(name, "its numbers are " + quote(header.type) + "; weights are '<f4' or '<f8'");
    }
    if (header.shape.size() != 2) {
        fail(name, "it has " + counted(header.shape.size(), "dimension") + " (" + shapeText(header.shape) +
                       "); weights have 2, points x cage points");
    }
    requireShape(header.shape[0], header.shape[1], name, points, cagePoints);
    const std::string_view data = bytes.substr(begin + length);
    return header.type == "<f4" ? takeNumbers<float>(data, name, points, cagePoints, header.fortranOrder)
                                : takeNumbers<double>(data, name, points, cagePoints, header.fortranOrder);
}

std::vector<float> parseDmat(std::string_view bytes, const std::string& name, std::size_t points,
                             std::size_t cagePoints)
{
    TextCursor cursor(bytes, name);
    DmatSize size = dmatSize(cursor);
    const bool binary = size.columns == 0 && size.rows == 0;
    if (!cursor.atLineEnd()) cursor.fail("the first line must be COLUMNS ROWS, and nothing behind it");
    if (binary) {
        cursor.nextLine();
        size = dmatSize(cursor);
        // The next bytes may be any, so no other line end is accepted.
        if (!cursor.skipCharacter('\n')) cursor.fail("the second line must be COLUMNS ROWS, and nothing behind it");
    }
    requireShape(size.rows, size.columns, name, points, cagePoints);
    if (binary) {
        const std::string_view data = bytes.substr(bytes.size() - cursor.bytesLeft());
        return takeNumbers<double>(data, name, points, cagePoints, true);
    }
    // A number has two bytes or more, so the counts of the header are bounded before memory is taken.
    const auto failTruncated = [&] {
        fail(name, "it is truncated: " + counted(points, "row") + " of " + counted(cagePoints, "column") + " need " +
                       std::to_string(points * cagePoints) + " numbers, and a line end behind the last");
    };
    if (cursor.bytesLeft() / 2 < points * cagePoints) failTruncated();
    std::vector<float> weights(points * cagePoints);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!cursor.skipToWord()) failTruncated();
        const double weight = cursor.coordinate("the weight");
        if (cursor.atEnd()) failTruncated(); // the number itself may have been longer
        weights[i % points * cagePoints + i / points] = static_cast<float>(weight);
    }
    if (cursor.skipToWord()) cursor.fail("there is " + cursor.quoted(cursor.position()) + " behind the last weight");
    return weights;
}

std::string weightsProblem(const std::vector<float>& weights, std::size_t columns)
{
    for (std::size_t first = 0; first < weights.size(); first += columns) {
        const auto row = [&] { return "row " + std::to_string(first / columns); };
        double sum = 0;
        for (std::size_t k = 0; k < columns; ++k) {
            const auto weight = static_cast<double>(weights[first + k]);
            if (!std::isfinite(weight)) {
                return row() + ": the weight in column " + std::to_string(k) + " is " + numberText(weight) +
                       " in single precision; weights must be finite";
            }
            sum += weight;
        }
        if (!(std::abs(sum - 1) <= sumTolerance)) {
            return row() + ": its weights have the sum " + numberText(sum) +
                   "; it must be 1 within 0.001, so that the model moves along with the cage";
        }
    }
    return "";
}

} // namespace vdbcage::detail
