#include <vdbcage/bounding/joints.h>

#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/text_cursor.h>

namespace vdbcage {

namespace {

openvdb::Vec3d place(detail::TextCursor& in)
{
    const double x = in.coordinate("the x coordinate");
    const double y = in.coordinate("the y coordinate");
    return {x, y, in.coordinate("the z coordinate")};
}

} // namespace

Joints readJoints(const std::filesystem::path& path)
{
    const std::string bytes = detail::readFile(path), name = detail::printable(path.string());
    detail::TextCursor in(bytes, name, {'#'});
    Joints joints;
    joints.file = path;
    while (in.skipToWord()) {
        const char* const line = in.position();
        Joint joint{place(in), {}};
        if (!in.atLineEnd()) {
            joint.axis = place(in) - joint.place;
            if (!(joint.axis->isFinite() && joint.axis->lengthSqr() > 0)) in.fail(line, "the bone has no length");
        }
        if (!in.atLineEnd()) {
            in.fail(in.quoted(in.position()) + " is not understood; a line has X Y Z, or X Y Z X Y Z for a bone");
        }
        joints.list.push_back(joint);
    }
    if (joints.list.empty()) {
        throw IoError(name + ": there is no joint; a line has X Y Z, or X Y Z X Y Z for a bone");
    }
    return joints;
}

} // namespace vdbcage
