#pragma once

#include <array>
#include <cstddef>

namespace vdbcage {

/// The named steps of a run, in the order in which they come. An interrupter is told their names.
enum class StageName {
    read,         ///< files are read
    bindCoarsely, ///< a coarse copy of the model is bound
    interior,     ///< the model's inside is examined
    voxelize,     ///< the model becomes voxels
    symmetry,     ///< a plane of symmetry is looked for
    guard,        ///< the search tree of a guard or of a check is built
    close,        ///< the voxels are closed
    surface,      ///< the surface that the cage is shrunk from is made
    fit,          ///< a drawn cage is moved until it bounds
    decimate,     ///< the surface gets fewer faces
    loops,        ///< the surface gets fewer quads, in closed loops
    tighten,      ///< triangles are pulled onto the model
    quads,        ///< triangles become quads, which are pulled onto the model
    smooth,       ///< the cage, or with `bounding` off the surface, is smoothed
    coplanar,     ///< edges that are nearly flat are bent
    certify,      ///< the cage is checked
    layers,       ///< the volumes, surfaces and distances between model and cage are prepared to be shown
    bind,         ///< the model is bound to the cage
    carryThePose, ///< a pose is transferred to another cage
    checkThePose, ///< a posed cage is checked
    write         ///< files are written
};

/// The text of a stage, and its share of a run's time.
struct StageInfo {
    StageName stage;  ///< the stage
    const char* name; ///< as reports and interrupters have it
    /// Percent of most runs at which it begins. -1 if it takes no share: it is short, or comes at different places.
    int from = -1;
    int to = -1; ///< percent at which it ends, or -1 in the same way
};

/// All stages, in the order of StageName.
inline constexpr std::array<StageInfo, 21> stageTable{{{StageName::read, "read", 0, 2},
                                                       {StageName::bindCoarsely, "bind coarsely", 0, 2},
                                                       {StageName::interior, "interior", 2, 3},
                                                       {StageName::voxelize, "voxelize", 3, 6},
                                                       {StageName::symmetry, "symmetry", 6, 6},
                                                       {StageName::guard, "guard", 6, 8},
                                                       {StageName::close, "close", 8, 10},
                                                       {StageName::surface, "surface", 10, 13},
                                                       {StageName::fit, "fit", 13, 60},
                                                       {StageName::decimate, "decimate", 13, 60},
                                                       {StageName::loops, "loops", 13, 92},
                                                       {StageName::tighten, "tighten", 60, 90},
                                                       {StageName::quads, "quads", 60, 92},
                                                       {StageName::smooth, "smooth"},
                                                       {StageName::coplanar, "coplanar"},
                                                       {StageName::certify, "certify", 92, 98},
                                                       {StageName::layers, "layers"},
                                                       {StageName::bind, "bind", 2, 95},
                                                       {StageName::carryThePose, "carry the pose over"},
                                                       {StageName::checkThePose, "check the pose"},
                                                       {StageName::write, "write", 98, 99}}};

/// Returns the row of a stage in stageTable.
/// \param stage any of StageName
constexpr const StageInfo& stageInfo(StageName stage)
{
    return stageTable[static_cast<std::size_t>(stage)];
}

} // namespace vdbcage
