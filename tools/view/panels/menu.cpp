#include <tools/view/panels/parts.h>

namespace vdbcage::view {

namespace {

void item(const PanelContext& context, const std::string& label, const Action& action, bool enabled = true,
          bool isChecked = false)
{
    const std::string chord = context.keyOf(action);
    if (ImGui::MenuItem(label.c_str(), chord.empty() ? nullptr : chord.c_str(), isChecked, enabled)) {
        context.ask(action);
    }
    context.name("menu." + textOf(action));
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

} // namespace

void buildMenu(const PanelContext& context)
{
    const Session& session = context.content.session;
    const Document& document = session.state().document;
    const ViewState& view = session.state().view;
    const bool hasModel = document.model != nullptr, hasCage = context.content.planner.made() != nullptr;
    const bool hasPoses = hasCage && !document.poses.isEmpty();
    const bool hasSelected = hasCage && !view.selection.ids.empty();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {length(8), length(5)});
    if (!ImGui::BeginMainMenuBar()) {
        ImGui::PopStyleVar();
        return;
    }
    ImGui::PopStyleVar();
    menu(context, "File", [&] {
        item(context, "Open model...", Browse{"open"});
        menu(context, "Open recent", [&] {
            for (const auto& file : context.content.recentFiles) {
                item(context, file.filename().string() + "##" + file.string(), OpenModel{file.string()});
            }
            if (context.content.recentFiles.empty()) ImGui::MenuItem("(none yet)", nullptr, false, false);
        });
        item(context, "Open cage...", Browse{"open-cage"}, hasModel);
        item(context, "Make the cage again", CloseCage{}, document.cage != nullptr);
        item(context, "Open posed cage...", Browse{"open-pose"}, hasCage);
        item(context, "Open sequence of posed cages...", Browse{"open-poses"}, hasCage);
        item(context, "Open weights...", Browse{"open-weights"}, hasCage);
        item(context, "Open scene...", Browse{"open-scene"});
        ImGui::Separator();
        item(context, "Save cage...", Browse{"save-cage"}, hasCage);
        item(context, "Save posed cage...", Browse{"save-posed-cage"}, hasCage);
        item(context, "Save posed model...", Browse{"save-posed-model"}, hasCage);
        item(context, "Save every posed cage...", Browse{"save-posed-cages"}, hasPoses);
        item(context, "Save every posed model...", Browse{"save-posed-models"}, hasPoses);
        item(context, "Save colours of the model...", Browse{"save-colours"}, hasCage);
        item(context, "Save weights...", Browse{"save-weights"}, hasCage && document.coordinates != Coordinates::given);
        item(context, "Save scene...", Browse{"save-scene"}, hasModel);
        item(context, "Save stages...", Browse{"save-stages"}, hasCage);
        item(context, "Save report...", Browse{"save-report"}, hasCage);
        item(context, "Save options...", Browse{"save-options"});
        item(context, "Save picture...", Browse{"save-picture"});
        ImGui::Separator();
        item(context, "Quit", Quit{});
    });
    menu(context, "Edit", [&] {
        const auto& documents = session.documents();
        const auto& views = session.views();
        item(context, documents.canUndo() ? "Undo " + documents.undone() : "Undo", Undo{}, documents.canUndo());
        item(context, documents.canRedo() ? "Redo " + documents.redone() : "Redo", Redo{}, documents.canRedo());
        ImGui::Separator();
        item(context, "Undo view", UndoView{}, views.canUndo());
        item(context, "Redo view", RedoView{}, views.canRedo());
        ImGui::Separator();
        item(context, "All options to their defaults", ResetOptions{});
        item(context, "Options from a file...", Browse{"preset"});
        ImGui::Separator();
        item(context, "Select all", SelectAll{}, hasCage);
        item(context, "Select nothing", SelectNone{}, hasSelected);
        item(context, "Invert the selection", SelectInvert{}, hasCage);
        item(context, "Select the connected part", SelectLinked{}, hasSelected);
        item(context, "Select loops", SelectLoop{}, hasSelected);
        item(context, "Select more", SelectGrow{}, hasSelected);
        item(context, "Select less", SelectShrink{}, hasSelected);
        item(context, "Select by a box", StartBox{}, hasCage);
        ImGui::Separator();
        item(context, "Move", Grab{Tool::move}, hasSelected);
        item(context, "Rotate", Grab{Tool::rotate}, hasSelected);
        item(context, "Scale", Grab{Tool::scale}, hasSelected);
        menu(context, "Cage at rest", [&] {
            const bool isShape = view.mode == Mode::shape && hasSelected;
            item(context, "Split edges", EditCage{CageEdit::split}, isShape);
            item(context, "Collapse edges", EditCage{CageEdit::collapse}, isShape);
            item(context, "Flip edges", EditCage{CageEdit::flip}, isShape);
            item(context, "Merge triangles to quads", EditCage{CageEdit::merge}, isShape);
            item(context, "Cut quads to triangles", EditCage{CageEdit::cut}, isShape);
            ImGui::Separator();
            item(context, "Lock points", LockPoints{}, isShape);
            item(context, "Unlock points", UnlockPoints{}, isShape && !document.locked.empty());
            item(context, "Fit to the model", FitCage{document.tightness}, hasCage);
        });
        item(context, "Reset the pose", ResetPose{false}, hasPoses);
        item(context, "Reset the pose of the selection", ResetPose{true}, hasPoses && hasSelected);
        item(context, "Insert a key", InsertKey{}, hasCage && view.mode == Mode::pose);
        item(context, "Remove the key", RemoveKey{}, document.poses.keyAt(view.frame) != nullptr);
        menu(context, "In-betweens from rest", [&] {
            for (const int frames : {12, 24, 48, 96}) {
                item(context, std::to_string(frames) + " frames", MakeInBetweens{frames}, hasPoses);
            }
        });
        item(context, "Remove all poses", ClearPoses{}, hasPoses);
    });
    menu(context, "View", [&] {
        item(context, "Frame all", FrameView{false});
        item(context, "Frame the selection", FrameView{true}, hasSelected);
        ImGui::Separator();
        for (const auto from : {Look::From::front, Look::From::back, Look::From::right, Look::From::left,
                                Look::From::top, Look::From::bottom}) {
            std::string label = nameIn(Look::names, from);
            label[0] = static_cast<char>(label[0] - 'a' + 'A');
            item(context, label, Look{from});
        }
        ImGui::Separator();
        item(context, "Orthographic", SetProjection{}, true, view.camera.projection == draw::Projection::orthographic);
        item(context, "Z is up", SetUp{}, true, view.camera.view.up == draw::UpAxis::z);
        item(context, "Turntable", SetTurntable{!view.turntable}, true, view.turntable);
        ImGui::Separator();
        item(context, "Ground grid", ShowGround{!view.ground}, true, view.ground);
        item(context, "Times", ShowTimes{!view.times}, true, view.times);
        item(context, "Axes", ShowAxes{!view.axes}, true, view.axes);
    });
    menu(context, "Help", [&] {
        item(context, "Keys, mouse and commands", ShowHelp{});
        menu(context, "Keys", [&] {
            item(context, "Blender", ChooseKeys{KeyMap::blender}, true, context.content.keys == KeyMap::blender);
            item(context, "Maya", ChooseKeys{KeyMap::maya}, true, context.content.keys == KeyMap::maya);
        });
    });
    ImGui::EndMainMenuBar();
}

} // namespace vdbcage::view
