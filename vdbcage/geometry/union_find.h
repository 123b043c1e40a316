#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vdbcage::detail {

/// Disjoint sets of the numbers 0 ... n - 1 that several threads may unite at once. The root of a set is its smallest
/// member, so the sets and their roots do not depend on the order of the calls.
class UnionFind {
public:
    explicit UnionFind(std::size_t n) : parents_(n)
    {
        for (std::size_t i = 0; i < n; ++i) parents_[i].store(static_cast<std::uint32_t>(i), std::memory_order_relaxed);
    }

    std::uint32_t find(std::uint32_t i)
    {
        for (;;) {
            std::uint32_t parent = parents_[i].load();
            if (parent == i) return i;
            const std::uint32_t grandparent = parents_[parent].load();
            // Halving the path: parents only ever become smaller, so a lost swap does no harm.
            if (grandparent != parent) parents_[i].compare_exchange_weak(parent, grandparent);
            i = grandparent;
        }
    }

    void unite(std::uint32_t a, std::uint32_t b)
    {
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::uint32_t expected = a; // put the larger root below the smaller one, if it still is a root
            if (parents_[a].compare_exchange_strong(expected, b)) return;
        }
    }

private:
    std::vector<std::atomic<std::uint32_t>> parents_;
};

} // namespace vdbcage::detail
