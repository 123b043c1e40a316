#include <vdbcage/pipeline/options.h>

#include <charconv>
#include <type_traits>
#include <utility>

#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

/// The names of an enumeration's values, in the order of the help; found by the type of a (null) value.
using ElementNames = std::vector<std::pair<const char*, StructuringElement>>;

const ElementNames& names(StructuringElement /*type*/)
{
    static const ElementNames list{{"sphere", StructuringElement::sphere}, {"cube", StructuringElement::cube}};
    return list;
}

const std::vector<std::pair<const char*, CageFaces>>& names(CageFaces /*type*/)
{
    static const std::vector<std::pair<const char*, CageFaces>> list{{"triangles", CageFaces::triangles},
                                                                     {"triquad", CageFaces::triquad},
                                                                     {"quads", CageFaces::quads},
                                                                     {"loops", CageFaces::loops}};
    return list;
}

const std::vector<std::pair<const char*, Interior>>& names(Interior /*type*/)
{
    static const std::vector<std::pair<const char*, Interior>> list{
        {"auto", Interior::automatic}, {"solid", Interior::solid}, {"shell", Interior::shell}};
    return list;
}

const std::vector<std::pair<const char*, Voxelizer>>& names(Voxelizer /*type*/)
{
    static const std::vector<std::pair<const char*, Voxelizer>> list{
        {"auto", Voxelizer::automatic}, {"cpu", Voxelizer::cpu}, {"gl", Voxelizer::gl}, {"cgal", Voxelizer::cgal}};
    return list;
}

const std::vector<std::pair<const char*, CageParts>>& names(CageParts /*type*/)
{
    static const std::vector<std::pair<const char*, CageParts>> list{{"keep", CageParts::keep},
                                                                     {"merge", CageParts::merge}};
    return list;
}

const std::vector<std::pair<const char*, CageSymmetry>>& names(CageSymmetry /*type*/)
{
    static const std::vector<std::pair<const char*, CageSymmetry>> list{{"auto", CageSymmetry::automatic},
                                                                        {"off", CageSymmetry::off},
                                                                        {"x", CageSymmetry::x},
                                                                        {"y", CageSymmetry::y},
                                                                        {"z", CageSymmetry::z}};
    return list;
}

const std::vector<std::pair<const char*, Precision>>& names(Precision /*type*/)
{
    static const std::vector<std::pair<const char*, Precision>> list{
        {"auto", Precision::automatic}, {"float32", Precision::float32}, {"float64", Precision::float64}};
    return list;
}

const std::vector<std::pair<const char*, Effort>>& names(Effort /*type*/)
{
    static const std::vector<std::pair<const char*, Effort>> list{
        {"fast", Effort::fast}, {"fair", Effort::fair}, {"best", Effort::best}};
    return list;
}

const std::vector<std::pair<const char*, bool>>& names(bool /*type*/)
{
    static const std::vector<std::pair<const char*, bool>> list{{"on", true}, {"off", false}};
    return list;
}

template <typename Value>
std::string nameList()
{
    return detail::joined(names(Value{}), "|", [](const auto& entry) { return entry.first; });
}

/// One overload set for each task: the text of a value, setting it from text, its range, its placeholder in the help.
struct ToText {
    std::string operator()(int value) const { return std::to_string(value); }
    std::string operator()(double value) const { return detail::numberText(value); }
    template <typename Number>
    std::string operator()(const std::optional<Number>& value) const
    {
        return value ? (*this)(*value) : "auto";
    }
    std::string operator()(const FactorField& value) const
    {
        if (!value.source.empty()) return value.source;
        return value.isNone() ? "none" : "given";
    }
    std::string operator()(const Joints& value) const
    {
        if (!value.file.empty()) return value.file.string();
        return value.list.empty() ? "none" : "given";
    }
    template <typename Name>
    std::string operator()(Name value) const
    {
        for (const auto& entry : names(value)) {
            if (entry.second == value) return entry.first;
        }
        return {};
    }
};

[[noreturn]] void refuse(const OptionInfo& info, const std::string& value, const std::string& allowed)
{
    throw InputError("--" + std::string(info.name), "'" + value + "' is not allowed; it must be " + allowed);
}

template <typename Number>
void requireInRange(const OptionInfo& info, Number value)
{
    if (!info.range.contains(value)) refuse(info, ToText{}(value), toText(info.range));
}

template <typename Number>
Number parseNumber(const OptionInfo& info, const std::string& text, const char* kind)
{
    Number value{};
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    if (parsed.ec != std::errc() || parsed.ptr != end) {
        refuse(info, text, std::string(kind) + ", " + toText(info.range));
    }
    requireInRange(info, value);
    return value;
}

struct FromText {
    const OptionInfo& info;
    const std::string& text;

