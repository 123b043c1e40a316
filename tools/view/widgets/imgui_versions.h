#pragma once

#include <cstdint>

#include <imgui.h>

#include <tools/view/input/input.h>

/// Wrappers of the functions that differ between versions 1.86 to 1.92 of Dear ImGui. The rest of the window is the
/// same for all of them.
namespace vdbcage::view::imgui {

/// Prepares the current context for the functions below. Call it once, before its first frame.
void setUp();

/// Take effect in the next frame.
void movePointer(float x, float y);
void setButton(Button button, bool isDown);
void turnWheel(float x, float y);
/// Sets a key. Keys that ImGui has no use for are ignored.
void setKey(Key key, bool isDown);
void setModifiers(const Modifiers& modifiers);

/// Makes the enter key, which goes down now, choose the entry that the arrows went to.
void chooseByEnter();

/// Ends a frame that the caller built only in part.
void abandonFrame();

/// Returns whether a key was pressed, within a frame.
bool isPressed(Key key);

/// Frees the pixels of an atlas that is built, and where glyphs do not go with them, its fonts' files.
void clearSources(ImFontAtlas& atlas);
/// Sets the font until ImGui::PopFont().
void pushFont(ImFont* font);

/// Returns the glyph of the current font; null if it has none.
const ImFontGlyph* glyphOf(char16_t letter);

/// Returns the argument of ImGui::Image() for a texture of OpenGL.
ImTextureID textureNamed(std::uint32_t name);
/// Returns the texture of a command; 0: that of the glyphs.
std::uint32_t textureOf(const ImDrawCmd& command);

} // namespace vdbcage::view::imgui
