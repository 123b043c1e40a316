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

// A block between two passes. Slots go by number: 0 is empty, 1 full, n the words at n - 2.
struct FlatBlock {
    Coord origin;
    std::vector<std::uint16_t> slots = std::vector<std::uint16_t>(slotsPerBlock, 0);
    std::vector<Words> words;

    void set(int n, const Words& bits)
    {
        auto& slot = slots[static_cast<std::size_t>(n)];
        if (bits == emptyWords || bits == fullWords) {
            slot = bits == fullWords ? 1 : 0;
        } else {
            words.push_back(bits);
            slot = static_cast<std::uint16_t>(words.size() + 1);
        }
    }
    const std::uint64_t* slot(int n) const
    {
        const std::size_t i = slots[static_cast<std::size_t>(n)];
        return i > 1 ? words[i - 2].data() : i == 1 ? fullWords.data() : emptyWords.data();
    }
    bool isUniform() const
    {
        return words.empty() && std::adjacent_find(slots.begin(), slots.end(), std::not_equal_to<>()) == slots.end();
    }
    bool isFull() const { return slots[0] == 1 && isUniform(); }
};

// A block of a tree or between two passes.
class Slots {
public:
    Slots(const Block& block) : block_(block) {}
    Slots(const FlatBlock& flat)
    {
        if (flat.isUniform()) {
            block_ = Block(flat.isFull());
        } else {
            flat_ = &flat;
        }
    }
    bool isFull() const { return !flat_ && block_.isFull(); }
    bool isEmpty() const { return !flat_ && block_.isEmpty(); }
    const std::uint64_t* slot(int n) const { return flat_ ? flat_->slot(n) : block_.slot(n); }

private:
    Block block_;
    const FlatBlock* flat_ = nullptr;
};

// A mask by its blocks, without the nodes of a tree: a tree's (which must live on), or what a pass made.
class SlotSet {
public:
    explicit SlotSet(const MaskTree& tree) : full_(fullParts(tree))
    {
        for (const Coord& origin : shellBlocks(tree)) {
            if (const Block block = blockAt(tree, origin); block.isNode()) blocks_.emplace(origin, block);
        }
        addFullParts();
    }
    // The full parts, with the blocks in their places.
    SlotSet(FullParts full, std::vector<FlatBlock> built) : built_(std::move(built)), full_(std::move(full))
    {
        std::set<Coord> broken; // full regions that no longer are
        for (const FlatBlock& block : built_) {
            blocks_.emplace(block.origin, block);
            if (!block.isFull()) broken.insert(alignedTo(block.origin, regionSize));
        }
        const auto isBroken = [&](const Coord& region) {
            if (broken.count(region) == 0) return false;
            forEachBlock(region, [&](const Coord& block) { full_.blocks.push_back(block); });
            return true;
        };
        full_.regions.erase(std::remove_if(full_.regions.begin(), full_.regions.end(), isBroken), full_.regions.end());
        const auto isBuilt = [&](const Coord& block) { return blocks_.count(block) > 0; };
        full_.blocks.erase(std::remove_if(full_.blocks.begin(), full_.blocks.end(), isBuilt), full_.blocks.end());
        for (const FlatBlock& block : built_) {
            if (block.isFull()) full_.blocks.push_back(block.origin);
        }
        addFullParts();
    }

    SlotSet(SlotSet&&) = default; // a copy would look at the other's blocks
    SlotSet& operator=(SlotSet&&) = default;

    Slots at(const Coord& origin) const
    {
        const auto found = blocks_.find(origin);
        return found != blocks_.end() ? found->second : Block(regions_.count(alignedTo(origin, regionSize)) > 0);
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
        std::vector<BuiltBlock> built(built_.size());
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, built_.size(), [&](std::size_t i) {
            progress.check(done++, built_.size());
            BlockBuilder builder(built_[i].origin);
            for (int n = 0; n < slotsPerBlock; ++n) builder.set(n, built_[i].slot(n));
            built[i] = builder.finish();
        });
        return assemble(full_, std::move(built));
    }

private:
    void addFullParts()
    {
        regions_.insert(full_.regions.begin(), full_.regions.end());
        for (const Coord& origin : full_.blocks) blocks_.insert_or_assign(origin, Block(true));
    }

    std::vector<FlatBlock> built_;
    FullParts full_;
    std::map<Coord, Slots> blocks_;
    std::set<Coord> regions_; // the full ones
};

// One pass along x. Everything is said for a dilation; for an erosion it holds for the complement.
class AxisPass {
public:
    AxisPass(const SlotSet& mask, Side side, int radius, const Progress& progress)
        : mask_(mask), flip_(side == Side::complement ? ~0ULL : 0), radius_(radius), wholeSlots_(radius / leafSize),
          rest_(radius % leafSize), slotReach_(wholeSlots_ + (rest_ > 0 ? 1 : 0)),
          blockReach_((radius + blockSize - 1) / blockSize), progress_(progress)
    {
        if (flip_ != 0) std::swap(none_, all_);
    }

    SlotSet run()
    {
        const std::vector<Coord> targets = targetBlocks();
        std::vector<FlatBlock> built(targets.size());
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, targets.size(), [&](std::size_t i) {
            progress_.check(done++, targets.size());
            built[i] = build(targets[i]);
        });
        FullParts full = mask_.full();
        for (auto* origins : {&full.regions, &full.blocks}) {
            for (Coord& origin : *origins) origin = turned(origin);
        }
        return {std::move(full), std::move(built)};
    }

