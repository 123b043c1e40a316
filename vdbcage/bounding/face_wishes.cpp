#include <vdbcage/bounding/face_wishes.h>

#include <vdbcage/bounding/detail/guard/wishes.h>

namespace vdbcage {

FaceWishes::FaceWishes() : wishes_(std::make_shared<const detail::Wishes>())
{
}

FaceWishes::FaceWishes(const BoundingGuard& guard, const FaceWishOptions& options, Interrupter* interrupter)
    : wishes_(std::make_shared<const detail::Wishes>(detail::modelOf(guard), options, interrupter))
{
}

const detail::Wishes& detail::wishesOf(const FaceWishes& wishes)
{
    return *wishes.wishes_;
}

} // namespace vdbcage
