#pragma once

#include <filesystem>

#include <tools/cli/render.h>

namespace vdbcage::cli {

/// \throw InputError unless the name ends in .png
void requirePngExtension(const std::filesystem::path& path);

/// Draws the model shaded, with the cage as a wireframe over it.
Picture drawCage(const Mesh& model, const Mesh& cage);

} // namespace vdbcage::cli
