#pragma once

#include <cstdint>

#include <imgui.h>

#include <tools/view/input/input.h>

/// What versions 1.86 to 1.92 of Dear ImGui want to be told in different ways. The rest of the window is the same for
/// all of them.
namespace vdbcage::view::imgui {

/// Prepares the current context for what follows. To be called once, before its first frame.
void setUp();

/// Each holds from the next frame on.
void movePointer(float x, float y);
void setButton(Button button, bool isDown);
void turnWheel(float x, float y);
/// Keys that ImGui has no use for are passed over.
void setKey(Key key, bool isDown);
void setModifiers(const Modifiers& modifiers);

/// Lets the enter key, which goes down now, choose what the arrows went to.
void chooseByEnter();

/// Ends the frame, of which the caller built a part only.
void abandonFrame();

/// Whether a key was pressed, within a frame.
bool isPressed(Key key);

/// Until ImGui::PopFont().
void pushFont(ImFont* font);

/// The glyph of the current font; null if it has none.
const ImFontGlyph* glyphOf(char16_t letter);

/// What ImGui::Image() takes for a texture of OpenGL.
ImTextureID textureNamed(std::uint32_t name);
/// The texture of a command; 0: that of the glyphs.
std::uint32_t textureOf(const ImDrawCmd& command);

} // namespace vdbcage::view::imgui
