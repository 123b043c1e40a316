#include <vdbcage/core/error.h>

#include <vdbcage/core/detail/printable.h>

namespace vdbcage {

Error::Error(const std::string& text) : std::runtime_error(detail::printable(text))
{
}

// The destructors are the key functions that pin each vtable (and type_info) to the library, so that an exception
// thrown inside the shared library is caught by its type outside.
Error::~Error() = default;
InputError::~InputError() = default;
IoError::~IoError() = default;
ResourceError::~ResourceError() = default;
DeviceError::~DeviceError() = default;
Cancelled::Cancelled() : Error("cancelled")
{
}
Cancelled::~Cancelled() = default;

} // namespace vdbcage
