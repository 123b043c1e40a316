#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vdbcage::detail {

/// The deviations of a file from its format: one text for each kind, with a count.
class Warnings {
public:
    /// Counts another case of the kind `what`. Returns false if that kind was not added.
    bool count(std::string_view what)
    {
        for (Warning& warning : list_) {
            if (warning.what != what) continue;
            ++warning.times;
            return true;
        }
        return false;
    }
    /// Adds a kind, first met on `line`. `what` is a literal: no text of a file gets into warnings.
    void add(const char* what, std::size_t line) { list_.push_back({what, line, 1}); }

    /// Returns texts such as "line 7: WHAT (3 times)".
    std::vector<std::string> texts() const
    {
        std::vector<std::string> all;
        for (const Warning& warning : list_) {
            all.push_back("line " + std::to_string(warning.line) + ": " + warning.what);
            if (warning.times > 1) all.back() += " (" + std::to_string(warning.times) + " times)";
        }
        return all;
    }

private:
    struct Warning {
        const char* what;
        std::size_t line, times;
    };
    std::vector<Warning> list_;
};

} // namespace vdbcage::detail
