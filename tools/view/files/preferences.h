#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

/// What a user prefers in every window, whatever is worked on. It is no part of scenes and of no undo.
namespace vdbcage::view {

/// Whose keys and mouse buttons the window has.
enum class KeyMap : std::uint8_t { blender, maya };
constexpr std::array<const char*, 2> keyMapNames{"blender", "maya"};

struct Preferences {
    KeyMap keys = KeyMap::blender;
};

/// They are kept in this file, beside the list of recent files (see recentFilesPath). Empty if that has no place.
std::filesystem::path preferencesPath();
/// What the file does not say, or says so that it cannot be understood, is as by default. So is all of a file that
/// cannot be read.
Preferences readPreferences(const std::filesystem::path& file);
/// What cannot be written is not: it is no more than a convenience.
void writePreferences(const std::filesystem::path& file, const Preferences& preferences);

} // namespace vdbcage::view
