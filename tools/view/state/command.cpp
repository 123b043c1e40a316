#include <tools/view/state/command.h>

#include <algorithm>
#include <set>

#include <tools/view/state/preset.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using Words = std::vector<std::string>;

// One struct a command: how it is written, how it is read, what it does. Arguments are without the command's word.

std::string numbers(std::initializer_list<double> values)
{
    std::string text;
    for (const double value : values) text += ' ' + detail::numberText(value);
    return text;
}

LayerId layerNamed(const std::string& name)
{
    std::string known;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto layer = static_cast<LayerId>(i);
        if (name == nameOf(layer)) return layer;
        known += (i > 0 ? ", " : "") + std::string(nameOf(layer));
    }
    throw InputError("layer: '" + name + "' is not allowed; it must be one of " + known);
}

double fractionOf(const std::string& word, const std::string& what)
{
    const double value = numberOf(word, what);
    requireWithin({0, 1}, value, what);
    return value;
}

constexpr std::array<const char*, 3> cageColourNames{"plain", "kinds", "distance"};

CageColours cageColoursNamed(const std::string& name)
{
    for (std::size_t i = 0; i < cageColourNames.size(); ++i) {
        if (name == cageColourNames[i]) return static_cast<CageColours>(i);
    }
    throw InputError("cage-colours: '" + name + "' is not allowed; it must be plain, kinds or distance");
}

const char* onOff(bool on)
{
    return on ? " on" : " off";
}

draw::Camera cameraOf(const Words& words)
{
    draw::Camera camera;
    if (words[0] == "orthographic") {
        camera.projection = draw::Projection::orthographic;
    } else if (words[0] != "perspective") {
        throw InputError("camera: '" + words[0] + "' is not allowed; it must be perspective or orthographic");
    }
    if (words[1] == "z") {
        camera.view.up = draw::UpAxis::z;
    } else if (words[1] != "y") {
        throw InputError("camera: '" + words[1] + "' is not allowed; up must be y or z");
    }
    camera.view.azimuthDegrees = numberOf(words[2], "azimuth");
    camera.view.elevationDegrees = numberOf(words[3], "elevation");
    draw::requireView(camera.view);
    for (int i = 0; i < 3; ++i) camera.target[i] = numberOf(words[4 + static_cast<std::size_t>(i)], "target");
    camera.distance = numberOf(words[7], "distance");
    requireWithin({draw::leastDistance, draw::mostDistance}, camera.distance, "distance");
    return camera;
}

std::optional<SectionPlane> sectionOf(const Words& words)
{
    if (words.size() == 1 && words[0] == "off") return std::nullopt;
    if (words.size() != 4) throw InputError("section: it must be off, or a normal X Y Z and an OFFSET");
    SectionPlane plane;
    for (int i = 0; i < 3; ++i) plane.normal[i] = numberOf(words[static_cast<std::size_t>(i)], "section");
    plane.offset = numberOf(words[3], "section");
    if (plane.normal == openvdb::Vec3d(0)) throw InputError("section: the normal 0 0 0 is not allowed");
    return plane;
}

std::vector<openvdb::Index32> facesOf(const Words& words)
{
    std::set<openvdb::Index32> faces;
    for (const std::string& word : words) {
        faces.insert(static_cast<openvdb::Index32>(wholeNumberOf(word, "select", 0, 2147483647)));
    }
    return {faces.begin(), faces.end()};
}

/// The options' values must be allowed together only when a cage is made of them: one by one they may pass through
/// what is not.
CageOptions withOption(CageOptions options, const SetOption& command)
{
    setOption(options, command.name, command.value);
    return options;
}

CageOptions withReset(CageOptions options, const ResetOptions& command)
{
    if (command.names.empty()) return {};
    const auto defaults = optionValues(CageOptions{});
    for (const std::string& name : command.names) {
        const auto known =
            std::find_if(defaults.begin(), defaults.end(), [&](const auto& o) { return o.first == name; });
        // setOption says which names there are.
        setOption(options, name, known == defaults.end() ? std::string() : known->second);
    }
    return options;
}

/// What is known of a command beside what it does.
struct Syntax {
    const char* name;
    const char* arguments;
    std::size_t least, most; ///< words that it takes
    const char* help;
    Command (*read)(const Words&);
};

constexpr std::size_t anyNumber = ~std::size_t{0};

