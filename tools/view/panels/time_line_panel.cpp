#include <algorithm>
#include <cmath>

#include <tools/view/panels/parts.h>
#include <vdbcage/core/detail/number_text.h>

namespace vdbcage::view {

namespace {

/// The least number of frames that a track shows.
constexpr int leastFrames = 24;

/// The places of frames along a track, in pixels of the window.
struct Track {
    float left = 0, right = 0;
    int last = leastFrames; ///< the frame at `right`

    float placeOf(int frame) const
    {
        return left + (right - left) * static_cast<float>(frame) / static_cast<float>(last);
    }
    int frameAt(float x) const
    {
        const float share = std::clamp((x - left) / std::max(1.0F, right - left), 0.0F, 1.0F);
        return static_cast<int>(std::lround(share * static_cast<float>(last)));
    }
    /// Returns the frames between two written numbers: 1, 2 or 5 times a power of ten, so that the numbers do not
    /// touch.
    int step() const
    {
        for (int power = 1; power <= lastFrame; power *= 10) {
            for (const int step : {power, 2 * power, 5 * power}) {
                if (placeOf(step) - left >= length(44)) return step;
            }
        }
        return lastFrame;
    }
};

void buildControls(const PanelContext& context, std::map<std::string, std::string>& typed)
{
    const State& state = context.content.session.state();
    const ViewState& view = state.view;
    const TimeLine& poses = state.document.poses;
    const auto arrow = [&](const char* id, ImGuiDir direction, const Action& action, const char* text) {
        if (ImGui::ArrowButton(id, direction)) context.ask(action);
        context.name(textOf(action));
        help(context.withKey(text, action));
        ImGui::SameLine(0, length(2));
    };
    const bool canPlay = poses.keys().size() > 1;
    arrow("##previous", ImGuiDir_Left, PreviousKey{}, "the key before");
    ImGui::BeginDisabled(!canPlay && !view.isPlaying);
    if (ImGui::Button(view.isPlaying ? "Stop" : "Play", {length(52), 0})) context.ask(Toggle{"play"});
    ImGui::EndDisabled();
    context.name("play");
    help(context.withKey("shows the frames from the first key to the last, again and again", Toggle{"play"}));
    ImGui::SameLine(0, length(2));
    arrow("##next", ImGuiDir_Right, NextKey{}, "the next key");
    ImGui::SameLine(0, length(12));
    ImGui::AlignTextToFramePadding();
    muted("Frame");
    ImGui::SameLine(0, length(6));
    if (const auto frame = typedField(context, typed, "time", std::to_string(view.frame), length(50))) {
        context.askTyped<SetFrame>({*frame});
    }
    help("whose pose is seen and changed");
    ImGui::SameLine(0, length(12));
    muted("Rate");
    ImGui::SameLine(0, length(6));
    if (const auto rate = typedField(context, typed, "rate", detail::numberText(view.framesPerSecond), length(40))) {
        context.askTyped<SetRate>({*rate});
    }
    help("frames a second, 1 to 240");
    ImGui::SameLine(0, length(18));

    const PoseKey* const key = poses.keyAt(view.frame);
    ImGui::BeginDisabled(!context.content.session.cage());
    const float buttonWidth = length(70);
    const float nameWidth = ImGui::GetContentRegionAvail().x - buttonWidth - length(4);
    if (const auto name = typedField(context, typed, "key.name", key ? key->name : std::string(),
                                     std::clamp(nameWidth, length(36), length(200)), key ? "a name" : "no key here")) {
        context.ask(SetKey{view.frame, *name});
    }
    help("the name of the key at this frame");
    ImGui::SameLine(0, length(4));
    if (ImGui::Button(key ? "Remove" : "Insert", {buttonWidth, 0})) {
        context.ask(key ? Action(RemoveKey{}) : InsertKey{});
    }
    context.name("key");
    help(key ? context.withKey("takes the pose at this frame off the time line", RemoveKey{})
             : context.withKey("keeps the pose that is seen at this frame", InsertKey{}) +
                   "; whatever is moved is kept by itself");
    ImGui::EndDisabled();
}

void drawKey(ImDrawList& list, const ImVec2& at, const draw::Colour& colour)
{
    const float radius = length(5);
    list.AddQuadFilled({at.x, at.y - radius}, {at.x + radius, at.y}, {at.x, at.y + radius}, {at.x - radius, at.y},
                       packed(colour));
}

void drawTrack(const State& state, const Track& track, const ImVec2& low, const ImVec2& high,
               const std::optional<int>& moved, int movedTo)
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, packed(theme::field), length(3));
    const TimeLine& poses = state.document.poses;
    const float keyLine = high.y - length(9);
    if (!poses.isEmpty()) {
        list.AddRectFilled({track.placeOf(poses.firstFrame()), keyLine - length(2)},
                           {track.placeOf(poses.finalFrame()), keyLine + length(2)}, packed(theme::selected));
    }
    const int step = track.step();
    for (int frame = 0; frame <= track.last; frame += step) {
        const float x = std::round(track.placeOf(frame));
        list.AddLine({x, low.y + length(2)}, {x, high.y - length(2)}, packed(theme::line));
        list.AddText({x + length(3), low.y}, packed(theme::mutedText), std::to_string(frame).c_str());
    }
    const float now = std::round(track.placeOf(state.view.frame));
    list.AddLine({now, low.y}, {now, high.y}, packed(theme::accent), length(2));
    for (const PoseKey& key : poses.keys()) {
        const int frame = moved && *moved == key.frame ? movedTo : key.frame;
        drawKey(list, {track.placeOf(frame), keyLine}, frame == state.view.frame ? theme::accent : theme::text);
    }
}

