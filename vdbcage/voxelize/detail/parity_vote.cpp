// Based on: Nooruddin and Turk, Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
#include <vdbcage/voxelize/detail/parity_vote.h>

#include <algorithm>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;

bool anyBit(const Word* words, int count)
{
    Word any = 0;
    for (int i = 0; i < count; ++i) any |= words[i];
    return any != 0;
}

/// Turns crossings into parities: bit z becomes the exclusive or of bits 0 to z.
void accumulate(Word* row, int words)
{
    for (int i = 0; i < words; ++i) {
        for (int step = 1; step < BitGrid::wordBits; step *= 2) row[i] ^= row[i] << step;
    }
    Word carry = 0;
    for (int i = 0; i < words; ++i) {
        row[i] ^= carry;
        carry = Word(0) - (row[i] >> 63);
    }
}

} // namespace

void voteInside(const Slab& slab, int x, Word* alongX, Word* alongY)
{
    const int words = slab.wordsPerRow;
    std::fill_n(alongY, words, Word(0));
    bool anyY = false;
    for (int y = 0; y < slab.rowsPerPlane; ++y, alongX += words) {
        const std::size_t row =
            static_cast<std::size_t>(x - slab.planes.first) * static_cast<std::size_t>(slab.rowsPerPlane) +
            static_cast<std::size_t>(y);
        const std::size_t offset = row * static_cast<std::size_t>(words);
        Word *const crossX = slab.crossings[0] + offset, *const crossY = slab.crossings[1] + offset,
                    *const alongZ = slab.crossings[2] + offset;
        const int crossed = slab.crossed[row];
        slab.crossed[row] = 0;
        if (crossed & 1) {
            for (int i = 0; i < words; ++i) alongX[i] ^= crossX[i];
            std::fill_n(crossX, words, Word(0));
        }
        if (crossed & 2) {
            for (int i = 0; i < words; ++i) alongY[i] ^= crossY[i];
            std::fill_n(crossY, words, Word(0));
            anyY = anyBit(alongY, words);
        }
        if (crossed & 4) {
            accumulate(alongZ, words);
        } else if (!anyY) {
            continue; // at most one vote
        }
        Word* const solid = slab.surface + offset;
        for (int i = 0; i < words; ++i) {
            solid[i] |= (alongX[i] & alongY[i]) | (alongZ[i] & (alongX[i] | alongY[i]));
        }
        if (crossed & 4) std::fill_n(alongZ, words, Word(0));
    }
}

} // namespace vdbcage::detail