/// In the order of Command's alternatives.
const std::array<Syntax, std::variant_size_v<Command>>& syntaxes()
{
    static const std::array<Syntax, std::variant_size_v<Command>> list{{
        {"open", "FILE", 1, 1, "opens a model (.obj .off .ply .stl) and makes its cage",
         [](const Words& w) -> Command { return OpenModel{w[0]}; }},
        {"open-cage", "FILE", 1, 1, "shows a cage from a file instead of making one",
         [](const Words& w) -> Command { return OpenCage{w[0]}; }},
        {"close-cage", "", 0, 0, "goes back to the cage that the options make",
         [](const Words&) -> Command { return CloseCage{}; }},
        {"set", "OPTION VALUE", 2, 2, "sets an option of `vdbcage make`",
         [](const Words& w) -> Command {
             return SetOption{w[0], w[1]};
         }},
        {"reset", "[OPTION...]", 0, anyNumber, "sets options, or all of them, to their defaults",
         [](const Words& w) -> Command { return ResetOptions{w}; }},
        {"preset", "NAME|FILE", 1, 1, "sets all options to those of a preset or of a file",
         [](const Words& w) -> Command { return ApplyPreset{w[0]}; }},
        {"camera", "perspective|orthographic y|z AZIMUTH ELEVATION X Y Z DISTANCE", 8, 8,
         "looks at X Y Z from DISTANCE; the model fills a ball of radius 1 around 0 0 0",
         [](const Words& w) -> Command { return SetCamera{cameraOf(w)}; }},
        {"layer", "NAME on|off", 2, 2, "shows or hides a layer",
         [](const Words& w) -> Command {
             return ShowLayer{layerNamed(w[0]), switchOf(w[1], "layer")};
         }},
        {"opacity", "NAME VALUE", 2, 2, "fades a layer's faces: 0 is clear, 1 is solid",
         [](const Words& w) -> Command {
             return FadeLayer{layerNamed(w[0]), fractionOf(w[1], "opacity")};
         }},
        {"colour", "NAME RED GREEN BLUE", 4, 4, "colours a layer, each of the three 0 to 1",
         [](const Words& w) -> Command {
             return ColourLayer{layerNamed(w[0]),
                                {static_cast<float>(fractionOf(w[1], "colour")),
                                 static_cast<float>(fractionOf(w[2], "colour")),
                                 static_cast<float>(fractionOf(w[3], "colour"))}};
         }},
        {"cage-colours", "plain|kinds|distance", 1, 1,
         "colours the cage's faces: quads apart, or distance to the model",
         [](const Words& w) -> Command { return SetCageColours{cageColoursNamed(w[0])}; }},
        {"section", "off|X Y Z OFFSET", 1, 4, "cuts off what has (X Y Z) . point > OFFSET",
         [](const Words& w) -> Command { return SetSection{sectionOf(w)}; }},
        {"ground", "on|off", 1, 1, "shows a grid below the model",
         [](const Words& w) -> Command { return ShowGround{switchOf(w[0], "ground")}; }},
        {"axes", "on|off", 1, 1, "shows axes in a corner",
         [](const Words& w) -> Command { return ShowAxes{switchOf(w[0], "axes")}; }},
        {"turntable", "on|off", 1, 1, "turns the view by itself",
         [](const Words& w) -> Command { return SetTurntable{switchOf(w[0], "turntable")}; }},
        {"times", "on|off", 1, 1, "shows how long making a cage took",
         [](const Words& w) -> Command { return ShowTimes{switchOf(w[0], "times")}; }},
        {"select", "[FACE...]", 0, anyNumber, "selects faces of the cage by number, triangles first; or nothing",
         [](const Words& w) -> Command { return Select{facesOf(w)}; }},
    }};
    return list;
}

struct ArgumentsOf {
    std::string operator()(const OpenModel& c) const { return ' ' + quotedWord(c.path); }
    std::string operator()(const OpenCage& c) const { return ' ' + quotedWord(c.path); }
    std::string operator()(const CloseCage&) const { return ""; }
    std::string operator()(const SetOption& c) const { return ' ' + quotedWord(c.name) + ' ' + quotedWord(c.value); }
    std::string operator()(const ResetOptions& c) const
    {
        std::string text;
        for (const std::string& name : c.names) text += ' ' + quotedWord(name);
        return text;
    }
    std::string operator()(const ApplyPreset& c) const { return ' ' + quotedWord(c.name); }
    std::string operator()(const SetCamera& c) const
    {
        const draw::Camera& camera = c.camera;
        const openvdb::Vec3d& target = camera.target;
        return (camera.projection == draw::Projection::perspective ? " perspective" : " orthographic") +
               std::string(camera.view.up == draw::UpAxis::y ? " y" : " z") +
               numbers({camera.view.azimuthDegrees, camera.view.elevationDegrees, target[0], target[1], target[2],
                        camera.distance});
    }
    std::string operator()(const ShowLayer& c) const { return ' ' + std::string(nameOf(c.layer)) + onOff(c.shown); }
    std::string operator()(const FadeLayer& c) const
    {
        return ' ' + std::string(nameOf(c.layer)) + numbers({c.opacity});
    }
    std::string operator()(const ColourLayer& c) const
    {
        // As doubles: exact, and read back as the same floats.
        return ' ' + std::string(nameOf(c.layer)) +
               numbers({double{c.colour[0]}, double{c.colour[1]}, double{c.colour[2]}});
    }
    std::string operator()(const SetCageColours& c) const
    {
        return ' ' + std::string(cageColourNames[static_cast<std::size_t>(c.colours)]);
    }
    std::string operator()(const SetSection& c) const
    {
        if (!c.section) return " off";
        const openvdb::Vec3d& normal = c.section->normal;
        return numbers({normal[0], normal[1], normal[2], c.section->offset});
    }
    std::string operator()(const ShowGround& c) const { return onOff(c.shown); }
    std::string operator()(const ShowAxes& c) const { return onOff(c.shown); }
    std::string operator()(const SetTurntable& c) const { return onOff(c.on); }
    std::string operator()(const ShowTimes& c) const { return onOff(c.shown); }
    std::string operator()(const Select& c) const
    {
        std::string text;
        for (const openvdb::Index32 face : c.faces) text += ' ' + std::to_string(face);
        return text;
    }
};

