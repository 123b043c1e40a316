// vdbcage-bench deform: costs of binding points to cages and of posing them, for each family of coordinates.

#include <cmath>
#include <iostream>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

using openvdb::Vec3d;

/// Returns `count` points on the model's faces, equally many on each face, evenly over it.
std::vector<Vec3d> pointsOn(const Mesh& model, std::size_t count)
{
    const std::vector<openvdb::Vec3I> triangles = triangulate(model);
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < count; ++i) {
        const openvdb::Vec3I& t = triangles[i % triangles.size()];
        const auto round = static_cast<double>(1 + i / triangles.size());
        double u = std::fmod(round * 0.7548776662466927, 1), v = std::fmod(round * 0.5698402909980532, 1);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        points.push_back((1 - u - v) * model.points[t[0]] + u * model.points[t[1]] + v * model.points[t[2]]);
    }
    return points;
}

void measure(const std::string& name, const Mesh& cage, const std::vector<Vec3d>& points, Coordinates family, int runs)
{
    Binding binding(cage, {}, family);
    const Cost bind = costOf([&] { binding = Binding(cage, points, family); });
    std::vector<Vec3d> posed = cage.points, oneMoved = cage.points, result;
    for (std::size_t i = 0; i < posed.size(); ++i) posed[i] *= 1 + 0.1 * static_cast<double>(i % 3);
    oneMoved[0] *= 1.1;
    const Cost pose = leastCost(runs, [&] { result = binding.pose(posed); });
    result = points;
    const Cost update = leastCost(runs, [&] { binding.update(result, cage.points, oneMoved); });
    std::cout << Json{{"model", name},
                      {"cage_triangles", cage.triangles.size()},
                      {"cage_quads", cage.quads.size()},
                      {"points", points.size()},
                      {"coordinates", coordinatesName(family)},
                      {"handles", binding.handles()},
                      {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)},
                      {"bind", toJson(bind)},
                      {"pose", toJson(pose)},
                      {"update_of_one_vertex", toJson(update)},
                      {"weights_mib", static_cast<double>(binding.weightBytes()) / (1 << 20)}}
                     .dump()
              << std::endl;
}

} // namespace

int runDeform(int argc, char** argv)
{
    std::string model;
    std::vector<int> faces{100, 400}, counts{10000, 100000};
    std::vector<std::string> families, meshes{"triangles", "triquad"};
    for (const FamilyInfo& family : coordinateFamilies()) families.emplace_back(family.name);
    int threads = tbb::info::default_concurrency(), runs = 10;
    CLI::App app("vdbcage-bench deform: times and memory of binding and posing, least of several runs, as JSON lines.\n"
                 "The points are spread over the model, the cages made with --effort fast --merge-angle 60");
    app.add_option("model", model, "the model in the cages")->required()->type_name("MODEL");
    addList(app, "--faces", faces, "list of cage sizes [100,400]")->type_name("N,N");
    addList(app, "--points", counts, "list of point counts [10000,100000]")->type_name("N,N");
    addList(app, "--mesh", meshes, "list of kinds of cages [triangles,triquad]")->type_name("KIND,KIND");
    addList(app, "--coordinates", families, "list of families [all]")->type_name("F,F");
    app.add_option("--threads", threads, "[all]")->type_name("N");
    app.add_option("--runs", runs, "poses to take the least of [10]")->type_name("N");
    CLI11_PARSE(app, argc - 1, argv + 1);
    for (const int count : faces) requirePositive("--faces", count);
    for (const int count : counts) requirePositive("--points", count);
    requirePositive("--threads", threads);
    requirePositive("--runs", runs);
    for (const std::string& family : families) coordinatesNamed(family);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const Mesh mesh = readMesh(model);
    for (const std::string& kind : meshes) {
        for (const int faceLimit : faces) {
            CageOptions options;
            setOption(options, "faces", std::to_string(faceLimit));
            setOption(options, "mesh", kind);
            setOption(options, "merge-angle", "60");
            setOption(options, "effort", "fast");
            const Mesh cage = makeCage(mesh, options);
            for (const int count : counts) {
                const std::vector<Vec3d> points = pointsOn(mesh, static_cast<std::size_t>(count));
                for (const std::string& family : families) {
                    measure(model, cage, points, coordinatesNamed(family), runs);
                }
            }
        }
    }
    return 0;
}

} // namespace vdbcage::bench
