#include <algorithm>
#include <cmath>
#include <cstdio>

#include <tools/report/report.h>
#include <tools/view/panels/parts.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::view {

namespace {

std::string number(const char* format, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string facesOf(const CageCheck& check)
{
    const std::size_t faces = check.triangles + check.quads;
    std::string text = std::to_string(faces) + (faces == 1 ? " face" : " faces");
    if (check.quads > 0) {
        text += " (" + std::to_string(check.quads) + " quads, " +
                number("%.0f", 100.0 * static_cast<double>(check.quads) / static_cast<double>(faces)) + " %)";
    }
    return text;
}

const char* verdictOf(const CageCheck& check)
{
    return check.bounding() ? "bounding, certified" : check.valid() ? "NOT bounding" : "NOT a valid cage";
}

template <class Build>
void row(const char* label, const Build& build)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    muted(label);
    ImGui::TableNextColumn();
    build();
}

void row(const char* label, const std::string& value)
{
    row(label, [&] { ImGui::TextUnformatted(value.c_str()); });
}

void buildStages(const CageResult& made)
{
    double all = 0;
    for (const StageTime& stage : made.stages) all += stage.seconds;
    for (const StageTime& stage : made.stages) {
        row(stage.name.c_str(), [&] {
            const float share = all > 0 ? static_cast<float>(stage.seconds / all) : 0;
            ImGui::ProgressBar(share, {-1, ImGui::GetTextLineHeight()}, number("%.2f s", stage.seconds).c_str());
        });
    }
}

/// Builds the progress of the binding, in mode pose.
void buildBinding(const PanelContext& context)
{
    if (context.content.session.state().view.mode != Mode::pose) return;
    const PanelContent& content = context.content;
    if (!content.bindingError.empty()) {
        coloured(theme::bad, "the pose is not followed"); // the reason is in the panel of options
        return ImGui::SameLine(0, length(18));
    }
    if (!content.binding) return;
    std::string text = content.binding->stage.empty() ? "bind" : content.binding->stage;
    if (content.binding->percent >= 0) text += ' ' + std::to_string(content.binding->percent) + " %";
    coloured(theme::accent, text);
    help("the model's points are being bound to the cage; until then a coarse stand-in follows. Escape stops it");
    ImGui::SameLine(0, length(18));
}

/// Builds the fit of a cage that was opened or edited, or that cuts the model, in the line of the verdict. `left`: its
/// place, where no verdict comes to. A slider that moves while it is dragged would change its value.
void buildFit(const PanelContext& context, bool cuts, float left)
{
    const Document& document = context.content.session.state().document;
    if (!document.cage && !cuts) return;
    const float pad = length(2), top = ImGui::GetCursorPosY();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {length(8), pad});
    ImGui::SetCursorPos({std::max(left, ImGui::GetCursorPosX()), top - pad});
    const bool isFitted = document.isFitted && !context.content.planner.isHalted();
    ImGui::BeginDisabled(isFitted);
    if (cuts && !isFitted ? mainButton("Fit") : ImGui::Button("Fit")) {
        context.ask(document.isFitted ? Action(MakeAgain{}) : FitCage{document.tightness});
    }
    ImGui::EndDisabled();
    context.name("fit");
    help("moves the cage's points until it bounds the model");
    ImGui::SameLine(0, length(6));
    ImGui::SetNextItemWidth(length(110));
    float tightness = static_cast<float>(document.tightness);
    if (ImGui::SliderFloat("##tight", &tightness, 0, 1, "Tight %.2f", ImGuiSliderFlags_AlwaysClamp)) {
        context.ask(FitCage{std::round(100 * double{tightness}) / 100});
    }
    context.followDrag();
    context.name("tight");
    help("fits the cage. 0: only points move that have to; 1: as tight as a made cage; between them: near to what was "
         "drawn");
    ImGui::PopStyleVar();
    ImGui::SameLine(0, length(18));
}

/// Builds the verdict on the pose.
void buildPose(const PanelContext& context)
{
    const PanelContent& content = context.content;
    if (!content.isPosed) return;
    const PoseCheckPtr& check = content.poseCheck;
    row("Pose", [&] {
        if (!check) return muted(content.isPoseChecked ? "is being checked" : "is not checked now");
        if (check->isValid) return coloured(theme::good, "the posed cage is valid");
        coloured(theme::bad, check->selfIntersections > 0
                                 ? std::to_string(check->selfIntersections) + " self-intersections of the posed cage"
                                 : std::string("the posed cage is not valid"));
    });
    if (!check || !check->inverted) return;
    const Mesh& model = content.session.state().document.model->mesh;
    const std::size_t triangles = model.triangles.size() + 2 * model.quads.size();
    row("Inverted", std::to_string(check->inverted->size()) + " of " + std::to_string(triangles) + " triangles");
}

} // namespace

