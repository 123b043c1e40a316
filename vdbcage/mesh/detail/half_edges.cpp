#include <vdbcage/mesh/detail/half_edges.h>

#include <algorithm>
#include <utility>

namespace vdbcage::detail {

EdgeTable::EdgeTable(const HalfEdges& halfEdges, std::size_t points)
    : edgeOf_(halfEdges.size(), none), opposite_(halfEdges.size(), none)
{
    const auto low = [&](std::size_t h) { return std::min(halfEdges.from(h), halfEdges.to(h)); };
    const auto high = [&](std::size_t h) { return std::max(halfEdges.from(h), halfEdges.to(h)); };
    const auto isOfAnEdge = [&](std::size_t h) { return halfEdges.from(h) != halfEdges.to(h); };
    // A counting sort by the smaller end; few half-edges share one.
    std::vector<std::size_t> bucket(points + 1, 0);
    for (std::size_t h = 0; h < halfEdges.size(); ++h) {
        if (isOfAnEdge(h)) ++bucket[low(h) + 1];
    }
    for (std::size_t p = 0; p < points; ++p) bucket[p + 1] += bucket[p];
    sorted_.resize(bucket[points]);
    std::vector<std::size_t> end(bucket.begin(), bucket.end() - 1);
    for (std::size_t h = 0; h < halfEdges.size(); ++h) {
        if (isOfAnEdge(h)) sorted_[end[low(h)]++] = h;
    }
    const auto at = [&](std::size_t i) { return sorted_.begin() + static_cast<std::ptrdiff_t>(i); };
    for (std::size_t p = 0; p < points; ++p) {
        std::sort(at(bucket[p]), at(bucket[p + 1]), [&](std::size_t a, std::size_t b) {
            return std::make_pair(high(a), a) < std::make_pair(high(b), b);
        });
    }
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const std::size_t h = sorted_[i];
        const bool starts = i == 0 || low(h) != low(sorted_[i - 1]) || high(h) != high(sorted_[i - 1]);
        if (starts) first_.push_back(i);
        edgeOf_[h] = first_.size() - 1;
    }
    first_.push_back(sorted_.size());
    for (std::size_t edge = 0; edge < size(); ++edge) {
        const Span span = (*this)[edge];
        if (span.size() != 2 || halfEdges.from(span[0]) != halfEdges.to(span[1])) continue;
        opposite_[span[0]] = span[1];
        opposite_[span[1]] = span[0];
    }
}

} // namespace vdbcage::detail
