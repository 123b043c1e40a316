#include <tools/view/input/verbs.h>

#include <algorithm>
#include <array>

namespace vdbcage::view {

namespace {

constexpr std::array<Verb, 51> verbs{{
    {"undo", "", 0, 0, "takes back the last change of options or files", false},
    {"redo", "", 0, 0, "does again what was taken back", false},
    {"undo-view", "", 0, 0, "takes back the last change of the view", false},
    {"redo-view", "", 0, 0, "does it again", false},
    {"make", "", 0, 0, "makes the cage that was cancelled or failed", false},
    {"cancel", "", 0, 0, "closes what is open, or stops what is written, made or bound", false},
    {"more", "", 0, 0, "a twentieth more faces", true},
    {"fewer", "", 0, 0, "a twentieth fewer faces", true},
    {"toggle", "LAYER|ground|axes|turntable|mode|play|see-through|mirror-x|mirror-y|mirror-z", 1, 1,
     "shows what is hidden and hides what is shown", true},
    {"frame", "all|selected", 1, 1, "moves the view so that all is seen", true},
    {"look", "front|back|left|right|top|bottom", 1, 1, "looks from there", true},
    {"projection", "perspective|orthographic|toggle", 1, 1, "how what is far away looks", true},
    {"up", "y|z|toggle", 1, 1, "which axis points up", true},
    {"select-kind", "points|edges|faces", 1, 1, "selects these from now on; what is selected becomes such", true},
    {"select-all", "", 0, 0, "selects all of the cage", true},
    {"select-none", "", 0, 0, "selects nothing", true},
    {"select-invert", "", 0, 0, "selects what is not selected", true},
    {"select-linked", "", 0, 0, "selects all that hangs together with what is selected", true},
    {"select-grow", "", 0, 0, "selects the neighbours too", true},
    {"select-shrink", "", 0, 0, "selects what has no neighbour that is not selected", true},
    {"select-loop", "", 0, 0, "selects the loops through what is selected", true},
    {"box", "", 0, 0, "selects what is in the box that is dragged next", true},
    {"grab", "move|rotate|scale", 1, 1, "moves what is selected with the pointer", true},
    {"next-frame", "", 0, 0, "shows the pose of the next frame", true},
    {"previous-frame", "", 0, 0, "shows the pose of the frame before", true},
    {"next-key", "", 0, 0, "goes to the next key of the time line", true},
    {"previous-key", "", 0, 0, "goes to the key before", true},
    {"insert-key", "", 0, 0, "keeps the pose that is seen on the time line", true},
    {"remove-key", "", 0, 0, "takes the key at this frame off the time line", true},
    {"save-posed-cage", "FILE", 1, 1, "writes the posed cage (.obj .off .ply .stl)", false},
    {"save-posed-model", "FILE", 1, 1, "writes the model, posed by the cage; all else of an OBJ file stays", false},
    {"save-posed-cages", "PATTERN", 1, 1,
     "writes the posed cage of every frame from the first key to the last: cage.%04d.obj", false},
    {"save-posed-models", "PATTERN", 1, 1,
     "writes the posed model of every frame from the first key to the last: out.%04d.obj", false},
    {"save-colours", "FILE.ply", 1, 1,
     "writes the posed model with what its colours tell: influence, stretch or inverted", false},
    {"save-weights", "FILE.npy", 1, 1, "writes by what weights the cage moves the model", false},
    {"save-cage", "FILE", 1, 1, "writes the cage (.obj .off .ply .stl)", false},
    {"save-stages", "FOLDER", 1, 1, "writes every stage (.vdb, .obj)", false},
    {"save-report", "FILE.json", 1, 1, "writes options, times, memory and verdict", false},
    {"save-options", "FILE", 1, 1, "writes the options, for `preset FILE`", false},
    {"save-scene", "FILE.json", 1, 1, "writes options, view and names of files, and the cage and poses beside it",
     false},
    {"save-picture", "FILE.png", 1, 1, "writes what is seen, without the panels; of two pictures the left one", false},
    {"open-scene", "FILE.json", 1, 1, "opens what save-scene wrote", false},
    {"drop", "FILE", 1, 1, "as if FILE was dropped on the window", true},
    {"reload", "", 0, 0, "reads the model's file anew", false},
    {"browse", "LINE", 1, 1, "asks for a file, and then does LINE with it", true},
    {"keys", "blender|maya", 1, 1, "has the keys and mouse buttons of that program from now on", true},
    {"help", "", 0, 0, "shows keys, mouse and commands", true},
    {"dismiss", "", 0, 0, "closes a message or a question", true},
    {"quit", "", 0, 0, "ends; asks if there is unsaved work", true},
    {"quit!", "", 0, 0, "ends", true},
    {"tick", "SECONDS", 1, 1, "lets time pass for what moves by itself", true},
}};

} // namespace

const Verb* verbNamed(const std::string& name)
{
    const auto found = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& verb) { return name == verb.name; });
    return found == verbs.end() ? nullptr : &*found;
}

std::vector<std::pair<std::string, std::string>> describeVerbs()
{
    std::vector<std::pair<std::string, std::string>> list;
    for (const Verb& verb : verbs) {
        list.emplace_back(verb.name + std::string(*verb.arguments ? " " : "") + verb.arguments, verb.help);
    }
    return list;
}

} // namespace vdbcage::view
