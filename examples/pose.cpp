// Poses a model by its cage, whose upper half leans over:  example_pose model.obj cage.obj posed.obj

#include <iostream>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh_io.h>

namespace {

/// Moves what is above `height` towards x, the more the higher it is.
openvdb::Vec3d leaning(openvdb::Vec3d point, double height)
{
    if (point.y() > height) point.x() += 0.5 * (point.y() - height);
    return point;
}

} // namespace

int main(int count, char** words)
try {
    if (count != 4) throw vdbcage::InputError("usage: example_pose MODEL CAGE POSED_MODEL");
    const vdbcage::Mesh model = vdbcage::readMesh(words[1]), cage = vdbcage::readMesh(words[2]);
    const openvdb::BBoxd box = vdbcage::boundingBox(model);
    const double height = box.getCenter().y(), size = box.extents().length();

    // Binding computes the weights once, which takes longest. Each pose is then a product with them.
    const vdbcage::Binding binding(cage, model.points, vdbcage::Coordinates::meanValue);
    std::vector<openvdb::Vec3d> moved = cage.points;
    for (openvdb::Vec3d& point : moved) point = leaning(point, height);
    const std::vector<openvdb::Vec3d> posed = binding.pose(moved);
    vdbcage::writeMoved(words[1], posed, words[3]); // keeps all else if the format stays

    // The cage leads: the model leans as it does, but smoothly where the cage has its fold.
    double motion = 0, difference = 0;
    for (std::size_t i = 0; i < posed.size(); ++i) {
        motion = std::fmax(motion, (posed[i] - model.points[i]).length() / size);
        difference = std::fmax(difference, (posed[i] - leaning(model.points[i], height)).length() / size);
    }
    std::cout << "points moved by up to " << motion << " of the model's size, within " << difference
              << " of the lean itself\n";
    return motion > 0.05 && difference < motion / 2 ? 0 : 1;
} catch (const vdbcage::Error& error) {
    std::cerr << "example_pose: " << error.what() << '\n';
    return 1;
}
