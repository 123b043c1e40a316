#include <tools/view/widgets/widgets.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include <imgui.h>

#include <embedded/fonts.h>
#include <tools/view/widgets/imgui_versions.h>
#include <tools/view/widgets/theme.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

// Line height of text, in units of length. Inter's letters then have the size that desktops use.
constexpr float textHeight = 16;

// The seconds of ImGui's clock for each layout: long enough for all fading to end within one.
constexpr float secondsOfLayout = 1;

// The letters of file names and figures: Latin, Greek and Cyrillic letters, punctuation, arrows, mathematical signs and
// marks.
constexpr std::array<ImWchar, 21> textRanges{0x0020, 0x017F, 0x0370, 0x03FF, 0x0400, 0x045F, 0x2010,
                                             0x2027, 0x2030, 0x203A, 0x2190, 0x2199, 0x21BA, 0x21BB,
                                             0x2200, 0x2265, 0x25A0, 0x25CF, 0x2713, 0x2717, 0};
constexpr std::array<ImWchar, 3> headingRanges{0x0020, 0x017F, 0};

enum Font { textFont, headingFont };

/// A scope in which a context is ImGui's current one; the previous one is restored at its end.
class Use {
public:
    explicit Use(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(context); }
    ~Use() { ImGui::SetCurrentContext(before_); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

private:
    ImGuiContext* before_;
};

struct Destroy {
    void operator()(ImGuiContext* context) const
    {
        const Use use(context);
        ImGui::DestroyContext(context);
    }
};
using Context = std::unique_ptr<ImGuiContext, Destroy>;

Context makeContext()
{
    // ImGui makes a new context current if none is.
    const Use use(nullptr);
    return Context(ImGui::CreateContext());
}

/// Returns the length in whole pixels, at least one.
float wholePixels(float length)
{
    return std::max(1.0F, std::floor(length));
}

void setColours(ImGuiStyle& style)
{
    const auto set = [&style](ImGuiCol what, const draw::Colour& colour, float opacity = 1) {
        style.Colors[what] = ImVec4(colour[0], colour[1], colour[2], opacity);
    };
    constexpr draw::Colour black{0, 0, 0};
    set(ImGuiCol_Text, theme::text);
    set(ImGuiCol_TextDisabled, theme::mutedText);
    set(ImGuiCol_WindowBg, theme::panel);
    set(ImGuiCol_ChildBg, theme::panel, 0);
    set(ImGuiCol_PopupBg, theme::popup);
    set(ImGuiCol_Border, theme::line);
    set(ImGuiCol_BorderShadow, black, 0);
    set(ImGuiCol_FrameBg, theme::field);
    set(ImGuiCol_FrameBgHovered, theme::fieldHovered);
    set(ImGuiCol_FrameBgActive, theme::fieldActive);
    set(ImGuiCol_TitleBg, theme::title);
    set(ImGuiCol_TitleBgActive, theme::title);
    set(ImGuiCol_TitleBgCollapsed, theme::title);
    set(ImGuiCol_MenuBarBg, theme::title);
    set(ImGuiCol_ScrollbarBg, theme::panel, 0);
    set(ImGuiCol_ScrollbarGrab, theme::grip);
    set(ImGuiCol_ScrollbarGrabHovered, theme::gripHovered);
    set(ImGuiCol_ScrollbarGrabActive, theme::gripHovered);
    set(ImGuiCol_CheckMark, theme::accent);
    set(ImGuiCol_SliderGrab, theme::accentFillHovered); // the value may be drawn on it
    set(ImGuiCol_SliderGrabActive, theme::accentFillHovered);
    set(ImGuiCol_Button, theme::button);
    set(ImGuiCol_ButtonHovered, theme::buttonHovered);
    set(ImGuiCol_ButtonActive, theme::buttonActive);
    set(ImGuiCol_Header, theme::selected);
    set(ImGuiCol_HeaderHovered, theme::buttonHovered);
    set(ImGuiCol_HeaderActive, theme::selected);
    set(ImGuiCol_Separator, theme::line);
    set(ImGuiCol_SeparatorHovered, theme::accent);
    set(ImGuiCol_SeparatorActive, theme::accent);
    set(ImGuiCol_ResizeGrip, theme::grip, 0);
    set(ImGuiCol_ResizeGripHovered, theme::gripHovered);
    set(ImGuiCol_ResizeGripActive, theme::accent);
    set(ImGuiCol_Tab, theme::title);
    set(ImGuiCol_TabHovered, theme::buttonHovered);
    set(ImGuiCol_TabActive, theme::button);
    set(ImGuiCol_TabUnfocused, theme::title);
    set(ImGuiCol_TabUnfocusedActive, theme::button);
    set(ImGuiCol_PlotLines, theme::accent);
    set(ImGuiCol_PlotLinesHovered, theme::text);
    set(ImGuiCol_PlotHistogram, theme::accentFill); // also of progress bars, under text
    set(ImGuiCol_PlotHistogramHovered, theme::accentFillHovered);
    set(ImGuiCol_TableHeaderBg, theme::title);
    set(ImGuiCol_TableBorderStrong, theme::line);
    set(ImGuiCol_TableBorderLight, theme::line);
    set(ImGuiCol_TableRowBg, theme::panel, 0);
    set(ImGuiCol_TableRowBgAlt, theme::field, 0.35F);
    set(ImGuiCol_TextSelectedBg, theme::selected);
    set(ImGuiCol_DragDropTarget, theme::accent);
    set(ImGuiCol_NavHighlight, theme::accent);
    set(ImGuiCol_NavWindowingHighlight, theme::accent);
    set(ImGuiCol_NavWindowingDimBg, black, 0.4F);
    set(ImGuiCol_ModalWindowDimBg, black, 0.5F);
}

void setStyle(ImGuiStyle& style, float scale)
{
    style = ImGuiStyle();
    setColours(style);
    style.WindowPadding = {12, 12};
    style.FramePadding = {8, 4};
    style.CellPadding = {6, 3};
    style.ItemSpacing = {8, 7};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 16;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.WindowRounding = 5;
    style.ChildRounding = 4;
    style.PopupRounding = 4;
    style.FrameRounding = 4;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 3;
    style.TabRounding = 4;
    style.WindowTitleAlign = {0, 0.5F};
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.DisabledAlpha = 0.5F;
    style.ScaleAllSizes(scale);
    const float border = wholePixels(scale); // ImGui does not scale these
    style.WindowBorderSize = style.PopupBorderSize = style.FrameBorderSize = style.ChildBorderSize = border;
}

Glyphs makeGlyphs(ImFontAtlas& atlas, float scale)
{
    const auto add = [&](const unsigned char* data, std::size_t size, const ImWchar* ranges) {
        ImFontConfig config;
        config.FontDataOwnedByAtlas = false;
        // ImGui only reads data that it does not own.
        atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(data), static_cast<int>(size),
                                   std::round(textHeight * scale), &config, ranges);
    };
    // In the order of Font.
    add(fonts::interRegular, sizeof fonts::interRegular, textRanges.data());
    add(fonts::interSemiBold, sizeof fonts::interSemiBold, headingRanges.data());
    atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
    unsigned char* coverage = nullptr;
    Glyphs glyphs;
    atlas.GetTexDataAsAlpha8(&coverage, &glyphs.width, &glyphs.height);
    const auto count = static_cast<std::size_t>(glyphs.width) * static_cast<std::size_t>(glyphs.height);
    glyphs.coverage.assign(coverage, coverage + count);
    imgui::clearSources(atlas);
    return glyphs;
}

