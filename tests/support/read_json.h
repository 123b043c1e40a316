#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>
#include <support/temporary_folder.h>

namespace vdbcage::test {

inline nlohmann::json readJson(const std::filesystem::path& path)
{
    return nlohmann::json::parse(readText(path));
}

} // namespace vdbcage::test
