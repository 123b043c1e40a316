#pragma once

#include <optional>
#include <utility>

namespace vdbcage::detail {

/// Keeps the value that was made last, with the key that it was made for. Equal keys must mean equal values. A key may
/// be asked for by anything that compares with a Key and converts to one, such as a tuple of references.
template <typename Key, typename Value>
class Memo {
public:
    /// Returns the value for `key`: the one that is kept, or else make(), which takes its place.
    template <typename Other, typename Make>
    Value& of(const Other& key, const Make& make)
    {
        if (!find(key)) {
            kept_.reset(); // before more memory is taken
            kept_.emplace(Key(key), make());
        }
        return kept_->second;
    }
    /// Returns the value that is kept if it is that of `key`, else null.
    template <typename Other>
    Value* find(const Other& key)
    {
        return kept_ && kept_->first == key ? &kept_->second : nullptr;
    }
    void forget() { kept_.reset(); }

private:
    std::optional<std::pair<Key, Value>> kept_;
};

} // namespace vdbcage::detail
