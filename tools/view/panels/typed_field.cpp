#include <tools/view/panels/parts.h>

namespace vdbcage::view {

std::optional<std::string> typedField(const PanelContext& context, std::map<std::string, std::string>& typed,
                                      const std::string& name, const std::string& shown, float width, const char* hint)
{
    const auto known = typed.find(name);
    std::string text = known == typed.end() ? shown : known->second;
    ImGui::SetNextItemWidth(width);
    const bool entered = ImGui::InputTextWithHint(
        ("##" + name).c_str(), hint, &text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    context.name(name);
    const bool isLeft = ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemActive() && !entered) {
        typed[name] = text;
    } else {
        typed.erase(name);
    }
    if ((entered || isLeft) && text != shown) return text;
    return std::nullopt;
}

} // namespace vdbcage::view
