// A cube is the sum of three segments, so a dilation by it is three passes along one axis each. All three are the same
// code: a pass works along x, where the 64 voxels of a word are 64 lanes, and turns the axes as it writes, (x, y, z)
// becoming (y, z, x); three turns are none. An erosion is the dilation of the complement.
#include <vdbcage/volume/detail/cube_pass.h>

#include <algorithm>
#include <atomic>
#include <cstring>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/word_bits.h>
#include <vdbcage/volume/detail/entry_set.h>

namespace vdbcage::detail {

namespace {

enum class Side { mask, complement };

Coord turned(const Coord& c)
{
    return {c.y(), c.z(), c.x()};
}

// Two words side by side: vectors of that size every machine has.
typedef std::uint64_t WordPair __attribute__((vector_size(16)));
typedef std::uint8_t BytePair __attribute__((vector_size(16))); // bytes of both

// The bytes of `a` and `b` in turn: first those of the first words, then those of the second.
void zip(WordPair& a, WordPair& b)
{
    const auto x = reinterpret_cast<BytePair>(a), y = reinterpret_cast<BytePair>(b);
    a = reinterpret_cast<WordPair>(
        __builtin_shufflevector(x, y, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
    b = reinterpret_cast<WordPair>(
        __builtin_shufflevector(x, y, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31));
}

using WordPairs = std::array<WordPair, 4>; // of an entry

// Bit (x, y, z), in word x at 8 y + z, moves to word y at 8 z + x.
Words turned(WordPairs w)
{
    // The three bits of x and of z in a voxel's place are exchanged one by one, in words two by two, which takes half
    // of what it takes within a word; zips turn the bytes, the first of them early as it parts the words of odd and
    // even x.
    swapBits(w[0], w[2], 0x0F0F0F0F0F0F0F0FULL, 4);
    swapBits(w[1], w[3], 0x0F0F0F0F0F0F0F0FULL, 4);
    swapBits(w[0], w[1], 0x3333333333333333ULL, 2);
    swapBits(w[2], w[3], 0x3333333333333333ULL, 2);
    zip(w[0], w[2]);
    zip(w[1], w[3]);
    swapBits(w[0], w[2], 0x5555555555555555ULL, 1);
    swapBits(w[1], w[3], 0x5555555555555555ULL, 1);
    zip(w[0], w[1]);
    zip(w[2], w[3]);
    zip(w[0], w[2]);
    zip(w[1], w[3]);
    std::swap(w[1], w[2]);
    Words result;
    std::memcpy(result.data(), w.data(), sizeof result);
    return result;
}

// For one stretch, 16 planes or, transposed, 16 z with the bits of a lane along x.
using Stretch = std::array<std::uint64_t, entriesPerAxis>;

// Replaces every value by the union of as many as it returns from there on (fewer at the end): the largest power of two
// that is at most `count`, so that two of them, overlapping, are the union of `count`.
std::size_t uniteAhead(std::uint64_t* values, std::size_t size, std::size_t count)
{
    std::size_t united = 1;
    for (; 2 * united <= count; united *= 2) {
        for (std::size_t i = 0; i + united < size; ++i) values[i] |= values[i + united];
    }
    return united;
}

// One pass along x. Everything is said for a dilation; for an erosion it holds for the complement.
class AxisPass {
public:
    AxisPass(const EntrySet& mask, Side side, int radius, const Progress& progress)
        : mask_(mask), flip_(side == Side::complement ? ~0ULL : 0), radius_(radius),
          wholeEntries_(static_cast<std::size_t>(radius / leafSize)), rest_(radius % leafSize),
          entryRadius_(wholeEntries_ + (rest_ > 0 ? 1 : 0)), blockRadius_((radius + blockSize - 1) / blockSize),
          progress_(progress)
    {
    }

    EntrySet run()
    {
        progress_.check(0, 1);
        const std::vector<Row> rows = targetRows();
        std::vector<std::unique_ptr<FlatBlock>> built(rows.empty() ? 0 : rows.back().start + rows.back().blocks);
        std::atomic<std::size_t> done{0};
        parallelFor(std::size_t{0}, rows.size(), [&](std::size_t i) {
            build(rows[i], &built[rows[i].start], [&] { progress_.check(done++, rows.size() * entriesPerAxis); });
        });
        FullParts full = mask_.full();
        for (auto* origins : {&full.upperNodes, &full.blocks}) {
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
    static constexpr std::size_t longestRow = 4; // longer ones share more, but leave the last thread alone with one

    bool isFull(const BlockEntries& block) const { return flip_ != 0 ? block.isEmpty() : block.isFull(); }
    bool isEmpty(const BlockEntries& block) const { return flip_ != 0 ? block.isFull() : block.isEmpty(); }

    // Whether a block so many blocks before or behind another has anything in reach of it.
    bool isWithin(const BlockEntries& block, int distance, bool before) const
    {
        if (!block.flat) return !isEmpty(block);
        const std::size_t away = static_cast<std::size_t>(distance - 1) * entriesPerAxis;
        const std::size_t planes = std::min(entryRadius_ - away, std::size_t{entriesPerAxis});
        const std::size_t count = stretchesPerPlane * planes, first = before ? FlatBlock::wordCount - count : 0;
        std::uint64_t any = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            any |= flip_ != 0 ? ~block.flat->full[i] : block.flat->some[i];
        }
        return any != 0;
    }

    // The blocks that are not full but have something in reach.
    std::vector<Row> targetRows() const
    {
        std::vector<Coord> shell = mask_.shell();
        const auto isBefore = [](const Coord& a, const Coord& b) { return turned(a) < turned(b); }; // x last
        std::sort(shell.begin(), shell.end(), isBefore);
        progress_.check(0, 1);
        std::vector<Coord> targets;
        for (const Coord& origin : shell) {
            for (int step = -blockRadius_; step <= blockRadius_; ++step) {
                const Coord near = origin.offsetBy(step * blockSize, 0, 0);
                if (targets.empty() || isBefore(targets.back(), near)) targets.push_back(near);
            }
        }
        const auto isDecided = [&](const Coord& origin) {
            const BlockEntries own = mask_.at(origin);
            if (isFull(own)) return true;
            if (!isEmpty(own)) return false;
            for (int step = 1; step <= blockRadius_; ++step) {
                if (isWithin(mask_.at(origin.offsetBy(-step * blockSize, 0, 0)), step, true)) return false;
                if (isWithin(mask_.at(origin.offsetBy(step * blockSize, 0, 0)), step, false)) return false;
            }
            return true;
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isDecided), targets.end());
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

    // What a row can see: its blocks and those in reach on both sides, entry by entry along x.
    struct View {
        explicit View(std::size_t blockCount)
            : blocks(blockCount), mixedLines(blockCount), fullLines(blockCount), line(entriesPerAxis * blockCount),
              any(line.size()), united(line.size())
        {
            for (auto* stretches : {&some, &full}) {
                for (auto& stretch : *stretches) stretch.resize(line.size());
            }
        }
        std::vector<const FlatBlock*> blocks; // null: uniform
        std::array<std::vector<std::uint64_t>, stretchesPerPlane> some, full;
        // Of one stretch, by block:
        std::vector<Stretch> mixedLines, fullLines;
        // Of one line of entries along x:
        std::vector<const std::uint64_t*> line; // their words
        std::vector<std::uint64_t> any;         // the voxels of all words of each in one
        std::vector<std::uint64_t> united;      // of `any`, of `unitedCount` entries from each on
        std::size_t unitedCount = 1;
    };
    // Of one stretch of a row, by block: lines of entries that are full for certain, and that are to be looked at.
    struct Verdict {
        std::vector<Stretch> full, open;
        bool isDecided = true; // nothing open
    };

    template <class Check>
    void build(const Row& row, std::unique_ptr<FlatBlock>* result, const Check& check) const
    {
        View view = look(row);
        for (std::size_t i = 0; i < row.blocks; ++i) {
            result[i] = std::make_unique<FlatBlock>();
            result[i]->origin = turned(row.first.offsetBy(static_cast<int>(i) * blockSize, 0, 0));
            if (const FlatBlock* const before = view.blocks[i + static_cast<std::size_t>(blockRadius_)]) {
                result[i]->words.reserve(before->words.size());
            }
        }
        for (std::size_t stretch = 0; stretch < stretchesPerPlane; ++stretch) {
            const Verdict verdict = decide(view, row.blocks, stretch);
            if (!verdict.isDecided) turnLines(view, stretch);
            for (std::size_t lane = 0; lane < 4; ++lane) {
                check();
                for (std::size_t z = 0; z < entriesPerAxis; ++z) buildLine(verdict, {stretch, lane, z}, view, result);
            }
        }
        for (std::size_t i = 0; i < row.blocks; ++i) {
            for (std::size_t n = 0; n < FlatBlock::wordCount && flip_ != 0; ++n) {
                const std::uint64_t some = result[i]->some[n];
                result[i]->some[n] = ~result[i]->full[n];
                result[i]->full[n] = ~some;
            }
            result[i]->words = std::vector<Words>(result[i]->words); // no longer than it must be: it is read from cache
            result[i]->finish();
        }
    }

    View look(const Row& row) const
    {
        const std::size_t blocks = row.blocks + 2 * static_cast<std::size_t>(blockRadius_);
        View view(blocks);
        for (std::size_t b = 0; b < blocks; ++b) {
            const BlockEntries entries =
                mask_.at(row.first.offsetBy((static_cast<int>(b) - blockRadius_) * blockSize, 0, 0));
            view.blocks[b] = entries.flat;
            for (std::size_t i = 0; i < FlatBlock::wordCount; ++i) {
                const std::uint64_t some = entries.flat ? entries.flat->some[i] : entries.full ? ~0ULL : 0;
                const std::uint64_t full = entries.flat ? entries.flat->full[i] : some;
                const std::size_t stretch = i % stretchesPerPlane, x = entriesPerAxis * b + i / stretchesPerPlane;
                view.some[stretch][x] = flip_ != 0 ? ~full : some;
                view.full[stretch][x] = flip_ != 0 ? ~some : full;
            }
        }
        return view;
    }

    // The entries of the row's blocks at this place in `values`, each united with `reach` on both sides.
    std::vector<Stretch> unitedAround(std::vector<std::uint64_t> values, std::size_t reach, std::size_t blocks) const
    {
        const std::size_t count = uniteAhead(values.data(), values.size(), 2 * reach + 1);
        std::vector<Stretch> result(blocks);
        std::size_t own = static_cast<std::size_t>(blockRadius_) * entriesPerAxis;
        for (Stretch& block : result) {
            for (std::uint64_t& entries : block) {
                entries = values[own - reach] | values[own + reach + 1 - count];
                ++own;
            }
        }
        return result;
    }

    // What whole entries tell: one that is full fills all that are as many entries away as the radius has whole ones.
    Verdict decide(const View& view, std::size_t blocks, std::size_t stretch) const
    {
        Verdict verdict;
        verdict.full = unitedAround(view.full[stretch], wholeEntries_, blocks);
        verdict.open = unitedAround(view.some[stretch], entryRadius_, blocks);
        for (std::size_t i = 0; i < blocks; ++i) {
            for (std::size_t x = 0; x < entriesPerAxis; ++x) {
                verdict.open[i][x] &= ~verdict.full[i][x];
                if (verdict.open[i][x] != 0) verdict.isDecided = false;
            }
            transposeLanes(verdict.full[i]);
            transposeLanes(verdict.open[i]);
        }
        return verdict;
    }

    void turnLines(View& view, std::size_t stretch) const
    {
        for (std::size_t b = 0; b < view.blocks.size(); ++b) {
            for (std::size_t x = 0; x < entriesPerAxis; ++x) {
                const std::size_t i = entriesPerAxis * b + x;
                view.fullLines[b][x] = view.full[stretch][i];
                view.mixedLines[b][x] = view.some[stretch][i] & ~view.full[stretch][i];
            }
            transposeLanes(view.fullLines[b]);
            transposeLanes(view.mixedLines[b]);
            for (std::size_t n = stretch; view.blocks[b] && n < FlatBlock::wordCount; n += stretchesPerPlane) {
                prefetch(view.blocks[b]->words.data() + view.blocks[b]->firstWords[4 * n], 0, prefetched);
            }
        }
    }

    // A line of entries along x.
    struct Line {
        std::size_t stretch, lane, z;

        std::size_t y() const { return 4 * stretch + lane; }
        // Of lines of its stretch: the bits of this one, by x.
        std::uint16_t of(const Stretch& lines) const { return static_cast<std::uint16_t>(lines[z] >> (16 * lane)); }
    };

    void buildLine(const Verdict& verdict, const Line& line, View& view, const std::unique_ptr<FlatBlock>* result) const
    {
        readAround(verdict, line, view);
        // Turned, the entries of a block on this line are a quarter of a word.
        const std::size_t n = (entriesPerAxis * line.y() + line.z) / 4, shift = 16 * (line.z % 4);
        for (std::size_t i = 0; i < verdict.full.size(); ++i) {
            std::uint64_t full = line.of(verdict.full[i]), some = full;
            for (unsigned open = line.of(verdict.open[i]); open != 0; open &= open - 1) {
                const auto x = static_cast<std::size_t>(__builtin_ctz(open));
                const WordPairs near = smear(view, (i + static_cast<std::size_t>(blockRadius_)) * entriesPerAxis + x);
                const WordPair any = near[0] | near[1] | near[2] | near[3], all = near[0] & near[1] & near[2] & near[3];
                if ((any[0] | any[1]) == 0) continue;
                some |= 1ULL << x;
                if ((all[0] & all[1]) == ~0ULL) {
                    full |= 1ULL << x;
                } else {
                    result[i]->words.push_back(turned(flipped(near)));
                }
            }
            result[i]->some[n] |= some << shift;
            result[i]->full[n] |= full << shift;
        }
    }

    // Lines are read side by side, each plane's words one after the other: too many streams for a processor to foresee.
    static constexpr int prefetched = 4; // words of a plane, on their way to the cache
    static void prefetch(const Words* words, int first, int count)
    {
        for (int i = first; i < first + count; ++i) __builtin_prefetch(words + i);
    }

    WordPairs flipped(WordPairs words) const
    {
        for (WordPair& pair : words) pair ^= flip_;
        return words;
    }

    // All that is in reach of the open entries.
    void readAround(const Verdict& verdict, const Line& line, View& view) const
    {
        std::size_t first = 0, end = 0; // of entries read in one go
        for (std::size_t i = 0; i < verdict.open.size(); ++i) {
            const unsigned open = line.of(verdict.open[i]);
            if (open == 0) continue;
            const std::size_t block = (i + static_cast<std::size_t>(blockRadius_)) * entriesPerAxis;
            const std::size_t from = block + static_cast<std::size_t>(__builtin_ctz(open)) - entryRadius_;
            const std::size_t to = block + static_cast<std::size_t>(32 - __builtin_clz(open)) + entryRadius_;
            if (from > end) {
                unite(first, end, view);
                first = end = from;
            }
            read(line, end, to, view);
            end = to;
        }
        unite(first, end, view);
    }

    // From one entry of the line to another, which is not included.
    void read(const Line& line, std::size_t from, std::size_t to, View& view) const
    {
        for (std::size_t i = from; i < to; ++i) view.any[i] = 0;
        for (std::size_t block = from - from % entriesPerAxis; block < to; block += entriesPerAxis) {
            const std::size_t b = block / entriesPerAxis;
            const auto inside = (from > block ? ~0U << (from - block) : ~0U) &
                                (to - block < entriesPerAxis ? ~(~0U << (to - block)) : ~0U);
            // Full entries tell nothing but at the end of a reach of more than whole entries: see decide().
            for (unsigned full = rest_ > 0 ? line.of(view.fullLines[b]) & inside : 0; full != 0; full &= full - 1) {
                const std::size_t i = block + static_cast<std::size_t>(__builtin_ctz(full));
                view.any[i] = ~0ULL;
                view.line[i] = (flip_ != 0 ? emptyWords : fullWords).data();
            }
            for (unsigned mixed = line.of(view.mixedLines[b]) & inside; mixed != 0; mixed &= mixed - 1) {
                const auto x = static_cast<std::size_t>(__builtin_ctz(mixed));
                const Words& words = mixedWords(*view.blocks[b], x, line);
                prefetch(&words, prefetched, 1);
                std::uint64_t any = 0;
                for (const std::uint64_t word : words) any |= word ^ flip_;
                view.any[block + x] = any;
                view.line[block + x] = words.data();
            }
        }
    }

    void unite(std::size_t first, std::size_t end, View& view) const
    {
        std::uint64_t* const united = view.united.data();
        for (std::size_t i = first; i < end; ++i) united[i] = view.any[i];
        view.unitedCount = uniteAhead(united + first, end - first, 2 * std::max(wholeEntries_, std::size_t{1}) - 1);
    }

    const Words& mixedWords(const FlatBlock& block, std::size_t x, const Line& line) const
    {
        const std::size_t n = stretchesPerPlane * x + line.stretch;
        const auto mixed = static_cast<std::uint16_t>((block.some[n] & ~block.full[n]) >> (16 * line.lane));
        const auto before = static_cast<std::uint16_t>(mixed & ((1U << line.z) - 1));
        return block.words[block.firstWords[4 * n + line.lane] + bitCount(before)];
    }

    // The result at entry `own` of the line.
    WordPairs smear(const View& view, std::size_t own) const
    {
        WordPairs near{};
        if (wholeEntries_ == 0) {
            smearWithin(view, own, near);
        } else {
            // All entries that lie wholly in reach of all of this one.
            const std::uint64_t all =
                view.united[own + 1 - wholeEntries_] | view.united[own + wholeEntries_ - view.unitedCount];
            near.fill(WordPair{all, all});
            addBefore(view, own - wholeEntries_, 0, near);
            addBehind(view, own + wholeEntries_, 0, near);
        }
        if (rest_ > 0) {
            addBefore(view, own - wholeEntries_ - 1, leafSize, near);
            addBehind(view, own + wholeEntries_ + 1, leafSize, near);
        }
        return near;
    }

    // Within one entry, of a radius below its size.
    void smearWithin(const View& view, std::size_t own, WordPairs& near) const
    {
        if (view.any[own] == 0) return;
        Words sums{};
        for (int from = 0; from < leafSize; ++from) {
            const std::uint64_t word = view.line[own][from] ^ flip_;
            const int last = std::min(from + radius_, leafSize - 1);
            for (int to = std::max(from - radius_, 0); to <= last; ++to) sums[static_cast<std::size_t>(to)] |= word;
        }
        std::memcpy(near.data(), sums.data(), sizeof sums);
    }

    WordPairs pairsOf(const std::uint64_t* words) const
    {
        WordPairs pairs;
        std::memcpy(pairs.data(), words, sizeof pairs);
        return flipped(pairs);
    }

    // From an entry at the end of the reach, before this one: its words from to - rest + beyond on reach word `to`.
    void addBefore(const View& view, std::size_t entry, int beyond, WordPairs& near) const
    {
        if (view.any[entry] == 0) return;
        WordPairs sums = pairsOf(view.line[entry]); // each word with all behind it
        WordPair sum{};
        for (std::size_t i = sums.size(); i-- > 0;) {
            sums[i] |= __builtin_shufflevector(sums[i], WordPair{}, 1, 2) | sum;
            sum = __builtin_shufflevector(sums[i], sums[i], 0, 0);
        }
        add(sum, sums, WordPair{}, leafSize - rest_ + beyond, near);
    }

    // The same behind it: the words up to to + rest - beyond reach word `to`.
    void addBehind(const View& view, std::size_t entry, int beyond, WordPairs& near) const
    {
        if (view.any[entry] == 0) return;
        WordPairs sums = pairsOf(view.line[entry]); // each word with all before it
        WordPair sum{};
        for (WordPair& pair : sums) {
            pair |= __builtin_shufflevector(WordPair{}, pair, 0, 2) | sum;
            sum = __builtin_shufflevector(pair, pair, 1, 1);
        }
        add(WordPair{}, sums, sum, leafSize + rest_ - beyond, near);
    }

    // Adds 8 words from one on, of 8 that are `before`, 8 of an entry and 8 that are `behind`.
    static void add(const WordPair& before, const WordPairs& sums, const WordPair& behind, int from, WordPairs& near)
    {
        const WordPair all[]{before,  before,  before, before, sums[0], sums[1],
                             sums[2], sums[3], behind, behind, behind,  behind};
        WordPairs added;
        std::memcpy(added.data(), reinterpret_cast<const std::uint64_t*>(all) + from, sizeof added);
        for (std::size_t i = 0; i < near.size(); ++i) near[i] |= added[i];
    }

    const EntrySet& mask_;
    std::uint64_t flip_;
    int radius_;
    std::size_t wholeEntries_;
    int rest_; // the radius is as many entries and voxels
    std::size_t entryRadius_;
    int blockRadius_;
    Progress progress_;
};

} // namespace

MaskTree::Ptr applyCube(const MaskTree& mask, std::initializer_list<CubeStep> steps, const Progress& progress)
{
    const int parts = 3 * static_cast<int>(steps.size()) + 2;
    int part = 0;
    EntrySet set(mask, progress.part(part++, parts));
    for (const CubeStep& step : steps) {
        const Side side = step.kind == CubeStep::dilation ? Side::mask : Side::complement;
        for (int axis = 0; axis < 3; ++axis) {
            set = AxisPass(set, side, step.radius, progress.part(part++, parts)).run();
        }
    }
    return std::move(set).tree(progress.part(part, parts));
}

} // namespace vdbcage::detail
