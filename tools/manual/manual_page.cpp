// The language: groff_man(7) and "man - legacy formatting language for manual pages" of mandoc, man(7).
#include <tools/manual/manual_page.h>

#include <algorithm>
#include <sstream>

#include <vdbcage/core/version.h>

namespace vdbcage::manual {

namespace {

/// Returns `text` such that roff shows it and takes no part for an order. Hyphens are those of the keyboard, which can
/// be copied.
std::string escaped(const std::string& text)
{
    std::string result;
    bool atLineStart = true;
    for (const char c : text) {
        if (atLineStart && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            result += c;
        }
        atLineStart = c == '\n';
    }
    return result;
}

/// Returns text that roff fills, in lines as mandoc wants them: short, and none with two sentences.
std::string filled(const std::string& text)
{
    constexpr std::size_t longest = 72;
    std::istringstream words(text);
    std::string lines, line;
    for (std::string word; words >> word;) {
        const bool endsSentence = !line.empty() && std::string(".?:").find(line.back()) != std::string::npos;
        if (endsSentence || (!line.empty() && line.size() + 1 + word.size() > longest)) {
            lines += escaped(line) + '\n';
            line = word;
        } else {
            line += (line.empty() ? "" : " ") + word;
        }
    }
    return lines + escaped(line) + '\n';
}

/// Returns the text without line ends before and behind it.
std::string trimmed(const std::string& text)
{
    const std::size_t begin = text.find_first_not_of('\n'), end = text.find_last_not_of('\n');
    return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
}

} // namespace

ManualPage::ManualPage(const std::string& name, const std::string& summary)
{
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    text_ = ".TH " + escaped(title) + " 1 " VDBCAGE_VERSION_DATE " \"vdbcage " VDBCAGE_VERSION "\"\n";
    section("NAME");
    text_ += escaped(name) + " \\- " + escaped(summary) + '\n';
}

void ManualPage::section(const std::string& title)
{
    text_ += ".SH " + escaped(title) + '\n';
    atSectionStart_ = true;
}

void ManualPage::beginParagraph()
{
    if (!atSectionStart_) text_ += ".PP\n"; // it would be superfluous where a section begins
    atSectionStart_ = false;
}

void ManualPage::paragraph(const std::string& text)
{
    beginParagraph();
    text_ += filled(text);
}

void ManualPage::code(const std::string& lines)
{
    beginParagraph();
    text_ += ".RS 4\n.EX\n" + escaped(trimmed(lines)) + "\n.EE\n.RE\n";
}

void ManualPage::item(const std::string& name, const std::string& value, const std::string& text)
{
    atSectionStart_ = false;
    text_ += ".TP\n\\fB" + escaped(name) + "\\fR";
    if (!value.empty()) text_ += " \\fI" + escaped(value) + "\\fR";
    text_ += '\n' + filled(text);
}

} // namespace vdbcage::manual
