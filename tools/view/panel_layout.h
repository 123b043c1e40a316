#pragma once

#include <tools/view/action_runner.h>

namespace vdbcage::view {

/// Lays the panels out, and has done what the user asks for in them.
class PanelLayout {
public:
    PanelLayout(AppParts& parts, ActionRunner& actions) : parts_(parts), actions_(actions) {}

    /// Brings the panels in line with the state, if they are not.
    void update();
    /// Hands them an event. Returns whether they took it.
    bool handle(const InputEvent& event);

private:
    bool layOut(const InputEvent* event, PanelAnswer& answer);
    void take(const PanelAnswer& answer);
    PanelContent content() const;

    AppParts& parts_;
    ActionRunner& actions_;
};

} // namespace vdbcage::view
