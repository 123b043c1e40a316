#include <algorithm>
#include <cstdio>

#include <tools/view/panels/parts.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/length_text.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

struct LayerText {
    LayerId id;
    const char* label;
    const char* help;
};

constexpr std::array<LayerText, layerCount> texts{
    {{LayerId::model, "Model", "the model inside the cage"},
     {LayerId::cage, "Cage", "the outcome; hidden edges are faint"},
     {LayerId::decimated, "Decimated", "the cage before its triangles were merged to quads and tightened"},
     {LayerId::smoothed, "Smoothed", "the cage after smoothing; where bounding is off, the surface after it"},
     {LayerId::surface, "Surface", "the surface that the cage was made from"},
     {LayerId::closed, "Closing", "exposed faces of the closing's voxels"},
     {LayerId::closedNodes, "Closing: nodes", "a box for each node of the closing's tree"},
     {LayerId::solid, "Voxels", "exposed faces of the model's voxels"},
     {LayerId::solidNodes, "Voxels: nodes", "a box for each node of the voxels' tree"}}};

void buildLayer(const PanelContext& context, const LayerText& text)
{
    const LayerLook& look = context.content.session.state().view.layer(text.id);
    const std::string name = nameOf(text.id);
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool shown = look.shown;
    if (ImGui::Checkbox("##shown", &shown)) context.ask(ShowLayer{text.id, shown});
    context.name("layer." + name);
    ImGui::TableNextColumn();
    draw::Colour colour = look.colour;
    if (ImGui::ColorEdit3("##colour", colour.data(), ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoTooltip)) {
        context.ask(ColourLayer{text.id, colour});
    }
    context.name("colour." + name);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (shown) {
        ImGui::TextUnformatted(text.label);
    } else {
        muted(text.label);
    }
    help(text.help);
    ImGui::TableNextColumn();
    float opacity = static_cast<float>(look.opacity);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##opacity", &opacity, 0, 1, "", pointerOnly)) {
        context.ask(FadeLayer{text.id, std::round(100 * double{opacity}) / 100});
    }
    context.followDrag();
    context.name("opacity." + name);
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "opacity of its faces: %.0f %%", 100 * look.opacity);
    help(buffer);
    ImGui::PopID();
}

/// Builds a choice; returns whether it was made. Three of them have room in a row beside a scroll bar.
bool choice(const char* label, bool isChosen, bool isFirst)
{
    if (!isFirst) ImGui::SameLine(0, length(4));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {length(3), length(4)});
    const bool isMade = ImGui::RadioButton(label, isChosen);
    ImGui::PopStyleVar();
    return isMade;
}

void buildCageColours(const PanelContext& context)
{
    const CageColours now = context.content.session.state().view.cageColours;
    struct Choice {
        CageColours colours;
        const char* label;
        const char* text;
    };
    for (const Choice& c : {Choice{CageColours::plain, "Plain", "one colour"},
                            Choice{CageColours::kinds, "Quads", "quads have another colour than triangles"},
                            Choice{CageColours::distance, "Distance", "how far the cage is from the model"}}) {
        if (choice(c.label, now == c.colours, c.colours == CageColours::plain)) context.ask(SetCageColours{c.colours});
        context.name(std::string("cage-colours.") + nameIn(cageColourNames, c.colours));
        help(c.text);
    }
}

void buildModelColours(const PanelContext& context)
{
    const ModelColours now = context.content.session.state().view.modelColours;
    constexpr std::array<const char*, 4> labels{"Plain", "Influence", "Stretch", "Inverted"},
        helps{"one colour", "how far the posed model follows the selection: red with it, blue against it",
              "where lengths are longer (red) or shorter (blue) than at rest",
              "triangles that the pose turns inside out; they are counted while it stands still"};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (i % 2 == 1) ImGui::SameLine(length(120));
        const std::string label = std::string(labels[i]) + "##model";
        const auto colours = static_cast<ModelColours>(i);
        if (ImGui::RadioButton(label.c_str(), now == colours)) context.ask(SetModelColours{colours});
        context.name(std::string("model-colours.") + modelColourNames[i]);
        help(helps[i]);
    }
}

/// Builds the list of families for the second picture.
void buildCompare(const PanelContext& context)
{
    const auto& compared = context.content.session.state().view.compared;
    ImGui::AlignTextToFramePadding();
    muted("Compare with");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    const char* const now = compared ? titleOf(*compared) : "nothing";
    const bool isOpen = ImGui::BeginCombo("##compare", now);
    context.name("compare");
    if (!isOpen) return help("a second picture has the model by another family of coordinates");
    if (ImGui::Selectable("nothing", !compared)) context.ask(Compare{});
    context.name("compare.off");
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (ImGui::Selectable(family.title, compared == family.family)) context.ask(Compare{family.family});
        context.name(std::string("compare.") + family.name);
        help(describe(family));
    }
    ImGui::EndCombo();
}

