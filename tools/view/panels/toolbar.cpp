// The toolbar for work in the picture: mode, kind of selection, tool, and options of motions.

#include <tools/view/panels/parts.h>

namespace vdbcage::view {

namespace {

struct Choice {
    const char* label;
    Action action;
    bool isOn;
    std::string text;
};

/// Builds buttons side by side, one of which is down.
void choices(const PanelContext& context, const char* group, const std::vector<Choice>& list)
{
    for (const Choice& choice : list) {
        if (&choice != &list.front()) ImGui::SameLine(0, length(1));
        if (choice.isOn) ImGui::PushStyleColor(ImGuiCol_Button, toImGui(theme::selected));
        if (ImGui::Button(choice.label)) context.ask(choice.action);
        if (choice.isOn) ImGui::PopStyleColor();
        const std::string line = textOf(choice.action);
        context.name(std::string(group) + '.' + line.substr(line.rfind(' ') + 1));
        help(context.withKey(choice.text, choice.action));
    }
}

void gap()
{
    ImGui::SameLine(0, length(10));
}

struct Entry {
    const char* name;
    const char* label;
    std::string text;
    Command command;
};

/// Builds a list with the chosen entry.
void list(const PanelContext& context, const std::string& name, const std::vector<Entry>& entries, std::size_t chosen,
          float width)
{
    ImGui::SetNextItemWidth(width);
    const bool isOpen = ImGui::BeginCombo(("##" + name).c_str(), entries[chosen].label);
    context.name(name);
    if (!isOpen) return help(entries[chosen].text);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        if (ImGui::Selectable(entry.label, i == chosen) && i != chosen) context.ask(entry.command);
        context.name(name + '.' + entry.name);
        help(entry.text);
    }
    ImGui::EndCombo();
}

void buildPivot(const PanelContext& context, const ViewState& view)
{
    const auto& selected = context.content.selected;
    const openvdb::Vec3d now = selected ? selected->origin : view.pivot.point;
    list(context, "pivot",
         {{"mean", "Mean", "turns and scales about the mean of the selected points", SetPivot{{Pivot::Kind::mean}}},
          {"box", "Box", "turns and scales about the middle of the box around the selected points",
           SetPivot{{Pivot::Kind::box}}},
          {"origin", "Origin", "turns and scales about the world's origin", SetPivot{{Pivot::Kind::origin}}},
          {"point", "Point", "turns and scales about one point: where the pivot was when this was chosen",
           SetPivot{{Pivot::Kind::point, now}}}},
         static_cast<std::size_t>(view.pivot.kind), length(72));
}

void buildMirror(const PanelContext& context, const ViewState& view)
{
    muted("Mirror");
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::SameLine(0, axis == 0 ? length(6) : length(1));
        const bool isOn = view.mirror && view.mirror->axis == axis;
        if (isOn) ImGui::PushStyleColor(ImGuiCol_Button, toImGui(theme::selected));
        const std::string name(1, "xyz"[axis]), label(1, "XYZ"[axis]);
        if (ImGui::Button((label + "##mirror").c_str())) context.ask(Toggle{"mirror-" + name});
        if (isOn) ImGui::PopStyleColor();
        context.name("mirror." + name);
        help("a change on one side of the cage is made on the other too, at points that have a partner there");
    }
}

void buildSoft(const PanelContext& context, const ViewState& view)
{
    float radius = static_cast<float>(view.softRadius);
    ImGui::SetNextItemWidth(length(84));
    const char* const format = radius > 0 ? "Soft %.2f" : "Soft off";
    if (ImGui::SliderFloat("##soft", &radius, 0, 0.5F, format, ImGuiSliderFlags_AlwaysClamp)) {
        context.ask(SetSoft{std::round(100 * double{radius}) / 100});
    }
    context.followDrag();
    context.name("soft");
    help("points nearer than this along the cage move too, less and less; a part of the model's longest side");
}

} // namespace

std::string describe(const FamilyInfo& family)
{
    return std::string(family.what) + " (" + family.paper + ")";
}

const char* titleOf(Coordinates family)
{
    return familyInfo(family).title;
}

void buildToolbar(const PanelContext& context)
{
    const State& state = context.content.session.state();
    const ViewState& view = state.view;
    const bool isPose = view.mode == Mode::pose;
    // Narrower than elsewhere: all widgets have room in a window of 1100 pixels.
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {length(6), length(4)});
    ImGui::BeginDisabled(!state.document.model);
    choices(context, "mode",
            {{"Shape", SetMode{Mode::shape}, !isPose,
              context.withKey("moves the cage at rest; the model stays", Toggle{"mode"})},
             {"Pose", SetMode{Mode::pose}, isPose,
              context.withKey("moves the cage, and the model with it", Toggle{"mode"})}});
    gap();
    const edit::Element kind = view.selection.kind;
    choices(context, "select-kind",
            {{"Points", SelectKind{edit::Element::point}, kind == edit::Element::point, "selects points of the cage"},
             {"Edges", SelectKind{edit::Element::edge}, kind == edit::Element::edge, "selects edges of the cage"},
             {"Faces", SelectKind{edit::Element::face}, kind == edit::Element::face, "selects faces of the cage"}});
    gap();
    const auto handles = [&](const char* does, Tool tool) {
        const std::string free = context.keyOf(Grab{tool});
        return std::string("handles that ") + does + " the selection" +
               (free.empty() ? "" : "; " + free + " does it without handles");
    };
    choices(context, "tool",
            {{"Select", SetTool{Tool::select}, view.tool == Tool::select, "no handles"},
             {"Move", SetTool{Tool::move}, view.tool == Tool::move, handles("move", Tool::move)},
             {"Rotate", SetTool{Tool::rotate}, view.tool == Tool::rotate, handles("turn", Tool::rotate)},
             {"Scale", SetTool{Tool::scale}, view.tool == Tool::scale, handles("scale", Tool::scale)}});
    gap();
    list(context, "orientation",
         {{"world", "World", "handles along the axes of the world", SetOrientation{Orientation::world}},
          {"local", "Local", "handles along the principal axes of the selection", SetOrientation{Orientation::local}},
          {"normal", "Normal", "handles along the mean normal of the selection", SetOrientation{Orientation::normal}},
          {"view", "View", "handles to the right, up and to the viewer", SetOrientation{Orientation::view}}},
         static_cast<std::size_t>(view.orientation), length(78));
    ImGui::SameLine(0, length(4));
    buildPivot(context, view);
    gap();
    if (view.seeThrough) ImGui::PushStyleColor(ImGuiCol_Button, toImGui(theme::selected));
    if (ImGui::Button("See through")) context.ask(SetSeeThrough{!view.seeThrough});
    if (view.seeThrough) ImGui::PopStyleColor();
    context.name("see-through");
    help(context.withKey("selects hidden elements too", Toggle{"see-through"}));
    gap();
    buildMirror(context, view);
    gap();
    buildSoft(context, view);
    gap();
    if (isPose) {
        const Coordinates now = state.document.coordinates;
        std::vector<Entry> families;
        for (const FamilyInfo& family : coordinateFamilies()) {
            families.push_back({family.name, family.title, describe(family), SetCoordinates{family.family}});
        }
        if (now == Coordinates::given) { // given weights are chosen by their file
            families.push_back(
                {coordinatesName(now), titleOf(now), "weights from a file (File > Open weights)", SetCoordinates{now}});
        }
        list(context, "coordinates", families, static_cast<std::size_t>(now), length(112));
    } else {
        ImGui::NewLine();
    }
    ImGui::EndDisabled();
    ImGui::PopStyleVar();
}

} // namespace vdbcage::view
