#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/floats.h>
#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

/// Boxes of things that move, are added and removed, in a tree of four children a node. Deterministic.
///
/// Boxes are refitted from changed leaves upwards. Things added since the tree was built are searched one by one. The
/// boxes of a node's children are compared at once, in float. Rounding keeps the order, so no meeting is missed; the
/// remaining candidates are tested in double.
class DynamicBvh {
public:
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    DynamicBvh() = default;
    /// Makes things numbered from 0: thing i has boxes[i].
    /// Cost: O(n log n), in parallel.
    explicit DynamicBvh(std::vector<Box> boxes) : boxes_(std::move(boxes)), placeOf_(boxes_.size(), none)
    {
        std::vector<Thing> things;
        things.reserve(boxes_.size());
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) things.push_back(thing(i));
        build(things);
    }

    /// Builds the tree again if this pays, after many additions or removals.
    void rebuildIfWorthwhile()
    {
        constexpr std::size_t mostLate = 32;
        if (live_ * 2 >= built_ && late_.size() <= mostLate) return;
        std::vector<Thing> things;
        things.reserve(live_);
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
            if (placeOf_[i] != none) things.push_back(thing(i));
        }
        for (const std::uint32_t i : late_) things.push_back(thing(i));
        build(things);
    }

    /// Adds a thing with the next number.
    void insert(std::uint32_t thing, const Box& box)
    {
        boxes_.push_back(box);
        placeOf_.push_back(none);
        late_.push_back(thing);
        ++live_;
    }

    /// Adds a removed thing again.
    void restore(std::uint32_t thing, const Box& box)
    {
        boxes_[thing] = box;
        late_.push_back(thing);
        ++live_;
    }

    /// Changes the box of a thing; takes effect with refit().
    void update(std::uint32_t thing, const Box& box)
    {
        boxes_[thing] = box;
        if (placeOf_[thing] != none) set(placeOf_[thing], rounded(box));
    }

    /// Removes a thing; takes effect with refit().
    void remove(std::uint32_t thing)
    {
        --live_;
        if (placeOf_[thing] == none) {
            late_.erase(std::find(late_.begin(), late_.end(), thing));
            return;
        }
        set(placeOf_[thing], FloatBox());
        placeOf_[thing] = none;
    }

    /// Applies updates and removals. One call for many changes computes a node above several of them once.
    void refit()
    {
        // A node's number is above its parent's.
        for (std::size_t i = changed_.size(); i-- > 0;) {
            while (changed_[i] != 0) {
                const auto bit = static_cast<std::size_t>(63 - __builtin_clzll(changed_[i]));
                changed_[i] ^= std::uint64_t(1) << bit;
                const Node& node = nodes_[64 * i + bit];
                if (node.place != none) set(node.place, node.box());
            }
        }
    }

    /// Calls visit(thing, itsBox) for each thing whose box meets `box`, until it returns false. Returns false if it
    /// stopped. Sides of `box` may be infinite.
    template <typename Visit>
    bool forEachOverlap(const Box& box, const Visit& visit) const
    {
        const auto goesOn = [&](std::uint32_t thing) {
            return !boxes_[thing].meets(box) || visit(thing, boxes_[thing]);
        };
        if (!std::all_of(late_.begin(), late_.end(), goesOn)) return false;
        if (nodes_.empty()) return true;
        const FloatBox outer = rounded(box);
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

    /// Returns the box in finite floats: an infinite one would meet absent children, too, which are empty boxes.
    static FloatBox rounded(const Box& box)
    {
        constexpr double most = std::numeric_limits<float>::max();
        FloatBox result;
        for (int i = 0; i < 3; ++i) {
            result.lo[i] = static_cast<float>(std::clamp(box.lo[i], -most, most));
            result.hi[i] = static_cast<float>(std::clamp(box.hi[i], -most, most));
        }
        return result;
    }

    /// The place of a child: four times its parent's number, plus its index in the parent.
    using Place = std::uint32_t;

    struct alignas(64) Node : FourBoxes {
        std::array<std::uint32_t, 4> child{}; // a node, or isThing and a thing
        Place place;                          // its own; none: the root

        explicit Node(Place own) : FourBoxes{}, place(own)
        {
            for (std::size_t i = 0; i < 4; ++i) set(i, FloatBox());
        }
        /// Sets a child's box. Returns whether that changed it.
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

    struct Thing {
        Vec3d twiceCentre;
        std::uint32_t number;
    };
    Thing thing(std::uint32_t number) const { return {boxes_[number].lo + boxes_[number].hi, number}; }

    using Things = std::vector<Thing>::iterator;
    struct Range {
        Things begin, end;

        std::ptrdiff_t size() const { return end - begin; }
    };

    static std::array<Range, 2> halves(const Range& things)
    {
        const Things middle = things.begin + things.size() / 2;
        return {Range{things.begin, middle}, Range{middle, things.end}};
    }

    /// Sorts the half of the things that is lower along the longest side of their centres' box before the others, and
    /// each half in the same way.
    static void sort(const Range& things)
    {
        constexpr std::ptrdiff_t taskSize = 1024; // worth a task
        if (things.size() < 2) return;
        Box centres = Box::of(things.begin->twiceCentre);
        for (auto i = things.begin + 1; i != things.end; ++i) centres.expand(Box::of(i->twiceCentre));
        const Vec3d extent = centres.hi - centres.lo;
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
        const auto parts = halves(things);
        std::nth_element(things.begin, parts[1].begin, things.end, [&](const Thing& a, const Thing& b) {
            const double ca = a.twiceCentre[axis], cb = b.twiceCentre[axis];
            return ca != cb ? ca < cb : a.number < b.number;
        });
        if (things.size() < taskSize) {
            sort(parts[0]);
            sort(parts[1]);
        } else {
            parallelInvoke([&] { sort(parts[0]); }, [&] { sort(parts[1]); });
        }
    }

    /// Builds the tree. \param things all, in any order
    void build(std::vector<Thing>& things)
    {
        live_ = built_ = things.size();
        late_.clear();
        nodes_.clear();
        nodes_.reserve(things.size());
        if (!things.empty()) {
            const Range all{things.begin(), things.end()};
            sort(all);
            buildNode(all, none);
        }
        changed_.assign(nodes_.size() / 64 + 1, 0);
    }

    /// Builds the node of these things, and those below it. Returns its number.
    std::uint32_t buildNode(const Range& things, Place place)
    {
        const auto self = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back(place);
        std::uint32_t child = 0;
        const auto add = [&](const Range& part) {
            const std::uint32_t at = child++;
            FloatBox box;
            if (part.size() == 1) {
                const std::uint32_t thing = part.begin->number;
                nodes_[self].child[at] = isThing | thing;
                placeOf_[thing] = 4 * self + at;
                box = rounded(boxes_[thing]);
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

    void set(Place place, const FloatBox& box)
    {
        const std::size_t node = place / 4;
        if (nodes_[node].set(place % 4, box)) changed_[node / 64] |= std::uint64_t(1) << node % 64;
    }

    std::vector<Node> nodes_;
    std::vector<Box> boxes_;     // by thing
    std::vector<Place> placeOf_; // by thing; none: gone, or late
    std::vector<std::uint32_t> late_;
    std::vector<std::uint64_t> changed_; // a bit for each node whose box must be set in its parent
    std::size_t live_ = 0, built_ = 0;
};

} // namespace vdbcage::detail
