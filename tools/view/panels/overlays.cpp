// Overlays of the picture. None of them takes the pointer.
#include <algorithm>
#include <cstdio>

#include <tools/view/panels/parts.h>
#include <tools/view/picture/distance_colours.h>
#include <vdbcage/core/detail/length_text.h>

namespace vdbcage::view {

namespace {

constexpr draw::Colour inkColour{0.20F, 0.21F, 0.23F};

/// Returns the options by which two cages differ, in words: "faces 300, not 400".
std::string differences(const CageOptions& made, const CageOptions& wanted)
{
    const auto have = optionValues(made), want = optionValues(wanted);
    std::string text;
    for (std::size_t i = 0; i < have.size(); ++i) {
        if (have[i].second == want[i].second) continue;
        text += (text.empty() ? "" : ", ") + have[i].first + ' ' + have[i].second + " (now " + want[i].second + ')';
    }
    return text;
}

/// Returns a note on an opened cage or a fit that is not the wanted one.
std::string openedText(const PanelContent& content)
{
    const Document& document = content.session.state().document;
    if (content.planner.made()->order.cage != document.cage) return "Shown is the cage that was opened before";
    if (!document.isFitted) return {}; // its fit was undone
    const std::string shown = content.planner.made()->order.fit ? "shown is the fit before" : "shown is the drawn cage";
    if (content.planner.isHalted()) return "The fit was cancelled; " + shown;
    const int percent = content.progress ? content.progress->percent : -1;
    return "Fitting" + (percent >= 0 ? ' ' + std::to_string(percent) + " %" : "") + "; " + shown;
}

/// Returns a note on the made cage; empty if it is the wanted one.
std::string standingText(const PanelContent& content)
{
    const Planner& planner = content.planner;
    const CageResultPtr& made = planner.made();
    if (!made) return {};
    switch (planner.standing()) {
    case Planner::Standing::preview:
        return "Preview, made with least effort";
    case Planner::Standing::stale:
        if (made->order.cage) return openedText(content);
        return "Shown is the last good cage: " +
               differences(made->order.options, content.session.state().document.options);
    case Planner::Standing::current:
        if (!made->fitProblem.empty()) return "The cage is not fitted: " + made->fitProblem;
        break;
    case Planner::Standing::none:
        break;
    }
    return {};
}

void drawPill(ImDrawList& list, const Rectangle& place, const std::string& text, const draw::Colour& colour)
{
    const float wrap = static_cast<float>(place.width) - length(60);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 pad{length(12), length(5)};
    const ImVec2 low{
        std::round(static_cast<float>(place.left) + (static_cast<float>(place.width) - size.x) / 2 - pad.x),
        static_cast<float>(place.top) + length(12)};
    const ImVec2 high{low.x + size.x + 2 * pad.x, low.y + size.y + 2 * pad.y};
    list.AddRectFilled(low, high, packed(theme::panel, 0.92F), length(6));
    list.AddRect(low, high, packed(colour), length(6), 0, std::max(1.0F, length(1)));
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + pad.x, low.y + pad.y}, packed(theme::text),
                 text.c_str(), nullptr, wrap);
}

void drawAxes(ImDrawList& list, const Rectangle& place, const std::array<openvdb::Vec3d, 3>& axes)
{
    constexpr std::array<draw::Colour, 3> colours{
        {{0.80F, 0.22F, 0.20F}, {0.25F, 0.58F, 0.20F}, {0.18F, 0.38F, 0.80F}}};
    const ImVec2 centre{static_cast<float>(place.left) + length(46),
                        static_cast<float>(place.top + place.height) - length(50)};
    std::array<std::size_t, 3> order{0, 1, 2};
    // The nearest axis is drawn last.
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return axes[a].z() < axes[b].z(); });
    for (const std::size_t i : order) {
        const ImVec2 tip{centre.x + length(28) * static_cast<float>(axes[i].x()),
                         centre.y - length(28) * static_cast<float>(axes[i].y())};
        list.AddLine(centre, tip, packed(colours[i]), length(2));
        list.AddCircleFilled(tip, length(8), packed(colours[i]), 24);
        const std::string label(1, static_cast<char>('X' + i));
        const ImVec2 size = ImGui::CalcTextSize(label.c_str());
        list.AddText({std::round(tip.x - size.x / 2), std::round(tip.y - size.y / 2)}, packed({1, 1, 1}),
                     label.c_str());
    }
}

void drawLegend(ImDrawList& list, const Rectangle& place, double largest)
{
    const float width = length(14), height = length(120);
    const ImVec2 low{static_cast<float>(place.left + place.width) - length(86),
                     static_cast<float>(place.top + place.height) - height - length(34)};
    constexpr int steps = 24;
    for (int i = 0; i < steps; ++i) {
        const float top = low.y + height * static_cast<float>(i) / steps;
        list.AddRectFilled({low.x, top}, {low.x + width, low.y + height * static_cast<float>(i + 1) / steps},
                           packed(distanceColour(1 - (i + 0.5) / steps)));
    }
    list.AddRect(low, {low.x + width, low.y + height}, packed(inkColour));
    const auto label = [&](double share, const char* format) {
        char text[32];
        std::snprintf(text, sizeof text, format, 100 * share * largest);
        const float y = low.y + height * static_cast<float>(1 - share) - ImGui::GetFontSize() / 2;
        list.AddText({low.x + width + length(6), std::round(y)}, packed(inkColour), text);
    };
    label(1, "%.2f %%");
    label(0.5, "%.2f %%");
    label(0, "%.0f");
}

constexpr draw::Colour pointColour{0.10F, 0.22F, 0.48F}, selectedColour{0.95F, 0.50F, 0.05F},
    hotColour{1.0F, 0.80F, 0.10F}, lockedColour{0.62F, 0.10F, 0.55F}, white{1, 1, 1};

