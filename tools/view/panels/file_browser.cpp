#include <tools/view/panels/file_browser.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>

#include <tools/files/frames.h>
#include <tools/view/files/saver.h>
#include <tools/view/panels/parts.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

struct Verb {
    const char* verb;
    const char* title;
    const char* button;
    std::vector<std::string> extensions;
    bool saves;
    const char* ending; ///< of the name that is offered: the model's without its extension, and this
};

const std::vector<Verb>& verbs()
{
    static const std::vector<std::string> meshes{".obj", ".off", ".ply", ".stl"};
    static const std::vector<Verb> list{
        {"open", "Open a model", "Open", meshes, false, ""},
        {"open-cage", "Open a cage", "Open", meshes, false, ""},
        {"open-scene", "Open a scene", "Open", {".json"}, false, ""},
        {"preset", "Take options from a file", "Open", {".options"}, false, ""},
        {"open-pose", "Open a posed cage", "Open", meshes, false, ""},
        {"save-posed-cage", "Save the posed cage", "Save", meshes, true, "_posed_cage.obj"},
        {"save-posed-model", "Save the posed model", "Save", meshes, true, "_posed.obj"},
        {"open-poses",
         "Open a sequence of posed cages: one of its files",
         "Open",
         {".obj", ".off", ".ply", ".stl", ".param"},
         false,
         ""},
        {"open-weights",
         "Open weights: points of the model x points of the cage",
         "Open",
         {".npy", ".dmat"},
         false,
         ""},
        {"save-posed-cages", "Save the posed cage of every frame", "Save", meshes, true, "_posed_cage.%04d.obj"},
        {"save-posed-models", "Save the posed model of every frame", "Save", meshes, true, "_posed.%04d.obj"},
        {"save-colours", "Save the colours of the model", "Save", {".ply"}, true, "_colours.ply"},
        {"save-weights", "Save the weights", "Save", {".npy"}, true, "_weights.npy"},
        {"save-cage", "Save the cage", "Save", meshes, true, "_cage.obj"},
        {"save-scene", "Save the scene", "Save", {".json"}, true, "_scene.json"},
        {"save-report", "Save the report", "Save", {".json"}, true, "_report.json"},
        {"save-options", "Save the options", "Save", {".options"}, true, ".options"},
        {"save-picture", "Save a picture", "Save", {".png"}, true, ".png"},
        {"save-stages", "Save the stages into a folder", "Save here", {}, true, "_stages"}};
    return list;
}

std::string sizeText(std::uintmax_t bytes)
{
    char text[32];
    const double size = static_cast<double>(bytes);
    if (bytes < 1000) {
        std::snprintf(text, sizeof text, "%.0f B", size);
    } else if (bytes < 1000 * 1000) {
        std::snprintf(text, sizeof text, "%.0f kB", size / 1e3);
    } else {
        std::snprintf(text, sizeof text, "%.1f MB", size / 1e6);
    }
    return text;
}

void goTo(FileBrowser& browser, const fs::path& folder)
{
    browser.folder = folder;
    browser.filter.clear();
    browser.isStale = true;
}

void readFolder(FileBrowser& browser)
{
    if (!browser.isStale) return;
    browser.isStale = false;
    browser.entries.clear();
    browser.problem.clear();
    try {
        browser.entries = listFolder(browser.folder, browser.extensions, browser.filter);
    } catch (const Error& error) {
        browser.problem = error.what();
    }
    if (browser.extensions.empty()) { // folders only
        browser.entries.erase(std::remove_if(browser.entries.begin(), browser.entries.end(),
                                             [](const FolderEntry& entry) { return !entry.isFolder; }),
                              browser.entries.end());
    }
}

