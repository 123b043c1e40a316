// vdbcage-bench voxelize: every voxelizer on the same models and resolutions in one run, and for comparison OpenVDB's
// meshToVolume, which also computes distances.

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>

#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/voxelize/detail/gl.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

using detail::BitGrid;
using detail::Frame;
using detail::GlVoxelizer;

/// The context and shaders, which are reused, and the time that making them took.
class Device {
public:
    Device() : began_(costSoFar().wallSeconds), current_(context_.makeCurrent()), contextMade_(costSoFar().wallSeconds)
    {
        compute_ = std::make_unique<GlVoxelizer>(context_.api(), GlVoxelizer::Path::compute);
        computeMade_ = costSoFar().wallSeconds;
        raster_ = std::make_unique<GlVoxelizer>(context_.api(), GlVoxelizer::Path::raster);
        rasterMade_ = costSoFar().wallSeconds;
    }
    const GlVoxelizer& voxelizer(const std::string& name) const { return name == "gl-raster" ? *raster_ : *compute_; }
    Json description() const
    {
        return {{"device", context_.description()},
                {"software", context_.isSoftware()},
                {"context_seconds", contextMade_ - began_},
                {"compute_shader_seconds", computeMade_ - contextMade_},
                {"raster_shader_seconds", rasterMade_ - computeMade_}};
    }

private:
    double began_;
    gl::OffscreenContext context_;
    gl::OffscreenContext::Current current_;
    double contextMade_, computeMade_ = 0, rasterMade_ = 0;
    std::unique_ptr<GlVoxelizer> compute_, raster_;
};

/// The faces in the index space of a transform, in the form that meshToVolume requires.
class IndexSpaceFaces {
public:
    IndexSpaceFaces(const Mesh& mesh, const openvdb::math::Transform& transform) : triangles_(triangulate(mesh))
    {
        for (const openvdb::Vec3d& point : mesh.points) points_.push_back(transform.worldToIndex(point));
    }
    std::size_t polygonCount() const { return triangles_.size(); }
    std::size_t pointCount() const { return points_.size(); }
    static std::size_t vertexCount(std::size_t /*face*/) { return 3; }
    void getIndexSpacePoint(std::size_t face, std::size_t corner, openvdb::Vec3d& point) const
    {
        point = points_[triangles_[face][static_cast<int>(corner)]];
    }

private:
    std::vector<openvdb::Vec3d> points_;
    std::vector<openvdb::Vec3I> triangles_;
};

std::size_t countDifferent(const BitGrid& a, const BitGrid& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.wordCount(); ++i) {
        count += static_cast<std::size_t>(__builtin_popcountll(a.words()[i] ^ b.words()[i]));
    }
    return count;
}

/// One way to voxelize on one model at one resolution, into a VDB grid.
using Run = std::function<void()>;

} // namespace

int runVoxelize(int argc, char** argv)
{
    const std::vector<std::string> known{"cpu", "gl", "gl-raster", "cgal", "meshToVolume"};
    std::vector<std::string> models, voxelizers = known;
    std::vector<int> resolutions{32, 64, 128, 256, 512, 1024};
    int repeat = 3, threads = tbb::info::default_concurrency();
    CLI::App app("vdbcage-bench voxelize: every voxelizer in one run, ratios to cpu, as JSON lines");
    app.add_option("models", models, "models to measure on")->required()->type_name("MODEL");
    addList(app, "--resolutions", resolutions, "[32,64,128,256,512,1024]")->type_name("N,N");
    addList(app, "--voxelizers", voxelizers, "[cpu,gl,gl-raster,cgal,meshToVolume]; always cpu too")
        ->type_name("V,V")
        ->check(CLI::IsMember(known));
    app.add_option("--repeat", repeat, "the least of so many runs [3]")->type_name("K");
    app.add_option("--threads", threads, "of the CPU [all]; a driver in software has its own")->type_name("N");
    CLI11_PARSE(app, argc - 1, argv + 1);
    for (const int resolution : resolutions) requirePositive("--resolutions", resolution);
    requirePositive("--repeat", repeat);
    requirePositive("--threads", threads);

    openvdb::initialize();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const auto wanted = [&](const char* name) {
        return std::find(voxelizers.begin(), voxelizers.end(), name) != voxelizers.end();
    };
    std::unique_ptr<Device> device;
    if (wanted("gl") || wanted("gl-raster")) {
        device = std::make_unique<Device>();
        std::cout << device->description().dump() << std::endl;
    }
    for (const std::string& path : models) {
        const Mesh model = readMesh(path);
        for (const int resolution : resolutions) {
            const Frame frame = detail::makeFrame(model, resolution);
            const auto transform = detail::makeTransform(frame);
            std::map<std::string, Run> runs;
            std::map<std::string, BitGrid> bits;
            const auto add = [&](const std::string& name, auto voxelizer) {
                runs[name] = [&bits, &transform, name, voxelizer] {
                    BitGrid grid = voxelizer();
                    detail::toMask(grid, transform);
                    bits.insert_or_assign(name, std::move(grid));
                };
            };
            add("cpu", [&] { return detail::voxelizeCpu(model, frame, nullptr); });
            if (wanted("cgal")) add("cgal", [&] { return detail::voxelizeCgal(model, frame, nullptr); });
            for (const char* name : {"gl", "gl-raster"}) {
                if (!wanted(name)) continue;
                add(name, [&, name] { return device->voxelizer(name).run(model, frame, nullptr); });
            }
            if (wanted("meshToVolume")) {
                runs["meshToVolume"] = [&] {
                    const IndexSpaceFaces faces(model, *transform);
                    openvdb::tools::meshToVolume<openvdb::FloatGrid>(faces, *transform, 1.0F, 1.0F);
                };
            }
            std::map<std::string, Cost> costs;
            for (int k = 0; k < repeat; ++k) {
                for (const auto& run : runs) {
                    const Cost cost = costOf(run.second);
                    costs[run.first] = k == 0 ? cost : leastOf(costs[run.first], cost);
                }
            }
            Json line{{"model", path}, {"faces", faceCount(model)}, {"resolution", resolution}, {"threads", threads}};
            for (const auto& entry : costs) {
                const Cost& cost = entry.second;
                Json& result = line[entry.first];
                result = toJson(cost);
                result["wall_ratio"] = cost.wallSeconds / costs["cpu"].wallSeconds;
                result["cpu_ratio"] = cost.cpuSeconds / costs["cpu"].cpuSeconds;
                const auto found = bits.find(entry.first);
                if (found != bits.end()) result["different_voxels"] = countDifferent(found->second, bits.at("cpu"));
            }
            std::cout << line.dump() << std::endl;
        }
    }
    return 0;
}

} // namespace vdbcage::bench
