#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <vdbcage/mesh/detail/floats.h>
#include <vdbcage/mesh/detail/triangle_tree.h>

namespace vdbcage::detail {

/// Boxes of things that move, come and vanish one at a time: a tree of four children a node that is refitted upwards
/// from a changed leaf; things that came since it was built are looked through one by one. To be built anew when
/// wantsBuild() says so. Deterministic.
///
/// Children's boxes are compared at once, in float: rounding keeps the order, so that no meeting is missed; what is
/// left is told apart in double.
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
        boxes_ = boxes;
        slotOf_.assign(boxes.size(), none);
        nodes_.clear();
        live_ = built_ = things.size();
        late_.clear();
        if (!things.empty()) buildNode({things.begin(), things.end()}, none);
    }

    /// Whether so many things have come or gone since the last build that another one pays.
    bool wantsBuild() const { return live_ * 2 < built_ || late_.size() > mostLate; }

    /// Adds a thing of the next number.
    void insert(std::uint32_t thing, const Box& box)
    {
        boxes_.push_back(box);
        slotOf_.push_back(none);
        late_.push_back(thing);
        ++live_;
    }

    void update(std::uint32_t thing, const Box& box)
    {
        boxes_[thing] = box;
        if (slotOf_[thing] != none) refit(slotOf_[thing], FloatBox(box));
    }

    void remove(std::uint32_t thing)
    {
        --live_;
        if (slotOf_[thing] == none) {
            late_.erase(std::find(late_.begin(), late_.end(), thing));
            return;
        }
        refit(slotOf_[thing], FloatBox());
        slotOf_[thing] = none;
    }

    /// Calls visit(thing, itsBox) for each thing whose box meets `box`, until it answers false. Returns false if it
    /// stopped.
    template <typename Visit>
    bool forEachOverlap(const Box& box, const Visit& visit) const
    {
        const auto goesOn = [&](std::uint32_t thing) {
            return !boxes_[thing].meets(box) || visit(thing, boxes_[thing]);
        };
        if (!std::all_of(late_.begin(), late_.end(), goesOn)) return false;
        if (nodes_.empty()) return true;
        const FloatBox outer(box);
        std::array<Floats, 3> lo, hi;
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = Floats{} + outer.lo[i];
            hi[i] = Floats{} + outer.hi[i];
        }
        std::array<std::uint32_t, 3 * 32 + 1> stack; // quartering: at most 32 deep
        std::size_t size = 0;
        stack[size++] = 0;
        while (size > 0) {
            const std::uint32_t at = stack[--size];
            if (at & isThing) {
                if (!goesOn(at & ~isThing)) return false;
                continue;
            }
            const Node& node = nodes_[at];
            const unsigned met = bits(node.meet(lo, hi));
            for (std::size_t i = 4; i-- > 0;) {
                if (met >> i & 1U) stack[size++] = node.child[i];
            }
        }
        return true;
    }

private:
    static constexpr std::uint32_t isThing = std::uint32_t(1) << 31;
    static constexpr std::size_t mostLate = 32;

    struct FloatBox {
        std::array<float, 3> lo, hi;

        FloatBox()
        {
            lo.fill(std::numeric_limits<float>::infinity());
            hi.fill(-std::numeric_limits<float>::infinity());
        }
        explicit FloatBox(const Box& box)
        {
            for (std::size_t i = 0; i < 3; ++i) {
                lo[i] = static_cast<float>(box.lo[static_cast<int>(i)]);
                hi[i] = static_cast<float>(box.hi[static_cast<int>(i)]);
            }
        }
    };

    /// The place of a child: four times its parent's number and which of the four it is.
    using Slot = std::uint32_t;

    struct alignas(64) Node : FourBoxes {
        std::array<std::uint32_t, 4> child{}; // a node, or isThing and a thing
        Slot slot;                            // its own; none: the root

        explicit Node(Slot own) : slot(own)
        {
            for (std::size_t i = 0; i < 4; ++i) set(i, FloatBox());
        }
        /// Returns whether that changed the child's box.
        bool set(std::size_t i, const FloatBox& box)
        {
            bool hasChanged = false;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                hasChanged = hasChanged || lo[axis][i] != box.lo[axis] || hi[axis][i] != box.hi[axis];
                lo[axis][i] = box.lo[axis];
                hi[axis][i] = box.hi[axis];
            }
            return hasChanged;
        }
        FloatBox box() const
        {
            FloatBox all;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                all.lo[axis] = leastOf(lo[axis]);
                all.hi[axis] = greatestOf(hi[axis]);
            }
            return all;
        }
    };

    using Things = std::vector<std::uint32_t>::iterator;
    struct Range {
        Things begin, end;

        std::ptrdiff_t size() const { return end - begin; }
    };

    /// Brings half of the things, along the longest side of their centres' box, before the others.
    std::array<Range, 2> halves(const Range& things) const
    {
        const auto twiceCentre = [&](std::uint32_t thing) { return boxes_[thing].lo + boxes_[thing].hi; };
        Box centres = Box::of(twiceCentre(*things.begin));
        for (auto i = things.begin + 1; i != things.end; ++i) centres.expand(Box::of(twiceCentre(*i)));
        const Vec3d extent = centres.hi - centres.lo;
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
        const Things middle = things.begin + things.size() / 2;
        std::nth_element(things.begin, middle, things.end, [&](std::uint32_t a, std::uint32_t b) {
            const double ca = boxes_[a].lo[axis] + boxes_[a].hi[axis], cb = boxes_[b].lo[axis] + boxes_[b].hi[axis];
            return ca != cb ? ca < cb : a < b;
        });
        return {Range{things.begin, middle}, Range{middle, things.end}};
    }

    /// Returns its number.
    std::uint32_t buildNode(const Range& things, Slot slot)
    {
        const auto self = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back(slot);
        std::uint32_t child = 0;
        const auto add = [&](const Range& part) {
            const std::uint32_t at = child++;
            FloatBox box;
            if (part.size() == 1) {
                const std::uint32_t thing = *part.begin;
                nodes_[self].child[at] = isThing | thing;
                slotOf_[thing] = 4 * self + at;
                box = FloatBox(boxes_[thing]);
            } else {
                const std::uint32_t node = buildNode(part, 4 * self + at);
                nodes_[self].child[at] = node;
                box = nodes_[node].box();
            }
            nodes_[self].set(at, box);
        };
        if (things.size() == 1) {
            add(things);
            return self;
        }
        for (const Range& half : halves(things)) {
            if (half.size() == 1) {
                add(half);
            } else {
                for (const Range& quarter : halves(half)) add(quarter);
            }
        }
        return self;
    }

    void refit(Slot slot, FloatBox box)
    {
        while (slot != none && nodes_[slot / 4].set(slot % 4, box)) {
            box = nodes_[slot / 4].box();
            slot = nodes_[slot / 4].slot;
        }
    }

    std::vector<Node> nodes_;
    std::vector<Box> boxes_;   // by thing
    std::vector<Slot> slotOf_; // by thing; none: gone, or late
    std::vector<std::uint32_t> late_;
    std::size_t live_ = 0, built_ = 0;
};

} // namespace vdbcage::detail
