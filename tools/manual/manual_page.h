#pragma once

#include <string>

namespace vdbcage::manual {

/// A page for the program `man`, in roff with the macros of man(7). Texts are plain; all escaping is done here.
class ManualPage {
public:
    /// Of section 1, programs: `name` is "vdbcage-make", `summary` a line on what it does.
    ManualPage(const std::string& name, const std::string& summary);

    void section(const std::string& title); ///< "OPTIONS"
    void paragraph(const std::string& text);
    /// What stands as it is, a line a line: code.
    void code(const std::string& lines);
    /// What `name`, with its `value` behind it unless that is empty, means.
    void item(const std::string& name, const std::string& value, const std::string& text);

    /// The page, to be written to NAME.1.
    const std::string& text() const { return text_; }

private:
    void beginParagraph();

    std::string text_;
    bool atSectionStart_ = false;
};

} // namespace vdbcage::manual
