#include <vdbcage/mesh/io/text_cursor.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

/// Does the same as std::from_chars, but accepts a leading plus sign.
template <typename Number>
std::from_chars_result parse(const char* first, const char* last, Number& value)
{
    const bool plus = last - first > 1 && first[0] == '+' && first[1] != '-';
    const std::from_chars_result result = std::from_chars(plus ? first + 1 : first, last, value);
    return result.ec == std::errc::invalid_argument ? std::from_chars_result{first, result.ec} : result;
}

/// A number whose exponent has an unusual form.
struct UnusualNumber {
    std::string text; ///< in the usual form; empty if it is no such number
    const char* warning = nullptr;
};

/// Converts two forms that have only one meaning. Fortran marks the exponent of a double by d: 1.5d3. Some programs
/// write the sign of the exponent before its mark: 3.1+e2. Fortran's 1.5-300 is not accepted, since it may also be two
/// numbers that touch.
UnusualNumber usualForm(std::string_view word)
{
    const auto digitsFrom = [&](std::size_t at) {
        while (at < word.size() && isDigit(word[at])) ++at;
        return at;
    };
    const auto isSign = [&](std::size_t at) { return at < word.size() && (word[at] == '+' || word[at] == '-'); };
    const auto isMark = [&](std::size_t at, char small, char large) {
        return at < word.size() && (word[at] == small || word[at] == large);
    };
    const std::size_t first = isSign(0) ? 1 : 0, point = digitsFrom(first);
    const bool hasPoint = point < word.size() && word[point] == '.';
    const std::size_t mantissa = hasPoint ? digitsFrom(point + 1) : point;
    if (mantissa - first == (hasPoint ? 1U : 0U)) return {};
    std::size_t digits = mantissa + 1;
    std::string exponent = "e";
    const bool isSignedFirst = isSign(mantissa) && isMark(mantissa + 1, 'e', 'E');
    if (isSignedFirst) {
        exponent += word[mantissa];
        ++digits;
    } else if (!isMark(mantissa, 'd', 'D')) {
        return {};
    } else if (isSign(digits)) {
        exponent += word[digits++];
    }
    if (digits >= word.size() || digitsFrom(digits) != word.size()) return {};
    exponent += word.substr(digits);
    return {std::string(word.substr(0, mantissa)) + exponent,
            isSignedFirst ? "a number has the sign of its exponent before the e, like 3.1+e2, which is read as 3.1e+2"
                          : "a number has an exponent of Fortran, like 1.5d3, which is read as 1.5e3"};
}

/// Returns whether a decimal number outside the range of double is too small, not too large. std::from_chars does not
/// distinguish them. The position of the first digit that is not zero, with the exponent, does: the two ranges are six
/// hundred powers of ten apart.
bool isTooSmall(const char* first, const char* last)
{
    const char* exponentMark = std::find_if(first, last, [](char c) { return c == 'e' || c == 'E'; });
    const char* point = std::find(first, exponentMark, '.');
    const char* digit = std::find_if(first, exponentMark, [](char c) { return c >= '1' && c <= '9'; });
    const long long magnitude = point - digit;
    if (exponentMark == last) return magnitude < 0;
    long long exponent = 0;
    const bool negative = exponentMark + 1 != last && exponentMark[1] == '-';
    for (const char* c = exponentMark + 1; c != last; ++c) {
        // 1e17 is beyond the length of any file, so saturating there cannot change the result.
        if (isDigit(*c)) exponent = std::min(exponent * 10 + (*c - '0'), 100'000'000'000'000'000LL);
    }
    return magnitude + (negative ? -exponent : exponent) < 0;
}

} // namespace

std::string quote(std::string_view piece)
{
    constexpr std::size_t longest = 24;
    std::string text = "\"";
    for (const char c : piece.substr(0, longest)) {
        const unsigned char byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte < 0x7F) {
            text += c;
        } else {
            constexpr const char* digits = "0123456789abcdef";
            text += {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
        }
    }
    return text + (piece.size() > longest ? "...\"" : "\"");
}

bool mayBeginRemark(std::string_view word)
{
    constexpr std::string_view replacement = "\xEF\xBF\xBD"; // for bytes that are no character
    const std::size_t first = word.find_first_not_of("+-.");
    const bool isNumber = first != std::string_view::npos && isDigit(word[first]);
    return !isNumber && word.find(replacement) == std::string_view::npos && printable(word) == word;
}

TextCursor::TextCursor(std::string_view bytes, const std::string& name, TextSyntax syntax, Warnings* warnings)
    : begin_(bytes.data()), at_(bytes.data()), end_(bytes.data() + bytes.size()), name_(&name), syntax_(syntax),
      warnings_(warnings)
{
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
}

bool TextCursor::continuesAt(const char* at) const
{
    return syntax_.continuesLines && *at == '\\' && end_ - at > 1 && isLineEnd(at[1]);
}

bool TextCursor::endsWord(const char* at) const
{
    if (at == end_) return true;
    return isBlank(*at) || isLineEnd(*at) || (*at == syntax_.comment && *at != '\0') || continuesAt(at);
}

const char* TextCursor::wordEnd(const char* at) const
{
    while (!endsWord(at)) ++at;
    return at;
}

