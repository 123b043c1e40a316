#include <tools/view/widgets/imgui_versions.h>

#include <algorithm>
#include <array>
#include <utility>

#include <imgui_internal.h>

static_assert(IMGUI_VERSION_NUM == 18600 || (IMGUI_VERSION_NUM >= 18900 && IMGUI_VERSION_NUM < 19300),
              "Dear ImGui 1.86, or 1.89 to 1.92");

namespace vdbcage::view::imgui {

namespace {

#if IMGUI_VERSION_NUM < 18700
constexpr ImGuiKey_ keypadEnter = ImGuiKey_KeyPadEnter;
#else
constexpr ImGuiKey keypadEnter = ImGuiKey_KeypadEnter;
#endif

// The keys that ImGui uses by itself.
constexpr std::array<std::pair<decltype(ImGuiKey_Tab), Key>, 22> keys{{
    {ImGuiKey_Tab, Key::tab},
    {ImGuiKey_LeftArrow, Key::left},
    {ImGuiKey_RightArrow, Key::right},
    {ImGuiKey_UpArrow, Key::up},
    {ImGuiKey_DownArrow, Key::down},
    {ImGuiKey_PageUp, Key::pageUp},
    {ImGuiKey_PageDown, Key::pageDown},
    {ImGuiKey_Home, Key::home},
    {ImGuiKey_End, Key::end},
    {ImGuiKey_Insert, Key::insert},
    {ImGuiKey_Delete, Key::del},
    {ImGuiKey_Backspace, Key::backspace},
    {ImGuiKey_Space, Key::space},
    {ImGuiKey_Enter, Key::enter},
    {ImGuiKey_Escape, Key::escape},
    {keypadEnter, Key::keypadEnter},
    {ImGuiKey_A, Key::a},
    {ImGuiKey_C, Key::c},
    {ImGuiKey_V, Key::v},
    {ImGuiKey_X, Key::x},
    {ImGuiKey_Y, Key::y},
    {ImGuiKey_Z, Key::z},
}};

} // namespace

#if IMGUI_VERSION_NUM < 18700

void setUp()
{
    for (const auto& [theirs, ours] : keys) ImGui::GetIO().KeyMap[theirs] = static_cast<int>(ours);
}

void movePointer(float x, float y)
{
    ImGui::GetIO().MousePos = ImVec2(x, y);
}

void setButton(Button button, bool isDown)
{
    ImGui::GetIO().MouseDown[static_cast<std::size_t>(button)] = isDown;
}

void turnWheel(float x, float y)
{
    ImGui::GetIO().MouseWheelH += x;
    ImGui::GetIO().MouseWheel += y;
}

void setKey(Key key, bool isDown)
{
    ImGui::GetIO().KeysDown[static_cast<std::size_t>(key)] = isDown;
}

void setModifiers(const Modifiers& modifiers)
{
    ImGuiIO& io = ImGui::GetIO();
    io.KeyShift = modifiers.shift;
    io.KeyCtrl = modifiers.control;
    io.KeyAlt = modifiers.alt;
}

void chooseByEnter()
{
    ImGui::GetIO().NavInputs[ImGuiNavInput_Activate] = 1; // ImGui itself chooses only by the space bar
}

bool isPressed(Key key)
{
    return ImGui::IsKeyPressed(static_cast<int>(key));
}

#else

namespace {

const std::pair<ImGuiKey, Key>* find(Key key)
{
    const auto known = std::find_if(keys.begin(), keys.end(), [&](const auto& pair) { return pair.second == key; });
    return known == keys.end() ? nullptr : &*known;
}

} // namespace

void setUp()
{
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigInputTrickleEventQueue = false; // a frame gets one event, and modifiers
#if IMGUI_VERSION_NUM >= 19140
    // An abandoned frame is no error to report. ImGui asks for one way to report it.
    ImGui::GetCurrentContext()->ErrorCallback = [](ImGuiContext*, void*, const char*) {};
    io.ConfigErrorRecoveryEnableAssert = false;
    io.ConfigErrorRecoveryEnableDebugLog = false;
    io.ConfigErrorRecoveryEnableTooltip = false;
#endif
}

void movePointer(float x, float y)
{
    ImGui::GetIO().AddMousePosEvent(x, y);
}

void setButton(Button button, bool isDown)
{
    ImGui::GetIO().AddMouseButtonEvent(static_cast<int>(button), isDown);
}

void turnWheel(float x, float y)
{
    ImGui::GetIO().AddMouseWheelEvent(x, y);
}

void setKey(Key key, bool isDown)
{
    if (const auto* const known = find(key)) ImGui::GetIO().AddKeyEvent(known->first, isDown);
}

void setModifiers(const Modifiers& modifiers)
{
    ImGuiIO& io = ImGui::GetIO();
    io.AddKeyEvent(ImGuiMod_Shift, modifiers.shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, modifiers.control);
    io.AddKeyEvent(ImGuiMod_Alt, modifiers.alt);
}

void chooseByEnter()
{
} // ImGui does

bool isPressed(Key key)
{
    const auto* const known = find(key);
    return known && ImGui::IsKeyPressed(known->first);
}

#endif

void abandonFrame()
{
#if IMGUI_VERSION_NUM < 19140
    ImGui::ErrorCheckEndFrameRecover(nullptr);
#endif
    ImGui::EndFrame(); // later versions recover here
}

void clearSources(ImFontAtlas& atlas)
{
    atlas.ClearTexData();
#if IMGUI_VERSION_NUM < 19200
    atlas.ClearInputData();
#endif
}

void pushFont(ImFont* font)
{
#if IMGUI_VERSION_NUM < 19200
    ImGui::PushFont(font);
#else
    ImGui::PushFont(font, font->LegacySize);
#endif
}

const ImFontGlyph* glyphOf(char16_t letter)
{
#if IMGUI_VERSION_NUM < 19200
    return ImGui::GetFont()->FindGlyphNoFallback(letter);
#else
    return ImGui::GetFontBaked()->FindGlyphNoFallback(letter);
#endif
}

ImTextureID textureNamed(std::uint32_t name)
{
    const std::uintptr_t number = name;
#if IMGUI_VERSION_NUM < 19140
    return reinterpret_cast<ImTextureID>(number);
#else
    return number;
#endif
}

std::uint32_t textureOf(const ImDrawCmd& command)
{
#if IMGUI_VERSION_NUM < 19200
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
#else
    return command.TexRef._TexData ? 0 : static_cast<std::uint32_t>(command.TexRef._TexID);
#endif
}

} // namespace vdbcage::view::imgui
