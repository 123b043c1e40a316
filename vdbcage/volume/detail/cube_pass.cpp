// A cube is the sum of three segments, so a dilation by it is three passes along one axis each. All three are the same
// code: a pass works along x, where the 64 voxels of a word are 64 lanes, and turns the axes as it writes, (x, y, z)
// becoming (y, z, x); three turns are none. An erosion is the dilation of the complement.
#include <vdbcage/volume/detail/cube_pass.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <set>

#include <tbb/parallel_for.h>

#include <vdbcage/volume/detail/word_bits.h>

namespace vdbcage::detail {

namespace {

enum class Side { mask, complement };

Coord turned(const Coord& c)
{
    return {c.y(), c.z(), c.x()};
}

// Bit (x, y, z), in word x at 8 y + z, moves to word y at 8 z + x.
Words turned(const Words& words)
{
    Words w = words;
    transposeBytes(w);
    // Now word y holds bytes x of bits z: each word transposed as an 8 x 8 matrix of bits.
    for (std::uint64_t& word : w) {
        swapBits(word, 0x00000000F0F0F0F0ULL, 28);
        swapBits(word, 0x0000CCCC0000CCCCULL, 14);
        swapBits(word, 0x00AA00AA00AA00AAULL, 7);
    }
    return w;
}

// A block between two passes. Slots go by kind: 0 is empty, 1 full, k the words at k - 2.
struct FlatBlock {
    Coord origin;
    std::vector<std::uint16_t> kinds = std::vector<std::uint16_t>(slotsPerBlock, 0);
    std::vector<Words> words;
    bool isUniform = true; // as finish() found

    void set(int n, const Words& bits)
    {
        auto& kind = kinds[static_cast<std::size_t>(n)];
        if (bits == emptyWords || bits == fullWords) {
            kind = bits == fullWords ? 1 : 0;
        } else {
            words.push_back(bits);
            kind = static_cast<std::uint16_t>(words.size() + 1);
        }
    }
    // When all slots are set.
    void finish()
    {
        isUniform =
            words.empty() && std::adjacent_find(kinds.begin(), kinds.end(), std::not_equal_to<>()) == kinds.end();
    }
    bool isFull() const { return kinds[0] == 1 && isUniform; }
};

FlatBlock flattened(const MaskBlock& node)
{
    FlatBlock flat;
    flat.origin = node.origin();
    Block(&node).forEachSlot([&](int n, const std::uint64_t* slot) {
        Words words;
        std::copy_n(slot, words.size(), words.begin());
        flat.set(n, words);
    });
    flat.finish();
    return flat;
}

BuiltBlock treeBlock(const FlatBlock& flat)
{
    BlockBuilder builder(flat.origin);
    for (int n = 0; n < slotsPerBlock; ++n) {
        const std::size_t kind = flat.kinds[static_cast<std::size_t>(n)];
        if (kind > 0) builder.set(n, kind == 1 ? fullWords.data() : flat.words[kind - 2].data());
    }
    return builder.finish();
}

// One block of a mask: flat, or uniformly full or empty.
struct Slots {
    const FlatBlock* flat = nullptr;
    bool full = false; // where it is uniform

    bool isFull() const { return !flat && full; }
    bool isEmpty() const { return !flat && !full; }
};

// A mask by its blocks, without the nodes of a tree.
class SlotSet {
public:
    SlotSet(const MaskTree& tree, const Progress& progress) : full_(fullParts(tree))
    {
        std::vector<const MaskBlock*> nodes;
        tree.getNodes(nodes);
        flat_.resize(nodes.size());
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
            progress.check(done++, nodes.size());
            flat_[i] = flattened(*nodes[i]);
        });
        index();
    }
    // The full parts, with the blocks in their places.
    SlotSet(FullParts full, std::vector<FlatBlock> flat, const Progress& progress)
        : flat_(std::move(flat)), full_(std::move(full))
    {
        progress.check(1, 1);
        std::set<Coord> broken; // full regions that no longer are
        for (const FlatBlock& block : flat_) {
            if (!block.isFull()) broken.insert(alignedTo(block.origin, regionSize));
        }
        const auto isBroken = [&](const Coord& region) {
            if (broken.count(region) == 0) return false;
            forEachBlock(region, [&](const Coord& block) { full_.blocks.push_back(block); });
            return true;
        };
        full_.regions.erase(std::remove_if(full_.regions.begin(), full_.regions.end(), isBroken), full_.regions.end());
        progress.check(1, 1);
        std::set<Coord> origins;
        for (const FlatBlock& block : flat_) origins.insert(block.origin);
        const auto isReplaced = [&](const Coord& block) { return origins.count(block) > 0; };
        full_.blocks.erase(std::remove_if(full_.blocks.begin(), full_.blocks.end(), isReplaced), full_.blocks.end());
        for (const FlatBlock& block : flat_) {
            if (block.isFull()) full_.blocks.push_back(block.origin);
        }
        progress.check(1, 1);
        index();
    }

