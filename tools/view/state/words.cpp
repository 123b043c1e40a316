#include <tools/view/state/words.h>

#include <charconv>
#include <cmath>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

bool isBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Reads a word in quotes that begins at `at`, and moves `at` behind it.
std::string quotedWordAt(std::string_view line, std::size_t& at)
{
    std::string word;
    for (++at; at < line.size(); ++at) {
        if (line[at] == '"') {
            ++at;
            return word;
        }
        if (line[at] == '\\' && at + 1 < line.size()) {
            const char next = line[++at];
            word += next == 'n' ? '\n' : next == 'r' ? '\r' : next == 't' ? '\t' : next;
        } else {
            word += line[at];
        }
    }
    throw InputError("a word begins with a quote (\") and has no other at its end");
}

} // namespace

Words wordsOf(std::string_view line)
{
    Words words;
    std::size_t at = 0;
    for (;;) {
        while (at < line.size() && isBlank(line[at])) ++at;
        if (at == line.size() || line[at] == '#') return words;
        if (line[at] == '"') {
            words.push_back(quotedWordAt(line, at));
            if (at < line.size() && !isBlank(line[at])) throw InputError("a blank must follow a word in quotes");
        } else {
            const std::size_t begin = at;
            while (at < line.size() && !isBlank(line[at])) ++at;
            words.emplace_back(line.substr(begin, at - begin));
        }
    }
}

std::string quotedWord(const std::string& word)
{
    bool isPlain = !word.empty() && word.front() != '"' && word.front() != '#';
    for (const char c : word) isPlain = isPlain && !isBlank(c);
    if (isPlain) return word;
    std::string text = "\"";
    for (const char c : word) {
        switch (c) {
        case '\n':
            text += "\\n";
            break;
        case '\r':
            text += "\\r";
            break;
        case '\t':
            text += "\\t";
            break;
        case '"':
        case '\\':
            text += '\\';
            [[fallthrough]];
        default:
            text += c;
        }
    }
    return text + '"';
}

double numberOf(const std::string& word, const std::string& what)
{
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) {
        throw InputError(what, "'" + word + "' is not allowed; it must be a number");
    }
    return value;
}

int wholeNumberOf(const std::string& word, const std::string& what, int least, int most)
{
    int value = 0;
    const char* const end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end || value < least || value > most) {
        throw InputError(what, "'" + word + "' is not allowed; it must be a whole number, " + std::to_string(least) +
                                   " to " + std::to_string(most));
    }
    return value;
}

bool switchOf(const std::string& word, const std::string& what)
{
    if (word == "on") return true;
    if (word == "off") return false;
    throw InputError(what, "'" + word + "' is not allowed; it must be on or off");
}

void refuse(const std::string& what, const std::string& value, const std::string& allowed)
{
    throw InputError(what, "'" + value + "' is not allowed; it must be " + allowed);
}

} // namespace vdbcage::view
