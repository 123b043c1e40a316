#pragma once

namespace vdbcage::cli {

/// From here on the process works with at most `count` threads, at least 1. To be called once, and before OpenGL is
/// first used. Libraries may have more that wait.
void limitThreads(int count);

} // namespace vdbcage::cli
