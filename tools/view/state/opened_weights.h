#pragma once

#include <filesystem>
#include <memory>

namespace vdbcage::view {

/// Weights from a file (see readWeights). They are read when a model is bound.
struct OpenedWeights {
    std::filesystem::path path; ///< absolute
};
using WeightsPtr = std::shared_ptr<const OpenedWeights>;

/// Returns the file's path without reading the file. \throw IoError there is no such file
WeightsPtr openWeights(const std::filesystem::path& path);

} // namespace vdbcage::view
