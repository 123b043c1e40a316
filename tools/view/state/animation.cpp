#include <tools/view/state/animation.h>

#include <algorithm>
#include <cmath>

namespace vdbcage::view {

namespace {

constexpr double turntableDegreesPerSecond = 24;

} // namespace

bool Animation::isTurning(const State& state)
{
    return state.view.turntable && state.document.model;
}

bool Animation::isPlaying(const State& state)
{
    return state.view.isPlaying && state.view.mode == Mode::pose && state.document.poses.keys().size() > 1;
}

ViewState Animation::passed(const State& state, double seconds)
{
    ViewState view = state.view;
    if (isTurning(state)) {
        view.camera = draw::orbited(view.camera, turntableDegreesPerSecond * seconds, 0, view.camera.target);
    }
    if (!isPlaying(state)) return view;
    const int first = state.document.poses.firstFrame(), count = state.document.poses.finalFrame() - first + 1;
    frames_ += seconds * view.framesPerSecond;
    const double whole = std::floor(frames_);
    frames_ -= whole;
    const int at = std::clamp(view.frame - first, 0, count - 1);
    view.frame = first + static_cast<int>(std::fmod(at + whole, count));
    return view;
}

} // namespace vdbcage::view
