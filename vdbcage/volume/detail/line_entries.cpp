#include <vdbcage/volume/detail/line_entries.h>

#include <algorithm>

#include <vdbcage/volume/detail/simd.h>

namespace vdbcage::detail {

namespace {

// Lines are read side by side, each plane's words one after the other: too many streams for a processor to foresee.
constexpr int prefetched = 4; // words of a plane, on their way to the cache

VDBCAGE_INLINE void prefetch(const Words* words, int first, int count)
{
    for (int i = first; i < first + count; ++i) __builtin_prefetch(words + i);
}

const Words& mixedWords(const FlatBlock& block, std::size_t x, const Line& line)
{
    const std::size_t n = stretchesPerPlane * x + line.stretch;
    const auto mixed = static_cast<std::uint16_t>((block.some[n] & ~block.full[n]) >> (16 * line.lane));
    const auto before = static_cast<std::uint16_t>(mixed & ((1U << line.z) - 1));
    return block.words[block.firstWords[4 * n + line.lane] + bitCount(before)];
}

} // namespace

LineEntries::LineEntries(const RowView& view, const StretchLines& lines, std::size_t stretch)
    : view_(view), lines_(lines), segment_(view.segment), flip_(view.foreground.flip),
      words_(entriesPerAxis * lines.mixedAround.size()), any_(words_.size()), united_(words_.size())
{
    for (std::size_t b = 0; b < lines.mixedAround.size(); ++b) {
        const FlatBlock* const block = view.blocks[b];
        for (std::size_t n = stretch; block && n < FlatBlock::wordCount; n += stretchesPerPlane) {
            prefetch(block->words.data() + block->firstWords[4 * n], 0, prefetched);
        }
    }
}

void LineEntries::read(const Line& line)
{
    const std::size_t radius = segment_.entryRadius;
    std::size_t first = 0, end = 0; // of entries read in one go
    for (std::size_t i = 0; i < view_.ownBlocks; ++i) {
        const unsigned open = line.of(lines_.open[i]);
        if (open == 0) continue;
        const std::size_t block = view_.ownBlock(i) * entriesPerAxis;
        const std::size_t from = block + static_cast<std::size_t>(__builtin_ctz(open)) - radius;
        const std::size_t to = block + static_cast<std::size_t>(32 - __builtin_clz(open)) + radius;
        if (from > end) {
            unite(first, end);
            first = end = from;
        }
        readFromTo(line, end, to);
        end = to;
    }
    unite(first, end);
}

void LineEntries::readFromTo(const Line& line, std::size_t from, std::size_t to)
{
    for (std::size_t x = from; x < to; ++x) any_[x] = 0;
    for (std::size_t block = from - from % entriesPerAxis; block < to; block += entriesPerAxis) {
        const std::size_t b = block / entriesPerAxis;
        const auto inside =
            (from > block ? ~0U << (from - block) : ~0U) & (to - block < entriesPerAxis ? ~(~0U << (to - block)) : ~0U);
        // Full entries only count at the end of a segment of more than whole entries: see stretchLines().
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

void LineEntries::unite(std::size_t first, std::size_t end)
{
    std::copy(any_.begin() + static_cast<std::ptrdiff_t>(first), any_.begin() + static_cast<std::ptrdiff_t>(end),
              united_.begin() + static_cast<std::ptrdiff_t>(first));
    const std::size_t count = 2 * std::max(segment_.wholeEntries, std::size_t{1}) - 1;
    unitedCount_ = uniteAhead(united_.data() + first, end - first, count);
}

} // namespace vdbcage::detail
