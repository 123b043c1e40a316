#include <tools/report/fingerprint.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/version.h>

namespace vdbcage::tool {

std::string fingerprint(const std::vector<std::filesystem::path>& files, const CageOptions& options)
{
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&](std::string_view bytes) {
        // With the length, so that what ends one text cannot begin the next.
        const std::string length = std::to_string(bytes.size()) + ' ';
        for (const std::string_view part : {std::string_view(length), bytes}) {
            for (const char byte : part) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
        }
    };
    add(VDBCAGE_VERSION);
    for (const auto& [name, value] : optionValues(options)) {
        add(name);
        add(value);
    }
    for (const std::filesystem::path& file : files) add(detail::readFile(file));
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return digits.data();
}

} // namespace vdbcage::tool