struct Apply {
    State& state;

    void operator()(const OpenModel& c) const
    {
        state.document.model = openMesh(c.path);
        state.document.cage.reset();
    }
    void operator()(const OpenCage& c) const
    {
        if (!state.document.model) throw InputError("open-cage: there is no model yet that the cage could bound");
        state.document.cage = openMesh(c.path);
    }
    void operator()(const CloseCage&) const { state.document.cage.reset(); }
    void operator()(const SetOption& c) const { setOptions(withOption(state.document.options, c)); }
    void operator()(const ResetOptions& c) const { setOptions(withReset(state.document.options, c)); }
    void operator()(const ApplyPreset& c) const { setOptions(presetOptions(c.name)); }
    void operator()(const SetCamera& c) const { state.view.camera = c.camera; }
    void operator()(const ShowLayer& c) const { state.view.layer(c.layer).shown = c.shown; }
    void operator()(const FadeLayer& c) const { state.view.layer(c.layer).opacity = c.opacity; }
    void operator()(const ColourLayer& c) const { state.view.layer(c.layer).colour = c.colour; }
    void operator()(const SetCageColours& c) const { state.view.cageColours = c.colours; }
    void operator()(const SetSection& c) const { state.view.section = c.section; }
    void operator()(const ShowGround& c) const { state.view.ground = c.shown; }
    void operator()(const ShowAxes& c) const { state.view.axes = c.shown; }
    void operator()(const SetTurntable& c) const { state.view.turntable = c.on; }
    void operator()(const ShowTimes& c) const { state.view.times = c.shown; }
    void operator()(const Select& c) const { state.view.selection = c.faces; }

private:
    void setOptions(CageOptions options) const
    {
        state.document.options = std::move(options);
        state.document.cage.reset();
    }
};

const Syntax* syntaxOf(const std::string& word)
{
    const auto& list = syntaxes();
    const auto found = std::find_if(list.begin(), list.end(), [&](const Syntax& s) { return word == s.name; });
    return found == list.end() ? nullptr : &*found;
}

} // namespace

bool changesDocument(const Command& command)
{
    // The first alternatives are those of the document.
    return command.index() < Command(SetCamera{}).index();
}

std::string toText(const Command& command)
{
    return syntaxes()[command.index()].name + std::visit(ArgumentsOf{}, command);
}

bool isCommand(const std::string& word)
{
    return syntaxOf(word) != nullptr;
}

Command commandOf(const Words& words)
{
    const Syntax* const syntax = words.empty() ? nullptr : syntaxOf(words[0]);
    if (!syntax) throw InputError("'" + (words.empty() ? std::string() : words[0]) + "' is not a command");
    const Words arguments(words.begin() + 1, words.end());
    if (arguments.size() < syntax->least || arguments.size() > syntax->most) {
        throw InputError(words[0] + ": it is written " + syntax->name + ' ' + syntax->arguments);
    }
    return syntax->read(arguments);
}

std::vector<std::pair<std::string, std::string>> describeCommands()
{
    std::vector<std::pair<std::string, std::string>> list;
    for (const Syntax& syntax : syntaxes()) {
        list.emplace_back(syntax.name + std::string(*syntax.arguments ? " " : "") + syntax.arguments, syntax.help);
    }
    return list;
}

std::vector<Command> commandsFor(const ViewState& view)
{
    std::vector<Command> commands{SetCamera{view.camera}};
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto layer = static_cast<LayerId>(i);
        const LayerLook& look = view.layers[i];
        commands.insert(commands.end(), {ShowLayer{layer, look.shown}, FadeLayer{layer, look.opacity},
                                         ColourLayer{layer, look.colour}});
    }
    commands.insert(commands.end(),
                    {SetCageColours{view.cageColours}, SetSection{view.section}, ShowGround{view.ground},
                     ShowAxes{view.axes}, SetTurntable{view.turntable}, ShowTimes{view.times}, Select{view.selection}});
    return commands;
}

State applied(const State& state, const Command& command)
{
    State changed = state;
    std::visit(Apply{changed}, command);
    return changed;
}

} // namespace vdbcage::view
