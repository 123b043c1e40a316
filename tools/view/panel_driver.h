#pragma once

#include <tools/view/action_runner.h>

namespace vdbcage::view {

/// The driver of the panels: it lays them out, and performs the actions that the user asks for in them.
class PanelDriver {
public:
    PanelDriver(AppParts& parts, ActionRunner& actions) : parts_(parts), actions_(actions) {}

    /// Updates the panels to the state if they are not current.
    void update();
    /// Passes an event to the panels. Returns whether they took it.
    bool handle(const InputEvent& event);
    /// Returns what the panels show of the state.
    PanelContent content() const;

private:
    bool layOut(const InputEvent* event, PanelAnswer& answer);
    void take(const PanelAnswer& answer);

    AppParts& parts_;
    ActionRunner& actions_;
};

} // namespace vdbcage::view
