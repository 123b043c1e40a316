#include <tools/view/picture/viewports.h>

#include <algorithm>

namespace vdbcage::view {

bool Viewports::show(const Rectangle& place, PictureContent content, const Follower& follower, const Follower* compared,
                     const ViewState& view)
{
    Rectangle left = place, right = place;
    if (compared) {
        left.width = std::max(1, place.width / 2);
        right.left += left.width;
        right.width = std::max(1, place.width - left.width);
    }
    bool changed = (compared != nullptr) != (second_ != nullptr);
    if (!compared) second_.reset();
    if (compared && !second_) second_ = std::make_unique<Viewport>(api_, isSoftware_);
    places_.assign(1, left);
    content.modelValues = follower.values();
    content.posed = &follower.model();
    first_.resize(left.width, left.height);
    changed |= first_.show(content, view);
    if (!second_) return changed;
    places_.push_back(right);
    content.modelValues = compared->values();
    content.posed = &compared->model();
    second_->resize(right.width, right.height);
    return second_->show(content, view) || changed;
}

void Viewports::draw(bool isMoving)
{
    first_.draw(isMoving);
    if (second_) second_->draw(isMoving);
}

void Viewports::copyTo(GLuint framebuffer, int height) const
{
    for (const Rectangle& place : places_) {
        const Viewport& picture = &place == &places_.front() ? first_ : *second_;
        picture.canvas().copyTo(framebuffer, place.left, height - place.top - place.height);
    }
}

} // namespace vdbcage::view
