#pragma once

#include <tools/view/state/commands/line.h>
#include <tools/view/state/state.h>

/// Commands that set one field of the view; each derives a struct that has info().
namespace vdbcage::view {

/// NAME on|off
template <bool ViewState::*field>
struct ViewSwitch {
    bool isOn = true;

    ViewSwitch() = default;
    explicit ViewSwitch(bool on) : isOn(on) {}

    static bool read(const Arguments& arguments) { return arguments.isOn(0); }
    static bool of(const ViewState& view) { return view.*field; }
    std::string text() const { return written(isOn); }
    void apply(ViewState& view) const { view.*field = isOn; }
};

/// NAME CHOICE
template <class Enum, Enum ViewState::*field, const auto& names>
struct ViewChoice {
    Enum choice{};

    ViewChoice() = default;
    explicit ViewChoice(Enum value) : choice(value) {}

    static Enum read(const Arguments& arguments) { return arguments.choice<Enum>(0, names); }
    static Enum of(const ViewState& view) { return view.*field; }
    std::string text() const { return written(nameIn(names, choice)); }
    void apply(ViewState& view) const { view.*field = choice; }
};

} // namespace vdbcage::view
