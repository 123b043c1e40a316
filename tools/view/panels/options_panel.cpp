// A row for every option, made from visitOptions: its widget follows from its type and its entry there.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <tools/view/panels/parts.h>
#include <tools/view/state/preset.h>
#include <vdbcage/core/detail/number_text.h>

namespace vdbcage::view {

namespace {

// Widths on an ordinary screen.
constexpr float labelWidth = 128, fieldWidth = 70, autoWidth = 44, resetWidth = 24;

/// Returns the place of a number between its ends on a slider, 0 to 1. Ranges of more than a factor of 100 are
/// logarithmic, those from 0 are finer near 0.
double placeOf(double value, const Range& range)
{
    const double span = range.most - range.least;
    if (!(span > 0)) return 0;
    if (range.least > 0 && range.most / range.least > 100) {
        return std::log(value / range.least) / std::log(range.most / range.least);
    }
    const double share = (value - range.least) / span;
    return range.least == 0 && range.most <= 1 ? std::sqrt(std::max(0.0, share)) : share;
}

double valueAt(double place, const Range& range)
{
    if (place <= 0) return range.least;
    if (place >= 1) return range.most;
    if (range.least > 0 && range.most / range.least > 100) {
        return range.least * std::pow(range.most / range.least, place);
    }
    const double share = range.least == 0 && range.most <= 1 ? place * place : place;
    return range.least + share * (range.most - range.least);
}

/// Returns the value with three digits, which a slider can set.
double rounded(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return std::strtod(text, nullptr);
}

/// Returns the value in the form that setOption reads.
std::string textOf(double value, bool isWhole)
{
    return isWhole ? std::to_string(std::lround(value)) : detail::numberText(rounded(value));
}

std::string unitOf(const OptionInfo& info)
{
    const std::string symbol = info.symbol;
    if (symbol == "F") return "Unit: the model's longest side.";
    if (symbol == "DEG") return "Unit: degrees.";
    return {};
}

class Row {
public:
    Row(const PanelContext& context, std::map<std::string, std::string>& typed, const OptionText& text,
        const OptionInfo& info, const std::string& value)
        : context_(context), typed_(typed), text_(text), info_(info), name_(text.name), value_(value)
    {
    }

    void build(int number, const std::optional<double>& /*came*/) const { buildNumber(number, true, {}); }
    void build(double number, const std::optional<double>& /*came*/) const { buildNumber(number, false, {}); }
    template <class Number>
    void build(const std::optional<Number>& number, const std::optional<double>& came) const
    {
        const double shown = number ? static_cast<double>(*number) : came.value_or(info_.range.least);
        buildNumber(shown, std::is_integral_v<Number>, Auto{!number.has_value(), came});
    }
    void build(const FactorField&, const std::optional<double>&) const { buildText(); }
    void build(const Joints&, const std::optional<double>&) const { buildText(); }
    template <class Name>
    void build(Name, const std::optional<double>&) const
    {
        buildChoice();
    }

    void buildLabel() const
    {
        std::string label = text_.name;
        std::replace(label.begin(), label.end(), '-', ' ');
        label[0] = static_cast<char>(label[0] - 'a' + 'A');
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(label.c_str());
        std::string about = text_.help + ".";
        about[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(about[0])));
        if (!text_.range.empty()) about += "\nRange: " + text_.range + ".";
        if (const std::string unit = unitOf(info_); !unit.empty()) about += "\n" + unit;
        about += "\nDefault: " + text_.defaultValue + ".";
        help(about);
    }

    void buildReset() const
    {
        if (value_ == text_.defaultValue) return;
        if (ImGui::Button("\xe2\x86\xba", {length(resetWidth), 0})) context_.ask(ResetOptions{{name_}});
        context_.name(name_ + ".reset");
        help("back to " + text_.defaultValue);
    }

private:
    /// The state of an option that can be left to the pipeline.
    struct Auto {
        bool isOn = false;
        std::optional<double> came; ///< the pipeline's choice
    };