    void operator()(int& field) const { field = parseNumber<int>(info, text, "a whole number"); }
    void operator()(double& field) const { field = parseNumber<double>(info, text, "a number"); }
    template <typename Number>
    void operator()(std::optional<Number>& field) const
    {
        if (text == "auto") {
            field.reset();
        } else {
            const bool whole = std::is_integral_v<Number>;
            field = parseNumber<Number>(info, text, whole ? "auto or a whole number" : "auto or a number");
        }
    }
    void operator()(FactorField& field) const
    {
        try {
            const std::string name = info.name;
            field = readFactorField(text, name == "scale-field" ? "scale" : name);
        } catch (const InputError& error) {
            throw InputError("--" + std::string(info.name), error.what());
        }
    }
    void operator()(Joints& field) const { field = text == "none" ? Joints{} : readJoints(text); }
    template <typename Name>
    void operator()(Name& field) const
    {
        for (const auto& entry : names(field)) {
            if (text == entry.first) {
                field = entry.second;
                return;
            }
        }
        refuse(info, text, "one of " + nameList<Name>());
    }
};

struct RequireRange {
    const OptionInfo& info;

    void operator()(int value) const { requireInRange(info, value); }
    void operator()(double value) const { requireInRange(info, value); }
    template <typename Number>
    void operator()(const std::optional<Number>& value) const
    {
        if (value) requireInRange(info, *value);
    }
    template <typename Name>
    void operator()(const Name& /*value*/) const
    {
    }
};

struct Placeholder {
    const OptionInfo& info;

    std::string operator()(int /*value*/) const { return info.symbol; }
    std::string operator()(double /*value*/) const { return info.symbol; }
    template <typename Number>
    std::string operator()(const std::optional<Number>& /*value*/) const
    {
        return "auto|" + std::string(info.symbol);
    }
    std::string operator()(const FactorField& /*value*/) const { return info.symbol; }
    std::string operator()(const Joints& /*value*/) const { return info.symbol; }
    template <typename Name>
    std::string operator()(Name /*value*/) const
    {
        return nameList<Name>();
    }
};

} // namespace

std::vector<OptionText> describeOptions()
{
    std::vector<OptionText> list;
    const CageOptions defaults;
    visitOptions(defaults, [&](const OptionInfo& info, const auto& field) {
        const bool isNumber = info.range.least < info.range.most;
        list.push_back({info.name, Placeholder{info}(field), info.help, isNumber ? toText(info.range) : "",
                        ToText{}(field), info.isRare});
    });
    return list;
}

std::vector<std::pair<std::string, std::string>> optionValues(const CageOptions& options)
{
    std::vector<std::pair<std::string, std::string>> list;
    visitOptions(options,
                 [&](const OptionInfo& info, const auto& field) { list.emplace_back(info.name, ToText{}(field)); });
    return list;
}

void setOption(CageOptions& options, const std::string& name, const std::string& value)
{
    bool found = false;
    visitOptions(options, [&](const OptionInfo& info, auto& field) {
        if (name == info.name) {
            FromText{info, value}(field);
            found = true;
        }
    });
    if (!found) {
        std::string known;
        for (const OptionText& option : describeOptions()) known += " " + option.name;
        throw InputError("there is no option '" + name + "'; there are:" + known);
    }
}

int leastFaces(CageFaces mesh)
{
    return mesh == CageFaces::triangles ? 4 : 6;
}

void requireValid(const CageOptions& options)
{
    visitOptions(options, [](const OptionInfo& info, const auto& field) { RequireRange{info}(field); });
    if (options.erodeRadius && !(options.closeRadius && *options.erodeRadius <= *options.closeRadius)) {
        throw InputError(
            "--erode-radius",
            "'" + detail::numberText(*options.erodeRadius) + "' is not allowed; it must be at most the close radius, " +
                (options.closeRadius ? detail::numberText(*options.closeRadius) : "which has to be given too"));
    }
    const bool asksForSymmetry = options.symmetry != CageSymmetry::automatic && options.symmetry != CageSymmetry::off;
    if (!options.bounding && asksForSymmetry) {
        throw InputError("--symmetry", "'" + ToText{}(options.symmetry) +
                                           "' is not allowed with --bounding off; it must be auto or off");
    }
    if (options.faces < leastFaces(options.mesh)) {
        throw InputError("--faces", "'" + ToText{}(options.faces) + "' is not allowed with --mesh " +
                                        ToText{}(options.mesh) + "; it must be 6 or more, or the mesh triangles");
    }
    if (!options.bounding && options.mesh == CageFaces::loops) {
        throw InputError("--mesh",
                         "'loops' is not allowed with --bounding off; it must be triangles, triquad or quads");
    }
    if (!options.bounding && ToText{}(options.density) != "none") {
        throw InputError("--density",
                         "'" + ToText{}(options.density) + "' is not allowed with --bounding off; it must be none");
    }
    if (!options.bounding && !options.joints.list.empty()) {
        throw InputError("--joints",
                         "'" + ToText{}(options.joints) + "' is not allowed with --bounding off; it must be none");
    }
    if (options.element != StructuringElement::sphere && ToText{}(options.scale) != "none") {
        throw InputError("--scale-field",
                         "'" + ToText{}(options.scale) +
                             "' is not allowed with --element cube; it must be none, or the element sphere");
    }
}

} // namespace vdbcage
