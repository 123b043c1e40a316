#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

/// A user's preferences for all windows, whatever is open. Scenes and undo leave them alone.
namespace vdbcage::view {

/// The program whose keys and mouse buttons the window has.
enum class KeyMap : std::uint8_t { blender, maya };
constexpr std::array<const char*, 2> keyMapNames{"blender", "maya"};

struct Preferences {
    KeyMap keys = KeyMap::blender;
};

/// Returns their file, beside the list of recent files (see recentFilesPath). Empty if that has no place.
std::filesystem::path preferencesPath();
/// Reads the preferences. Entries that are missing or not understood have their defaults, and all do if the file cannot
/// be read.
Preferences readPreferences(const std::filesystem::path& file);
/// Writes the preferences. Ignores errors: the file is only a convenience.
void writePreferences(const std::filesystem::path& file, const Preferences& preferences);

} // namespace vdbcage::view