    void ask(const std::string& value) const { context_.ask(SetOption{name_, value}); }

    /// Builds a field whose text is taken over by Enter or a click elsewhere.
    void buildField(const std::string& shown, float width) const
    {
        if (const auto text = typedField(context_, typed_, name_, shown, width)) ask(*text);
    }

    void buildNumber(double number, bool isWhole, const std::optional<Auto>& automatic) const
    {
        const bool isAuto = automatic && automatic->isOn;
        const bool isKnown = !isAuto || automatic->came;
        float place = isKnown ? static_cast<float>(placeOf(number, info_.range)) : 0;
        ImGui::SetNextItemWidth(-length(fieldWidth + autoWidth + resetWidth + 18));
        if (isAuto) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.5F);
        if (ImGui::SliderFloat("##slider", &place, 0, 1, "", pointerOnly)) {
            const double value = valueAt(double{place}, info_.range);
            ask(textOf(std::clamp(rounded(value), info_.range.least, info_.range.most), isWhole));
        }
        context_.followDrag();
        context_.name(name_ + ".slider");
        if (isAuto) ImGui::PopStyleVar();
        ImGui::SameLine(0, length(4));
        if (isAuto) ImGui::PushStyleColor(ImGuiCol_Text, toImGui(theme::mutedText));
        // The pipeline's choice is rounded for reading.
        buildField(isAuto ? (automatic->came ? detail::numberText(rounded(*automatic->came)) : "auto") : value_,
                   length(fieldWidth));
        if (isAuto) ImGui::PopStyleColor();
        ImGui::SameLine(0, length(4));
        if (automatic) {
            if (isAuto) ImGui::PushStyleColor(ImGuiCol_Button, toImGui(theme::selected));
            if (ImGui::Button("auto", {length(autoWidth), 0})) {
                ask(isAuto ? textOf(number, isWhole) : "auto");
            }
            if (isAuto) ImGui::PopStyleColor();
            context_.name(name_ + ".auto");
            help(isAuto ? "chosen for you; press to keep the chosen value" : "press to have it chosen for you");
        } else {
            ImGui::Dummy({length(autoWidth), 1});
        }
        ImGui::SameLine(0, length(4));
    }

    void buildChoice() const
    {
        ImGui::SetNextItemWidth(-length(resetWidth + 8));
        const bool isOpen = ImGui::BeginCombo("##choice", value_.c_str());
        context_.name(name_);
        if (isOpen) {
            std::size_t begin = 0;
            while (begin <= text_.value.size()) {
                const std::size_t end = std::min(text_.value.find('|', begin), text_.value.size());
                const std::string choice = text_.value.substr(begin, end - begin);
                if (ImGui::Selectable(choice.c_str(), choice == value_)) ask(choice);
                context_.name(name_ + '.' + choice);
                begin = end + 1;
            }
            ImGui::EndCombo();
        }
        ImGui::SameLine(0, length(4));
    }

    void buildText() const
    {
        buildField(value_, -length(resetWidth + 8));
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
            help("none, or parts with semicolons between them:\nsphere:X,Y,Z,RADIUS,SCALE\nbox:X,Y,Z,X,Y,Z,SCALE\n"
                 "a .vdb file");
        }
        ImGui::SameLine(0, length(4));
    }

    const PanelContext& context_;
    std::map<std::string, std::string>& typed_;
    const OptionText& text_;
    const OptionInfo& info_;
    const std::string& name_;
    const std::string& value_;
};

/// Returns the pipeline's choice for `auto` in the made cage, by the option's name.
std::optional<double> cameTo(const std::string& name, const CageResultPtr& made)
{
    if (!made || made->order.cage) return std::nullopt;
    const CageReport& report = made->report;
    if (name == "resolution") return report.resolution;
    if (name == "close-radius") return report.closeRadius;
    if (name == "erode-radius") return report.erodeRadius;
    if (name == "min-angle") return report.minAngle;
    if (name == "merge-angle") return report.mergeAngle;
    if (name == "smooth") return report.smooth;
    return std::nullopt;
}

