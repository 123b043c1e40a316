#include <tools/report/run_facts.h>

#include <array>
#include <new>

#include <openssl/evp.h>
#include <unistd.h>

#include <tbb/global_control.h>
#include <tools/report/commit.h>
#include <vdbcage/core/version.h>

namespace vdbcage::report {

namespace {

std::string hostName()
{
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

} // namespace

Json runFacts(const std::string& kind, const std::vector<std::string>& arguments)
{
    const std::string commit = VDBCAGE_COMMIT;
    return {{"format", 1},
            {"kind", kind},
            {"vdbcage", VDBCAGE_VERSION},
            {"commit", commit.empty() ? Json() : Json(commit)},
            {"arguments", arguments.empty() ? Json() : Json(arguments)},
            {"host", hostName()},
            {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)}};
}

std::string sha256Of(const std::string& bytes)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
        throw std::bad_alloc();
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
        constexpr const char* digits = "0123456789abcdef";
        text += digits[digest[i] >> 4U];
        text += digits[digest[i] & 15U];
    }
    return text;
}

} // namespace vdbcage::report
