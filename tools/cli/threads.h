#pragma once

namespace vdbcage::cli {

/// Limits the process to `count` threads, at least 1, from here on. Call it once, before the first use of OpenGL.
/// Libraries may have more that wait.
void limitThreads(int count);

} // namespace vdbcage::cli
