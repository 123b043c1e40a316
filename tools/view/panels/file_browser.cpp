#include <tools/view/panels/file_browser.h>

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <utility>

#include <tools/files/frames.h>
#include <tools/view/panels/parts.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

template <class T>
FileLine opens(const char* title, std::vector<std::string> extensions)
{
    const auto of = [](const std::string& path) -> Action { return T{path}; };
    return {T::info().name, of, title, std::move(extensions)};
}

template <class T>
FileLine saves(const char* title, std::vector<std::string> extensions, const char* ending)
{
    FileLine line = opens<T>(title, std::move(extensions));
    line.ending = ending;
    line.isSequence = T::isSequence;
    return line;
}

const std::vector<FileLine>& fileLines()
{
    const std::vector<std::string>& meshes = meshExtensions();
    static const std::vector<std::string> posed = [&] {
        std::vector<std::string> list = meshes;
        list.emplace_back(".param");
        return list;
    }();
    static const std::vector<FileLine> list{
        opens<OpenModel>("Open a model", meshes),
        opens<OpenCage>("Open a cage", meshes),
        opens<OpenScene>("Open a scene", {".json"}),
        opens<ApplyPreset>("Take options from a file", {".options"}),
        opens<OpenPose>("Open a posed cage", meshes),
        opens<OpenPoses>("Open a sequence of posed cages: one of its files", posed),
        opens<OpenWeights>("Open weights: points of the model x points of the cage", {".npy", ".dmat"}),
        saves<SavePosedCage>("Save the posed cage", meshes, "_posed_cage.obj"),
        saves<SavePosedModel>("Save the posed model", meshes, "_posed.obj"),
        saves<SavePosedCages>("Save the posed cage of every frame", meshes, "_posed_cage.%04d.obj"),
        saves<SavePosedModels>("Save the posed model of every frame", meshes, "_posed.%04d.obj"),
        saves<SaveColours>("Save the colours of the model", {".ply"}, "_colours.ply"),
        saves<SaveWeights>("Save the weights", {".npy"}, "_weights.npy"),
        saves<SaveCage>("Save the cage", meshes, "_cage.obj"),
        saves<SaveScene>("Save the scene", {".json"}, "_scene.json"),
        saves<SaveReport>("Save the report", {".json"}, "_report.json"),
        saves<SaveOptions>("Save the options", {".options"}, ".options"),
        saves<SavePicture>("Save a picture", {".png"}, ".png"),
        saves<SaveStages>("Save the stages into a folder", {}, "_stages")};
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
        browser.entries = listFolder(browser.folder, browser.line->extensions, browser.filter);
    } catch (const Error& error) {
        browser.problem = error.what();
    }
    if (browser.line->extensions.empty()) { // folders only
        browser.entries.erase(std::remove_if(browser.entries.begin(), browser.entries.end(),
                                             [](const FolderEntry& entry) { return !entry.isFolder; }),
                              browser.entries.end());
    }
}

/// Takes the typed name: goes to a folder, asks before a file is overwritten, or performs the line. A name to save by
/// gets an extension if it has none.
void choose(const PanelContext& context, FileBrowser& browser, bool isConfirmed)
{
    if (!browser.isOpen || browser.name.empty()) return;
    const FileLine& line = *browser.line;
    fs::path path = (browser.folder / browser.name).lexically_normal();
    std::error_code error;
    if (!line.extensions.empty() && fs::is_directory(path, error)) {
        goTo(browser, path);
        browser.name.clear();
        return;
    }
    if (line.ending && !line.extensions.empty() && !path.has_extension()) path += line.extensions.front();
    const bool isThere = line.isSequence ? files::countFrames(files::patternFor(path)) > 0 : fs::exists(path, error);
    if (line.ending && !isConfirmed && isThere) {
        browser.question =
            path.filename().string() + (line.extensions.empty() ? " is there already. Write the stages into it?"
                                        : line.isSequence       ? ": some frames are there already. Write over them?"
                                                                : " is there already. Write over it?");
        return;
    }
    context.ask(line.of(path.string()));
    browser.isOpen = false;
}

void buildList(const PanelContext& context, FileBrowser& browser)
{
    ImGui::BeginChild("list", {0, length(300)}, true);
    const auto entries = browser.entries; // a copy, as a click reads another folder
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

void open(FileBrowser& browser, const std::string& line, const fs::path& suggested)
{
    for (const FileLine& known : fileLines()) {
        if (line != known.name) continue;
        std::error_code error;
        fs::path folder = suggested.parent_path();
        if (folder.empty()) folder = fs::current_path(error);
        browser = {};
        browser.isOpen = true;
        browser.line = &known;
        browser.folder = folder;
        if (known.ending) browser.name = suggested.stem().string() + known.ending;
        return;
    }
    throw InputError("browse", "'" + line + "' is not a line that takes a file");
}

void buildBrowser(const PanelContext& context, FileBrowser& browser)
{
    const FileLine& line = *browser.line;
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
    muted(line.extensions.empty() ? "Folder, or a path:" : "Name, or a path:");
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
    const char* const button = !line.ending ? "Open" : line.extensions.empty() ? "Save here" : "Save";
    if (mainButton(button, length(110))) choose(context, browser, false);
    context.name("browser.ok");
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {length(110), 0})) browser.isOpen = false;
    context.name("browser.cancel");
}

} // namespace vdbcage::view
