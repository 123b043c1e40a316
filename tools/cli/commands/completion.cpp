// The shells ask the command itself for completions: bash(1), "Programmable Completion"; zsh's zshcompsys(1),
// _describe; fish's complete(1).

#include <iostream>
#include <sstream>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>

#include <tools/cli/commands.h>

namespace vdbcage::cli {

namespace {

/// A printer of the completions at the cursor, one per line: a word, then a tab and its description; or a kind of file.
class Offers {
public:
    /// Prints only words that begin with `begun`.
    explicit Offers(std::string begun) : begun_(std::move(begun)) {}

    void word(const std::string& word, const std::string& about = "") const
    {
        if (word.compare(0, begun_.size(), begun_) == 0) std::cout << word << '\t' << about << '\n';
    }
    void files() const { std::cout << ":files\n"; }
    void directories() const { std::cout << ":directories\n"; }

private:
    std::string begun_;
};

/// Prints the values of the option's type: "auto|N" has the word auto; capitals are a file, a folder or a number.
void offerValues(const OptionFacts& option, const Offers& offers)
{
    std::istringstream parts(option.value);
    for (std::string part; std::getline(parts, part, '|');) {
        const std::string kind = part.substr(0, part.find('.'));
        if (kind == "FAMILY") {
            for (const FamilyInfo& family : coordinateFamilies()) offers.word(family.name, family.title);
        } else if (kind == "DIR") {
            offers.directories();
        } else if (kind == "FILE" || kind == "CAGE" || kind == "OUT" || kind == "PICTURE" || kind == "WEIGHTS") {
            offers.files();
        } else if (part[0] >= 'a' && part[0] <= 'z') {
            offers.word(part);
        }
    }
}

void offerCommands(const Offers& offers)
{
    for (const Command& command : commands()) offers.word(command.name, command.summary);
}

/// Prints the completions of the last of `words`; the first is the command's name.
void printOffers(std::vector<std::string> words)
{
    std::string option = words.size() > 1 ? words[words.size() - 2] : "", begun = words.back();
    if (const std::size_t sign = begun.find('='); begun[0] == '-' && sign != std::string::npos) { // --mesh=q
        option = begun.substr(0, sign);
        begun.erase(0, sign + 1);
    } else if (option == "=" && words.size() > 2) { // bash splits it into three words
        option = words[words.size() - 3];
    } else if (begun == "=") {
        begun.clear();
    }
    const Offers offers(begun);
    if (words.size() == 1) {
        offerCommands(offers);
        offers.word("help", "print the options of a command");
        offers.word("--help");
        offers.word("--version");
    } else if (words[0] == "help") {
        offerCommands(offers);
    } else {
        const std::vector<OptionFacts> options = describe(commandNamed(words[0])).options;
        for (const OptionFacts& known : options) {
            if (!known.value.empty() && (known.name == option || known.letter == option)) {
                return offerValues(known, offers);
            }
        }
        if (begun[0] == '-') {
            for (const OptionFacts& known : options) offers.word(known.name, known.help);
        } else if (words[0] == "man") {
            offerCommands(offers);
        } else if (words[0] == "completion") {
            for (const char* shell : {"bash", "fish", "zsh"}) offers.word(shell);
        } else {
            offers.files();
        }
    }
}

constexpr const char* bash = R"(# source <(vdbcage completion bash)
_vdbcage() {
    local offer rest word=${COMP_WORDS[COMP_CWORD]#=}
    COMPREPLY=()
    while IFS=$'\t' read -r offer rest; do
        case $offer in
        :*)
            compopt -o filenames 2>/dev/null
            mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -${offer:1:1} -- "$word")
            ;;
        *) COMPREPLY+=("$offer") ;;
        esac
    done < <(vdbcage completion offers "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -F _vdbcage vdbcage
)";

constexpr const char* fish = R"(# vdbcage completion fish > ~/.config/fish/completions/vdbcage.fish
function __vdbcage_offers
    set -l words (commandline -opc)
    set -l token (commandline -ct)
    set -l option (string match -r '^--[a-z-]+=' -- $token)
    for offer in (vdbcage completion offers $words[2..] "$token" 2>/dev/null)
        switch $offer
            case :files
                __fish_complete_path (string replace -- "$option" '' $token)
            case :directories
                __fish_complete_directories (string replace -- "$option" '' $token) ''
            case '*'
                echo "$option$offer"
        end
    end
end
complete -c vdbcage -f -a '(__vdbcage_offers)'
)";

constexpr const char* zsh = R"(#compdef vdbcage
# source <(vdbcage completion zsh), after compinit
_vdbcage() {
    local offer
    local -a words_offered
    for offer in "${(@f)$(vdbcage completion offers "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
        case $offer in
        (:files) compset -P '--*='; _files ;;
        (:directories) compset -P '--*='; _files -/ ;;
        (?*) words_offered+=("${offer/$'\t'/:}") ;;
        esac
    done
    compset -P '--*='
    _describe value words_offered
}
if [[ $funcstack[1] == _vdbcage ]]; then
    _vdbcage "$@"
else
    compdef _vdbcage vdbcage
fi
)";

} // namespace

int runCompletion(Call call)
{
    if (call.words.size() > 1 && call.words.front() == "offers") { // for these scripts
        call.words.erase(call.words.begin());
        printOffers(std::move(call.words));
        return exitGood;
    }
    std::string shell;
    CLI::App app("vdbcage completion bash|fish|zsh\n"
                 "Prints a shell's script that completes commands, options and files of vdbcage.",
                 "completion");
    app.add_option("shell", shell)->required()->type_name("SHELL");
    if (!parse(app, std::move(call))) return exitGood;
    if (shell != "bash" && shell != "fish" && shell != "zsh") {
        throw InputError("shell", "'" + shell + "' is neither bash nor fish nor zsh");
    }
    std::cout << (shell == "bash" ? bash : shell == "fish" ? fish : zsh);
    return exitGood;
}

} // namespace vdbcage::cli
