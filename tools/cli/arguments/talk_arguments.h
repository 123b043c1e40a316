#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <tools/cli/interrupt.h>

namespace vdbcage::cli {

/// \throw InputError `--progress` has no such form
void requireProgress(const std::string& form);

/// The options of a long command: -q and --progress, and -v if it has more to say.
class TalkArguments {
public:
    /// `verboseHelp` is the help of -v; null: the command has no -v. It must outlive parsing.
    explicit TalkArguments(CLI::App& app, const char* verboseHelp = nullptr);

    bool quiet() const { return quiet_; }
    bool verbose() const { return verbose_; }
    /// \throw InputError no such form
    ProgressForm progressForm() const;

private:
    bool quiet_ = false, verbose_ = false;
    std::string progress_ = "auto";
};

} // namespace vdbcage::cli
