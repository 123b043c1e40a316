#pragma once

namespace vdbcage::view {

/// A rectangle of the window, in pixels from its top left.
struct Rectangle {
    int left = 0, top = 0, width = 0, height = 0;
};

} // namespace vdbcage::view
