#pragma once

#include <string>

namespace vdbcage::manual {

/// A page for the program `man`, in roff with the macros of man(7). It takes plain texts and does all escaping.
class ManualPage {
public:
    /// Begins a page of section 1, programs: `name` is "vdbcage-make", `summary` a line on its purpose.
    ManualPage(const std::string& name, const std::string& summary);

    void section(const std::string& title); ///< "OPTIONS"
    void paragraph(const std::string& text);
    /// Adds code, kept line by line.
    void code(const std::string& lines);
    /// Adds the meaning of `name`, with its `value` behind it unless that is empty.
    void item(const std::string& name, const std::string& value, const std::string& text);

    /// Returns the page, to be written to NAME.1.
    const std::string& text() const { return text_; }

private:
    void beginParagraph();

    std::string text_;
    bool atSectionStart_ = false;
};

} // namespace vdbcage::manual
