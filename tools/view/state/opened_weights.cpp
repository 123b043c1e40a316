#include <tools/view/state/opened_weights.h>

#include <system_error>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

WeightsPtr openWeights(const std::filesystem::path& path)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) throw IoError(path.string() + ": there is no such file");
    return std::make_shared<const OpenedWeights>(OpenedWeights{std::filesystem::absolute(path).lexically_normal()});
}

} // namespace vdbcage::view
