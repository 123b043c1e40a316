#include <tools/cli/arguments/cage_arguments.h>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

#include <tools/cli/command_line.h>

namespace vdbcage::cli {

std::vector<CLI::Option*> addCageOptions(CLI::App& app, CageOptions& options)
{
    std::vector<CLI::Option*> added;
    for (const OptionText& option : describeOptions()) {
        added.push_back(app.add_option_function<std::string>(
            "--" + option.name,
            [&options, name = option.name](const std::string& value) { setOption(options, name, value); },
            option.help + (option.range.empty() ? "" : ", " + option.range) + " [" + option.defaultValue + "]"));
        added.back()->type_name(option.value)->group(option.isRare ? rareOptions : "Options");
    }
    return added;
}

void setPrecisionFor(const std::filesystem::path& cage, CageOptions& options)
{
    if (precisionOf(cage) == Precision::float64) return;
    if (options.precision == Precision::float64) {
        throw InputError("--precision",
                         "'float64' is not allowed with " + cage.string() + ": " + cage.extension().string() +
                             " files hold float32; it must be auto or float32, or the file .obj, .off or .ply");
    }
    options.precision = Precision::float32;
}

CLI::Option* addMemoryOption(CLI::App& app, std::string& text)
{
    return app.add_option("--memory", text, "refuse runs that would take more memory [auto]")
        ->type_name("auto|off|SIZE")
        ->group(rareOptions);
}

} // namespace vdbcage::cli
