#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vdbcage::detail {

/// Swaps the bits of `low` that are `shift` places above `mask` with those of `high` at `mask`. Takes words, or vectors
/// of them.
template <class Word>
inline void swapBits(Word& low, Word& high, std::uint64_t mask, int shift)
{
    const Word difference = ((low >> shift) ^ high) & mask;
    high ^= difference;
    low ^= difference << shift;
}

/// Transposes bytes: byte y of word x goes to byte x of word y.
inline void transposeBytes(std::array<std::uint64_t, 8>& w)
{
    for (std::size_t i = 0; i < 4; ++i) swapBits(w[i], w[i + 4], 0x00000000FFFFFFFFULL, 32);
    for (const std::size_t i : {0U, 1U, 4U, 5U}) swapBits(w[i], w[i + 2], 0x0000FFFF0000FFFFULL, 16);
    for (const std::size_t i : {0U, 2U, 4U, 6U}) swapBits(w[i], w[i + 1], 0x00FF00FF00FF00FFULL, 8);
}

/// Transposes each of four lanes of 16 bits: in every lane, bit z of word x goes to bit x of word z.
inline void transposeLanes(std::array<std::uint64_t, 16>& w)
{
    const auto swapApart = [&](std::size_t distance, std::uint64_t mask) {
        for (std::size_t i = 0; i < w.size(); ++i) {
            if ((i & distance) == 0) swapBits(w[i], w[i + distance], mask, static_cast<int>(distance));
        }
    };
    swapApart(8, 0x00FF00FF00FF00FFULL);
    swapApart(4, 0x0F0F0F0F0F0F0F0FULL);
    swapApart(2, 0x3333333333333333ULL);
    swapApart(1, 0x5555555555555555ULL);
}

/// Returns the number of set bits. The builtin would call a function where the processor may lack the instruction.
inline unsigned bitCount(std::uint16_t bits)
{
    unsigned v = bits;
    v -= (v >> 1) & 0x5555U;
    v = (v & 0x3333U) + ((v >> 2) & 0x3333U);
    v = (v + (v >> 4)) & 0x0F0FU;
    return (v + (v >> 8)) & 0x1FU;
}

} // namespace vdbcage::detail