    SlotSet(SlotSet&&) = default; // a copy would look at the other's blocks
    SlotSet& operator=(SlotSet&&) = default;

    Slots at(const Coord& origin) const
    {
        const auto found = blocks_.find(origin);
        return found != blocks_.end() ? found->second
                                      : Slots{nullptr, regions_.count(alignedTo(origin, regionSize)) > 0};
    }
    const FullParts& full() const { return full_; }
    // The blocks where the mask may begin or end.
    std::vector<Coord> shell() const
    {
        std::vector<Coord> origins = facesOfRegions(full_.regions);
        for (const auto& [origin, slots] : blocks_) origins.push_back(origin);
        return origins;
    }
    MaskTree::Ptr tree(const Progress& progress) const
    {
        std::vector<BuiltBlock> built(flat_.size());
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, flat_.size(), [&](std::size_t i) {
            progress.check(done++, flat_.size());
            built[i] = treeBlock(flat_[i]);
        });
        return assemble(full_, std::move(built));
    }

private:
    void index()
    {
        for (const FlatBlock& block : flat_) {
            blocks_.emplace(block.origin, block.isUniform ? Slots{nullptr, block.isFull()} : Slots{&block, false});
        }
        regions_.insert(full_.regions.begin(), full_.regions.end());
        for (const Coord& origin : full_.blocks) blocks_.insert_or_assign(origin, Slots{nullptr, true});
    }

    std::vector<FlatBlock> flat_;
    FullParts full_;
    std::map<Coord, Slots> blocks_;
    std::set<Coord> regions_; // the full ones
};

// The kinds of a plane of slots of a uniform block.
using Plane = std::array<std::uint16_t, slotsPerAxis * slotsPerAxis>;
constexpr Plane emptyPlane{};
constexpr Plane fullPlane = [] {
    Plane plane{};
    for (std::uint16_t& kind : plane) kind = 1;
    return plane;
}();

// One pass along x. Everything is said for a dilation; for an erosion it holds for the complement.
class AxisPass {
public:
    AxisPass(const SlotSet& mask, Side side, int radius, const Progress& progress)
        : mask_(mask), flip_(side == Side::complement ? ~0ULL : 0), none_(flip_ != 0 ? 1 : 0), all_(flip_ != 0 ? 0 : 1),
          radius_(radius), wholeSlots_(static_cast<std::size_t>(radius / leafSize)), rest_(radius % leafSize),
          slotReach_(wholeSlots_ + (rest_ > 0 ? 1 : 0)), blockReach_((radius + blockSize - 1) / blockSize),
          progress_(progress)
    {
    }

    SlotSet run()
    {
        progress_.check(0, 1);
        const std::vector<Row> rows = targetRows();
        std::vector<FlatBlock> built(rows.empty() ? 0 : rows.back().start + rows.back().blocks);
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
            build(rows[i], &built[rows[i].start], [&] { progress_.check(done++, rows.size() * slotsPerAxis); });
        });
        FullParts full = mask_.full();
        for (auto* origins : {&full.regions, &full.blocks}) {
            for (Coord& origin : *origins) origin = turned(origin);
        }
        return {std::move(full), std::move(built), progress_};
    }

