#include <vdbcage/volume/detail/cube/line_dilation.h>

#include <algorithm>

namespace vdbcage::detail {

namespace {

// Adds 8 consecutive words, from word `from` on, of 8 words `before`, 8 of an entry and 8 words `behind`.
VDBCAGE_INLINE void add(const WordPair& before, const WordPairs& sums, const WordPair& behind, int from,
                        WordPairs& result)
{
    const WordPair all[]{before,  before,  before, before, sums[0], sums[1],
                         sums[2], sums[3], behind, behind, behind,  behind};
    WordPairs added;
    std::memcpy(added.data(), reinterpret_cast<const std::uint64_t*>(all) + from, sizeof added);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] |= added[i];
}

// Adds an entry at the end of the segment, before this one: its words from to - rest + beyond on go to word `to`.
VDBCAGE_INLINE void addBefore(const LineEntries& line, std::size_t x, int beyond, WordPairs& result)
{
    if (line.isEmpty(x)) return;
    WordPairs sums = line.words(x); // each word with all behind it
    WordPair sum{};
    for (std::size_t i = sums.size(); i-- > 0;) {
        sums[i] |= __builtin_shufflevector(sums[i], WordPair{}, 1, 2) | sum;
        sum = __builtin_shufflevector(sums[i], sums[i], 0, 0);
    }
    add(sum, sums, WordPair{}, leafSize - line.segment().rest + beyond, result);
}

// Adds an entry at the end of the segment, behind this one: its words up to to + rest - beyond go to word `to`.
VDBCAGE_INLINE void addBehind(const LineEntries& line, std::size_t x, int beyond, WordPairs& result)
{
    if (line.isEmpty(x)) return;
    WordPairs sums = line.words(x); // each word with all before it
    WordPair sum{};
    for (WordPair& pair : sums) {
        pair |= __builtin_shufflevector(WordPair{}, pair, 0, 2) | sum;
        sum = __builtin_shufflevector(pair, pair, 1, 1);
    }
    add(WordPair{}, sums, sum, leafSize + line.segment().rest - beyond, result);
}

// Returns an entry dilated within itself, by a radius below its size.
WordPairs dilatedWithin(const LineEntries& line, std::size_t x)
{
    WordPairs result{};
    if (line.isEmpty(x)) return result;
    const int radius = line.segment().radius;
    Words sums{};
    for (int from = 0; from < leafSize; ++from) {
        const std::uint64_t word = line.word(x, from);
        const int last = std::min(from + radius, leafSize - 1);
        for (int to = std::max(from - radius, 0); to <= last; ++to) sums[static_cast<std::size_t>(to)] |= word;
    }
    std::memcpy(result.data(), sums.data(), sizeof sums);
    return result;
}

VDBCAGE_INLINE WordPairs dilatedEntry(const LineEntries& line, std::size_t x)
{
    const Segment& segment = line.segment();
    const std::size_t whole = segment.wholeEntries;
    WordPairs result;
    if (whole == 0) {
        result = dilatedWithin(line, x);
    } else {
        const std::uint64_t inAll = line.unionAround(x); // within the segment of every voxel of the entry
        result.fill(WordPair{inAll, inAll});
        addBefore(line, x - whole, 0, result);
        addBehind(line, x + whole, 0, result);
    }
    if (segment.rest > 0) {
        addBefore(line, x - whole - 1, leafSize, result);
        addBehind(line, x + whole + 1, leafSize, result);
    }
    return result;
}

VDBCAGE_INLINE void dilateLine(const Line& line, LineEntries& entries, const std::unique_ptr<FlatBlock>* result)
{
    entries.read(line);
    const RowView& view = entries.view();
    // Permuted, the entries of a block on this line are a quarter of a word.
    const std::size_t n = (entriesPerAxis * line.y() + line.z) / 4, shift = 16 * (line.z % 4);
    for (std::size_t i = 0; i < view.ownBlocks; ++i) {
        std::uint64_t full = line.of(entries.lines().full[i]), some = full;
        for (unsigned open = line.of(entries.lines().open[i]); open != 0; open &= open - 1) {
            const auto x = static_cast<std::size_t>(__builtin_ctz(open));
            WordPairs words = dilatedEntry(entries, view.ownBlock(i) * entriesPerAxis + x);
            const WordPair any = words[0] | words[1] | words[2] | words[3];
            const WordPair all = words[0] & words[1] & words[2] & words[3];
            if ((any[0] | any[1]) == 0) continue;
            some |= 1ULL << x;
            if ((all[0] & all[1]) == ~0ULL) {
                full |= 1ULL << x;
            } else {
                for (WordPair& pair : words) pair ^= view.foreground.flip;
                result[i]->words.push_back(permuted(words));
            }
        }
        result[i]->some[n] |= some << shift;
        result[i]->full[n] |= full << shift;
    }
}

} // namespace

void dilateLines(std::size_t stretch, std::size_t i, LineEntries& entries, const std::unique_ptr<FlatBlock>* result)
{
    for (std::size_t z = 0; z < entriesPerAxis; ++z) dilateLine({stretch, i, z}, entries, result);
}

} // namespace vdbcage::detail