ImVec2 inWindow(const Rectangle& place, const Pixel& at)
{
    return {static_cast<float>(place.left + at[0]), static_cast<float>(place.top + at[1])};
}

std::vector<ImVec2> inWindow(const Rectangle& place, const std::vector<Pixel>& line)
{
    std::vector<ImVec2> points;
    for (const Pixel& at : line) points.push_back(inWindow(place, at));
    return points;
}

void drawGizmo(ImDrawList& list, const Rectangle& place, const PictureOverlay& overlay)
{
    for (const GizmoPart& part : overlay.gizmo) {
        const bool isHot = overlay.hot && *overlay.hot == part.handle;
        const draw::Colour& colour = isHot ? hotColour : part.colour;
        const std::vector<ImVec2> line = inWindow(place, part.line);
        const int count = static_cast<int>(line.size());
        if (!part.isFilled) {
            // A pale rim makes it visible on any ground.
            list.AddPolyline(line.data(), count, packed(white, 0.6F), 0, length(5));
            list.AddPolyline(line.data(), count, packed(colour), 0, length(3));
            continue;
        }
        const float opacity = part.handle.kind == Handle::Kind::axis ? 1 : isHot ? 0.7F : 0.4F;
        list.AddConvexPolyFilled(line.data(), count, packed(colour, opacity));
        list.AddPolyline(line.data(), count, packed(colour), ImDrawFlags_Closed, length(1));
    }
}

void drawEditing(ImDrawList& list, const Rectangle& place, const PictureOverlay& overlay)
{
    for (const auto& edge : overlay.edges) {
        list.AddLine(inWindow(place, edge[0]), inWindow(place, edge[1]), packed(selectedColour), length(3));
    }
    for (const PictureOverlay::Point& point : overlay.points) {
        const ImVec2 at = inWindow(place, point.at);
        if (point.isLocked) {
            const auto square = [&](float half, const draw::Colour& colour) {
                list.AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, packed(colour));
            };
            square(length(6), white);
            square(length(5), lockedColour);
            square(length(3), point.isSelected ? selectedColour : white);
            continue;
        }
        const float radius = length(point.isSelected ? 5 : 4);
        list.AddCircleFilled(at, radius, packed(white), 16);
        list.AddCircleFilled(at, radius - length(1), packed(point.isSelected ? selectedColour : pointColour), 16);
    }
    drawGizmo(list, place, overlay);
    if (overlay.band.size() > 1) {
        const std::vector<ImVec2> line = inWindow(place, overlay.band);
        list.AddPolyline(line.data(), static_cast<int>(line.size()), packed(white, 0.8F), ImDrawFlags_Closed,
                         length(3));
        list.AddPolyline(line.data(), static_cast<int>(line.size()), packed(pointColour), ImDrawFlags_Closed,
                         length(1));
    }
}

/// Draws the editing overlay of each picture, and the names of the coordinates if there are two.
void drawPictures(ImDrawList& list, const PanelContent& content)
{
    const State& state = content.session.state();
    for (const Rectangle& picture : content.pictures) {
        const ImVec2 low{static_cast<float>(picture.left), static_cast<float>(picture.top)};
        const ImVec2 high{low.x + static_cast<float>(picture.width), low.y + static_cast<float>(picture.height)};
        list.PushClipRect(low, high, true);
        drawEditing(list, picture, content.overlay);
        if (content.pictures.size() > 1) {
            const bool isFirst = &picture == &content.pictures.front();
            const Coordinates family =
                isFirst ? state.document.coordinates : state.view.compared.value_or(state.document.coordinates);
            list.AddText({low.x + length(12), low.y + length(10)}, packed(inkColour), titleOf(family));
            if (!isFirst) list.AddLine(low, {low.x, high.y}, packed(theme::line), length(2));
        }
        list.PopClipRect();
    }
}

} // namespace

void buildOverlays(const PanelContext& context, const Rectangle& place)
{
    const PanelContent& content = context.content;
    const ViewState& view = content.session.state().view;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({static_cast<float>(place.left), static_cast<float>(place.top)},
                      {static_cast<float>(place.left + place.width), static_cast<float>(place.top + place.height)});
    if (content.session.state().document.model) {
        drawPictures(list, content);
        if (view.axes) drawAxes(list, place, content.axes);
        if (view.ground) {
            const std::string text = "grid " + detail::lengthText(content.gridStep, content.gridStep);
            list.AddText({static_cast<float>(place.left) + length(92),
                          static_cast<float>(place.top + place.height) - length(30)},
                         packed(inkColour), text.c_str());
        }
        if (content.largestDistance > 0) drawLegend(list, place, content.largestDistance);
    } else {
        const char* const text = "Drop a model here";
        const ImVec2 size = ImGui::CalcTextSize(text);
        list.AddText({std::round(static_cast<float>(place.left) + (static_cast<float>(place.width) - size.x) / 2),
                      std::round(static_cast<float>(place.top) + static_cast<float>(place.height) / 2)},
                     packed(inkColour), text);
    }
    const std::string standing = standingText(content);
    if (!content.overlay.hint.empty()) {
        drawPill(list, place, content.overlay.hint, theme::accent);
    } else if (content.isPosedCoarsely) {
        drawPill(list, place, "Preview: a coarse model follows the cage until the model is bound", theme::accent);
    } else if (!standing.empty()) {
        const bool isWorking = content.planner.standing() == Planner::Standing::preview ||
                               (content.progress && content.session.state().document.isFitted);
        drawPill(list, place, standing, isWorking ? theme::accent : theme::warning);
    }
    list.PopClipRect();
}

} // namespace vdbcage::view