void buildPresets(const PanelContext& context)
{
    const CageOptions& options = context.content.session.state().document.options;
    const auto count = static_cast<float>(presets().size());
    const float gap = length(4);
    const float width = std::floor((ImGui::GetContentRegionAvail().x - (count - 1) * gap) / count);
    for (const Preset& preset : presets()) {
        if (&preset != &presets().front()) ImGui::SameLine(0, gap);
        std::string label = preset.name;
        label[0] = static_cast<char>(label[0] - 'a' + 'A');
        const bool isOn = areEqual(presetOptions(preset.name), options);
        if (isOn) ImGui::PushStyleColor(ImGuiCol_Button, toImGui(theme::selected));
        if (ImGui::Button(label.c_str(), {width, 0})) context.ask(ApplyPreset{preset.name});
        if (isOn) ImGui::PopStyleColor();
        context.name("preset." + preset.name);
        help(preset.help);
    }
}

void buildProgress(const PanelContext& context)
{
    const Planner& planner = context.content.planner;
    const auto& progress = context.content.progress;
    const bool isMaking = progress && progress->kind != Job::Kind::ahead;
    const float width = length(84);
    std::string text = "nothing to do";
    float share = 0;
    if (isMaking) {
        text = (progress->kind == Job::Kind::preview ? "preview: " : "") + progress->stage;
        if (progress->percent >= 0) {
            text += ' ' + std::to_string(progress->percent) + " %";
            share = static_cast<float>(progress->percent) / 100;
        }
    } else if (!context.content.session.state().document.model) {
        text = "open a model, or drop one here";
    } else if (!planner.error().empty()) {
        text = "it cannot be made";
    } else if (planner.isHalted()) {
        text = "cancelled";
    } else if (planner.standing() == Planner::Standing::current) {
        text = "done";
        share = 1;
    }
    ImGui::ProgressBar(share, {-width - length(6), 0}, "");
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(),
                 size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetWindowDrawList()->AddText(
        {std::round((low.x + high.x - size.x) / 2), std::round((low.y + high.y - size.y) / 2)}, packed(theme::text),
        text.c_str());
    ImGui::SameLine(0, length(6));
    if (isMaking) {
        if (ImGui::Button("Cancel", {width, 0})) context.ask(Cancel{});
    } else {
        ImGui::BeginDisabled(!planner.isHalted());
        if (mainButton("Make", width)) context.ask(MakeAgain{});
        ImGui::EndDisabled();
    }
    context.name(isMaking ? "cancel" : "make");
    const auto complain = [&](const char* name, const std::string& problem) {
        ImGui::PushTextWrapPos(0);
        coloured(theme::bad, problem);
        ImGui::PopTextWrapPos();
        context.name(name);
    };
    if (!planner.error().empty()) complain("error.cage", planner.error());
    const std::string& binding = context.content.bindingError;
    if (!binding.empty()) complain("error.pose", "The pose is not followed: " + binding);
}

} // namespace

void buildOptions(const PanelContext& context, std::map<std::string, std::string>& typed)
{
    CageOptions options = context.content.session.state().document.options;
    const std::vector<OptionText> texts = describeOptions();
    const auto values = optionValues(options);
    heading("Options");
    buildPresets(context);
    ImGui::Dummy({0, length(2)});
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {length(2), length(2)});
    if (ImGui::BeginTable("options", 2)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, length(labelWidth));
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
        std::size_t i = 0;
        visitOptions(options, [&](const OptionInfo& info, auto& field) {
            const Row row(context, typed, texts[i], info, values[i].second);
            ImGui::PushID(info.name);
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            row.buildLabel();
            ImGui::TableNextColumn();
            row.build(field, cameTo(info.name, context.content.planner.made()));
            row.buildReset();
            ImGui::PopID();
            ++i;
        });
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::Dummy({0, length(2)});
    buildProgress(context);
}

} // namespace vdbcage::view
