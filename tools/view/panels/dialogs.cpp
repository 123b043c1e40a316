#include <tools/view/panels/parts.h>

namespace vdbcage::view {

namespace {

/// Builds a window in the middle, over a dimmed one. ImGui closes it only from inside, so it is built once more for
/// that.
template <class Build>
void dialog(bool isWanted, const char* title, float width, const Build& build)
{
    const bool isOpen = ImGui::IsPopupOpen(title);
    if (!isWanted && !isOpen) return;
    if (!isOpen) ImGui::OpenPopup(title);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({length(width), 0});
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse;
    if (!ImGui::BeginPopupModal(title, nullptr, flags)) return;
    if (isWanted) {
        build();
    } else {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void paragraph(const std::string& text)
{
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

void buildMessage(const PanelContext& context)
{
    const std::vector<std::string>& messages = context.content.messages;
    dialog(!messages.empty(), "That did not work", 520, [&] {
        paragraph(messages.front());
        ImGui::Dummy({0, length(6)});
        if (mainButton("Dismiss", length(110))) context.ask(Dismiss{});
        context.name("message.dismiss");
        if (messages.size() > 1) {
            ImGui::SameLine();
            ImGui::AlignTextToFramePadding();
            muted(std::to_string(messages.size() - 1) + " more");
        }
    });
}

void buildQuestion(const PanelContext& context, bool isWanted)
{
    dialog(isWanted, "Quit without saving?", 420, [&] {
        paragraph("The scene was changed since it was saved last.");
        ImGui::Dummy({0, length(6)});
        const auto button = [&](const char* label, const Action& action, bool isMain) {
            const bool pressed = isMain ? mainButton(label, length(120)) : ImGui::Button(label, {length(120), 0});
            context.name("quit." + textOf(action));
            if (pressed) context.ask(action);
        };
        button("Save scene...", Browse{"save-scene"}, true);
        ImGui::SameLine();
        button("Quit", QuitUnsaved{}, false);
        ImGui::SameLine();
        button("Stay", Dismiss{}, false);
    });
}

void buildChanged(const PanelContext& context, bool isWanted)
{
    dialog(isWanted, "The model has changed", 420, [&] {
        const OpenedMeshPtr& model = context.content.session.state().document.model;
        paragraph((model ? model->path.filename().string() : std::string("its file")) +
                  " is another file on disk now.");
        ImGui::Dummy({0, length(6)});
        if (mainButton("Open it anew", length(130))) context.ask(Reload{});
        context.name("changed.reload");
        ImGui::SameLine();
        if (ImGui::Button("Keep the old one", {length(150), 0})) context.ask(Dismiss{});
        context.name("changed.keep");
    });
}

void table(const char* name, const std::vector<std::pair<std::string, std::string>>& rows)
{
    if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, length(250));
    ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
    for (const auto& [what, does] : rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        paragraph(what);
        ImGui::TableNextColumn();
        ImGui::PushTextWrapPos(0);
        muted(does);
        ImGui::PopTextWrapPos();
    }
    ImGui::EndTable();
}

void buildHelp(const PanelContext& context, bool isWanted, bool& isOpen)
{
    dialog(isWanted, "Keys, mouse and commands", 760, [&] {
        ImGui::BeginChild("text", {0, length(480)});
        const std::string as = context.content.keys == KeyMap::maya ? " as in Maya" : " as in Blender";
        heading("Mouse" + as);
        table("mouse", describeMouse(context.content.keys));
        heading("Keys" + as);
        std::vector<std::pair<std::string, std::string>> keys;
        for (const Shortcut& shortcut : context.content.shortcuts) keys.emplace_back(shortcut.chord, shortcut.help);
        table("keys", keys);
        heading("Commands, for scripts");
        table("commands", describeCommands());
        ImGui::EndChild();
        if (mainButton("Close", length(110))) isOpen = false;
        context.name("help.close");
    });
}

} // namespace

void buildDialogs(const PanelContext& context, bool& isHelpOpen, FileBrowser& browser)
{
    // ImGui shows one of them at a time; the others come back.
    const PanelContent& content = context.content;
    const bool isMessage = !content.messages.empty();
    const bool isBrowser = !isMessage && browser.isOpen;
    const bool isQuestion = !isMessage && !isBrowser && content.asksToQuit;
    const bool isChanged = !isMessage && !isBrowser && !isQuestion && content.hasModelChanged;
    const bool isHelp = !isMessage && !isBrowser && !isQuestion && !isChanged && isHelpOpen;
    buildHelp(context, isHelp, isHelpOpen);
    buildQuestion(context, isQuestion);
    buildChanged(context, isChanged);
    const std::string title = browser.line ? browser.line->title : "";
    dialog(isBrowser, (title + "###browser").c_str(), 560, [&] { buildBrowser(context, browser); });
    buildMessage(context);
}

} // namespace vdbcage::view