/// Takes what is typed: goes to a folder, asks before a file is written over, or asks for the line. A name to save by
/// gets an extension if it has none.
void choose(const PanelContext& context, FileBrowser& browser, bool isConfirmed)
{
    if (browser.name.empty()) return;
    fs::path path = (browser.folder / browser.name).lexically_normal();
    std::error_code error;
    if (!browser.extensions.empty() && fs::is_directory(path, error)) {
        goTo(browser, path);
        browser.name.clear();
        return;
    }
    if (browser.saves && !browser.extensions.empty() && !path.has_extension()) path += browser.extensions.front();
    const bool isThere =
        isSequence(browser.verb) ? files::countFrames(files::patternFor(path)) > 0 : fs::exists(path, error);
    if (browser.saves && !isConfirmed && isThere) {
        browser.question =
            path.filename().string() + (browser.extensions.empty() ? " is there already. Write the stages into it?"
                                        : isSequence(browser.verb) ? ": some frames are there already. Write over them?"
                                                                   : " is there already. Write over it?");
        return;
    }
    context.ask(browser.verb + ' ' + quotedWord(path.string()));
    browser.verb.clear();
}

void buildList(const PanelContext& context, FileBrowser& browser)
{
    ImGui::BeginChild("list", {0, length(300)}, true);
    const auto entries = browser.entries; // a click reads another folder
    for (const FolderEntry& entry : entries) {
        const std::string label = (entry.isFolder ? "\xe2\x96\xb6 " : "   ") + entry.name;
        const bool isChosen = entry.name == browser.name;
        if (ImGui::Selectable(label.c_str(), isChosen, ImGuiSelectableFlags_AllowDoubleClick)) {
            if (entry.isFolder) {
                goTo(browser, browser.folder / entry.name);
            } else {
                browser.name = entry.name;
                browser.question.clear();
                if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) choose(context, browser, false);
            }
        }
        context.name("browser.entry." + entry.name);
        if (entry.isFolder) continue;
        const std::string size = sizeText(entry.bytes);
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
        muted(size);
    }
    if (entries.empty()) muted(browser.problem.empty() ? "nothing of that kind is here" : browser.problem);
    ImGui::EndChild();
}

} // namespace

void open(FileBrowser& browser, const std::string& verb, const fs::path& suggested)
{
    for (const Verb& known : verbs()) {
        if (verb != known.verb) continue;
        std::error_code error;
        fs::path folder = suggested.parent_path();
        if (folder.empty()) folder = fs::current_path(error);
        browser = {};
        browser.verb = verb;
        browser.title = known.title;
        browser.button = known.button;
        browser.extensions = known.extensions;
        browser.saves = known.saves;
        browser.folder = folder;
        if (known.saves) browser.name = suggested.stem().string() + known.ending;
        return;
    }
    throw InputError("browse: '" + verb + "' is not a line that takes a file");
}

void buildBrowser(const PanelContext& context, FileBrowser& browser)
{
    readFolder(browser);
    if (ImGui::Button("Up")) goTo(browser, browser.folder.parent_path());
    context.name("browser.up");
    ImGui::SameLine();
    if (const char* const home = std::getenv("HOME")) {
        if (ImGui::Button("Home")) goTo(browser, home);
        context.name("browser.home");
        ImGui::SameLine();
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(browser.folder.string().c_str());
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##filter", "part of a name", &browser.filter)) browser.isStale = true;
    context.name("browser.filter");
    buildList(context, browser);
    muted(browser.extensions.empty() ? "Folder, or a path:" : "Name, or a path:");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere(); // a name can be typed at once
    if (ImGui::InputText("##name", &browser.name,
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll)) {
        choose(context, browser, false);
    }
    context.name("browser.name");
    if (ImGui::IsItemEdited()) browser.question.clear();
    ImGui::Dummy({0, length(4)});
    if (!browser.question.empty()) {
        coloured(theme::warning, browser.question);
        if (mainButton("Yes", length(90))) choose(context, browser, true);
        context.name("browser.yes");
        ImGui::SameLine();
        if (ImGui::Button("No", {length(90), 0})) browser.question.clear();
        context.name("browser.no");
        return;
    }
    ImGui::BeginDisabled(browser.name.empty());
    if (mainButton(browser.button, length(110))) choose(context, browser, false);
    context.name("browser.ok");
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {length(110), 0})) browser.verb.clear();
    context.name("browser.cancel");
}

} // namespace vdbcage::view
