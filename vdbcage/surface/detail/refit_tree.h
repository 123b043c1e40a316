#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <vdbcage/mesh/detail/triangle_tree.h>

namespace vdbcage::detail {

/// Boxes of things that move, come and vanish one at a time: a binary tree that is refitted upwards from a changed
/// leaf; things that came since it was built are looked through one by one. To be built anew when wantsBuild() says so.
/// Deterministic.
class RefitTree {
public:
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    /// Thing i has boxes[i]; those with alive[i] == 0 are left out. O(n log n).
    void build(const std::vector<Box>& boxes, const std::vector<char>& alive)
    {
        std::vector<std::uint32_t> things;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            if (alive[i]) things.push_back(i);
        }
        leafOf_.assign(boxes.size(), none);
        nodes_.clear();
        nodes_.reserve(2 * things.size());
        live_ = built_ = things.size();
        late_.clear();
        if (!things.empty()) buildNode(boxes, things, 0, things.size(), none);
    }

    /// Whether so many things have come or gone since the last build that another one pays.
    bool wantsBuild() const { return live_ * 2 < built_ || late_.size() > mostLate; }

    /// Adds a thing of the next number.
    void insert(std::uint32_t thing, const Box& box)
    {
        leafOf_.push_back(none);
        late_.push_back({thing, box});
        ++live_;
    }

    void update(std::uint32_t thing, const Box& box)
    {
        if (leafOf_[thing] == none) {
            findLate(thing)->box = box;
            return;
        }
        nodes_[leafOf_[thing]].box = box;
        refit(nodes_[leafOf_[thing]].parent);
    }

    void remove(std::uint32_t thing)
    {
        --live_;
        if (leafOf_[thing] == none) {
            late_.erase(findLate(thing));
            return;
        }
        nodes_[leafOf_[thing]].box = empty();
        refit(nodes_[leafOf_[thing]].parent);
        leafOf_[thing] = none;
    }

    /// Calls visit(thing, itsBox) for each thing whose box meets `box`, until it answers false. Returns false if it
    /// stopped.
    template <typename Visit>
    bool forEachOverlap(const Box& box, const Visit& visit) const
    {
        for (const Late& late : late_) {
            if (late.box.meets(box) && !visit(late.thing, late.box)) return false;
        }
        if (nodes_.empty()) return true;
        std::array<std::uint32_t, 64> stack; // halving: depth at most 32
        std::size_t size = 0;
        stack[size++] = 0;
        while (size > 0) {
            const Node& node = nodes_[stack[--size]];
            if (!node.box.meets(box)) continue;
            if (node.right == none) {
                if (!visit(node.left, node.box)) return false;
                continue;
            }
            stack[size++] = node.right;
            stack[size++] = node.left;
        }
        return true;
    }

private:
    struct Node {
        Box box;
        std::uint32_t parent, left, right; // right == none: a leaf, left is its thing
    };

    struct Late {
        std::uint32_t thing;
        Box box;
    };
    static constexpr std::size_t mostLate = 32;

    std::vector<Late>::iterator findLate(std::uint32_t thing)
    {
        return std::find_if(late_.begin(), late_.end(), [&](const Late& late) { return late.thing == thing; });
    }

    static Box empty()
    {
        const double infinity = std::numeric_limits<double>::infinity();
        return {Vec3d(infinity), Vec3d(-infinity)};
    }

    std::uint32_t buildNode(const std::vector<Box>& boxes, std::vector<std::uint32_t>& things, std::size_t begin,
                            std::size_t end, std::uint32_t parent)
    {
        const auto self = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({boxes[things[begin]], parent, things[begin], none});
        if (end - begin == 1) {
            leafOf_[things[begin]] = self;
            return self;
        }
        Box centres = Box::of(boxes[things[begin]].lo + boxes[things[begin]].hi);
        for (std::size_t i = begin + 1; i < end; ++i) {
            nodes_[self].box.expand(boxes[things[i]]);
            centres.expand(Box::of(boxes[things[i]].lo + boxes[things[i]].hi));
        }
        const Vec3d extent = centres.hi - centres.lo;
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
        const std::size_t middle = (begin + end) / 2;
        const auto at = [&](std::size_t i) { return things.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
            const double ca = boxes[a].lo[axis] + boxes[a].hi[axis], cb = boxes[b].lo[axis] + boxes[b].hi[axis];
            return ca != cb ? ca < cb : a < b;
        });
        const std::uint32_t left = buildNode(boxes, things, begin, middle, self);
        const std::uint32_t right = buildNode(boxes, things, middle, end, self);
        nodes_[self].left = left;
        nodes_[self].right = right;
        return self;
    }

    void refit(std::uint32_t at)
    {
        while (at != none) {
            Node& node = nodes_[at];
            Box box = nodes_[node.left].box;
            box.expand(nodes_[node.right].box);
            if (box.lo == node.box.lo && box.hi == node.box.hi) return;
            node.box = box;
            at = node.parent;
        }
    }

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leafOf_; // none: gone, or late
    std::vector<Late> late_;
    std::size_t live_ = 0, built_ = 0;
};

} // namespace vdbcage::detail
