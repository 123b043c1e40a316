#include <tools/view/picture/drags.h>

#include <cmath>

namespace vdbcage::view {

namespace {

constexpr double degreesPerPixel = 0.4, zoomPerPixel = 1.01;

} // namespace

std::array<double, 2> inPanel(const Rectangle& picture, const Pixel& at)
{
    return {2 * at[0] / picture.width - 1, 1 - 2 * at[1] / picture.height};
}

double aspectOf(const Rectangle& picture)
{
    return 1.0 * picture.width / picture.height;
}

draw::Camera CameraDrag::moved(const draw::Camera& camera, const Rectangle& picture, double dx, double dy) const
{
    if (action == DragAction::pan) {
        return draw::panned(camera, aspectOf(picture), 2 * dx / picture.width, -2 * dy / picture.height);
    }
    if (action == DragAction::turn) {
        const double degrees = degreesPerPixel / pixel;
        return draw::orbited(camera, -degrees * dx, degrees * dy, pivot);
    }
    const auto [x, y] = inPanel(picture, from);
    return draw::zoomed(camera, aspectOf(picture), std::pow(zoomPerPixel, -dy / pixel), x, y);
}

void Band::moveTo(const Pixel& at, double step)
{
    if (isBox_) {
        places_ = {places_.front(), at};
    } else if (std::hypot(at[0] - places_.back()[0], at[1] - places_.back()[1]) >= step) {
        places_.push_back(at);
    }
}

std::vector<Pixel> Band::border() const
{
    if (!isBox_ || !hasInside()) return places_;
    const Pixel &a = places_[0], &b = places_[1];
    return {a, {b[0], a[1]}, b, {a[0], b[1]}};
}

} // namespace vdbcage::view