/// Returns the frame of the key that is hit at `x`; none if there is none.
std::optional<int> nearestKey(const TimeLine& poses, const Track& track, float x)
{
    std::optional<int> nearest;
    float distance = length(6);
    for (const PoseKey& key : poses.keys()) {
        const float there = std::abs(track.placeOf(key.frame) - x);
        if (there > distance) continue;
        distance = there;
        nearest = key.frame;
    }
    return nearest;
}

void buildTrack(const PanelContext& context, TimeLineMemory& memory)
{
    const State& state = context.content.session.state();
    const TimeLine& poses = state.document.poses;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, length(32)};
    const ImVec2 high{low.x + size.x, low.y + size.y};
    if (size.x < length(60)) return;
    Track track;
    track.left = low.x + length(10);
    track.right = high.x - length(26);
    ImGui::InvisibleButton("##track", size);
    context.name("time-line");
    context.followDrag();
    // A track keeps its length while it is dragged; else the length follows the frame.
    if (!ImGui::IsItemActive() && !ImGui::IsItemDeactivated()) memory = {};
    track.last = memory.last.value_or(std::max({leastFrames, poses.finalFrame(), state.view.frame}));
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    if (ImGui::IsItemActivated()) {
        memory.last = track.last;
        if (pointer.y > high.y - length(18)) memory.draggedKey = nearestKey(poses, track, pointer.x);
        if (memory.draggedKey) memory.besideKey = pointer.x - track.placeOf(*memory.draggedKey);
    }
    const int frame = track.frameAt(pointer.x - memory.besideKey);
    if (memory.draggedKey) {
        if (ImGui::IsItemDeactivated()) {
            const int from = *memory.draggedKey;
            if (frame != from) context.ask(MoveKey{from, frame});
            if (frame != state.view.frame) context.ask(SetFrame{frame});
        }
    } else if (ImGui::IsItemActive() && frame != state.view.frame) {
        context.ask(SetFrame{frame});
    }
    const PoseKey* const hovered = ImGui::IsItemHovered() ? poses.keyAt(frame) : nullptr;
    if (hovered && !hovered->name.empty()) help(hovered->name + " (frame " + std::to_string(frame) + ')');
    drawTrack(state, track, low, high, memory.draggedKey, frame);
}

} // namespace

void buildTimeLine(const PanelContext& context, std::map<std::string, std::string>& typed, TimeLineMemory& memory)
{
    ImGui::BeginDisabled(!context.content.session.state().document.model);
    buildControls(context, typed);
    buildTrack(context, memory);
    ImGui::EndDisabled();
}

} // namespace vdbcage::view
