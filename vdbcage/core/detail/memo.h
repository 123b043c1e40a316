#pragma once

#include <optional>
#include <utility>

namespace vdbcage::detail {

/// The last value that was made, with its key. Equal keys must mean equal values. Any type that compares with a Key and
/// converts to one, such as a tuple of references, can stand for a key.
template <typename Key, typename Value>
class Memo {
public:
    /// Returns the value for `key`: the kept one, or else make(), which replaces it.
    template <typename Other, typename Make>
    Value& of(const Other& key, const Make& make)
    {
        if (!find(key)) {
            kept_.reset(); // before make() takes more memory
            kept_.emplace(Key(key), make());
        }
        return kept_->second;
    }
    /// Returns the kept value if its key is `key`, else null.
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