/// Returns a number of pixels within [0, limit].
int pixel(float value, int limit)
{
    return static_cast<int>(std::lround(std::clamp(value, 0.0F, static_cast<float>(limit))));
}

/// Appends the triangles of a list, except calls that ImGui keeps for its own back ends; ours makes none.
void append(Drawing& drawing, const ImDrawList& list)
{
    static_assert(sizeof(Drawing::Vertex) == sizeof(ImDrawVert) && sizeof(ImDrawVert) == 20, "the same bytes");
    const std::size_t base = drawing.vertices.size();
    drawing.vertices.resize(base + static_cast<std::size_t>(list.VtxBuffer.Size));
    for (int i = 0; i < list.VtxBuffer.Size; ++i) {
        const ImDrawVert& from = list.VtxBuffer[i];
        Drawing::Vertex& to = drawing.vertices[base + static_cast<std::size_t>(i)];
        const auto channel = [&from](int shift) { return static_cast<std::uint8_t>(from.col >> shift & 0xFF); };
        to = {from.pos.x,
              from.pos.y,
              from.uv.x,
              from.uv.y,
              {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT),
               channel(IM_COL32_A_SHIFT)}};
    }
    for (const ImDrawCmd& command : list.CmdBuffer) {
        Drawing::Batch batch{};
        batch.left = pixel(command.ClipRect.x, drawing.width);
        batch.top = pixel(command.ClipRect.y, drawing.height);
        batch.right = pixel(command.ClipRect.z, drawing.width);
        batch.bottom = pixel(command.ClipRect.w, drawing.height);
        if (command.UserCallback != nullptr || batch.left >= batch.right || batch.top >= batch.bottom) continue;
        batch.texture = imgui::textureOf(command);
        batch.firstIndex = static_cast<std::uint32_t>(drawing.indices.size());
        batch.indexCount = command.ElemCount;
        for (unsigned i = 0; i < command.ElemCount; ++i) {
            const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
            drawing.indices.push_back(static_cast<std::uint32_t>(base + command.VtxOffset + index));
        }
        drawing.batches.push_back(batch);
    }
}

