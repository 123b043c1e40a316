#include <vdbcage/voxelize/detail/fill.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;

/// Returns the bits of `open` that a run of ones in `open` joins to one of `seeds`, a subset of it.
Word spread(Word seeds, Word open)
{
    Word up = seeds, down = seeds, upOpen = open, downOpen = open;
    for (int step = 1; step < BitGrid::wordBits; step *= 2) {
        up |= upOpen & up << step;
        upOpen &= upOpen << step;
        down |= downOpen & down >> step;
        downOpen &= downOpen >> step;
    }
    return up | down;
}

/// Visits the zero bits of `row` between its first and its last set bit, word by word: visit(word index, bits).
template <typename Visit>
void forEachGap(const Word* row, int words, const Visit& visit)
{
    int first = 0, last = words - 1;
    while (first < words && row[first] == 0) ++first;
    if (first == words) return;
    while (row[last] == 0) --last;
    for (int i = first; i <= last; ++i) {
        Word gap = ~row[i];
        if (i == first) gap &= ~(row[i] ^ (row[i] - 1)); // above the lowest set bit
        if (i == last) gap &= ~Word(0) >> __builtin_clzll(row[i]);
        if (gap != 0) visit(i, gap);
    }
}

class Filler {
public:
    Filler(BitGrid& bits, Interrupter* interrupter)
        : bits_(bits), unknown_(bits.box()), hidden_(static_cast<std::size_t>(bits.size().x())),
          interrupter_(interrupter)
    {
    }

    void fill()
    {
        const int rowWords = bits_.wordsPerRow();
        tbb::enumerable_thread_specific<std::vector<Word>> buffers;
        parallelFor(0, bits_.size().x(), [&](int x) {
            throwIfInterrupted(interrupter_);
            hide(x, buffers.local());
        });
        drain(rowWords);
        parallelFor(0, bits_.size().x(), [&](int x) {
            for (const std::uint32_t i : hidden_[static_cast<std::size_t>(x)]) bits_.words()[i] |= unknown_.words()[i];
        });
    }

private:
    /// Collects, as unknown, the zero voxels of plane x that have a set voxel on all four sides along y and z; a
    /// straight line joins the others to the outside.
    void hide(int x, std::vector<Word>& above)
    {
        const int rows = bits_.size().y(), words = bits_.wordsPerRow();
        const auto wordCount = static_cast<std::size_t>(words);
        // above: for each row, the set bits of the rows after it.
        above.assign(wordCount * static_cast<std::size_t>(rows), 0);
        for (int y = rows - 1; y > 0; --y) {
            const Word* row = bits_.row(x, y);
            Word* after = above.data() + wordCount * static_cast<std::size_t>(y);
            for (int i = 0; i < words; ++i) after[i - words] = after[i] | row[i];
        }
        std::vector<Word> below(wordCount);
        for (int y = 0; y < rows; ++y) {
            const Word *row = bits_.row(x, y), *after = above.data() + wordCount * static_cast<std::size_t>(y);
            forEachGap(row, words, [&](int i, Word gap) {
                gap &= below[static_cast<std::size_t>(i)] & after[i];
                if (gap == 0) return;
                const std::size_t index = bits_.rowOffset(x, y) + static_cast<std::size_t>(i);
                unknown_.words()[index] = gap;
                hidden_[static_cast<std::size_t>(x)].push_back(static_cast<std::uint32_t>(index));
            });
            for (int i = 0; i < words; ++i) below[static_cast<std::size_t>(i)] |= row[i];
        }
    }

    /// Removes from the unknown voxels those that are joined to a zero voxel that is known to be outside.
    void drain(int rowWords)
    {
        const auto rowStep = static_cast<std::size_t>(rowWords);
        const std::size_t planeStep = rowStep * static_cast<std::size_t>(bits_.size().y());
        const std::size_t end = bits_.wordCount();
        const Word* bits = bits_.words();
        Word* unknown = unknown_.words();
        const auto outside = [&](std::size_t i) { return ~(bits[i] | unknown[i]); };

        std::vector<std::uint32_t> wave, next;
        for (const auto& list : hidden_) wave.insert(wave.end(), list.begin(), list.end());
        std::size_t visits = 0;
        while (!wave.empty()) {
            for (const std::size_t i : wave) {
                if (++visits % 65536 == 0) throwIfInterrupted(interrupter_);
                const Word open = unknown[i];
                if (open == 0) continue;
                // Unknown voxels are never in the first or last row or plane that has a set voxel. So along y they have
                // neighbours in the grid; along x they need not.
                const std::size_t inRow = i % rowStep;
                const Word here = outside(i);
                Word seeds = here << 1 | here >> 1 | outside(i - rowStep) | outside(i + rowStep);
                if (inRow > 0) seeds |= outside(i - 1) >> 63;
                if (inRow + 1 < rowStep) seeds |= outside(i + 1) << 63;
                seeds |= i >= planeStep ? outside(i - planeStep) : ~Word(0);
                seeds |= i + planeStep < end ? outside(i + planeStep) : ~Word(0);
                seeds &= open;
                if (seeds == 0) continue;
                unknown[i] = open & ~spread(seeds, open);
                const auto visitNext = [&](std::size_t j) {
                    if (unknown[j] != 0) next.push_back(static_cast<std::uint32_t>(j));
                };
                if (inRow > 0) visitNext(i - 1);
                if (inRow + 1 < rowStep) visitNext(i + 1);
                visitNext(i - rowStep);
                visitNext(i + rowStep);
                if (i >= planeStep) visitNext(i - planeStep);
                if (i + planeStep < end) visitNext(i + planeStep);
            }
            wave.swap(next);
            next.clear();
        }
    }

    BitGrid& bits_;
    BitGrid unknown_;
    std::vector<std::vector<std::uint32_t>> hidden_; ///< by plane, the words with unknown voxels
    Interrupter* interrupter_;
};

} // namespace

void fillEnclosed(BitGrid& bits, Interrupter* interrupter)
{
    Filler(bits, interrupter).fill();
}

} // namespace vdbcage::detail