void buildResult(const PanelContext& context)
{
    const CageResultPtr& made = context.content.planner.made();
    if (!made) return;
    const CageCheck& check = made->report.check;
    ImGui::Dummy({0, length(4)});
    heading("Cage");
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {length(2), length(2)});
    if (ImGui::BeginTable("result", 2)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, length(92));
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
        row("Verdict", [&] {
            coloured(check.bounding() ? theme::good : theme::bad, verdictOf(check));
            if (made->fitProblem.empty()) return;
            ImGui::PushTextWrapPos(0);
            coloured(theme::bad, made->fitProblem);
            ImGui::PopTextWrapPos();
            context.name("error.fit");
        });
        row("Faces", facesOf(check));
        row("Volume", check.volumeRatio > 0 ? number("%.3f times the model's", check.volumeRatio)
                                            : std::string("model or cage is not closed"));
        row("Distance", number("%.2f %% in the mean, ", 100 * check.meanDistance) +
                            number("%.2f %% at most", 100 * check.maxDistance));
        ImGui::TableSetColumnIndex(1);
        help("from the cage to the model; parts of the model's longest side");
        row("Angles", number("%.1f degrees at least", check.minAngleDegrees));
        if (!check.valid() || !check.bounding()) {
            row("Bad faces", std::to_string(check.badFaces.size()) + ", in red");
            row("Contacts", std::to_string(check.contactFaces) + " faces touch the model");
            row("Outside", std::to_string(check.modelVerticesOutside) + " points of the model");
        }
        if (!made->order.cage) {
            row("Voxels", std::to_string(made->report.resolution) + " along the longest side");
        }
        buildPose(context);
        ImGui::EndTable();
    }
    if (!made->order.cage) {
        ImGui::PushTextWrapPos(0);
        for (const std::string& remark : report::remarks(made->report, made->order.options)) muted(remark);
        ImGui::PopTextWrapPos();
    }
    const bool showsTimes = context.content.session.state().view.times;
    if (showsTimes && section("Times of the stages", false)) {
        if (ImGui::BeginTable("stages", 2)) {
            ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, length(92));
            ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
            buildStages(*made);
            ImGui::EndTable();
        }
    }
    if (showsTimes) context.name("stages");
    ImGui::PopStyleVar();
}

void buildStatusLine(const PanelContext& context)
{
    const Planner& planner = context.content.planner;
    const Document& document = context.content.session.state().document;
    const auto part = [](const std::string& text, const draw::Colour& colour = theme::text) {
        coloured(colour, text);
        ImGui::SameLine(0, length(18));
    };
    if (!document.model) {
        muted("No model. Drop a file here (" + detail::joined(meshExtensions(), " ") +
              ", or a scene .json), or use File > Open model.");
        return;
    }
    part(document.model->path.filename().string());
    if (const CageResultPtr& made = planner.made()) {
        const CageCheck& check = made->report.check;
        part(facesOf(check));
        const float verdict = ImGui::GetCursorPosX();
        if (check.volumeRatio > 0) part(number("volume x %.2f", check.volumeRatio));
        part(number("distance %.2f %%", 100 * check.meanDistance));
        part(verdictOf(check), check.bounding() ? theme::good : theme::bad);
        buildFit(context, !check.bounding(), verdict + length(385));
        if (context.content.session.state().view.times) part(number("%.2f s", made->seconds), theme::mutedText);
    }
    buildBinding(context);
    if (const auto& saving = context.content.saving) {
        std::string text = "saving";
        if (!saving->stage.empty()) text += ": " + saving->stage;
        if (saving->percent >= 0) text += ' ' + std::to_string(saving->percent) + " %";
        part(text, theme::accent);
        help("Escape stops it");
        ImGui::NewLine();
    } else if (const std::string& note = context.content.note; !note.empty()) {
        const float width = ImGui::CalcTextSize(note.c_str()).x;
        const float right = ImGui::GetWindowContentRegionMax().x - width;
        if (right > ImGui::GetCursorPosX()) ImGui::SetCursorPosX(right);
        muted(note);
    } else {
        ImGui::NewLine();
    }
}

} // namespace vdbcage::view
