// vdbcage-walk CAGE DIR: poses a cage of the creature as it walks in place, one stride in 12 frames, and writes them as
// DIR/walk.0000.obj to walk.0011.obj.

#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <system_error>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

#include "poses.h"

constexpr int frames = 12;

int main(int argc, char** argv)
{
    if (argc != 3 || argv[2][0] == '-') {
        std::fputs("usage: vdbcage-walk CAGE DIR\n", stderr);
        return 1;
    }
    try {
        const vdbcage::Mesh cage = vdbcage::readMesh(argv[1]);
        std::filesystem::create_directories(argv[2]);
        vdbcage::PendingFiles files;
        for (int frame = 0; frame < frames; ++frame) {
            vdbcage::Mesh pose = cage;
            for (openvdb::Vec3d& p : pose.points) p = data::walking(p, static_cast<double>(frame) / frames);
            std::array<char, 32> name{};
            std::snprintf(name.data(), name.size(), "walk.%04d.obj", frame);
            const std::filesystem::path path = std::filesystem::path(argv[2]) / name.data();
            std::error_code ignored;
            if (std::filesystem::equivalent(path, argv[1], ignored)) {
                throw vdbcage::InputError(path.string() + ": is the cage itself; it would be overwritten");
            }
            files.add(path, [&](std::ostream& out) { vdbcage::writeMesh(pose, out, path); });
        }
        files.commit();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-walk: %s\n", error.what());
        return 1;
    }
    return 0;
}
