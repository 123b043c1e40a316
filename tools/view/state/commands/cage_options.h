#pragma once

#include <algorithm>

#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>
#include <tools/view/state/preset.h>

/// Commands for the options of the cage. Each closes an opened or edited cage, so that the made one is shown.
/// Combinations are checked only when a cage is made: in between they may be invalid.
namespace vdbcage::view {

struct SetOption {
    std::string name, value; ///< as `vdbcage make --NAME VALUE`

    static LineInfo info() { return {"set", "OPTION VALUE", 2, 2, "sets an option of `vdbcage make`"}; }
    static SetOption read(const Arguments& arguments) { return {arguments[0], arguments[1]}; }
    std::string text() const { return written(name, value); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        setOption(document.options, name, value);
        document.setCage(nullptr);
    }
};

struct ResetOptions {
    Words names; ///< none: all options

    static LineInfo info()
    {
        return {"reset", "[OPTION...]", 0, anyNumber, "sets options, or all of them, to their defaults"};
    }
    static ResetOptions read(const Arguments& arguments) { return {arguments.words()}; }
    std::string text() const
    {
        std::string text;
        for (const std::string& name : names) text += written(name);
        return text;
    }
    void apply(Document& document, const Situation& /*now*/) const
    {
        const auto defaults = optionValues(CageOptions{});
        if (names.empty()) document.options = {};
        for (const std::string& name : names) {
            const auto known =
                std::find_if(defaults.begin(), defaults.end(), [&](const auto& o) { return o.first == name; });
            // setOption lists the allowed names.
            setOption(document.options, name, known == defaults.end() ? std::string() : known->second);
        }
        document.setCage(nullptr);
    }
};

/// A command that sets the options of a preset, and resets all others.
struct ApplyPreset {
    std::string name; ///< of a built-in preset, or a file's path

    static LineInfo info()
    {
        return {"preset", "NAME|FILE", 1, 1, "sets all options to those of a preset or of a file"};
    }
    static ApplyPreset read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(name); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        document.options = presetOptions(name);
        document.setCage(nullptr);
    }
};

} // namespace vdbcage::view
