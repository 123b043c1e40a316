#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/export.h>

namespace vdbcage {

/// A place where the model is to bend: an elbow, a knee.
struct Joint {
    openvdb::Vec3d place{0};            ///< inside the limb, world units
    std::optional<openvdb::Vec3d> axis; ///< along the limb, of any length above 0; unset: where it is thinnest across

    /// Returns whether place and axis are exactly the same.
    bool operator==(const Joint& other) const { return place == other.place && axis == other.axis; }
    /// Returns whether place or axis differ.
    bool operator!=(const Joint& other) const { return !(*this == other); }
};

/// Joints, and where they were read from.
struct Joints {
    std::vector<Joint> list;         ///< in the order of the file
    std::filesystem::path file = {}; ///< empty if they were not read

    /// Returns whether the joints are the same, in the same order. The file plays no part.
    bool operator==(const Joints& other) const { return list == other.list; }
};

/// Reads joints from a text file: one a line. Blank lines, and all after a # of a line, are left out.
///
/// `X Y Z` is a joint. `X Y Z X Y Z` is a bone, from its head to its tail, in the model's coordinates. It turns about
/// its head: the joint is there, and the axis goes to the tail.
/// \param path of the text file
/// \throw IoError when the file cannot be read, or has no joint; when a line has something else, or a bone without
/// length; names the file and the line
VDBCAGE_API Joints readJoints(const std::filesystem::path& path);

} // namespace vdbcage
