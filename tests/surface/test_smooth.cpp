#include <boost/test/unit_test.hpp>

#include <set>

#include <tbb/global_control.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/volume/extract.h>

#include "support/solids.h"
#include "support/stop_at.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

/// The paper's algorithm as it is printed, with sets.
std::vector<Vec3d> slowSmooth(const Mesh& mesh, int iterations, double alpha, double beta)
{
    std::vector<std::set<unsigned>> neighbours(mesh.points.size());
    for (const auto& face : polygons(mesh)) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            const unsigned a = face[i], b = face[(i + 1) % face.size()];
            neighbours[a].insert(b);
            neighbours[b].insert(a);
        }
    }
    const std::vector<Vec3d> o = mesh.points;
    std::vector<Vec3d> p = o, b(o.size());
    for (int n = 0; n < iterations; ++n) {
        const std::vector<Vec3d> q = p;
        for (std::size_t i = 0; i < o.size(); ++i) {
            if (neighbours[i].empty()) continue;
            p[i] = Vec3d(0.0);
            for (const unsigned j : neighbours[i]) p[i] += q[j] / double(neighbours[i].size());
            b[i] = p[i] - (alpha * o[i] + (1 - alpha) * q[i]);
        }
        for (std::size_t i = 0; i < o.size(); ++i) {
            if (neighbours[i].empty()) continue;
            Vec3d sum(0.0);
            for (const unsigned j : neighbours[i]) sum += b[j];
            p[i] -= beta * b[i] + (1 - beta) / double(neighbours[i].size()) * sum;
        }
    }
    return p;
}

double largestDifference(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    double largest = a.size() == b.size() ? 0 : 1e300;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, (a[i] - b[i]).length());
    return largest;
}

} // namespace

BOOST_AUTO_TEST_SUITE(smoothing)

BOOST_AUTO_TEST_CASE(equals_the_paper)
{
    Mesh mesh = extractSurface(*sample(24, inCreature));
    // Triangles as well, some with boundary, and a point of no face.
    const openvdb::Vec4I first = mesh.quads.back();
    mesh.quads.pop_back();
    mesh.triangles.emplace_back(first[0], first[1], first[2]);
    mesh.points.emplace_back(5, 5, 5);
    for (const SmoothOptions& options : {SmoothOptions{1, 0, 0.5}, {3, 0.2, 0.5}, {9, 0, 0.7}, {2, 1, 0}, {2, 0, 1}}) {
        const Mesh result = smooth(mesh, options);
        BOOST_TEST(largestDifference(result.points, slowSmooth(mesh, options.iterations, options.alpha, options.beta)) <
                   1e-12);
        BOOST_TEST((result.quads == mesh.quads && result.triangles == mesh.triangles));
        BOOST_TEST((result.points.back() == Vec3d(5, 5, 5)));
    }
}

BOOST_AUTO_TEST_CASE(no_iterations_change_nothing)
{
    const Mesh mesh = extractSurface(*sample(16, inTorus));
    SmoothOptions options;
    options.iterations = 0;
    BOOST_TEST((smooth(mesh, options).points == mesh.points));
}

BOOST_AUTO_TEST_CASE(a_plane_stays_a_plane)
{
    Mesh mesh;
    for (int n = 0; n < 100; ++n) mesh.points.emplace_back(n % 10 + 0.3 * std::sin(n), n / 10, 7);
    for (unsigned n = 0; n < 89; ++n) {
        if (n % 10 != 9) mesh.quads.emplace_back(n, n + 1, n + 11, n + 10);
    }
    for (const Vec3d& p : smooth(mesh).points) BOOST_REQUIRE_SMALL(p.z() - 7, 1e-12);
}

BOOST_AUTO_TEST_CASE(rounds_without_shrinking)
{
    const Mesh mesh = extractSurface(*sample(64, [](const Vec3d& p) { return inSphere(p); }));
    const TopologyCount before = countTopology(mesh);
    double area = before.area;
    for (const int iterations : {1, 3, 9, 20}) {
        SmoothOptions options;
        options.iterations = iterations;
        const TopologyCount after = countTopology(smooth(mesh, options));
        BOOST_TEST(std::abs(after.volume / before.volume - 1) < 0.01);
        BOOST_TEST(after.area < area); // the steps go, more with every iteration
        area = after.area;
    }
    BOOST_TEST(area < 1.05 * 4 * detail::pi * 0.45 * 0.45);
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh mesh = extractSurface(*sample(48, inCreature));
    const Mesh many = smooth(mesh);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST((smooth(mesh).points == many.points));
}

BOOST_AUTO_TEST_CASE(bad_input_and_cancelling)
{
    const Mesh mesh = extractSurface(*sample(16, inTorus));
    for (const SmoothOptions& options :
         {SmoothOptions{-1, 0, 0}, {101, 0, 0}, {1, -0.1, 0}, {1, 1.1, 0}, {1, 0, -0.1}, {1, 0, std::nan("")}}) {
        BOOST_CHECK_THROW(smooth(mesh, options), InputError);
    }
    Mesh bad = mesh;
    bad.quads.emplace_back(0, 1, 2, unsigned(mesh.points.size()));
    BOOST_CHECK_THROW(smooth(bad), InputError);
    for (int k = 0; k < 7; ++k) {
        StopAt stop(k);
        BOOST_CHECK_THROW(smooth(mesh, {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
