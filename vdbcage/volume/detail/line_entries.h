#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <vdbcage/volume/detail/axis_permutation.h>
#include <vdbcage/volume/detail/row_view.h>

namespace vdbcage::detail {

/// The voxels of the entries on one line after the other of a stretch. Entries are counted along x from the view's
/// first block.
class LineEntries {
public:
    /// The arguments must outlive it.
    LineEntries(const RowView& view, const StretchLines& lines, std::size_t stretch);

    /// Reads what the line's open entries have within the segment. Entries elsewhere must not be asked for.
    void read(const Line& line);

    bool isEmpty(std::size_t x) const { return any_[x] == 0; }
    /// Word i of an entry.
    /// \pre it is not empty
    std::uint64_t word(std::size_t x, int i) const { return words_[x][i] ^ flip_; }
    /// All words of an entry.
    /// \pre it is not empty
    WordPairs words(std::size_t x) const
    {
        WordPairs words;
        std::memcpy(words.data(), words_[x], sizeof words);
        for (WordPair& pair : words) pair ^= flip_;
        return words;
    }
    /// The union of all words of the entries less than the segment's whole entries away from an open one.
    /// \pre the segment has a whole entry
    std::uint64_t unionAround(std::size_t x) const
    {
        const std::size_t radius = segment_.wholeEntries;
        return united_[x + 1 - radius] | united_[x + radius - unitedCount_];
    }

    const RowView& view() const { return view_; }
    const StretchLines& lines() const { return lines_; }
    const Segment& segment() const { return segment_; }
    std::uint64_t flip() const { return flip_; }

private:
    void readFromTo(const Line& line, std::size_t from, std::size_t to);
    void unite(std::size_t first, std::size_t end);

    const RowView& view_;
    const StretchLines& lines_;
    Segment segment_;
    std::uint64_t flip_;
    // By x:
    std::vector<const std::uint64_t*> words_; // of the mask
    std::vector<std::uint64_t> any_;          // the union of the words
    std::vector<std::uint64_t> united_;       // the union of `any_` of `unitedCount_` entries from here on
    std::size_t unitedCount_ = 1;
};

} // namespace vdbcage::detail
