#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <vdbcage/core/detail/simd.h>
#include <vdbcage/volume/detail/cube/axis_permutation.h>
#include <vdbcage/volume/detail/cube/row_view.h>

namespace vdbcage::detail {

/// The voxels of the entries of one line at a time. Entries are counted along x from the view's first block.
///
/// Functions called for each line or entry are inlined by force: calls cost several percent of a dilation.
class LineEntries {
public:
    /// Reads lines of the stretch that `lines` has at that time. The arguments must outlive this.
    LineEntries(const RowView& view, const StretchLines& lines)
        : view_(view), lines_(lines), segment_(view.segment), flip_(view.foreground.flip),
          words_(entriesPerAxis * view.blocks.size()), any_(words_.size()), united_(words_.size())
    {
    }

    /// Prefetches the first words of the stretch.
    void prefetchStretch(std::size_t stretch) const;

    /// Reads the entries within the segment of the line's open entries. Others must not be used.
    void read(const Line& line);

    bool isEmpty(std::size_t x) const { return any_[x] == 0; }
    /// Returns word i of an entry.
    /// \pre it is not empty
    std::uint64_t word(std::size_t x, int i) const { return words_[x][i] ^ flip_; }
    /// Returns all words of an entry.
    /// \pre it is not empty
    WordPairs words(std::size_t x) const
    {
        WordPairs words;
        std::memcpy(words.data(), words_[x], sizeof words);
        for (WordPair& pair : words) pair ^= flip_;
        return words;
    }
    /// Returns the union of all words of the entries less than the segment's whole entries away from an open one.
    /// \pre the segment has a whole entry
    std::uint64_t unionAround(std::size_t x) const
    {
        const std::size_t radius = segment_.wholeEntries;
        return united_[x + 1 - radius] | united_[x + radius - unitedCount_];
    }

    const RowView& view() const { return view_; }
    const StretchLines& lines() const { return lines_; }
    const Segment& segment() const { return segment_; }

private:
    // Lines are read side by side, each plane's words one after the other: too many streams for a processor to predict.
    static constexpr int prefetched = 4; // words of a plane that are prefetched

    static void prefetch(const Words* words, int first, int count);
    static const Words& mixedWords(const FlatBlock& block, std::size_t x, const Line& line);
    void readFromTo(const Line& line, std::size_t from, std::size_t to);
    void unite(std::size_t first, std::size_t end);

    const RowView& view_;
    const StretchLines& lines_;
    Segment segment_;
    std::uint64_t flip_;
    // By x:
    std::vector<const std::uint64_t*> words_; // of the mask
    std::vector<std::uint64_t> any_;          // the union of the entry's words
    std::vector<std::uint64_t> united_;       // the union of `any_` of `unitedCount_` entries from this one on
    std::size_t unitedCount_ = 1;
};

// Inlined, since GCC takes a function that only prefetches for one without effect, and drops its calls.
VDBCAGE_INLINE void LineEntries::prefetch(const Words* words, int first, int count)
{
    for (int i = first; i < first + count; ++i) __builtin_prefetch(words + i);
}

VDBCAGE_INLINE void LineEntries::prefetchStretch(std::size_t stretch) const
{
    for (const FlatBlock* const block : view_.blocks) {
        for (std::size_t n = stretch; block && n < FlatBlock::wordCount; n += stretchesPerPlane) {
            prefetch(block->words.data() + block->firstWords[4 * n], 0, prefetched);
        }
    }
}

VDBCAGE_INLINE const Words& LineEntries::mixedWords(const FlatBlock& block, std::size_t x, const Line& line)
{
    const std::size_t n = stretchesPerPlane * x + line.stretch;
    const auto mixed = static_cast<std::uint16_t>((block.some[n] & ~block.full[n]) >> (16 * line.i));
    const auto before = static_cast<std::uint16_t>(mixed & ((1U << line.z) - 1));
    return block.words[block.firstWords[4 * n + line.i] + bitCount(before)];
}

VDBCAGE_INLINE void LineEntries::read(const Line& line)
{
    std::size_t first = 0, end = 0; // of entries read in one go
    for (std::size_t i = 0; i < view_.ownBlocks; ++i) {
        const unsigned open = line.of(lines_.open[i]);
        if (open == 0) continue;
        const std::size_t block = view_.ownBlock(i) * entriesPerAxis;
        const std::size_t from = block + static_cast<std::size_t>(__builtin_ctz(open)) - segment_.entryRadius;
        const std::size_t to = block + static_cast<std::size_t>(32 - __builtin_clz(open)) + segment_.entryRadius;
        if (from > end) {
            unite(first, end);
            first = end = from;
        }
        readFromTo(line, end, to);
        end = to;
    }
    unite(first, end);
}

VDBCAGE_INLINE void LineEntries::readFromTo(const Line& line, std::size_t from, std::size_t to)
{
    for (std::size_t x = from; x < to; ++x) any_[x] = 0;
    for (std::size_t block = from - from % entriesPerAxis; block < to; block += entriesPerAxis) {
        const std::size_t b = block / entriesPerAxis;
        const auto inside =
            (from > block ? ~0U << (from - block) : ~0U) & (to - block < entriesPerAxis ? ~(~0U << (to - block)) : ~0U);
        // Full entries only count at the end of a segment of more than whole entries: see StretchLines::find().
        const bool needsFull = segment_.rest > 0;
        for (unsigned full = needsFull ? line.of(lines_.fullAround[b]) & inside : 0; full != 0; full &= full - 1) {
            const std::size_t x = block + static_cast<std::size_t>(__builtin_ctz(full));
            any_[x] = ~0ULL;
            words_[x] = (flip_ != 0 ? emptyWords : fullWords).data();
        }
        for (unsigned mixed = line.of(lines_.mixedAround[b]) & inside; mixed != 0; mixed &= mixed - 1) {
            const auto x = static_cast<std::size_t>(__builtin_ctz(mixed));
            const Words& words = mixedWords(*view_.blocks[b], x, line);
            prefetch(&words, prefetched, 1);
            std::uint64_t any = 0;
            for (const std::uint64_t word : words) any |= word ^ flip_;
            any_[block + x] = any;
            words_[block + x] = words.data();
        }
    }
}

VDBCAGE_INLINE void LineEntries::unite(std::size_t first, std::size_t end)
{
    std::uint64_t* const united = united_.data();
    for (std::size_t x = first; x < end; ++x) united[x] = any_[x];
    const std::size_t count = 2 * std::max(segment_.wholeEntries, std::size_t{1}) - 1;
    unitedCount_ = uniteAhead(united + first, end - first, count);
}

} // namespace vdbcage::detail
