#include <tools/view/panels/panels.h>

#include <tools/view/panels/parts.h>

namespace vdbcage::view {

namespace {

// Lengths on an ordinary screen.
constexpr float menuHeight = 26, toolbarHeight = 38, statusHeight = 28, timeLineHeight = 76, layersWidth = 256,
                optionsWidth = 392;

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_NoSavedSettings;

/// Builds a window with a fixed place.
template <class Build>
void pane(const char* name, const Rectangle& place, ImGuiWindowFlags flags, const Build& build)
{
    ImGui::SetNextWindowPos({static_cast<float>(place.left), static_cast<float>(place.top)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::Begin(name, nullptr, fixed | flags);
    ImGui::PopStyleVar(2);
    build();
    ImGui::End();
}

int scaled(float pixels, float by)
{
    return static_cast<int>(pixels * by);
}

} // namespace

struct Panels::State {
    std::map<std::string, Rectangle> places;
    std::string revealed;
    std::map<std::string, std::string> typed;
    FileBrowser browser;
    TimeLineMemory timeLine;
    bool isHelpOpen = false;
    std::filesystem::path suggested; ///< the folder where files are looked for first
};

Panels::Panels() : state_(std::make_unique<State>())
{
}
Panels::~Panels() = default;

Rectangle Panels::picturePlace(int width, int height, float by, bool hasTimeLine)
{
    const int left = scaled(layersWidth, by), top = scaled(menuHeight, by) + scaled(toolbarHeight, by);
    const int below = scaled(statusHeight, by) + (hasTimeLine ? scaled(timeLineHeight, by) : 0);
    return {left, top, std::max(1, width - left - scaled(optionsWidth, by)), std::max(1, height - top - below)};
}

void Panels::build(const PanelContent& content, PanelAnswer& answer)
{
    state_->places.clear();
    const PanelContext context(content, answer, state_->places, state_->revealed);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
    const bool hasTimeLine = content.session.state().view.mode == Mode::pose;
    const Rectangle middle = picturePlace(width, height, scale(), hasTimeLine);
    const int below = middle.top + middle.height, right = middle.left + middle.width;
    const int bottom = std::max(below, height - scaled(statusHeight, scale()));

    buildOverlays(context, middle);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {length(10), length(10)});
    // The bars are always there: a slider whose width changes while it is dragged changes its value.
    pane("layers", {0, middle.top, middle.left, bottom - middle.top}, ImGuiWindowFlags_AlwaysVerticalScrollbar,
         [&] { buildLayers(context, state_->typed); });
    pane("options", {right, middle.top, width - right, bottom - middle.top}, ImGuiWindowFlags_AlwaysVerticalScrollbar,
         [&] {
             buildOptions(context, state_->typed);
             buildResult(context);
         });
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {length(10), length(6)});
    const int barTop = scaled(menuHeight, scale());
    pane("toolbar", {0, barTop, width, middle.top - barTop},
         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse, [&] { buildToolbar(context); });
    if (hasTimeLine) {
        pane("time line", {middle.left, below, middle.width, bottom - below},
             ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse,
             [&] { buildTimeLine(context, state_->typed, state_->timeLine); });
    }
    ImGui::PushStyleColor(ImGuiCol_WindowBg, toImGui(theme::title));
    pane("status", {0, bottom, width, height - bottom},
         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse, [&] { buildStatusLine(context); });
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    buildMenu(context);
    buildDialogs(context, state_->isHelpOpen, state_->browser);
    const Document& document = content.session.state().document;
    if (document.model) state_->suggested = document.model->path;
}

const std::map<std::string, Rectangle>& Panels::places() const
{
    return state_->places;
}

void Panels::reveal(const std::string& name)
{
    state_->revealed = name;
}

void Panels::browse(const std::string& line)
{
    open(state_->browser, line, state_->suggested);
}

void Panels::showHelp()
{
    state_->isHelpOpen = true;
}

bool Panels::dismiss()
{
    const bool isOpen = state_->browser.isOpen || state_->isHelpOpen;
    state_->browser.isOpen = false;
    state_->isHelpOpen = false;
    return isOpen;
}

} // namespace vdbcage::view
