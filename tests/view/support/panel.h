#pragma once

#include <array>
#include <map>
#include <string>

#include <imgui.h>

#include <tools/view/widgets/imgui_versions.h>
#include <tools/view/widgets/widgets.h>

namespace vdbcage::test {

/// A panel with one widget of each kind, and what a user did to them.
struct Panel {
    static constexpr int width = 360, height = 420; // pixels
    // NOLINTNEXTLINE(readability-identifier-naming)
    static constexpr std::array<const char*, 3> choices{"fast", "fair", "thorough"};

    /// In pixels.
    struct Place {
        float left, top, right, bottom;
    };

    int presses = 0, doubleClicks = 0, builds = 0, deletes = 0;
    bool checked = false;
    float amount = 0; ///< in [0, 100]
    std::array<char, 64> name{};
    int choice = 0;
    std::map<std::string, Place> places; ///< of what was last built

    void build()
    {
        ++builds;
        ImGui::SetNextWindowPos({20, 20});
        ImGui::SetNextWindowSize({300, 0}); // as high as what it has
        ImGui::Begin("Cage", nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
        view::heading("Shape");
        if (ImGui::Button("Make")) ++presses;
        note("button");
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) ++doubleClicks;
        ImGui::Checkbox("Quads", &checked);
        note("checkbox");
        ImGui::SliderFloat("Faces", &amount, 0, 100, "%.0f");
        note("slider");
        ImGui::InputText("Name", name.data(), name.size());
        note("field");
        if (ImGui::BeginCombo("Effort", choices.at(static_cast<std::size_t>(choice)))) {
            for (int i = 0; i < 3; ++i) {
                const char* text = choices.at(static_cast<std::size_t>(i));
                if (ImGui::Selectable(text, choice == i)) choice = i;
                note(text);
            }
            ImGui::EndCombo();
        }
        note("combo");
        // As a shortcut of a panel asks.
        if (view::imgui::isPressed(view::Key::del)) ++deletes;
        ImGui::End();
    }

private:
    void note(const std::string& what)
    {
        const ImVec2 from = ImGui::GetItemRectMin();
        const ImVec2 to = ImGui::GetItemRectMax();
        places[what] = {from.x, from.y, to.x, to.y};
    }
};

/// A panel in a window, and the hand of its user.
struct Desk {
    Desk() { look(); }

    bool look()
    {
        return widgets.layOut(nullptr, Panel::width, Panel::height, [this] { panel.build(); });
    }

    template <typename What>
    bool does(const What& what, const view::Modifiers& modifiers = {})
    {
        const view::InputEvent event{what, modifiers};
        return widgets.layOut(&event, Panel::width, Panel::height, [this] { panel.build(); });
    }

    /// `share` of the way from the left end of a widget to its right one.
    bool moveTo(const std::string& where, float share = 0.3F)
    {
        const Panel::Place& place = panel.places.at(where);
        return does(
            view::PointerMoved{place.left + share * (place.right - place.left), (place.top + place.bottom) / 2});
    }

    void click(const std::string& where, int clicks = 1)
    {
        moveTo(where);
        does(view::ButtonDown{view::Button::left, clicks});
        does(view::ButtonUp{});
    }

    void press(view::Key key, const view::Modifiers& modifiers = {})
    {
        does(view::KeyDown{key}, modifiers);
        does(view::KeyUp{key}, modifiers);
    }

    void type(const std::u32string& text)
    {
        for (const char32_t character : text) does(view::Typed{character});
    }

    std::string name() const { return panel.name.data(); }

    Panel panel;
    view::Widgets widgets{1};
};

/// Uses every widget of the panel.
inline void useAll(Desk& desk)
{
    desk.click("button");
    desk.click("checkbox");
    desk.moveTo("slider", 0.1F);
    desk.does(view::ButtonDown{});
    for (float share = 0.1F; share < 0.4F; share += 0.02F) desk.moveTo("slider", share);
    desk.does(view::ButtonUp{});
    desk.click("field");
    desk.type(U"ogre \u00e4");
    desk.click("combo");
    desk.moveTo("fair");
}

} // namespace vdbcage::test