Drawing toDrawing(const ImDrawData& data, int width, int height)
{
    Drawing drawing;
    drawing.width = width;
    drawing.height = height;
    for (int i = 0; i < data.CmdListsCount; ++i) append(drawing, *data.CmdLists[i]);
    return drawing;
}

/// A visitor that passes an event to ImGui: it sets fields of `io` that hold from the next layout on.
struct Feed {
    ImGuiIO& io;

    void operator()(const PointerMoved& moved) const
    {
        imgui::movePointer(static_cast<float>(moved.x), static_cast<float>(moved.y));
    }

    void operator()(const PointerLeft&) const { imgui::movePointer(-FLT_MAX, -FLT_MAX); }

    void operator()(const ButtonDown& down) const
    {
        const auto button = static_cast<std::size_t>(down.button);
        // ImGui counts clicks by its clock. It takes a press for a further one of a row if it comes within this time.
        io.MouseDoubleClickTime = down.clicks > 1 ? FLT_MAX : 0;
        io.MouseClickedLastCount[button] = static_cast<ImU16>(std::clamp(down.clicks, 1, 100) - 1);
        imgui::setButton(down.button, true);
    }

    void operator()(const ButtonUp& up) const { imgui::setButton(up.button, false); }

    void operator()(const WheelTurned& turned) const
    {
        imgui::turnWheel(static_cast<float>(turned.x), static_cast<float>(turned.y));
    }

    void operator()(const KeyDown& down) const { imgui::setKey(down.key, true); }
    void operator()(const KeyUp& up) const { imgui::setKey(up.key, false); }
    void operator()(const Typed& typed) const { io.AddInputCharacter(typed.character); }
};

/// Returns whether ImGui, which has begun to lay out with `event`, takes it. `tookPointer`: whether it took the pointer
/// before.
bool takes(const ImGuiIO& io, const InputEvent& event, bool tookPointer)
{
    // The release goes where the press went, wherever the pointer is by then.
    if (std::holds_alternative<ButtonUp>(event.what)) return tookPointer;
    if (std::holds_alternative<Typed>(event.what)) return io.WantTextInput;
    if (std::holds_alternative<KeyDown>(event.what) || std::holds_alternative<KeyUp>(event.what)) {
        return io.WantCaptureKeyboard;
    }
    return io.WantCaptureMouse;
}

