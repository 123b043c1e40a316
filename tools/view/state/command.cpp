#include <tools/view/state/command.h>

#include <algorithm>
#include <set>

#include <tools/view/state/move.h>
#include <tools/view/state/pose_files.h>
#include <tools/view/state/preset.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using Words = std::vector<std::string>;
using openvdb::Vec3d;

// One struct a command: how it is written, how it is read, what it does. Arguments are without the command's word.

std::string numbers(std::initializer_list<double> values)
{
    std::string text;
    for (const double value : values) text += ' ' + detail::numberText(value);
    return text;
}

std::string numbers(const Vec3d& v)
{
    return numbers({v[0], v[1], v[2]});
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

std::size_t placeOf(const std::string& word, const char* const* names, std::size_t count, const char* what)
{
    std::string known;
    for (std::size_t i = 0; i < count; ++i) {
        if (word == names[i]) return i;
        known += (i == 0 ? "" : i + 1 < count ? ", " : " or ") + std::string(names[i]);
    }
    throw InputError(what + (": '" + word) + "' is not allowed; it must be " + known);
}

/// The value that is called `word` in a list of names, the first being value 0.
template <class Enum, std::size_t count>
Enum named(const std::array<const char*, count>& names, const std::string& word, const char* what)
{
    return static_cast<Enum>(placeOf(word, names.data(), count, what));
}

edit::Selection selectionOf(const Words& words)
{
    std::set<openvdb::Index32> ids;
    for (std::size_t i = 1; i < words.size(); ++i) {
        ids.insert(static_cast<openvdb::Index32>(wholeNumberOf(words[i], "select", 0, 2147483647)));
    }
    return {named<edit::Element>(edit::elementNames, words[0], "select"), {ids.begin(), ids.end()}};
}

Vec3d vectorOf(const Words& words, std::size_t first, const char* what)
{
    return {numberOf(words[first], what), numberOf(words[first + 1], what), numberOf(words[first + 2], what)};
}

constexpr std::array<const char*, 3> axisNames{"x", "y", "z"};

Command rotationOf(const Words& words)
{
    const RotateSelected command{vectorOf(words, 0, "rotate"), numberOf(words[3], "rotate"),
                                 vectorOf(words, 4, "rotate")};
    if (command.axis == Vec3d(0)) throw InputError("rotate: the axis 0 0 0 is not allowed");
    return command;
}

Command scalingOf(const Words& words)
{
    if (words.size() != 6 && words.size() != 12) {
        throw InputError("scale: it takes three factors, a point, and no axes or two");
    }
    ScaleSelected command{vectorOf(words, 0, "scale"), vectorOf(words, 3, "scale")};
    if (words.size() == 12) {
        command.axes = {vectorOf(words, 6, "scale"), vectorOf(words, 9, "scale")};
        const double cosine = command.axes[0].dot(command.axes[1]);
        if (!(command.axes[0].length() > 0 && command.axes[1].length() > 0 &&
              std::abs(cosine) <= 1e-6 * command.axes[0].length() * command.axes[1].length())) {
            throw InputError("scale: the two axes must be at right angles, and not 0 0 0");
        }
    }
    return command;
}

std::optional<SymmetryPlane> mirrorOf(const Words& words)
{
    if (words.size() == 1 && words[0] == "off") return std::nullopt;
    if (words.size() != 2) throw InputError("mirror: it must be off, or an axis x, y or z and an OFFSET");
    return SymmetryPlane{named<int>(axisNames, words[0], "mirror"), numberOf(words[1], "mirror")};
}

Pivot pivotOf(const Words& words)
{
    if (words.size() == 3) return {Pivot::Kind::point, vectorOf(words, 0, "pivot")};
    if (words.size() != 1) throw InputError("pivot: it must be mean, box or origin, or a point X Y Z");
    return {named<Pivot::Kind>(pivotNames, words[0], "pivot"), Vec3d(0)};
}

int frameOf(const std::string& word, const char* what)
{
    return wholeNumberOf(word, what, 0, lastFrame);
}

double rateOf(const std::string& word)
{
    const double rate = numberOf(word, "rate");
    requireWithin({1, 240}, rate, "rate");
    return rate;
}

double softRadiusOf(const std::string& word)
{
    const double radius = numberOf(word, "soft");
    requireWithin({0, 10}, radius, "soft");
    return radius;
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

Command materialOf(const Words& words)
{
    Elasticity elasticity;
    elasticity.nu = numberOf(words[0], "nu");
    elasticity.rotations = rotationsNamed(words[1]);
    elasticity.localBulging = numberOf(words[2], "local bulging");
    elasticity.globalBulging = numberOf(words[3], "global bulging");
    requireElasticity(elasticity);
    return SetMaterial{elasticity};
}

/// The names of all families, with bars between them.
std::string familyWords()
{
    std::string words;
    for (const FamilyInfo& family : coordinateFamilies()) {
        words += (words.empty() ? "" : "|") + std::string(family.name);
    }
    return words;
}

/// What is known of a command beside what it does.
struct Syntax {
    const char* name;
    std::string arguments;
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
        {"coordinates", familyWords(), 1, 1, "chooses how the model follows the cage",
         [](const Words& w) -> Command { return SetCoordinates{coordinatesNamed(w[0])}; }},
        {"open-weights", "FILE", 1, 1,
         "the model follows the cage by weights of vdbcage bind or of others (.npy, .dmat: points x points of the "
         "cage)",
         [](const Words& w) -> Command { return OpenWeights{w[0]}; }},
        {"material", "NU global|local LOCAL GLOBAL", 4, 4,
         "chooses for somigliana: Poisson's ratio, what turns, local and global bulging",
         [](const Words& w) { return materialOf(w); }},
        {"move", "X Y Z", 3, 3, "moves what is selected, in world units",
         [](const Words& w) -> Command { return MoveSelected{vectorOf(w, 0, "move")}; }},
        {"rotate", "X Y Z DEGREES PX PY PZ", 7, 7, "turns what is selected around X Y Z through PX PY PZ",
         [](const Words& w) { return rotationOf(w); }},
        {"scale", "FX FY FZ PX PY PZ [X Y Z X Y Z]", 6, 12,
         "scales what is selected from PX PY PZ, along the world's axes or along two others and their normal",
         [](const Words& w) { return scalingOf(w); }},
        {"edit-cage", "split|collapse|flip|merge|cut", 1, 1,
         "changes selected edges (merge: of two triangles) or cuts selected quads, in mode shape",
         [](const Words& w) -> Command { return EditCage{named<CageEdit>(cageEditNames, w[0], "edit-cage")}; }},
        {"reset-pose", "all|selected", 1, 1, "moves all or what is selected back to where it is at rest",
         [](const Words& w) -> Command {
             if (w[0] != "all" && w[0] != "selected") {
                 throw InputError("reset-pose: '" + w[0] + "' is not allowed; it must be all or selected");
             }
             return ResetPose{w[0] == "selected"};
         }},
        {"open-pose", "FILE", 1, 1, "poses the cage as another file has it",
         [](const Words& w) -> Command { return OpenPose{w[0]}; }},
        {"open-poses", "FILE [FRAMES]", 1, 2,
         "opens a sequence such as walk.%04d.obj, or one of its files; or FRAMES frames of a .param file",
         [](const Words& w) -> Command {
             return w.size() == 1 ? OpenPoses{w[0]}
                                  : OpenPoses{w[0], wholeNumberOf(w[1], "open-poses", 1, lastFrame + 1)};
         }},
        {"set-key", "FRAME [NAME]", 1, 2, "keeps the pose at a frame on the time line, and names it",
         [](const Words& w) -> Command {
             return w.size() == 1 ? SetKey{frameOf(w[0], "set-key")} : SetKey{frameOf(w[0], "set-key"), w[1]};
         }},
        {"delete-key", "FRAME", 1, 1, "takes a pose off the time line",
         [](const Words& w) -> Command { return DeleteKey{frameOf(w[0], "delete-key")}; }},
        {"move-key", "FROM TO", 2, 2, "moves a pose to another frame",
         [](const Words& w) -> Command {
             return MoveKey{frameOf(w[0], "move-key"), frameOf(w[1], "move-key")};
         }},
        {"in-betweens", "FRAMES", 1, 1, "makes so many frames from rest to the pose that is seen",
         [](const Words& w) -> Command {
             return MakeInBetweens{wholeNumberOf(w[0], "in-betweens", 2, lastFrame + 1)};
         }},
        {"clear-poses", "", 0, 0, "takes all poses off the time line",
         [](const Words&) -> Command { return ClearPoses{}; }},
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
         [](const Words& w) -> Command {
             return SetCageColours{named<CageColours>(cageColourNames, w[0], "cage-colours")};
         }},
        {"model-colours", "plain|influence|stretch|inverted", 1, 1,
         "colours the posed model: how far it follows what is selected, how lengths changed, or what is inside out",
         [](const Words& w) -> Command {
             return SetModelColours{named<ModelColours>(modelColourNames, w[0], "model-colours")};
         }},
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
        {"select", "points|edges|faces [NUMBER...]", 1, anyNumber,
         "selects parts of the cage by number, or none; faces count triangles first",
         [](const Words& w) -> Command { return Select{selectionOf(w)}; }},
        {"mode", "shape|pose", 1, 1, "moves the cage at rest, or the cage and with it the model",
         [](const Words& w) -> Command { return SetMode{named<Mode>(modeNames, w[0], "mode")}; }},
        {"tool", "select|move|rotate|scale", 1, 1, "what the picture has handles for",
         [](const Words& w) -> Command { return SetTool{named<Tool>(toolNames, w[0], "tool")}; }},
        {"orientation", "world|local|normal|view", 1, 1, "along which axes things are moved",
         [](const Words& w) -> Command {
             return SetOrientation{named<Orientation>(orientationNames, w[0], "orientation")};
         }},
        {"pivot", "mean|box|origin|X Y Z", 1, 3, "what is turned and scaled by hand turns about it",
         [](const Words& w) -> Command { return SetPivot{pivotOf(w)}; }},
        {"see-through", "on|off", 1, 1, "selects what is hidden too",
         [](const Words& w) -> Command { return SetSeeThrough{switchOf(w[0], "see-through")}; }},
        {"soft", "RADIUS", 1, 1, "moves what is near, less and less; a part of the model's longest side, 0: off",
         [](const Words& w) -> Command { return SetSoft{softRadiusOf(w[0])}; }},
        {"mirror", "off|x|y|z OFFSET", 1, 2, "does the same on the other side of a plane across an axis",
         [](const Words& w) -> Command { return SetMirror{mirrorOf(w)}; }},
        {"compare", "off|" + familyWords(), 1, 1, "shows the model by another family of coordinates too, side by side",
         [](const Words& w) -> Command { return w[0] == "off" ? Compare{} : Compare{coordinatesNamed(w[0])}; }},
        {"time", "FRAME", 1, 1, "shows, and changes from now on, the pose at a frame",
         [](const Words& w) -> Command { return SetFrame{frameOf(w[0], "time")}; }},
        {"play", "on|off", 1, 1, "shows the frames of the time line one after the other, again and again",
         [](const Words& w) -> Command { return Play{switchOf(w[0], "play")}; }},
        {"rate", "FRAMES", 1, 1, "so many frames a second, 1 to 240",
         [](const Words& w) -> Command { return SetRate{rateOf(w[0])}; }},
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
    std::string operator()(const SetCoordinates& c) const { return ' ' + std::string(coordinatesName(c.family)); }
    std::string operator()(const OpenWeights& c) const { return ' ' + quotedWord(c.path); }
    std::string operator()(const SetMaterial& c) const
    {
        const Elasticity& e = c.elasticity;
        return numbers({e.nu}) + ' ' + rotationsName(e.rotations) + numbers({e.localBulging, e.globalBulging});
    }
    std::string operator()(const MoveSelected& c) const { return numbers(c.by); }
    std::string operator()(const RotateSelected& c) const
    {
        return numbers(c.axis) + numbers({c.degrees}) + numbers(c.pivot);
    }
    std::string operator()(const ScaleSelected& c) const
    {
        const std::string text = numbers(c.factors) + numbers(c.pivot);
        return c.axes == ScaleSelected().axes ? text : text + numbers(c.axes[0]) + numbers(c.axes[1]);
    }
    std::string operator()(const EditCage& c) const { return named(cageEditNames, c.edit); }
    std::string operator()(const ResetPose& c) const { return c.onlySelected ? " selected" : " all"; }
    std::string operator()(const OpenPose& c) const { return ' ' + quotedWord(c.path); }
    std::string operator()(const OpenPoses& c) const
    {
        return ' ' + quotedWord(c.path) + (c.frames == OpenPoses().frames ? "" : ' ' + std::to_string(c.frames));
    }
    std::string operator()(const SetKey& c) const
    {
        return ' ' + std::to_string(c.frame) + (c.name ? ' ' + quotedWord(*c.name) : "");
    }
    std::string operator()(const DeleteKey& c) const { return ' ' + std::to_string(c.frame); }
    std::string operator()(const MoveKey& c) const { return ' ' + std::to_string(c.from) + ' ' + std::to_string(c.to); }
    std::string operator()(const MakeInBetweens& c) const { return ' ' + std::to_string(c.frames); }
    std::string operator()(const ClearPoses&) const { return ""; }
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
    std::string operator()(const SetCageColours& c) const { return named(cageColourNames, c.colours); }
    std::string operator()(const SetModelColours& c) const { return named(modelColourNames, c.colours); }
    std::string operator()(const SetSection& c) const
    {
        if (!c.section) return " off";
        return numbers(c.section->normal) + numbers({c.section->offset});
    }
    std::string operator()(const ShowGround& c) const { return onOff(c.shown); }
    std::string operator()(const ShowAxes& c) const { return onOff(c.shown); }
    std::string operator()(const SetTurntable& c) const { return onOff(c.on); }
    std::string operator()(const ShowTimes& c) const { return onOff(c.shown); }
    std::string operator()(const Select& c) const
    {
        std::string text = named(edit::elementNames, c.selection.kind);
        for (const openvdb::Index32 id : c.selection.ids) text += ' ' + std::to_string(id);
        return text;
    }
    std::string operator()(const SetMode& c) const { return named(modeNames, c.mode); }
    std::string operator()(const SetTool& c) const { return named(toolNames, c.tool); }
    std::string operator()(const SetOrientation& c) const { return named(orientationNames, c.orientation); }
    std::string operator()(const SetPivot& c) const
    {
        return c.pivot.kind == Pivot::Kind::point ? numbers(c.pivot.point) : named(pivotNames, c.pivot.kind);
    }
    std::string operator()(const SetSeeThrough& c) const { return onOff(c.on); }
    std::string operator()(const SetSoft& c) const { return numbers({c.radius}); }
    std::string operator()(const Compare& c) const
    {
        return c.family ? ' ' + std::string(coordinatesName(*c.family)) : " off";
    }
    std::string operator()(const SetFrame& c) const { return ' ' + std::to_string(c.frame); }
    std::string operator()(const Play& c) const { return onOff(c.on); }
    std::string operator()(const SetRate& c) const { return numbers({c.framesPerSecond}); }
    std::string operator()(const SetMirror& c) const
    {
        if (!c.plane) return " off";
        return ' ' + std::string(axisNames[static_cast<std::size_t>(c.plane->axis)]) + numbers({c.plane->offset});
    }

private:
    template <class Enum, std::size_t count>
    static std::string named(const std::array<const char*, count>& names, Enum value)
    {
        const char* const* const first = names.data(); // GCC 12 mixes up the sizes of lists that it inlines
        return ' ' + std::string(first[static_cast<std::size_t>(value)]);
    }
};

struct Apply {
    State& state;
    std::string* remark;

    void operator()(const OpenModel& c) const
    {
        state.document.model = openMesh(c.path);
        state.document.cage.reset();
        state.document.poses = {};
        if (state.document.weights) state.document.coordinates = Coordinates::meanValue;
        state.document.weights.reset();
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
    void operator()(const SetCoordinates& c) const
    {
        state.document.coordinates = c.family;
        state.document.weights.reset();
    }
    void operator()(const OpenWeights& c) const
    {
        state.document.weights = openWeights(c.path);
        state.document.coordinates = Coordinates::given;
    }
    void operator()(const SetMaterial& c) const { state.document.elasticity = c.elasticity; }
    void operator()(const MoveSelected& c) const { state.document = withMotion(state, edit::Move{c.by}); }
    void operator()(const RotateSelected& c) const
    {
        state.document = withMotion(state, edit::Rotate{c.axis.unit(), c.degrees, c.pivot});
    }
    void operator()(const ScaleSelected& c) const
    {
        const Vec3d x = c.axes[0].unit(), y = (c.axes[1] - x * x.dot(c.axes[1])).unit();
        state.document = withMotion(state, edit::Scale{c.factors, {x, y, x.cross(y)}, c.pivot});
    }
    void operator()(const EditCage& c) const { state.document = withEdit(state, c.edit); }
    void operator()(const ResetPose& c) const { state.document = withResetPose(state, c.onlySelected); }
    void operator()(const OpenPose& c) const { state.document = withOpenedPose(state, c.path, remark); }
    void operator()(const OpenPoses& c) const { state.document = withOpenedPoses(state, c.path, c.frames, remark); }
    void operator()(const SetKey& c) const { state.document = withKey(state, c.frame, c.name); }
    void operator()(const DeleteKey& c) const
    {
        requiredKey(c.frame, "delete-key");
        state.document.poses = state.document.poses.without(c.frame);
    }
    void operator()(const MoveKey& c) const
    {
        TimeLine& poses = state.document.poses;
        PoseKey key = requiredKey(c.from, "move-key");
        if (c.from == c.to) return;
        if (poses.keyAt(c.to))
            throw InputError("move-key: there is a key at frame " + std::to_string(c.to) + " already");
        key.frame = c.to;
        poses = poses.without(c.from).with(std::move(key));
    }
    void operator()(const MakeInBetweens& c) const { state.document = withInBetweens(state, c.frames); }
    void operator()(const ClearPoses&) const { state.document.poses = {}; }
    void operator()(const SetCamera& c) const { state.view.camera = c.camera; }
    void operator()(const ShowLayer& c) const { state.view.layer(c.layer).shown = c.shown; }
    void operator()(const FadeLayer& c) const { state.view.layer(c.layer).opacity = c.opacity; }
    void operator()(const ColourLayer& c) const { state.view.layer(c.layer).colour = c.colour; }
    void operator()(const SetCageColours& c) const { state.view.cageColours = c.colours; }
    void operator()(const SetModelColours& c) const { state.view.modelColours = c.colours; }
    void operator()(const SetSection& c) const { state.view.section = c.section; }
    void operator()(const ShowGround& c) const { state.view.ground = c.shown; }
    void operator()(const ShowAxes& c) const { state.view.axes = c.shown; }
    void operator()(const SetTurntable& c) const { state.view.turntable = c.on; }
    void operator()(const ShowTimes& c) const { state.view.times = c.shown; }
    void operator()(const Select& c) const { state.view.selection = c.selection; }
    void operator()(const SetMode& c) const { state.view.mode = c.mode; }
    void operator()(const SetTool& c) const { state.view.tool = c.tool; }
    void operator()(const SetOrientation& c) const { state.view.orientation = c.orientation; }
    void operator()(const SetPivot& c) const { state.view.pivot = c.pivot; }
    void operator()(const SetSeeThrough& c) const { state.view.seeThrough = c.on; }
    void operator()(const SetSoft& c) const { state.view.softRadius = c.radius; }
    void operator()(const SetMirror& c) const { state.view.mirror = c.plane; }
    void operator()(const Compare& c) const { state.view.compared = c.family; }
    void operator()(const SetFrame& c) const { state.view.frame = c.frame; }
    void operator()(const Play& c) const { state.view.isPlaying = c.on; }
    void operator()(const SetRate& c) const { state.view.framesPerSecond = c.framesPerSecond; }

private:
    PoseKey requiredKey(int frame, const char* what) const
    {
        const PoseKey* const key = state.document.poses.keyAt(frame);
        if (!key) throw InputError(what + (": there is no key at frame " + std::to_string(frame)));
        return *key;
    }
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
        list.emplace_back(syntax.name + std::string(syntax.arguments.empty() ? "" : " ") + syntax.arguments,
                          syntax.help);
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
                    {SetCageColours{view.cageColours}, SetModelColours{view.modelColours}, SetSection{view.section},
                     ShowGround{view.ground}, ShowAxes{view.axes}, SetTurntable{view.turntable}, ShowTimes{view.times},
                     SetMode{view.mode}, SetTool{view.tool}, SetOrientation{view.orientation}, SetPivot{view.pivot},
                     SetSeeThrough{view.seeThrough}, SetSoft{view.softRadius}, SetMirror{view.mirror},
                     Compare{view.compared}, SetFrame{view.frame}, SetRate{view.framesPerSecond}, Play{view.isPlaying},
                     Select{view.selection}});
    return commands;
}

State applied(const State& state, const Command& command, std::string* remark)
{
    State changed = state;
    std::visit(Apply{changed, remark}, command);
    return changed;
}

} // namespace vdbcage::view