private:
    bool isFull(const Slots& block) const { return flip_ != 0 ? block.isEmpty() : block.isFull(); }
    bool isEmpty(const Slots& block) const { return flip_ != 0 ? block.isFull() : block.isEmpty(); }

    // The blocks that are not full but have something in reach.
    std::vector<Coord> targetBlocks() const
    {
        std::vector<Coord> targets;
        for (const Coord& origin : mask_.shell()) {
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                targets.push_back(origin.offsetBy(step * blockSize, 0, 0));
            }
        }
        std::sort(targets.begin(), targets.end());
        targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
        const auto isSettled = [&](const Coord& origin) {
            if (isFull(mask_.at(origin))) return true;
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                if (!isEmpty(mask_.at(origin.offsetBy(step * blockSize, 0, 0)))) return false;
            }
            return true;
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isSettled), targets.end());
        return targets;
    }

    // The slots of one line along x, from slotReach_ before the block to as many behind it.
    struct Line {
        std::vector<const std::uint64_t*> slots;
        std::vector<std::uint64_t> any; // of each slot the voxels of all its words in one
    };

    FlatBlock build(const Coord& origin) const
    {
        std::vector<Slots> blocks;
        for (int step = -blockReach_; step <= blockReach_; ++step) {
            blocks.push_back(mask_.at(origin.offsetBy(step * blockSize, 0, 0)));
        }
        FlatBlock result;
        result.origin = turned(origin);
        if (flip_ != 0) result.slots.assign(slotsPerBlock, 1);
        const auto size = static_cast<std::size_t>(slotsPerAxis + 2 * slotReach_);
        Line line{std::vector<const std::uint64_t*>(size), std::vector<std::uint64_t>(size)};
        for (int y = 0; y < slotsPerAxis; ++y) {
            for (int z = 0; z < slotsPerAxis; ++z) {
                if (!readLine(blocks, y, z, line)) continue;
                for (int x = 0; x < slotsPerAxis; ++x) {
                    Words near = smear(line, static_cast<std::size_t>(x + slotReach_));
                    if (near == emptyWords) continue;
                    for (std::uint64_t& word : near) word ^= flip_;
                    result.set(slotIndex(y, z, x), near == fullWords || near == emptyWords ? near : turned(near));
                }
            }
        }
        return result;
    }

    // Returns whether there is anything.
    bool readLine(const std::vector<Slots>& blocks, int y, int z, Line& line) const
    {
        std::uint64_t all = 0;
        for (std::size_t i = 0; i < line.slots.size(); ++i) {
            const int x = static_cast<int>(i) - slotReach_ + blockReach_ * slotsPerAxis;
            const std::uint64_t* const words =
                blocks[static_cast<std::size_t>(x / slotsPerAxis)].slot(slotIndex(x % slotsPerAxis, y, z));
            line.slots[i] = words;
            std::uint64_t any = words == all_ ? ~0ULL : 0;
            if (words != none_ && words != all_) {
                for (int k = 0; k < leafSize; ++k) any |= words[k] ^ flip_;
            }
            line.any[i] = any;
            all |= any;
        }
        return all != 0;
    }

    // The result at slot `own` of the line.
    Words smear(const Line& line, std::size_t own) const
    {
        // Slots that are wholly within reach of all voxels of this one.
        std::uint64_t inner = line.slots[own] == all_ ? ~0ULL : 0;
        const auto whole = static_cast<std::size_t>(wholeSlots_);
        for (std::size_t i = own + 1 - whole; i + 1 <= own + whole && inner != ~0ULL; ++i) inner |= line.any[i];
        Words near;
        near.fill(inner);
        if (inner == ~0ULL) return near;
        if (whole == 0) {
            smearWithin(line.slots[own], near);
        } else {
            addSums(line.slots[own - whole], true, 0, near);
            addSums(line.slots[own + whole], false, 0, near);
        }
        if (rest_ > 0) {
            addSums(line.slots[own - whole - 1], true, leafSize, near);
            addSums(line.slots[own + whole + 1], false, leafSize, near);
        }
        return near;
    }

    // Within one slot, of a radius below its size.
    void smearWithin(const std::uint64_t* words, Words& near) const
    {
        if (words == none_) return;
        for (int from = 0; from < leafSize; ++from) {
            const std::uint64_t word = words[from] ^ flip_;
            const int last = std::min(from + radius_, leafSize - 1);
            for (int to = std::max(from - radius_, 0); to <= last; ++to) near[static_cast<std::size_t>(to)] |= word;
        }
    }

    // From a slot at the end of the reach, before or behind this one. Counted from its end next to this slot, and here
    // from the end next to it, the words 0 to 7 - (to - rest + beyond) of it reach word `to`.
    void addSums(const std::uint64_t* words, bool before, int beyond, Words& near) const
    {
        if (words == none_) return;
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
    const std::uint64_t* none_ = emptyWords.data(); // the uniform slots, as seen from this side
    const std::uint64_t* all_ = fullWords.data();
    int radius_;
    int wholeSlots_, rest_; // the radius is as many slots and voxels
    int slotReach_, blockReach_;
    Progress progress_;
};

MaskTree::Ptr threePasses(const MaskTree& mask, Side side, int radius, const Progress& progress)
{
    SlotSet set(mask);
    for (int i = 0; i < 3; ++i) set = AxisPass(set, side, radius, progress.part(i, 4)).run();
    return set.tree(progress.part(3, 4));
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
