#pragma once

#include <string>
#include <string_view>

namespace vdbcage::detail {

/// Joins the texts of the list's elements.
template <typename List, typename ToText>
std::string joined(const List& list, std::string_view separator, const ToText& toText)
{
    std::string text;
    bool isFirst = true;
    for (const auto& element : list) {
        if (!isFirst) text += separator;
        isFirst = false;
        text += toText(element);
    }
    return text;
}

/// Joins texts.
template <typename List>
std::string joined(const List& list, std::string_view separator)
{
    return joined(
        list, separator, [](const auto& text) -> const auto& { return text; });
}

} // namespace vdbcage::detail
