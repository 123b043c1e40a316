// Options from lines of "NAME VALUE", or with fields of any value at all. What is refused is refused in one line; what
// is allowed comes back from its own text.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>

#include <fuzz/bytes.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/options.h>

using namespace vdbcage;
using fuzz::require;

namespace {

void requireComesBack(const CageOptions& options)
{
    CageOptions again;
    const auto values = optionValues(options);
    for (const auto& [name, value] : values) setOption(again, name, value);
    require(optionValues(again) == values);
    require(again.joints == options.joints);
    require(again.scale.regions.size() == options.scale.regions.size());
}

bool isValid(const CageOptions& options)
{
    try {
        requireValid(options);
        return true;
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
        return false;
    }
}

/// Files that a value names are read, too.
void setFromLines(const std::string& text)
{
    CageOptions options;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t blank = line.find(' ');
        try {
            setOption(options, line.substr(0, blank), blank == std::string::npos ? "" : line.substr(blank + 1));
        } catch (const InputError& error) {
            fuzz::requireOneLine(error.what());
        } catch (const IoError& error) {
            fuzz::requireOneLine(error.what());
        }
    }
    isValid(options);
    requireComesBack(options);
}

struct AnyValue {
    fuzz::Choices& choices;

    template <typename Field>
    void operator()(const OptionInfo& info, Field& field) const
    {
        if constexpr (std::is_arithmetic_v<Field> && !std::is_same_v<Field, bool>) {
            set(info, field);
        } else if constexpr (std::is_same_v<Field, bool>) {
            field = choices.oneIn(2);
        } else if constexpr (std::is_enum_v<Field>) {
            field = static_cast<Field>(choices.below(2)); // all have two values at least
        }
    }
    template <typename Number>
    void operator()(const OptionInfo& info, std::optional<Number>& field) const
    {
        if (choices.oneIn(2)) set(info, field.emplace());
    }
    /// Near the ends of what is allowed more often than elsewhere.
    template <typename Number>
    void set(const OptionInfo& info, Number& number) const
    {
        const int kind = choices.below(4);
        number = kind == 0   ? static_cast<Number>(info.range.least)
                 : kind == 1 ? static_cast<Number>(info.range.most)
                             : choices.any<Number>();
    }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size > 0 && data[0] != 0) {
        setFromLines(fuzz::textOf(data, size));
        return 0;
    }
    fuzz::Choices choices(data, size);
    choices.any<std::uint8_t>();
    CageOptions options;
    visitOptions(options, AnyValue{choices});
    if (isValid(options)) requireComesBack(options);
    return 0;
}
