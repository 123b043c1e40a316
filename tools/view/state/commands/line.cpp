#include <tools/view/state/commands/line.h>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

double Arguments::number(std::size_t i, const Range& range) const
{
    const double value = number(i);
    requireWithin(range, value, name_);
    return value;
}

void Arguments::fail(const std::string& problem) const
{
    throw InputError(name_, problem);
}

std::size_t Arguments::placeAmong(std::size_t i, const char* const* names, std::size_t count) const
{
    std::string known;
    for (std::size_t k = 0; k < count; ++k) {
        if (words_[i] == names[k]) return k;
        known += (k == 0 ? "" : k + 1 < count ? ", " : " or ") + std::string(names[k]);
    }
    refuse(name_, words_[i], known);
}

std::string written(double value)
{
    return ' ' + detail::numberText(value);
}

std::string written(int value)
{
    return ' ' + std::to_string(value);
}

std::string written(bool isOn)
{
    return isOn ? " on" : " off";
}

std::string written(const char* word)
{
    return written(std::string(word));
}

std::string written(const std::string& word)
{
    return ' ' + quotedWord(word);
}

std::string written(const openvdb::Vec3d& vector)
{
    return written(vector[0], vector[1], vector[2]);
}

} // namespace vdbcage::view