/// Builds the sliders of the material of Somigliana coordinates.
void buildMaterial(const PanelContext& context)
{
    const Elasticity& now = context.content.session.state().document.elasticity;
    const auto ask = [&](const Elasticity& elasticity) { context.ask(SetMaterial{elasticity}); };
    struct Number {
        const char* label;
        const char* name;
        double Elasticity::*value;
        float least, most;
        double perUnit; ///< steps of the slider
        const char* format;
        const char* text;
    };
    for (const Number& n : {Number{"Poisson's ratio", "material.nu", &Elasticity::nu, -0.9F, 0.45F, 100, "%.2f",
                                   "how much the model gets thinner where it is stretched; below 0 it gets thicker"},
                            Number{"Local bulging", "material.local-bulging", &Elasticity::localBulging, 0, 30, 10,
                                   "%.1f", "how much the model bulges where the cage's normals come to spread more"},
                            Number{"Global bulging", "material.global-bulging", &Elasticity::globalBulging, 0, 30, 10,
                                   "%.1f", "how much the model bulges where the cage moves outward"}}) {
        ImGui::PushID(n.name);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(n.label);
        help(n.text);
        ImGui::SameLine(length(112));
        ImGui::SetNextItemWidth(-length(28));
        Elasticity changed = now;
        auto value = static_cast<float>(now.*n.value);
        if (ImGui::SliderFloat("##value", &value, n.least, n.most, n.format, ImGuiSliderFlags_AlwaysClamp)) {
            changed.*n.value = std::round(n.perUnit * double{value}) / n.perUnit + 0.0; // not -0
            ask(changed);
        }
        context.followDrag();
        context.name(n.name);
        help(n.text);
        const double normal = Elasticity().*n.value;
        if (now.*n.value != normal) {
            ImGui::SameLine(0, length(4));
            if (ImGui::Button("\xe2\x86\xba", {-1, 0})) {
                changed.*n.value = normal;
                ask(changed);
            }
            context.name(std::string(n.name) + ".reset");
            help("back to " + detail::numberText(normal));
        }
        ImGui::PopID();
    }
    constexpr std::array<const char*, 2> labels{"Turns as a whole", "Turns with faces"},
        helps{"the material turns as one; for parts that turn up to a quarter turn from the mean",
              "the material turns at each face as the face does; for parts that turn farther, but it stretches more"};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto rotations = static_cast<Elasticity::Rotations>(i);
        if (ImGui::RadioButton(labels[i], now.rotations == rotations)) {
            Elasticity changed = now;
            changed.rotations = rotations;
            ask(changed);
        }
        context.name(std::string("material.") + rotationsName(rotations));
        help(helps[i]);
    }
}

void buildSection(const PanelContext& context)
{
    const auto& section = context.content.session.state().view.section;
    const auto& box = context.content.box;
    bool on = section.has_value();
    ImGui::BeginDisabled(!box && !on);
    if (ImGui::Checkbox("Section", &on)) {
        const double middle = box ? 0.5 * (box->min().z() + box->max().z()) : 0;
        context.ask(on ? SetSection{SectionPlane{{0, 0, 1}, middle}} : SetSection{});
    }
    context.name("section");
    help("cuts off all layers on one side of a plane");
    ImGui::EndDisabled();
    if (!section || !box) return;
    const auto ask = [&](const openvdb::Vec3d& normal, double offset) {
        context.ask(SetSection{SectionPlane{normal, offset}});
    };
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(section->normal[k]) > std::abs(section->normal[axis])) axis = k;
    }
    const double sign = section->normal[axis] < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {
        ImGui::SameLine();
        const std::string label(1, "XYZ"[k]);
        openvdb::Vec3d normal(0);
        normal[k] = 1;
        if (ImGui::RadioButton(label.c_str(), k == axis)) ask(normal, 0.5 * (box->min()[k] + box->max()[k]));
        context.name(std::string("section.") + "xyz"[k]);
    }
    openvdb::Vec3d normal(0);
    normal[axis] = sign;
    const double low = box->min()[axis], high = box->max()[axis];
    float share =
        high > low ? static_cast<float>((sign * section->offset / section->normal.length() - low) / (high - low)) : 0;
    ImGui::SetNextItemWidth(-length(56));
    if (ImGui::SliderFloat("##offset", &share, 0, 1, "", pointerOnly)) {
        ask(normal, sign * (low + (high - low) * double{share}));
    }
    context.followDrag();
    context.name("section.offset");
    ImGui::SameLine();
    if (ImGui::Button("Flip", {-1, 0})) ask(-section->normal, -section->offset);
    context.name("section.flip");
}

/// Returns a coordinate's text for its field: 0 if it is 0 up to rounding, else with at least six digits.
std::string coordinateText(double value, double longest)
{
    if (!(std::abs(value) > 1e-9 * longest)) return "0";
    return detail::lengthText(value, std::min(1e-6 * longest, 1e-5 * std::abs(value)));
}

