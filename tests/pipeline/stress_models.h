#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

struct StressModel {
    std::string name; ///< family, number within it, placement: "needles-03-tiny-far"; a valid file name
    Mesh mesh;
};

inline std::ostream& operator<<(std::ostream& out, const StressModel& model)
{
    return out << model.name;
}

/// More than 300 models that are hard to cage, of every family in every size and distance from the origin that the
/// list of placements has; the same ones at every call.
std::vector<StressModel> stressModels();

} // namespace vdbcage::test
