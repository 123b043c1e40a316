#include <vdbcage/volume/detail/sphere/sphere_tables.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace vdbcage::detail {

namespace {

std::int64_t square(std::int64_t v)
{
    return v * v;
}

// Returns for a column at an offset (dx, dy) the number of voxels at z = 0, 1, ... within the radius of a contour voxel
// at z = 0.
int heightAt(int dx, int dy, std::int64_t squaredRadius)
{
    const std::int64_t rest = squaredRadius - square(dx) - square(dy);
    if (rest < 0) return 0;
    auto height = static_cast<std::int64_t>(std::sqrt(static_cast<double>(rest)));
    while (height * height > rest) --height;
    while (square(height + 1) <= rest) ++height;
    return static_cast<int>(height) + 1;
}

} // namespace

SphereTables::SphereTables(std::int64_t squared, const Progress& progress)
    : squaredRadius(squared), radius(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(squared))))),
      isSmall(radius <= smallRadius), entryRadius((radius + 7) / 8 + 1), rowRadius(8 * entryRadius + 7),
      coordinates(2 * margin() + 32)
{
    while ((squaredRadius >> shift) > std::numeric_limits<std::int16_t>::max() / 3 - 1) ++shift;
    limit = static_cast<std::int16_t>(squaredRadius >> shift);
    isSmall ? fillHeights(smallRows, smallEntries, progress) : fillHeights(largeRows, largeEntries, progress);
    fillSquares();
}

template <class T>
void SphereTables::fillHeights(std::vector<T>& rows, std::vector<T>& entries, const Progress& progress)
{
    // One quarter of the disc; the rest is its mirror image.
    const int size = rowRadius + 8;
    std::vector<T> heights(static_cast<std::size_t>(size * size));
    for (int dx = 0; dx < size; ++dx) {
        if (dx % 32 == 0) progress.check(0, 1);
        for (int dy = 0; dy < size; ++dy) {
            heights[static_cast<std::size_t>(dx * size + dy)] =
                static_cast<T>(none<T> + heightAt(dx, dy, squaredRadius));
        }
    }
    const auto at = [&](int dx, int dy) { return heights[static_cast<std::size_t>(dx * size + dy)]; };
    for (int dx = -rowRadius; dx <= rowRadius; ++dx) {
        if (dx % 32 == 0) progress.check(0, 1);
        for (int dy = -rowRadius; dy <= rowRadius + 7; ++dy) {
            for (int x = 0; x < 8; ++x) rows.push_back(at(std::abs(dx + x), std::abs(dy)));
        }
    }
    for (int dx = -entryRadius; dx <= entryRadius; ++dx) {
        progress.check(0, 1);
        for (int dy = -entryRadius; dy <= entryRadius; ++dy) {
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 8; ++x) entries.push_back(at(gap(8 * dx + x, 0, 7), gap(8 * dy + y, 0, 7)));
            }
        }
    }
}

void SphereTables::fillSquares()
{
    const std::int64_t most = std::int64_t{limit} + 1, unit = std::int64_t{1} << shift;
    const auto down = [&](std::int64_t v) { return static_cast<std::int16_t>(std::min(square(v) / unit, most)); };
    const auto up = [&](std::int64_t v) {
        return static_cast<std::int16_t>(std::min((square(v) + unit - 1) / unit, most));
    };
    for (int c = -margin(); c < 32 + margin(); ++c) {
        Squares& narrow = squares_.emplace_back();
        WideSquares& wide = wideSquares_.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) {
            const int first = 8 * static_cast<int>(i), last = first + 7;
            narrow.below[i] = down(std::max(c - last, 0));
            narrow.above[i] = down(std::max(first - c, 0));
            narrow.far[i] = up(std::max(last - c, c - first));
            std::fill_n(wide.below.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, narrow.below[i]);
            std::fill_n(wide.above.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, narrow.above[i]);
            std::fill_n(wide.far.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, narrow.far[i]);
        }
    }
}

} // namespace vdbcage::detail