bool isEnterDown(const InputEvent& event)
{
    const auto* down = std::get_if<KeyDown>(&event.what);
    return down != nullptr && (down->key == Key::enter || down->key == Key::keypadEnter);
}

bool popupIsOpen()
{
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

} // namespace

struct Widgets::State {
    State(float scaleIn, Clipboard clipboardIn);

    Drawing layOutOnce(int width, int height, const Build& build, const InputEvent* event);

    float scale;
    Clipboard clipboard;
    std::string pasted; ///< ImGui reads it after `clipboard.get` has returned
    Context context = makeContext();
    Glyphs glyphs;
    Drawing drawing;
    std::vector<bool> held = std::vector<bool>(allKeys().size(), false); ///< keys
    std::uint64_t version = 0;
    bool eventIsTaken = false;
};

Widgets::State::State(float scaleIn, Clipboard clipboardIn) : scale(scaleIn), clipboard(std::move(clipboardIn))
{
    const Use use(context.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
    io.DeltaTime = secondsOfLayout;
    io.KeyRepeatDelay = FLT_MAX; // the keyboard repeats keys, not a clock
    io.MouseDoubleClickMaxDist = FLT_MAX;
    io.MouseDragThreshold = 4 * scale;
    io.ConfigInputTextCursorBlink = false;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigMemoryCompactTimer = -1; // seconds of a clock that has no meaning here
    io.UserData = &scale;             // for view::scale
    if (clipboard.get && clipboard.set) {
        io.ClipboardUserData = this;
        io.GetClipboardTextFn = [](void* state) {
            auto& own = *static_cast<State*>(state);
            own.pasted = own.clipboard.get();
            return own.pasted.c_str();
        };
        io.SetClipboardTextFn = [](void* state, const char* text) { static_cast<State*>(state)->clipboard.set(text); };
    }
    imgui::setUp();
    setStyle(ImGui::GetStyle(), scale);
    glyphs = makeGlyphs(*io.Fonts, scale);
}

/// `event`: the one fed since the last layout, or null.
Drawing Widgets::State::layOutOnce(int width, int height, const Build& build, const InputEvent* event)
{
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    // In an open popup arrows, enter and escape choose. Without one, ImGui would take keys that are for others.
    const bool choosing = popupIsOpen();
    io.ConfigFlags = choosing ? ImGuiConfigFlags_NavEnableKeyboard : ImGuiConfigFlags_None;
    if (choosing && event != nullptr && isEnterDown(*event)) {
        imgui::chooseByEnter();
    }
    const bool tookPointer = io.WantCaptureMouse;
    ImGui::NewFrame();
    if (event != nullptr) eventIsTaken = takes(io, *event, tookPointer);
    try {
        build();
    } catch (...) {
        imgui::abandonFrame();
        throw;
    }
    ImGui::Render();
    return toDrawing(*ImGui::GetDrawData(), width, height);
}

Widgets::Widgets(float scale, Clipboard clipboard)
{
    constexpr float least = 0.5F;
    constexpr float most = 8;
    if (!(scale >= least && scale <= most)) {
        throw InputError("scale", std::to_string(scale) + " is not allowed; it must be in [0.5, 8]");
    }
    state_ = std::make_unique<State>(scale, std::move(clipboard));
}

Widgets::~Widgets() = default;

bool Widgets::layOut(const InputEvent* event, int width, int height, const Build& build)
{
    const Use use(state_->context.get());
    ImGuiIO& io = ImGui::GetIO();
    state_->eventIsTaken = false;
    if (event != nullptr) {
        const auto* down = std::get_if<KeyDown>(&event->what);
        if (down != nullptr && state_->held[static_cast<std::size_t>(down->key)]) {
            // ImGui sees a repeated key only if it goes up in between.
            imgui::setKey(down->key, false);
            state_->layOutOnce(width, height, build, nullptr);
        }
        imgui::setModifiers(event->modifiers);
        // Tab goes from field to field. If no field is being typed into, ImGui would start with the first one.
        const bool isIdleTab = down != nullptr && down->key == Key::tab && !io.WantTextInput && !popupIsOpen();
        if (!isIdleTab) std::visit(Feed{io}, event->what);
        if (down != nullptr) state_->held[static_cast<std::size_t>(down->key)] = !isIdleTab;
        if (const auto* up = std::get_if<KeyUp>(&event->what)) state_->held[static_cast<std::size_t>(up->key)] = false;
    }
    Drawing last = state_->layOutOnce(width, height, build, event);
    for (int layouts = 1; layouts < mostLayouts; ++layouts) {
        Drawing next = state_->layOutOnce(width, height, build, nullptr);
        const bool settled = next == last;
        last = std::move(next);
        if (settled) break;
    }
    if (last != state_->drawing) {
        state_->drawing = std::move(last);
        ++state_->version;
    }
    return state_->eventIsTaken;
}

const Drawing& Widgets::drawing() const
{
    return state_->drawing;
}

std::uint64_t Widgets::version() const
{
    return state_->version;
}

const Glyphs& Widgets::glyphs() const
{
    return state_->glyphs;
}

bool Widgets::wantsPointer() const
{
    const Use use(state_->context.get());
    return ImGui::GetIO().WantCaptureMouse;
}

bool Widgets::wantsKeyboard() const
{
    const Use use(state_->context.get());
    return ImGui::GetIO().WantCaptureKeyboard;
}

bool Widgets::wantsText() const
{
    const Use use(state_->context.get());
    return ImGui::GetIO().WantTextInput;
}

PointerShape Widgets::pointerShape() const
{
    const Use use(state_->context.get());
    switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
        return PointerShape::text;
    case ImGuiMouseCursor_Hand:
        return PointerShape::hand;
    case ImGuiMouseCursor_ResizeEW:
        return PointerShape::resizeHorizontally;
    case ImGuiMouseCursor_ResizeNS:
        return PointerShape::resizeVertically;
    default:
        return PointerShape::arrow;
    }
}

