#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <vdbcage/mesh/io/warnings.h>

namespace vdbcage::detail {

/// Returns a piece of a file for a message: in quotes, shortened, with codes for unprintable bytes.
std::string quote(std::string_view piece);

/// Returns whether a line that begins with this word may be skipped as a remark. The word must not be a number, which
/// may belong to the model, and must be printable: other bytes show that the file is no text or damaged.
bool mayBeginRemark(std::string_view word);

/// The warning about such lines.
constexpr const char* remarkWarning = "a line begins with a word that the format does not have; it is passed over";

/// The syntax in which text formats differ.
struct TextSyntax {
    char comment = '\0';         ///< starts a comment that ends with the line; '\0' for none
    bool continuesLines = false; ///< a backslash before the line's end joins the next line to it
};

/// A position in the text of a file that moves by words and lines. Lines end with LF, CR LF or CR. A UTF-8 byte order
/// mark is skipped. Nothing depends on the locale.
/// \throw IoError "NAME: line N: PROBLEM", from every failure
class TextCursor {
public:
    /// `bytes`, `name` (the file's, for messages) and `warnings` must outlive the cursor. If `warnings` is null,
    /// nothing unusual is accepted.
    TextCursor(std::string_view bytes, const std::string& name, TextSyntax syntax = {}, Warnings* warnings = nullptr);

    const char* position() const { return at_; }
    /// Returns the number of bytes from here to the end of the file.
    std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - at_); }
    bool atEnd() const { return at_ == end_; }
    /// Skips blanks. Returns whether only a comment, or nothing, is left on the line.
    bool atLineEnd();
    /// Skips the rest of the line and its end.
    void nextLine();
    /// Does the same, together with the lines that continue this one.
    void nextStatement();
    /// Skips blanks, comments and line ends up to a word. Returns false if there is none.
    bool skipToWord();

    /// Reads the next word of the line; returns an empty one if there is none.
    std::string_view word();
    /// Skips the next word of the line if it is `expected`. Returns whether.
    bool skipWord(std::string_view expected);
    /// Reads the next word as a finite number. One that is too small for a double becomes zero. If there are
    /// `warnings`, forms like 3.1+e2 and 1.5d3 are numbers too. `what` names the number in messages, as "the x
    /// coordinate". If `place` is not null, it becomes the piece of the file that is the number.
    double coordinate(const char* what, std::string_view* place = nullptr);
    /// Does the same, but returns nothing, and may stop anywhere in the line, if the next word is not a finite number.
    std::optional<double> finiteNumber();
    /// Skips the next word if it is a number of any kind. Returns whether.
    bool skipNumber();
    /// Reads the next word as an integer.
    std::int64_t integer(const char* what);
    /// Reads an integer that may end before the end of its word, as in the corner 1/2/3. Returns false if there is
    /// none. Fails if it does not fit in 64 bits.
    bool integerPrefix(std::int64_t& value);
    /// Skips `c` if it comes next in the same word. Returns whether.
    bool skipCharacter(char c)
    {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    /// Returns whether this is between two words: at a blank, a comment, or the end of the line or file.
    bool atWordEnd() const { return endsWord(at_); }

    /// Returns the number of the line of `where`, counted from 1.
    std::size_t lineOf(const char* where) const;
    /// \throw IoError for the line of `where`
    [[noreturn]] void fail(const char* where, const std::string& problem) const;
    [[noreturn]] void fail(const std::string& problem) const { fail(at_, problem); }
    /// Adds a warning, or counts one more of its kind. \see Warnings
    void warn(const char* where, const char* what) const
    {
        if (warnings_ && !warnings_->count(what)) warnings_->add(what, lineOf(where));
    }
    /// Returns the word at `where`, for a message.
    std::string quoted(const char* where) const;

private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool isLineEnd(char c) { return c == '\n' || c == '\r'; }
    bool continuesAt(const char* at) const;
    bool endsWord(const char* at) const;
    const char* wordEnd(const char* at) const;
    void skipBlanks();
    enum class Problem { none, missing, noNumber, notFinite };
    Problem readNumber(double& value);
    Problem readUnusualNumber(double& value);
    [[noreturn]] void failMissing(const char* what) const;

    const char* begin_;
    const char* at_;
    const char* end_;
    const std::string* name_;
    TextSyntax syntax_;
    Warnings* warnings_;
};

} // namespace vdbcage::detail
