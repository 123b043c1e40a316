// Makes a cage in steps, with one of its own between closing and extraction: it fills all that is undercut, so that the
// cage has no tunnels along x and z.  example_own_stage model.obj cage.obj

#include <iostream>

#include <vdbcage/vdbcage.h> // the whole interface, and OpenVDB's grids

namespace {

/// Fills each column of voxels from its highest one down to the floor. Voxels may be added, but never removed: they
/// hold the model.
void fillColumns(openvdb::MaskGrid& solid)
{
    const openvdb::CoordBBox box = solid.evalActiveVoxelBoundingBox();
    auto voxels = solid.getAccessor();
    for (int x = box.min().x(); x <= box.max().x(); ++x) {
        for (int z = box.min().z(); z <= box.max().z(); ++z) {
            int top = box.max().y();
            while (top >= box.min().y() && !voxels.isValueOn({x, top, z})) --top;
            for (int y = box.min().y(); y < top; ++y) voxels.setValueOn({x, y, z});
        }
    }
}

} // namespace

int main(int count, char** words)
try {
    if (count != 3) throw vdbcage::InputError("usage: example_own_stage MODEL CAGE");
    const vdbcage::Mesh model = vdbcage::readMesh(words[1]);
    vdbcage::VoxelizeOptions voxels;
    voxels.resolution = 64; // along the longest side
    // The erosion is smaller than the dilation, so that the surface lies at a distance from the model.
    const vdbcage::CloseOptions radii{2, 1, vdbcage::StructuringElement::sphere};
    const auto closed = vdbcage::closeMask(*vdbcage::voxelize(model, voxels).mask, radii);
    fillColumns(*closed);
    const vdbcage::BoundingGuard guard(model); // it refuses each step that would cut the model
    const vdbcage::Mesh fewer = vdbcage::decimate(vdbcage::extractSurface(*closed), guard, {200});
    const vdbcage::Mesh cage = vdbcage::tighten(fewer, guard);
    vdbcage::writeMesh(cage, words[2]);

    const vdbcage::CageCheck check = vdbcage::checkCage(cage, model);
    std::cout << check.triangles << " triangles with " << check.genus << " tunnels\n";
    return check.bounding() && check.triangles <= 200 && check.genus == 0 ? 0 : 1;
} catch (const vdbcage::Error& error) {
    std::cerr << "example_own_stage: " << error.what() << '\n';
    return 1;
}
