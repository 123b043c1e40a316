#include "drawn_cages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/pipeline/pipeline.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

using openvdb::Vec3d;
using Counts = std::array<std::uint32_t, 3>;

/// Returns the same numbers everywhere, which the distributions of the standard library do not promise.
class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    /// Returns a vector in the unit ball.
    Vec3d inBall()
    {
        for (;;) {
            const Vec3d v(number(), number(), number());
            if (v.lengthSqr() <= 1) return v;
        }
    }

private:
    double number() { return static_cast<double>(engine_()) / 2147483648.0 - 1; } // -1 to 1
    std::mt19937 engine_;
};

Mesh withNoise(Mesh cage, double most, std::uint32_t seed)
{
    Random random(seed);
    for (Vec3d& p : cage.points) p += most * random.inBall();
    return cage;
}

Mesh scaled(Mesh cage, double factor)
{
    const Vec3d middle = boundingBox(cage).getCenter();
    for (Vec3d& p : cage.points) p = middle + factor * (p - middle);
    return cage;
}

/// Turns the part beyond 70 % of an axis back into the rest.
Mesh bent(Mesh cage, int axis)
{
    constexpr double begin = 0.7, steepness = 2;
    const openvdb::BBoxd bounds = boundingBox(cage);
    const double length = bounds.extents()[axis];
    for (Vec3d& p : cage.points) {
        const double beyond = (p[axis] - bounds.min()[axis]) / length - begin;
        if (beyond > 0) p[axis] -= steepness * beyond * length;
    }
    return cage;
}

/// Makes a box of n[0] x n[1] x n[2] quads.
Mesh box(const Vec3d& lo, const Vec3d& hi, const Counts& n)
{
    Mesh mesh;
    std::map<Counts, std::uint32_t> points;
    const auto point = [&](const Counts& at) {
        const auto [found, isNew] = points.emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
        if (isNew) {
            Vec3d p;
            for (const std::size_t i : {0U, 1U, 2U}) {
                const int axis = static_cast<int>(i);
                p[axis] = lo[axis] + (hi - lo)[axis] * at[i] / n[i];
            }
            mesh.points.push_back(p);
        }
        return found->second;
    };
    for (const std::size_t axis : {0U, 1U, 2U}) {
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const bool isHigh : {false, true}) {
            for (std::uint32_t i = 0; i < n[b]; ++i) {
                for (std::uint32_t j = 0; j < n[c]; ++j) {
                    const auto corner = [&](std::uint32_t di, std::uint32_t dj) {
                        Counts at{};
                        at[axis] = isHigh ? n[axis] : 0;
                        at[b] = i + di;
                        at[c] = j + dj;
                        return point(at);
                    };
                    const openvdb::Vec4I quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
                    mesh.quads.push_back(isHigh ? quad : openvdb::Vec4I(quad[3], quad[2], quad[1], quad[0]));
                }
            }
        }
    }
    return mesh;
}

struct Made {
    Mesh cage;
    double cpuSeconds;
};

Made make(const Mesh& model, CageFaces kind, int faces)
{
    CageOptions options;
    options.mesh = kind;
    options.faces = faces;
    Pipeline pipeline(model);
    const Cost cost = costOf([&] { pipeline.run(options, nullptr); });
    return {pipeline.cage(), cost.cpuSeconds};
}

Mesh coarse(const Mesh& model)
{
    CageOptions options;
    options.mesh = CageFaces::quads;
    options.faces = 120;
    options.resolution = 24;
    options.bounding = false;
    Pipeline pipeline(model);
    pipeline.run(options, nullptr);
    return pipeline.cage();
}

} // namespace

std::vector<DrawnCage> drawnCages(const Mesh& model)
{
    struct Kind {
        const char* name;
        CageFaces faces;
        int count;
        std::array<int, 2> noises; ///< %
    };
    constexpr std::array<Kind, 4> kinds{{{"triangles", CageFaces::triangles, 200, {1, 4}},
                                         {"loops", CageFaces::loops, 300, {2, 8}},
                                         {"quads", CageFaces::quads, 300, {1, 4}},
                                         {"triquad", CageFaces::triquad, 150, {2, 8}}}};
    const openvdb::BBoxd bounds = boundingBox(model);
    const int axis = static_cast<int>(bounds.maxExtent());
    std::vector<DrawnCage> cages;
    std::uint32_t seed = 0;
    for (const Kind& kind : kinds) {
        const Made made = make(model, kind.faces, kind.count);
        const std::string name = kind.name;
        const auto add = [&](const std::string& defect, Mesh mesh, double noise) {
            cages.push_back({defect + ' ' + name, std::move(mesh), noise, made.cpuSeconds});
        };
        for (const int noise : kind.noises) {
            add("noise" + std::to_string(noise),
                withNoise(made.cage, noise / 100.0 * detail::longestSide(bounds), ++seed), noise);
        }
        if (kind.faces != CageFaces::triangles && kind.faces != CageFaces::loops) continue;
        add("scaled", scaled(made.cage, 0.9), 0);
        if (kind.faces == CageFaces::loops) add("bent", bent(made.cage, axis), 0);
    }
    const Vec3d middle = bounds.getCenter(), half = 0.5 * bounds.extents();
    Vec3d thin = 0.12 * half, centroid(0.0);
    thin[axis] = 0.6 * half[axis];
    for (const Vec3d& p : model.points) centroid += p / static_cast<double>(model.points.size());
    Counts along{1, 1, 1};
    along[static_cast<std::size_t>(axis)] = 6;
    cages.push_back({"coarse", coarse(model)});
    cages.push_back({"small box", box(middle - 0.8 * half, middle + 0.8 * half, {3, 5, 3})});
    cages.push_back({"box of six", box(middle - 0.97 * half, middle + 0.97 * half, {1, 1, 1})});
    cages.push_back({"tube", box(centroid - thin, centroid + thin, along)});
    return cages;
}

} // namespace vdbcage::bench
