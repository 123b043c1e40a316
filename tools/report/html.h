#pragma once

#include <string>

namespace vdbcage::report {

/// `text` for a page of HTML, its control bytes escaped.
std::string htmlText(const std::string& text);

/// A picture that is in the page itself: `png` are the bytes of its file.
std::string htmlPicture(const std::string& png, const std::string& description);

} // namespace vdbcage::report
