#pragma once

#include <random>
#include <string>
#include <vector>

#include <tools/view/state/command.h>
#include <tools/view/state/preset.h>

namespace vdbcage::test {

inline Coordinates randomFamily(std::mt19937& random)
{
    return coordinateFamilies()[random() % coordinateFamilies().size()].family;
}

/// Any command that moves what is selected, or changes it otherwise. It may be refused where nothing is.
inline view::Command randomMove(std::mt19937& random)
{
    using namespace view;
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto real = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    const auto vector = [&] { return openvdb::Vec3d(real(), real(), real()); };
    switch (below(11)) {
    case 10:
        switch (below(3)) {
        case 0:
            return FitCage{real() > 0 ? 0.5 : 0.25};
        case 1:
            return LockPoints{};
        default:
            return UnlockPoints{};
        }
    case 8:
        return below(2) == 0 ? Command(SetFrame{below(6)}) : Command(SetKey{below(6)});
    case 9:
        switch (below(5)) {
        case 0:
            return DeleteKey{below(6)};
        case 1:
            return MoveKey{below(6), below(6)};
        case 2:
            return MakeInBetweens{2 + below(5)};
        case 3:
            return ClearPoses{};
        default:
            return SetKey{below(6), "name " + std::to_string(below(3))};
        }
    case 0:
    case 1:
        return MoveSelected{vector()};
    case 2:
    case 3:
        return RotateSelected{vector(), 180 * real(), vector()};
    case 4: {
        ScaleSelected scale{vector(), vector()};
        if (below(2) == 0) scale.axes = {openvdb::Vec3d(0, 1, 1), openvdb::Vec3d(3, 0, 0)};
        return scale;
    }
    case 5:
        return ResetPose{below(3) != 0};
    case 6:
        return SetCoordinates{randomFamily(random)};
    default:
        return EditCage{static_cast<CageEdit>(below(5))};
    }
}

/// Any command that is allowed in any state that has a model; files are taken from `files`.
inline view::Command randomCommand(std::mt19937& random, const std::vector<std::string>& files)
{
    using namespace view;
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto real = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    const auto fraction = [&] { return static_cast<float>(real(0, 1)); };
    const auto layer = static_cast<LayerId>(below(static_cast<int>(layerCount)));
    switch (below(22)) {
    case 0:
        return OpenModel{files[random() % files.size()]};
    case 1:
        return OpenCage{files[random() % files.size()]};
    case 2:
        return CloseCage{};
    case 3:
    case 4: {
        const std::vector<std::pair<std::string, std::string>> values{
            {"faces", std::to_string(12 + below(1000))},
            {"resolution", below(4) == 0 ? "auto" : std::to_string(8 + below(120))},
            {"close-radius", below(4) == 0 ? "auto" : std::to_string(real(0, 0.25))},
            {"element", below(2) == 0 ? "sphere" : "cube"},
            {"smooth", std::to_string(below(101))},
            {"parts", below(2) == 0 ? "keep" : "merge"},
            {"mesh", below(3) == 0   ? "triangles"
                     : below(2) == 0 ? "triquad"
                                     : "quads"},
            {"symmetry", below(2) == 0 ? "auto" : "off"},
            {"bounding", below(2) == 0 ? "on" : "off"},
            {"scale-field", below(2) == 0 ? "none" : "sphere:0,0,0,1,0.5"},
            {"effort", below(3) == 0   ? "fast"
                       : below(2) == 0 ? "fair"
                                       : "best"}};
        const auto& [name, value] = values[random() % values.size()];
        return SetOption{name, value};
    }
    case 5:
        if (below(2) == 0) {
            return SetMaterial{{real(-0.99, 0.49), static_cast<Elasticity::Rotations>(below(2)), real(0, 100),
                                below(3) == 0 ? 0 : real(0, 100)}};
        }
        return below(4) == 0 ? ResetOptions{} : ResetOptions{{"faces", "mesh"}};
    case 6:
        return ApplyPreset{presets()[random() % presets().size()].name};
    case 7: {
        draw::Camera camera;
        camera.projection = below(2) == 0 ? draw::Projection::perspective : draw::Projection::orthographic;
        camera.view = {real(-360, 360), real(-90, 90), below(2) == 0 ? draw::UpAxis::y : draw::UpAxis::z};
        camera.target = {real(-1, 1), real(-1, 1), real(-1, 1)};
        camera.distance = real(0.5, 20);
        return SetCamera{camera};
    }
    case 8:
        return ShowLayer{layer, below(2) == 0};
    case 9:
        return FadeLayer{layer, real(0, 1)};
    case 10:
        return ColourLayer{layer, {fraction(), fraction(), fraction()}};
    case 11:
        return below(2) == 0 ? Command(SetCageColours{static_cast<CageColours>(below(3))})
                             : Command(SetModelColours{static_cast<ModelColours>(below(3))});
    case 12:
        if (below(2) == 0) return SetSection{};
        return SetSection{SectionPlane{{real(-1, 1), real(-1, 1), 1}, real(-1, 1)}};
    case 13:
        return ShowGround{below(2) == 0};
    case 14:
        return below(2) == 0 ? Command(ShowAxes{below(2) == 0}) : Command(SetTurntable{below(2) == 0});
    case 15:
        return ShowTimes{below(2) == 0};
    case 16:
        return below(2) == 0 ? Command(SetMode{static_cast<Mode>(below(2))})
                             : Command(SetTool{static_cast<Tool>(below(4))});
    case 17:
        return below(2) == 0 ? Command(SetOrientation{static_cast<Orientation>(below(4))})
                             : Command(SetSeeThrough{below(2) == 0});
    case 20:
        if (below(4) == 0) return Compare{randomFamily(random)};
        if (below(6) == 0) return Compare{};
        return below(3) == 0   ? Command(SetFrame{below(200)})
               : below(2) == 0 ? Command(Play{below(2) == 0})
                               : Command(SetRate{real(1, 240)});
    case 18:
        if (below(2) == 0) return SetSoft{below(2) == 0 ? 0 : real(0, 1)};
        if (below(2) == 0) return SetPivot{{Pivot::Kind::point, {real(-1, 1), real(-1, 1), real(-1, 1)}}};
        return SetPivot{{static_cast<Pivot::Kind>(below(3))}};
    case 19:
        return below(2) == 0 ? SetMirror{} : SetMirror{SymmetryPlane{below(3), real(-1, 1)}};
    default: {
        Select select;
        select.selection.kind = static_cast<edit::Element>(below(3));
        for (int id = below(3); id < 40; id += 1 + below(30)) {
            select.selection.ids.push_back(static_cast<openvdb::Index32>(id));
        }
        return select;
    }
    }
}

} // namespace vdbcage::test
