#pragma once

#include <string>
#include <vector>

#include <vdbcage/pipeline/options.h>

/// Presets: options under a name. A line of their files has an option's name and its value; comments begin with #.
namespace vdbcage::view {

struct Preset {
    std::string name;
    std::string help; ///< one line
    std::string text; ///< in the format of files
};

/// Returns the presets that come with the window: balanced, tight, coarse, blocky.
const std::vector<Preset>& presets();

/// Returns the options in `text`, the content of a file; others have their defaults. `source` names it in errors.
/// \throw InputError naming source, line, value and the allowed values
CageOptions optionsOf(const std::string& text, const std::string& source);

/// Returns the options of the preset `name`, or of the file with that path if there is no such preset.
/// \throw InputError as optionsOf; IoError
CageOptions presetOptions(const std::string& name);

/// Returns the content of a file with the options that differ from their defaults.
std::string presetText(const CageOptions& options);

} // namespace vdbcage::view
