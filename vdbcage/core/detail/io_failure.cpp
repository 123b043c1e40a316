#include <vdbcage/core/detail/io_failure.h>

#include <cerrno>
#include <system_error>

namespace vdbcage::detail {

void throwIoError(const std::string& what, int error)
{
    const std::string text = what + (error != 0 ? ": " + std::generic_category().message(error) : std::string());
    if (error == ENOSPC || error == EDQUOT || error == ENOMEM) throw ResourceError(text);
    throw IoError(text);
}

} // namespace vdbcage::detail
