#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include <vdbcage/core/detail/word_bits.h>
#include <vdbcage/volume/detail/mask_blocks.h>

/// The cyclic permutation of the axes that makes (y, z, x) of (x, y, z). Three of them are the identity.
namespace vdbcage::detail {

inline Coord permuted(const Coord& c)
{
    return {c.y(), c.z(), c.x()};
}

/// Two words side by side: a vector size that every machine has.
typedef std::uint64_t WordPair __attribute__((vector_size(16)));
/// The words of an entry.
using WordPairs = std::array<WordPair, 4>;

/// Interleaves the bytes of `a` and `b`: first those of the first words, then those of the second.
inline void interleaveBytes(WordPair& a, WordPair& b)
{
    typedef std::uint8_t Bytes __attribute__((vector_size(16)));
    const auto x = reinterpret_cast<Bytes>(a), y = reinterpret_cast<Bytes>(b);
    a = reinterpret_cast<WordPair>(
        __builtin_shufflevector(x, y, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
    b = reinterpret_cast<WordPair>(
        __builtin_shufflevector(x, y, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31));
}

/// Returns the bits of an entry, permuted: bit 8 y + z of word x moves to bit 8 z + x of word y.
inline Words permuted(WordPairs w)
{
    // The three bits of x and of z in a voxel's place are exchanged one by one, in pairs of words, which takes half the
    // time of an exchange within a word. Interleaving permutes the bytes; the first of it comes early, since it
    // separates the words of odd and even x.
    swapBits(w[0], w[2], 0x0F0F0F0F0F0F0F0FULL, 4);
    swapBits(w[1], w[3], 0x0F0F0F0F0F0F0F0FULL, 4);
    swapBits(w[0], w[1], 0x3333333333333333ULL, 2);
    swapBits(w[2], w[3], 0x3333333333333333ULL, 2);
    interleaveBytes(w[0], w[2]);
    interleaveBytes(w[1], w[3]);
    swapBits(w[0], w[2], 0x5555555555555555ULL, 1);
    swapBits(w[1], w[3], 0x5555555555555555ULL, 1);
    interleaveBytes(w[0], w[1]);
    interleaveBytes(w[2], w[3]);
    interleaveBytes(w[0], w[2]);
    interleaveBytes(w[1], w[3]);
    std::swap(w[1], w[2]);
    Words result;
    std::memcpy(result.data(), w.data(), sizeof result);
    return result;
}

} // namespace vdbcage::detail
