// Based on: Nooruddin and Turk, Simplification and Repair of Polygonal Models Using Volumetric Techniques, 2003.
// Differs: a ray that crosses the model an odd number of times in all has no vote, since its parity from one end
// differs from that from the other.
#include <vdbcage/voxelize/detail/parity_vote.h>

#include <algorithm>
#include <vector>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>

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

/// Finds `crossed`.
void markCrossed(const Slab& slab)
{
    const int rows = slab.rowsPerPlane * (slab.planes.last - slab.planes.first + 1);
    for (int axis = 0; axis < 3; ++axis) {
        const Word* words = slab.crossings[axis];
        for (int row = 0; row < rows; ++row, words += slab.wordsPerRow) {
            const bool any = anyBit(words, slab.wordsPerRow);
            slab.crossed[row] = static_cast<std::uint8_t>(slab.crossed[row] | (any ? 1 << axis : 0));
        }
    }
}

} // namespace

std::vector<Word> paritiesAlongX(const SlabbedTriangles& triangles, int wordsPerRow, std::size_t planeWords,
                                 Interrupter* interrupter)
{
    constexpr std::size_t asksEvery = 16384; // triangles
    constexpr int percent = 5;
    const int slabs = triangles.slabCount();
    std::vector<Word> parities(static_cast<std::size_t>(slabs + 1) * planeWords);
    const auto entering = [&](int slab) { return parities.data() + static_cast<std::size_t>(slab) * planeWords; };
    parallelFor(0, slabs, [&](int slab) {
        for (std::size_t i = 0; i < triangles.size(slab); ++i) {
            if (i % asksEvery == 0) throwIfInterrupted(interrupter, percent);
            if (!triangles.counted(slab, i)) continue;
            scanCrossingsAlongX(triangles.triangle(slab, i), triangles.planes(slab), entering(slab + 1), wordsPerRow);
        }
    });
    parallelFor(tbb::blocked_range<std::size_t>(0, planeWords, 4096), [&](const auto& range) {
        for (int slab = 1; slab <= slabs; ++slab) {
            const Word* before = entering(slab - 1);
            Word* here = entering(slab);
            for (std::size_t i = range.begin(); i != range.end(); ++i) here[i] ^= before[i];
        }
    });
    return parities;
}

void voteInside(const Slab& slab, int x, Word* alongX, const Word* leakingX, Word* rows)
{
    const int words = slab.wordsPerRow;
    const std::size_t firstRow =
        static_cast<std::size_t>(x - slab.planes.first) * static_cast<std::size_t>(slab.rowsPerPlane);
    const auto offsetOf = [&](int y) {
        return (firstRow + static_cast<std::size_t>(y)) * static_cast<std::size_t>(words);
    };
    Word *const alongY = rows, *const leakingY = rows + words;
    std::fill_n(rows, 2 * words, Word(0));
    for (int y = 0; y < slab.rowsPerPlane; ++y) {
        if (!(slab.crossed[firstRow + static_cast<std::size_t>(y)] & 2)) continue;
        const Word* const crossY = slab.crossings[1] + offsetOf(y);
        for (int i = 0; i < words; ++i) leakingY[i] ^= crossY[i];
    }
    bool anyY = false;
    for (int y = 0; y < slab.rowsPerPlane; ++y, alongX += words, leakingX += words) {
        const std::size_t row = firstRow + static_cast<std::size_t>(y), offset = offsetOf(y);
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
        const Word votesZ = (alongZ[words - 1] >> 63) - Word(1); // none if the ray leaks
        for (int i = 0; i < words; ++i) {
            const Word byX = alongX[i] & ~leakingX[i], byY = alongY[i] & ~leakingY[i], byZ = alongZ[i] & votesZ;
            solid[i] |= (byX & byY) | (byZ & (byX | byY));
        }
        if (crossed & 4) std::fill_n(alongZ, words, Word(0));
    }
}

void voteInside(const Slab& slab, Word* alongX, const Word* leakingX, Interrupter* interrupter)
{
    constexpr int thickness = 8; // of the slabs that are processed in parallel
    const int count = (slab.planes.last - slab.planes.first) / thickness + 1;
    const std::size_t planeWords =
        static_cast<std::size_t>(slab.rowsPerPlane) * static_cast<std::size_t>(slab.wordsPerRow);
    const auto part = [&](int i) {
        const std::size_t offset = static_cast<std::size_t>(i * thickness) * planeWords;
        Slab thin = slab;
        thin.planes.first += i * thickness;
        thin.planes.last = std::min(thin.planes.first + thickness - 1, slab.planes.last);
        thin.surface += offset;
        for (Word*& crossings : thin.crossings) crossings += offset;
        return thin;
    };
    // The parities along x with which each part is entered: first the changes by the part before.
    std::vector<Word> entering(static_cast<std::size_t>(count + 1) * planeWords);
    const auto enteringAt = [&](int i) { return entering.data() + static_cast<std::size_t>(i) * planeWords; };
    std::copy_n(alongX, planeWords, enteringAt(0));
    parallelFor(0, count, [&](int i) {
        throwIfInterrupted(interrupter);
        const Slab thin = part(i);
        const Word* crossings = thin.crossings[0];
        Word* const parities = enteringAt(i + 1);
        for (int x = thin.planes.first; x <= thin.planes.last; ++x, crossings += planeWords) {
            for (std::size_t k = 0; k < planeWords; ++k) parities[k] ^= crossings[k];
        }
    });
    parallelFor(tbb::blocked_range<std::size_t>(0, planeWords, 4096), [&](const auto& range) {
        for (int i = 1; i <= count; ++i) {
            for (std::size_t k = range.begin(); k != range.end(); ++k) enteringAt(i)[k] ^= enteringAt(i - 1)[k];
        }
    });
    std::copy_n(enteringAt(count), planeWords, alongX);

    parallelFor(0, count, [&](int i) {
        throwIfInterrupted(interrupter);
        Slab thin = part(i);
        std::vector<std::uint8_t> crossed(static_cast<std::size_t>(thickness * slab.rowsPerPlane));
        std::vector<Word> rows(2 * static_cast<std::size_t>(slab.wordsPerRow));
        thin.crossed = crossed.data();
        markCrossed(thin);
        for (int x = thin.planes.first; x <= thin.planes.last; ++x) {
            voteInside(thin, x, enteringAt(i), leakingX, rows.data());
        }
    });
}

} // namespace vdbcage::detail
