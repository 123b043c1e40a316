#pragma once

#include <string>
#include <vector>

namespace vdbcage::bench {

/// A page of HTML in one file. Texts are plain: what means something in HTML is escaped.
class Page {
public:
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    /// Rows are as long as the head. Numbers, also with a unit, and a lone - are to the right.
    void table(const std::string& caption, const std::vector<std::string>& head,
               const std::vector<std::vector<std::string>>& rows);
    /// `png` are the bytes of its file.
    void picture(const std::string& png, const std::string& caption);
    /// Plots side by side, of logPlot().
    void plots(const std::vector<std::string>& svg, const std::string& caption);

    /// The file.
    std::string text(const std::string& title) const;

private:
    std::string body_;
};

} // namespace vdbcage::bench