private:
    // Blocks side by side along x, which share most of what they look at.
    struct Row {
        Coord first;
        std::size_t blocks;
        std::size_t start; // of its blocks among those of all rows
    };
    static constexpr std::size_t longestRow = 8; // shorter ones for more threads

    bool isFull(const Slots& block) const { return flip_ != 0 ? block.isEmpty() : block.isFull(); }
    bool isEmpty(const Slots& block) const { return flip_ != 0 ? block.isFull() : block.isEmpty(); }

    // The blocks that are not full but have something in reach.
    std::vector<Row> targetRows() const
    {
        std::vector<Coord> targets;
        for (const Coord& origin : mask_.shell()) {
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                targets.push_back(origin.offsetBy(step * blockSize, 0, 0));
            }
        }
        std::sort(targets.begin(), targets.end(), [](const Coord& a, const Coord& b) { return turned(a) < turned(b); });
        targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
        progress_.check(0, 1);
        const auto isSettled = [&](const Coord& origin) {
            if (isFull(mask_.at(origin))) return true;
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                if (!isEmpty(mask_.at(origin.offsetBy(step * blockSize, 0, 0)))) return false;
            }
            return true;
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isSettled), targets.end());
        std::vector<Row> rows;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const bool continues = !rows.empty() && rows.back().blocks < longestRow &&
                                   targets[i] == targets[i - 1].offsetBy(blockSize, 0, 0);
            if (continues) {
                ++rows.back().blocks;
            } else {
                rows.push_back({targets[i], 1, i});
            }
        }
        return rows;
    }

    // What a row can see: by slot along x, from slotReach_ before its first to as many behind its last.
    struct View {
        std::vector<const std::uint16_t*> kinds; // of the plane of slots there, first along z
        std::vector<const Words*> words;         // that they stand for
        // Of one line of slots along x:
        std::vector<const std::uint64_t*> line; // their words
        std::vector<std::uint64_t> any;         // the voxels of all words of each in one
        std::vector<std::uint64_t> sums;        // of `any`, of `summed` slots from each on
        std::size_t summed = 1;
    };

    template <class Check>
    void build(const Row& row, FlatBlock* result, const Check& check) const
    {
        for (std::size_t i = 0; i < row.blocks; ++i) {
            const Coord origin = row.first.offsetBy(static_cast<int>(i) * blockSize, 0, 0);
            result[i].origin = turned(origin);
            if (none_ != 0) result[i].kinds.assign(slotsPerBlock, none_);
            if (const FlatBlock* const before = mask_.at(origin).flat) result[i].words.reserve(before->words.size());
        }
        View view = look(row);
        for (int y = 0; y < slotsPerAxis; ++y) {
            check();
            const Lines lines = compareLines(view, y);
            for (int z = 0; z < slotsPerAxis; ++z) {
                const int start = slotIndex(y, z, 0); // turned
                if (lines.isNone(z)) continue;
                if (lines.isAll(z)) {
                    for (std::size_t i = 0; i < row.blocks; ++i) {
                        std::fill_n(result[i].kinds.begin() + start, slotsPerAxis, all_);
                    }
                    continue;
                }
                readLine(view, slotIndex(0, y, z));
                for (std::size_t i = 0; i < row.blocks; ++i) smearLine(view, i, start, result[i]);
            }
        }
        for (std::size_t i = 0; i < row.blocks; ++i) result[i].finish();
    }

    View look(const Row& row) const
    {
        View view;
        const int reach = static_cast<int>(slotReach_), size = static_cast<int>(row.blocks) * slotsPerAxis;
        for (int block = -blockReach_; block < static_cast<int>(row.blocks) + blockReach_; ++block) {
            const Slots slots = mask_.at(row.first.offsetBy(block * blockSize, 0, 0));
            for (int i = 0; i < slotsPerAxis; ++i) {
                const int x = block * slotsPerAxis + i;
                if (x < -reach || x >= size + reach) continue;
                view.kinds.push_back(slots.flat ? &slots.flat->kinds[static_cast<std::size_t>(slotIndex(i, 0, 0))]
                                                : (slots.full ? fullPlane : emptyPlane).data());
                view.words.push_back(slots.flat ? slots.flat->words.data() : nullptr);
            }
        }
        view.line.resize(view.kinds.size());
        view.any.resize(view.kinds.size());
        return view;
    }

    // Of the 16 lines at one y: which have slots that are not none, and not all.
    struct Lines {
        std::array<std::uint16_t, slotsPerAxis> some{}, open{};
        bool isNone(int z) const { return some[static_cast<std::size_t>(z)] == 0; }
        bool isAll(int z) const { return open[static_cast<std::size_t>(z)] == 0; }
    };
    Lines compareLines(const View& view, int y) const
    {
        Lines lines;
        for (const std::uint16_t* plane : view.kinds) {
            const std::uint16_t* const kinds = plane + slotIndex(0, y, 0);
            for (std::size_t z = 0; z < slotsPerAxis; ++z) {
                lines.some[z] = static_cast<std::uint16_t>(lines.some[z] | (kinds[z] ^ none_));
                lines.open[z] = static_cast<std::uint16_t>(lines.open[z] | (kinds[z] ^ all_));
            }
        }
        return lines;
    }

    // The line through slot n of the planes.
    void readLine(View& view, int n) const
    {
        const std::size_t size = view.kinds.size();
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t kind = view.kinds[i][n];
            if (kind < 2) {
                view.line[i] = kind == 0 ? emptyWords.data() : fullWords.data();
                view.any[i] = kind == none_ ? 0 : ~0ULL;
                continue;
            }
            const Words& words = view.words[i][kind - 2];
            std::uint64_t any = 0;
            for (const std::uint64_t word : words) any |= word ^ flip_;
            view.line[i] = words.data();
            view.any[i] = any;
        }
        // Sums of more and more slots, by doubling, up to those that lie wholly in reach of all of one.
        view.sums = view.any;
        view.summed = 1;
        for (; view.summed < wholeSlots_; view.summed *= 2) {
            for (std::size_t i = 0; i + view.summed < size; ++i) view.sums[i] |= view.sums[i + view.summed];
        }
    }

    // The slots of one block of the row on the line; they start at slot `start` of the result.
    void smearLine(const View& view, std::size_t block, int start, FlatBlock& result) const
    {
        for (std::size_t x = 0; x < slotsPerAxis; ++x) {
            const std::size_t own = slotReach_ + block * slotsPerAxis + x;
            const int n = start + static_cast<int>(x);
            const std::uint64_t inner = innerOf(view, own);
            if (inner == ~0ULL) {
                result.kinds[static_cast<std::size_t>(n)] = all_;
            } else if ((inner | view.any[own - slotReach_] | view.any[own + slotReach_] | view.any[own - wholeSlots_] |
                        view.any[own + wholeSlots_]) != 0) {
                Words near = smear(view, own, inner);
                for (std::uint64_t& word : near) word ^= flip_;
                result.set(n, turned(near));
            }
        }
    }

    // The voxels of all slots that lie wholly in reach of all of slot `own`, in one.
    std::uint64_t innerOf(const View& view, std::size_t own) const
    {
        if (wholeSlots_ == 0) return view.line[own] == (flip_ != 0 ? emptyWords : fullWords).data() ? ~0ULL : 0;
        return view.sums[own + 1 - wholeSlots_] | view.sums[own + wholeSlots_ - view.summed];
    }

    // The result at slot `own` of the line.
    Words smear(const View& view, std::size_t own, std::uint64_t inner) const
    {
        Words near;
        near.fill(inner);
        if (wholeSlots_ == 0) {
            smearWithin(view, own, near);
        } else {
            addSums(view, own - wholeSlots_, true, 0, near);
            addSums(view, own + wholeSlots_, false, 0, near);
        }
        if (rest_ > 0) {
            addSums(view, own - wholeSlots_ - 1, true, leafSize, near);
            addSums(view, own + wholeSlots_ + 1, false, leafSize, near);
        }
        return near;
    }

    // Within one slot, of a radius below its size.
    void smearWithin(const View& view, std::size_t own, Words& near) const
    {
        if (view.any[own] == 0) return;
        for (int from = 0; from < leafSize; ++from) {
            const std::uint64_t word = view.line[own][from] ^ flip_;
            const int last = std::min(from + radius_, leafSize - 1);
            for (int to = std::max(from - radius_, 0); to <= last; ++to) near[static_cast<std::size_t>(to)] |= word;
        }
    }

    // From a slot at the end of the reach, before or behind this one. Counted from its end next to this slot, and here
    // from the end next to it, the words 0 to 7 - (to - rest + beyond) of it reach word `to`.
    void addSums(const View& view, std::size_t slot, bool before, int beyond, Words& near) const
    {
        if (view.any[slot] == 0) return;
        const std::uint64_t* const words = view.line[slot];
        std::uint64_t sum = 0;
        std::array<std::uint64_t, 8> sums; // of the words 0 to i
        for (std::size_t i = 0; i < 8; ++i) {
            sum |= words[before ? 7 - i : i] ^ flip_;
            sums[i] = sum;
        }
        for (int to = 0; to < leafSize; ++to) {
            const int last = leafSize - 1 - (to - rest_ + beyond);
            if (last < 0) break;
            near[static_cast<std::size_t>(before ? to : leafSize - 1 - to)] |=
                sums[static_cast<std::size_t>(std::min(last, leafSize - 1))];
        }
    }

    const SlotSet& mask_;
    std::uint64_t flip_;
    std::uint16_t none_, all_; // the uniform kinds, as seen from this side
    int radius_;
    std::size_t wholeSlots_;
    int rest_; // the radius is as many slots and voxels
    std::size_t slotReach_;
    int blockReach_;
    Progress progress_;
};

MaskTree::Ptr threePasses(const MaskTree& mask, Side side, int radius, const Progress& progress)
{
    SlotSet set(mask, progress.part(0, 5));
    for (int i = 1; i < 4; ++i) set = AxisPass(set, side, radius, progress.part(i, 5)).run();
    return set.tree(progress.part(4, 5));
}

} // namespace

MaskTree::Ptr dilateByCube(const MaskTree& mask, int radius, const Progress& progress)
{
    return threePasses(mask, Side::mask, radius, progress);
}

MaskTree::Ptr erodeByCube(const MaskTree& mask, int radius, const Progress& progress)
{
    return threePasses(mask, Side::complement, radius, progress);
}

} // namespace vdbcage::detail