void TextCursor::skipBlanks()
{
    for (;;) {
        while (at_ != end_ && isBlank(*at_)) ++at_;
        if (at_ == end_ || !continuesAt(at_)) return;
        at_ += end_ - at_ > 2 && at_[1] == '\r' && at_[2] == '\n' ? 3 : 2;
    }
}

bool TextCursor::atLineEnd()
{
    skipBlanks();
    return at_ == end_ || isLineEnd(*at_) || (*at_ == syntax_.comment && *at_ != '\0');
}

void TextCursor::nextLine()
{
    while (at_ != end_ && !isLineEnd(*at_)) ++at_;
    if (at_ == end_) return;
    at_ += end_ - at_ > 1 && at_[0] == '\r' && at_[1] == '\n' ? 2 : 1;
}

void TextCursor::nextStatement()
{
    bool continues = false;
    do {
        const char* start = at_;
        while (at_ != end_ && !isLineEnd(*at_)) ++at_;
        continues = at_ != start && continuesAt(at_ - 1);
        nextLine();
    } while (continues && at_ != end_);
}

bool TextCursor::skipToWord()
{
    while (atLineEnd()) {
        if (at_ == end_) return false;
        nextLine();
    }
    return true;
}

std::string_view TextCursor::word()
{
    if (atLineEnd()) return {};
    const char* first = at_;
    at_ = wordEnd(at_);
    return {first, static_cast<std::size_t>(at_ - first)};
}

bool TextCursor::skipWord(std::string_view expected)
{
    const char* start = at_;
    if (word() == expected) return true;
    at_ = start;
    return false;
}

double TextCursor::coordinate(const char* what, std::string_view* place)
{
    skipBlanks();
    const char* first = at_;
    double value = 0;
    switch (readNumber(value)) {
    case Problem::none:
        break;
    case Problem::missing:
        failMissing(what);
    case Problem::noNumber:
        fail(first, std::string(what) + " is " + quoted(first) +
                        ", which is not a number; numbers are written like 12, -0.5 and 3e-2");
    case Problem::notFinite:
        fail(first, std::string(what) + " is " + quoted(first) + "; coordinates must be finite");
    }
    if (place) *place = {first, static_cast<std::size_t>(at_ - first)};
    return value;
}

std::optional<double> TextCursor::finiteNumber()
{
    skipBlanks();
    double value = 0;
    if (readNumber(value) == Problem::none) return value;
    return std::nullopt;
}

TextCursor::Problem TextCursor::readNumber(double& value)
{
    const std::from_chars_result result = parse(at_, end_, value);
    if (result.ptr == at_ || !endsWord(result.ptr) || result.ec != std::errc() || !std::isfinite(value)) {
        return readUnusualNumber(value);
    }
    at_ = result.ptr;
    return Problem::none;
}

TextCursor::Problem TextCursor::readUnusualNumber(double& value)
{
    if (atLineEnd()) return Problem::missing;
    const char* start = at_;
    std::string_view text = word();
    const UnusualNumber unusual = warnings_ ? usualForm(text) : UnusualNumber{};
    if (unusual.warning) {
        warn(start, unusual.warning);
        text = unusual.text;
    }
    const char* end = text.data() + text.size();
    const std::from_chars_result result = parse(text.data(), end, value);
    if (result.ptr != end) return Problem::noNumber;
    if (result.ec == std::errc()) return std::isfinite(value) ? Problem::none : Problem::notFinite;
    if (!isTooSmall(text.data(), end)) return Problem::notFinite;
    value = text.front() == '-' ? -0.0 : 0.0;
    return Problem::none;
}

bool TextCursor::skipNumber()
{
    skipBlanks();
    double value = 0;
    const std::from_chars_result result = parse(at_, end_, value);
    if (result.ptr != at_ && endsWord(result.ptr)) {
        at_ = result.ptr;
        return true;
    }
    const char* end = wordEnd(at_);
    if (!warnings_ || !usualForm({at_, static_cast<std::size_t>(end - at_)}).warning) return false;
    at_ = end;
    return true;
}

std::int64_t TextCursor::integer(const char* what)
{
    if (atLineEnd()) failMissing(what);
    const char* first = at_;
    std::int64_t value = 0;
    if (!integerPrefix(value) || !atWordEnd()) {
        fail(first, std::string(what) + " is " + quoted(first) + ", which is not an integer; write a whole number");
    }
    return value;
}

bool TextCursor::integerPrefix(std::int64_t& value)
{
    const std::from_chars_result result = parse(at_, end_, value);
    if (result.ptr == at_) return false;
    if (result.ec != std::errc()) fail("the integer " + quoted(at_) + " is too large; it must be below 2^63");
    at_ = result.ptr;
    return true;
}

void TextCursor::failMissing(const char* what) const
{
    if (at_ == end_) fail(std::string("the file ends where ") + what + " should be; copy or export it again");
    fail(std::string(what) + " is missing; add it, or export the file again");
}

std::size_t TextCursor::lineOf(const char* where) const
{
    std::size_t line = 1;
    for (const char* c = begin_; c < where; ++c) {
        if (*c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'))) ++line;
    }
    return line;
}

void TextCursor::fail(const char* where, const std::string& problem) const
{
    throw IoError(*name_ + ": line " + std::to_string(lineOf(where)) + ": " + problem);
}

std::string TextCursor::quoted(const char* where) const
{
    return quote({where, static_cast<std::size_t>(wordEnd(where) - where)});
}

} // namespace vdbcage::detail
