#pragma once

#include <cmath>
#include <string>

#include <imgui.h>

#include <imgui_stdlib.h> // needs the one above

#include <tools/view/panels/panels.h>
#include <tools/view/widgets/theme.h>
#include <tools/view/widgets/widgets.h>
#include <vdbcage/core/error.h>

/// Helpers that all parts of the panels share.
namespace vdbcage::view {

inline ImVec4 toImGui(const draw::Colour& colour, float opacity = 1)
{
    return {colour[0], colour[1], colour[2], opacity};
}

inline ImU32 packed(const draw::Colour& colour, float opacity = 1)
{
    return ImGui::ColorConvertFloat4ToU32(toImGui(colour, opacity));
}

/// Returns the pixels of this screen for `pixels` of an ordinary one, rounded down.
inline float length(float pixels)
{
    return std::floor(pixels * scale());
}

inline void muted(const std::string& text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, toImGui(theme::mutedText));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

inline void coloured(const draw::Colour& colour, const std::string& text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, toImGui(colour));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

/// Flags of a slider that shows no number: Tab and control do not turn it into a field for typing its share.
constexpr ImGuiSliderFlags pointerOnly = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;

/// Shows help for the last item.
inline void help(const std::string& text)
{
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(length(320));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// The data of one layout: the content, the answer and the places of widgets.
class PanelContext {
public:
    PanelContext(const PanelContent& shown, PanelAnswer& answer, std::map<std::string, Rectangle>& places,
                 std::string& revealed)
        : content(shown), answer_(answer), places_(places), revealed_(revealed)
    {
    }

    const PanelContent& content;

    void ask(const Action& action) const { answer_.actions.push_back(action); }
    /// Asks for the line T with typed words.
    template <class T>
    void askTyped(const Words& typed) const
    {
        try {
            Words line{T::info().name};
            line.insert(line.end(), typed.begin(), typed.end());
            ask(actionOf(line));
        } catch (const InputError& error) {
            answer_.problems.emplace_back(error.what());
        }
    }

    /// Returns the first key of an action, such as "control+z"; empty: it has none.
    std::string keyOf(const Action& action) const
    {
        const std::string line = textOf(action);
        for (const Shortcut& shortcut : content.shortcuts) {
            if (shortcut.line == line) return shortcut.chord;
        }
        return {};
    }
    /// Returns the text, with the key of the action if it has one: "no handles (w)".
    std::string withKey(const std::string& text, const Action& action) const
    {
        const std::string key = keyOf(action);
        return key.empty() ? text : text + " (" + key + ')';
    }

    /// Notes the last item as the widget `name`.
    void name(const std::string& widget) const
    {
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        if (revealed_ == widget) {
            ImGui::SetScrollHereY(0.5F);
            revealed_.clear();
        }
        places_[widget] = {static_cast<int>(std::lround(low.x)), static_cast<int>(std::lround(low.y)),
                           static_cast<int>(std::lround(high.x - low.x)),
                           static_cast<int>(std::lround(high.y - low.y))};
    }

    /// Notes where a drag of the last item, a slider, begins and ends.
    void followDrag() const
    {
        if (ImGui::IsItemActivated()) answer_.beginsDrag = true;
        if (ImGui::IsItemDeactivated()) answer_.endsDrag = true;
    }

private:
    PanelAnswer& answer_;
    std::map<std::string, Rectangle>& places_;
    std::string& revealed_;
};

} // namespace vdbcage::view