/// Builds the buttons that lock and unlock what is selected.
void buildLocks(const PanelContext& context)
{
    const std::size_t locked = context.content.session.state().document.locked.size();
    const std::string now = " (" + std::to_string(locked) + " of the cage's points are locked now)";
    if (ImGui::Button("Lock")) context.ask(LockPoints{});
    context.name("lock");
    help("the selected points stay in fits, and when others are moved" + now);
    ImGui::SameLine(0, length(4));
    ImGui::BeginDisabled(locked == 0);
    if (ImGui::Button("Unlock")) context.ask(UnlockPoints{});
    ImGui::EndDisabled();
    context.name("unlock");
    help("the selected points can move again" + now);
}

/// Builds fields for the mean of the selected points, which move so that it gets the typed place.
void buildSelected(const PanelContext& context, std::map<std::string, std::string>& typed)
{
    const auto& selected = context.content.selected;
    if (!selected) return;
    const ViewState& view = context.content.session.state().view;
    heading("Selected");
    const std::string points = std::to_string(selected->count) + (selected->count == 1 ? " point" : " points");
    const std::size_t count = view.selection.ids.size();
    const std::string kind = edit::elementNames[static_cast<std::size_t>(view.selection.kind)];
    if (view.selection.kind == edit::Element::point) {
        muted(points);
    } else {
        muted(std::to_string(count) + ' ' + (count == 1 ? kind.substr(0, kind.size() - 1) : kind) + ", " + points);
    }
    const auto& box = context.content.box;
    const double longest = box ? box->extents()[box->maxExtent()] : 1;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {length(8), length(4)});
    for (int k = 0; k < 3; ++k) {
        const std::string name = std::string("selected.") + "xyz"[k];
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(std::string(1, "XYZ"[k]).c_str());
        help("the mean of the selected points along this axis, in world units; a number that is typed moves it there");
        ImGui::SameLine(length(30));
        const auto text = typedField(context, typed, name, coordinateText(selected->mean[k], longest), -1);
        if (!text) continue;
        Words by{"0", "0", "0"};
        try {
            by[static_cast<std::size_t>(k)] = detail::numberText(numberOf(*text, name) - selected->mean[k]);
        } catch (const InputError&) { // the command reports the error
            by[static_cast<std::size_t>(k)] = *text;
        }
        context.askTyped<MoveSelected>(by);
    }
    ImGui::PopStyleVar();
    if (view.mode == Mode::shape) buildLocks(context);
    ImGui::Dummy({0, length(4)});
}

void buildCounts(const PanelContext& context)
{
    if (!context.content.model) return;
    ImGui::Dummy({0, length(4)});
    if (!ImGui::BeginTable("counts", 3, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    muted("Model");
    ImGui::TableNextColumn();
    muted("Cage");
    const auto row = [&](const char* label, std::size_t Counts::*count) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        muted(label);
        for (const auto& counts : {context.content.model, context.content.cage}) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(counts ? std::to_string((*counts).*count).c_str() : "-");
        }
    };
    row("points", &Counts::points);
    row("edges", &Counts::edges);
    row("faces", &Counts::faces);
    ImGui::EndTable();
}

} // namespace

void buildLayers(const PanelContext& context, std::map<std::string, std::string>& typed)
{
    const ViewState& view = context.content.session.state().view;
    heading("Layers");
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {length(3), length(2)});
    if (ImGui::BeginTable("layers", 4)) {
        const float frame = ImGui::GetFrameHeight();
        ImGui::TableSetupColumn("shown", ImGuiTableColumnFlags_WidthFixed, frame);
        ImGui::TableSetupColumn("colour", ImGuiTableColumnFlags_WidthFixed, frame);
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("opacity", ImGuiTableColumnFlags_WidthFixed, length(44));
        for (const LayerText& text : texts) buildLayer(context, text);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::Dummy({0, length(4)});
    heading("Colours of the cage");
    buildCageColours(context);
    ImGui::Dummy({0, length(4)});
    if (view.mode == Mode::pose) {
        heading("Colours of the model");
        buildModelColours(context);
        buildCompare(context);
        ImGui::Dummy({0, length(4)});
        if (context.content.hasMaterial) {
            heading("Material");
            buildMaterial(context);
            ImGui::Dummy({0, length(4)});
        }
    }
    buildSelected(context, typed);
    heading("View");
    buildSection(context);
    const auto check = [&](const char* label, auto command, const char* text) {
        using Switch = decltype(command);
        if (ImGui::Checkbox(label, &command.isOn)) context.ask(command);
        context.name(Switch::info().name);
        help(text);
    };
    check("Ground grid", ShowGround{view.ground}, "a grid below the model; the label says how far its lines are apart");
    check("Axes", ShowAxes{view.axes}, "x, y and z in the corner of the picture");
    check("Turntable", SetTurntable{view.turntable}, "turns the view by itself");
    buildCounts(context);
}

} // namespace vdbcage::view
