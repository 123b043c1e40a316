#include <tools/cli/fingerprint.h>

#include <string_view>

#include <vdbcage/core/detail/hash.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/version.h>

namespace vdbcage::cli {

std::string fingerprint(const std::vector<std::filesystem::path>& files, const CageOptions& options)
{
    detail::Hash hash;
    const auto add = [&](std::string_view bytes) {
        // The length keeps the end of a text apart from the beginning of the next.
        hash.add(std::to_string(bytes.size()) + ' ');
        hash.add(bytes);
    };
    add(VDBCAGE_VERSION);
    for (const auto& [name, value] : optionValues(options)) {
        add(name);
        add(value);
    }
    for (const std::filesystem::path& file : files) add(detail::readFile(file));
    return hash.digits();
}

} // namespace vdbcage::cli
