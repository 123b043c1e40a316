#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/pipeline/options.h>

/// Values for any option, by its entry in visitOptions(): tests that use them look at new options, too.
namespace vdbcage::test {

/// Returns the names that an option takes: "sphere", "cube".
/// \param option one of names, not of numbers or files
inline std::vector<std::string> optionWords(const OptionText& option)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= option.value.size();) {
        const std::size_t end = std::min(option.value.find('|', begin), option.value.size());
        words.push_back(option.value.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// The values of an option by the type of its field, as optionValues() writes them.
struct ValuesByType {
    const OptionInfo& info;
    const OptionText& text;

    std::vector<std::string> operator()(int /*type*/) const
    {
        return {std::to_string(static_cast<int>(info.range.most)), std::to_string(static_cast<int>(info.range.least))};
    }
    std::vector<std::string> operator()(double /*type*/) const
    {
        return {detail::numberText(info.range.most), detail::numberText(info.range.least)};
    }
    template <typename Number>
    std::vector<std::string> operator()(const std::optional<Number>& /*type*/) const
    {
        return (*this)(Number{});
    }
    std::vector<std::string> operator()(const FactorField& /*type*/) const
    {
        return {"sphere:0,0,0,1,0.5", "box:0,0,0,1,1,1,2"};
    }
    std::vector<std::string> operator()(const Joints& /*type*/) const { return {}; }
    template <typename Name>
    std::vector<std::string> operator()(Name /*type*/) const
    {
        return optionWords(text);
    }
};

/// Returns texts that setOption() takes for an option, other than its default: the largest and the smallest number, or
/// all names. There are none if all values are files.
inline std::vector<std::string> otherValues(const OptionText& option)
{
    std::vector<std::string> values;
    const CageOptions defaults;
    visitOptions(defaults, [&](const OptionInfo& info, const auto& field) {
        if (option.name == info.name) values = ValuesByType{info, option}(field);
    });
    values.erase(std::remove(values.begin(), values.end(), option.defaultValue), values.end());
    return values;
}

} // namespace vdbcage::test
