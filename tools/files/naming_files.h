#pragma once

#include <map>
#include <string>

#include <vdbcage/core/error.h>

namespace vdbcage::files {

/// Returns the result of `work`. The library knows no files: if it objects to an argument, such as "cage", the error
/// names the file that the argument was read from.
/// \param files names of files, by the argument
/// \throw InputError
template <typename Work>
auto namingFiles(const std::map<std::string, std::string>& files, const Work& work)
{
    try {
        return work();
    } catch (const InputError& error) {
        const auto file = files.find(error.subject());
        if (file == files.end()) throw;
        throw InputError(file->second, error.problem());
    }
}

} // namespace vdbcage::files
