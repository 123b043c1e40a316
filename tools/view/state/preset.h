#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/pipeline/options.h>

/// Presets: options by a name. A file of options has lines of an option's name and its value, and comments after #.
namespace vdbcage::view {

struct Preset {
    std::string name;
    std::string help; ///< one line
    std::string text; ///< as in a file
};

/// Those that come with the window: balanced, tight, coarse, blocky.
const std::vector<Preset>& presets();

/// The options in `text`, a file's; those that it does not name are as by default. `source` names it in errors.
/// \throw InputError naming source, line, value and what is allowed
CageOptions optionsOf(const std::string& text, const std::string& source);

/// The options of the preset `name`, or of the file with that path if there is no such preset.
/// \throw InputError as optionsOf; IoError
CageOptions presetOptions(const std::string& name);

/// A file of the options that are not as by default.
std::string presetText(const CageOptions& options);

} // namespace vdbcage::view
