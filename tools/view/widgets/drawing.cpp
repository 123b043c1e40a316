#include <tools/view/widgets/drawing.h>

#include <algorithm>

namespace vdbcage::view {

bool operator==(const Drawing& a, const Drawing& b)
{
    const auto sameVertices = [](const Drawing::Vertex& first, const Drawing::Vertex& second) {
        return first.x == second.x && first.y == second.y && first.u == second.u && first.v == second.v &&
               first.rgba == second.rgba;
    };
    const auto sameBatches = [](const Drawing::Batch& first, const Drawing::Batch& second) {
        return first.left == second.left && first.top == second.top && first.right == second.right &&
               first.bottom == second.bottom && first.texture == second.texture &&
               first.firstIndex == second.firstIndex && first.indexCount == second.indexCount;
    };
    return a.width == b.width && a.height == b.height && a.indices == b.indices &&
           std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), sameVertices) &&
           std::equal(a.batches.begin(), a.batches.end(), b.batches.begin(), b.batches.end(), sameBatches);
}

bool operator!=(const Drawing& a, const Drawing& b)
{
    return !(a == b);
}

} // namespace vdbcage::view
