#include <vdbcage/core/error.h>

namespace vdbcage {

// The destructors are the key functions that pin each vtable (and type_info) to the library, so that an exception
// thrown inside the shared library is caught by its type outside.
Error::~Error() = default;
InputError::~InputError() = default;
IoError::~IoError() = default;
DeviceError::~DeviceError() = default;
Cancelled::Cancelled() : Error("cancelled")
{
}
Cancelled::~Cancelled() = default;

} // namespace vdbcage