namespace {

/// A scope in which colours of a widget are set.
class Colours {
public:
    Colours(std::initializer_list<std::pair<ImGuiCol, draw::Colour>> colours) : count_(static_cast<int>(colours.size()))
    {
        for (const auto& [what, colour] : colours) {
            ImGui::PushStyleColor(what, ImVec4(colour[0], colour[1], colour[2], 1));
        }
    }
    ~Colours() { ImGui::PopStyleColor(count_); }
    Colours(const Colours&) = delete;
    Colours& operator=(const Colours&) = delete;

private:
    int count_;
};

} // namespace

void heading(const std::string& text)
{
    imgui::pushFont(ImGui::GetIO().Fonts->Fonts[headingFont]);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopFont();
}

bool section(const std::string& title, bool open)
{
    const Colours colours{{ImGuiCol_Header, theme::title},
                          {ImGuiCol_HeaderHovered, theme::button},
                          {ImGuiCol_HeaderActive, theme::buttonActive}};
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(5 * scale(), 4 * scale())); // moves the title nearer to its
                                                                                       // arrow
    imgui::pushFont(ImGui::GetIO().Fonts->Fonts[headingFont]);
    const bool shown = ImGui::CollapsingHeader(title.c_str(), open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopFont();
    ImGui::PopStyleVar(2);
    return shown;
}

bool mainButton(const std::string& label, float width)
{
    const Colours colours{{ImGuiCol_Button, theme::accentFill},
                          {ImGuiCol_ButtonHovered, theme::accentFillHovered},
                          {ImGuiCol_ButtonActive, theme::accentFillActive},
                          {ImGuiCol_Border, theme::accentFillHovered}};
    return ImGui::Button(label.c_str(), ImVec2(width < 0 ? -FLT_MIN : width, 0));
}

float scale()
{
    return *static_cast<const float*>(ImGui::GetIO().UserData);
}

} // namespace vdbcage::view
