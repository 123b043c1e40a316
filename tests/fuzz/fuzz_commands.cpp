// Lines of the window's scripts, done one after the other on a state with a model and a cage. A line is refused in one
// line, or its command comes back from its own text, and the view from the commands for it. Lines that open files, and
// those that need the window, are left out.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <variant>

#include <fuzz/bytes.h>
#include <support/shapes.h>
#include <tools/view/state/command.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::view;
using fuzz::require;

namespace {

State startingState()
{
    OpenedMesh model;
    model.mesh = test::box({0, 0, 0}, {1, 1, 1});
    State state;
    state.document.model = std::make_shared<const OpenedMesh>(model);
    return state;
}

PosableCagePtr startingCage()
{
    return std::make_shared<PosableCage>(std::make_shared<const Mesh>(test::sphere({0.5, 0.5, 0.5}, 1, 4)));
}

template <typename... Some>
bool isOneOf(const Command& command)
{
    return (std::holds_alternative<Some>(command) || ...);
}

bool opensFiles(const Command& command)
{
    return isOneOf<OpenModel, OpenCage, ApplyPreset, OpenWeights, OpenPose, OpenPoses>(command);
}

/// Equal, and of the same text.
void requireComesBack(const Command& command)
{
    const std::string text = toText(command);
    require(text.find('\n') == std::string::npos);
    require(toText(commandOf(wordsOf(text))) == text);
}

void perform(State& state, const PosableCagePtr& cage, const std::string& line)
{
    try {
        const std::vector<std::string> words = wordsOf(line);
        std::string again;
        for (const std::string& word : words) again += ' ' + quotedWord(word);
        require(wordsOf(again) == words);
        if (words.empty()) return;
        const Command command = commandOf(words);
        requireComesBack(command);
        if (opensFiles(command)) return;
        state = applied(state, command, cage);
    } catch (const InputError& error) {
        fuzz::requireOneLine(error.what());
    } catch (const IoError& error) { // options may name files, too
        fuzz::requireOneLine(error.what());
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    State state = startingState();
    const PosableCagePtr cage = startingCage();
    std::istringstream lines(fuzz::textOf(data, size));
    for (std::string line; std::getline(lines, line);) perform(state, cage, line);
    State again;
    for (const Command& command : commandsFor(state.view)) {
        require(!changesDocument(command));
        again = applied(again, command);
    }
    require(again.view == state.view);
    for (const PoseKey& key : state.document.poses.keys()) {
        if (!key.pose) continue;
        for (const openvdb::Vec3d& p : key.pose->points) require(p.isFinite());
    }
    return 0;
}
