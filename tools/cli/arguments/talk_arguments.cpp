#include <tools/cli/arguments/talk_arguments.h>

#include <unistd.h>

#include <vdbcage/core/error.h>

namespace vdbcage::cli {

void requireProgress(const std::string& form)
{
    if (form != "auto" && form != "lines") throw InputError("progress", "'" + form + "' is neither auto nor lines");
}

TalkArguments::TalkArguments(CLI::App& app, const char* verboseHelp)
{
    app.add_option("--progress", progress_, "for terminals, or on standard output [auto]")->type_name("auto|lines");
    app.add_flag("-q,--quiet", quiet_, "print nothing but errors");
    if (verboseHelp) app.add_flag("-v,--verbose", verbose_, verboseHelp);
}

ProgressForm TalkArguments::progressForm() const
{
    requireProgress(progress_);
    if (progress_ == "lines") return ProgressForm::farm;
    if (quiet_) return ProgressForm::none;
    if (::isatty(STDERR_FILENO) == 1) return ProgressForm::bar;
    return verbose_ ? ProgressForm::lines : ProgressForm::none;
}

} // namespace vdbcage::cli
