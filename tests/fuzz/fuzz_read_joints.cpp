// Any bytes at all: a file of joints is refused in one line that begins with its name, or has joints that are the same
// when they are written and read again.

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include <fuzz/bytes.h>
#include <vdbcage/bounding/joints.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using fuzz::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::filesystem::path path = fuzz::file("joints", fuzz::textOf(data, size));
    Joints joints;
    try {
        joints = readJoints(path);
    } catch (const IoError& error) {
        fuzz::requireOneLine(error.what());
        require(std::string_view(error.what()).rfind(path.string() + ":", 0) == 0);
        return 0;
    }
    require(!joints.list.empty());
    std::string text;
    const auto add = [&](const openvdb::Vec3d& p) {
        for (int k = 0; k < 3; ++k) text += detail::numberText(p[k]) + ' ';
    };
    for (Joint& joint : joints.list) {
        require(joint.place.isFinite());
        require(!joint.axis || (joint.axis->isFinite() && joint.axis->lengthSqr() > 0));
        add(joint.place);
        // From an axis to the end of the bone and back rounds, but not where the bone begins at zero.
        if (joint.axis && joint.place == openvdb::Vec3d(0)) add(*joint.axis);
        if (joint.place != openvdb::Vec3d(0)) joint.axis.reset();
        text += '\n';
    }
    require(readJoints(fuzz::file("again", text)) == joints);
    return 0;
}
