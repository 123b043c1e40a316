#include <vdbcage/core/error.h>

#include <string_view>

#include <vdbcage/core/detail/printable.h>

namespace vdbcage {

Error::Error(const std::string& text) : std::runtime_error(detail::printable(text))
{
}

// The destructors are the key functions that place each vtable (and type_info) in the library, so that an exception
// thrown inside the shared library is caught by its type outside.
Error::~Error() = default;
InputError::InputError(const std::string& text) : Error(text)
{
}
InputError::InputError(const std::string& subject, const std::string& problem)
    : Error(subject + ": " + problem), subjectSize_(detail::printable(subject).size())
{
}
InputError::~InputError() = default;
std::string InputError::subject() const
{
    return std::string(what(), subjectSize_);
}
std::string InputError::problem() const
{
    return what() + (subjectSize_ > 0 ? subjectSize_ + std::string_view(": ").size() : 0);
}
IoError::~IoError() = default;
ResourceError::~ResourceError() = default;
DeviceError::~DeviceError() = default;
Cancelled::Cancelled() : Error("cancelled")
{
}
Cancelled::~Cancelled() = default;

} // namespace vdbcage
