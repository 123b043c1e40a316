#include <tools/view/state/preset.h>

#include <sstream>

#include <tools/view/state/words.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

const std::vector<Preset>& presets()
{
    static const std::vector<Preset> list{
        {"balanced", "the defaults: 400 triangles in about a second", "# balanced: all as by default\n"},
        {"tight", "as close to the model as it gets", "faces 800\neffort best\n"},
        {"coarse", "few faces around everything, gaps bridged", "faces 80\nparts merge\neffort best\n"},
        {"blocky", "boxes: cubes close the gaps, quads where it can", "faces 160\nelement cube\nmesh quads\n"},
    };
    return list;
}

CageOptions optionsOf(const std::string& text, const std::string& source)
{
    CageOptions options;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        try {
            const std::vector<std::string> words = wordsOf(line);
            if (words.empty()) continue;
            if (words.size() != 2) throw InputError("'" + line + "' is not an option's name and its value");
            setOption(options, words[0], words[1]);
        } catch (const Error& error) {
            throw InputError(source + ":" + std::to_string(number), error.what());
        }
    }
    try {
        requireValid(options);
    } catch (const InputError& error) {
        throw InputError(source, error.what());
    }
    return options;
}

CageOptions presetOptions(const std::string& name)
{
    for (const Preset& preset : presets()) {
        if (preset.name == name) return optionsOf(preset.text, "preset " + name);
    }
    // Built-in names have no dot and no slash, so another name without them was mistyped.
    if (name.find_first_of("./") == std::string::npos) {
        const std::string known = detail::joined(presets(), ", ", [](const Preset& preset) { return preset.name; });
        throw InputError("preset",
                         "'" + name + "' is not known; there are " + known + ", and files such as ./my.options");
    }
    return optionsOf(detail::readFile(name), name);
}

std::string presetText(const CageOptions& options)
{
    std::string text = "# Options of vdbcage; those that are not here are as by default.\n";
    const auto values = optionValues(options), defaults = optionValues(CageOptions{});
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i].second != defaults[i].second) text += values[i].first + ' ' + quotedWord(values[i].second) + '\n';
    }
    return text;
}

} // namespace vdbcage::view
