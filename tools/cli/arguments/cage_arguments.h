#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <vdbcage/pipeline/options.h>

/// The options of the commands that make cages.
namespace vdbcage::cli {

/// Adds the options of cages, which set `options`, and returns them. Both must outlive parsing.
std::vector<CLI::Option*> addCageOptions(CLI::App& app, CageOptions& options);

/// Sets the precision of the file that the cage is written to, so that the written cage is certified.
/// \throw InputError the file cannot hold the requested precision; IoError unknown extension
void setPrecisionFor(const std::filesystem::path& cage, CageOptions& options);

/// Adds --memory, for memoryLimit(). `text` must outlive parsing.
CLI::Option* addMemoryOption(CLI::App& app, std::string& text);

} // namespace vdbcage::cli
