#include <tools/view/panels/parts.h>
#include <tools/view/state/preset.h>
#include <tools/view/state/words.h>

namespace vdbcage::view {

namespace {

void item(const PanelContext& context, const std::string& label, const std::string& line, bool enabled = true,
          bool isChecked = false)
{
    const std::string chord = context.keyOf(line);
    if (ImGui::MenuItem(label.c_str(), chord.empty() ? nullptr : chord.c_str(), isChecked, enabled)) context.ask(line);
    context.name("menu." + line);
}

template <class Build>
void menu(const PanelContext& context, const char* label, const Build& build)
{
    const bool isOpen = ImGui::BeginMenu(label);
    context.name(std::string("menu.") + label);
    if (!isOpen) return;
    build();
    ImGui::EndMenu();
}

std::string onOff(bool on)
{
    return on ? "on" : "off";
}

} // namespace

void buildMenu(const PanelContext& context)
{
    const Session& session = context.content.session;
    const Document& document = session.state().document;
    const ViewState& view = session.state().view;
    const bool hasModel = document.model != nullptr, hasCage = context.content.planner.shown() != nullptr;
    const bool hasPoses = hasCage && !document.poses.isEmpty();
    const bool hasSelected = hasCage && !view.selection.ids.empty();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {length(8), length(5)});
    if (!ImGui::BeginMainMenuBar()) {
        ImGui::PopStyleVar();
        return;
    }
    ImGui::PopStyleVar();
    menu(context, "File", [&] {
        item(context, "Open model...", "browse open");
        menu(context, "Open recent", [&] {
            for (const auto& file : context.content.recentFiles) {
                item(context, file.filename().string() + "##" + file.string(), "open " + quotedWord(file.string()));
            }
            if (context.content.recentFiles.empty()) ImGui::MenuItem("(none yet)", nullptr, false, false);
        });
        item(context, "Open cage...", "browse open-cage", hasModel);
        item(context, "Make the cage again", "close-cage", document.cage != nullptr);
        item(context, "Open posed cage...", "browse open-pose", hasCage);
        item(context, "Open sequence of posed cages...", "browse open-poses", hasCage);
        item(context, "Open weights...", "browse open-weights", hasCage);
        item(context, "Open scene...", "browse open-scene");
        ImGui::Separator();
        item(context, "Save cage...", "browse save-cage", hasCage);
        item(context, "Save posed cage...", "browse save-posed-cage", hasCage);
        item(context, "Save posed model...", "browse save-posed-model", hasCage);
        item(context, "Save every posed cage...", "browse save-posed-cages", hasPoses);
        item(context, "Save every posed model...", "browse save-posed-models", hasPoses);
        item(context, "Save colours of the model...", "browse save-colours", hasCage);
        item(context, "Save weights...", "browse save-weights", hasCage && document.coordinates != Coordinates::given);
        item(context, "Save scene...", "browse save-scene", hasModel);
        item(context, "Save stages...", "browse save-stages", hasCage);
        item(context, "Save report...", "browse save-report", hasCage);
        item(context, "Save options...", "browse save-options");
        item(context, "Save picture...", "browse save-picture");
        ImGui::Separator();
        item(context, "Quit", "quit");
    });
    menu(context, "Edit", [&] {
        const auto& documents = session.documents();
        const auto& views = session.views();
        item(context, documents.canUndo() ? "Undo " + documents.undone() : "Undo", "undo", documents.canUndo());
        item(context, documents.canRedo() ? "Redo " + documents.redone() : "Redo", "redo", documents.canRedo());
        ImGui::Separator();
        item(context, "Undo view", "undo-view", views.canUndo());
        item(context, "Redo view", "redo-view", views.canRedo());
        ImGui::Separator();
        item(context, "All options to their defaults", "reset");
        item(context, "Options from a file...", "browse preset");
        ImGui::Separator();
        item(context, "Select all", "select-all", hasCage);
        item(context, "Select nothing", "select-none", hasSelected);
        item(context, "Invert the selection", "select-invert", hasCage);
        item(context, "Select what hangs together", "select-linked", hasSelected);
        item(context, "Select loops", "select-loop", hasSelected);
        item(context, "Select more", "select-grow", hasSelected);
        item(context, "Select less", "select-shrink", hasSelected);
        item(context, "Select by a box", "box", hasCage);
        ImGui::Separator();
        item(context, "Move", "grab move", hasSelected);
        item(context, "Rotate", "grab rotate", hasSelected);
        item(context, "Scale", "grab scale", hasSelected);
        menu(context, "Cage at rest", [&] {
            const bool isShape = view.mode == Mode::shape && hasSelected;
            item(context, "Split edges", "edit-cage split", isShape);
            item(context, "Collapse edges", "edit-cage collapse", isShape);
            item(context, "Flip edges", "edit-cage flip", isShape);
            item(context, "Merge triangles to quads", "edit-cage merge", isShape);
            item(context, "Cut quads to triangles", "edit-cage cut", isShape);
        });
        item(context, "Reset the pose", "reset-pose all", hasPoses);
        item(context, "Reset the pose of what is selected", "reset-pose selected", hasPoses && hasSelected);
        item(context, "Insert a key", "insert-key", hasCage && view.mode == Mode::pose);
        item(context, "Remove the key", "remove-key", document.poses.keyAt(view.frame) != nullptr);
        menu(context, "In-betweens from rest", [&] {
            for (const int frames : {12, 24, 48, 96}) {
                const std::string count = std::to_string(frames);
                item(context, count + " frames", "in-betweens " + count, hasPoses);
            }
        });
        item(context, "Remove all poses", "clear-poses", hasPoses);
    });
    menu(context, "View", [&] {
        item(context, "Frame all", "frame all");
        item(context, "Frame what is selected", "frame selected", hasSelected);
        ImGui::Separator();
        for (const char* side : {"front", "back", "right", "left", "top", "bottom"}) {
            std::string label = side;
            label[0] = static_cast<char>(label[0] - 'a' + 'A');
            item(context, label, std::string("look ") + side);
        }
        ImGui::Separator();
        item(context, "Orthographic", "projection toggle", true,
             view.camera.projection == draw::Projection::orthographic);
        item(context, "Z is up", "up toggle", true, view.camera.view.up == draw::UpAxis::z);
        item(context, "Turntable", "turntable " + onOff(!view.turntable), true, view.turntable);
        ImGui::Separator();
        item(context, "Ground grid", "ground " + onOff(!view.ground), true, view.ground);
        item(context, "Times", "times " + onOff(!view.times), true, view.times);
        item(context, "Axes", "axes " + onOff(!view.axes), true, view.axes);
    });
    menu(context, "Help", [&] {
        item(context, "Keys, mouse and commands", "help");
        menu(context, "Keys", [&] {
            item(context, "Blender", "keys blender", true, context.content.keys == KeyMap::blender);
            item(context, "Maya", "keys maya", true, context.content.keys == KeyMap::maya);
        });
    });
    ImGui::EndMainMenuBar();
}

} // namespace vdbcage::view
