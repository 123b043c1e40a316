#pragma once

#include <tools/view/state/state.h>

namespace vdbcage::view {

/// Animated views: the turntable, and poses played from the first key to the last, over and over.
class Animation {
public:
    static bool isTurning(const State& state);
    static bool isPlaying(const State& state);
    static bool isAnimated(const State& state) { return isTurning(state) || isPlaying(state); }

    /// Returns the view after that time. \pre seconds >= 0
    ViewState passed(const State& state, double seconds);

private:
    double frames_ = 0; ///< the part of a frame that has passed
};

} // namespace vdbcage::view
