#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <deform/cages.h>
#include <vdbcage/core/detail/simd.h>
#include <vdbcage/deform/detail/coordinate_family.h>

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec3d;
using test::Kind;
using test::kinds;
using test::Random;
using test::randomCage;

namespace {

/// Those that have a kernel for such a cage.
std::vector<const CoordinateFamily*> familiesFor(const KernelCage& cage)
{
    std::vector<const CoordinateFamily*> list;
    for (const FamilyInfo& info : coordinateFamilies()) {
        const CoordinateFamily& family = coordinateFamily(info.family);
        if (family.kernel != nullptr && !(info.splitsQuads && cage.quadCount > 0)) list.push_back(&family);
    }
    BOOST_REQUIRE(!list.empty());
    return list;
}

std::size_t columnsOf(const KernelCage& cage, const CoordinateFamily& family)
{
    return cage.pointCount + family.vectors.perTriangle * cage.triangleCount + family.vectors.perQuad * cage.quadCount;
}

struct Result {
    std::vector<double> rows; // a row a point; of zeros if it is left out
    std::vector<bool> leftOut;
};

Result rowsOf(const RowKernels& kernels, const KernelCage& cage, const CoordinateFamily& family,
              const std::vector<Vec3d>& points)
{
    struct alignas(64) Chunk {
        char bytes[64];
    };
    const std::size_t columns = columnsOf(cage, family);
    const std::unique_ptr<Chunk[]> scratch(new Chunk[scratchSize(cage) / sizeof(Chunk)]);
    Result result;
    for (std::size_t first = 0; first < points.size(); first += packetSize) {
        double x[3][packetSize];
        for (std::size_t lane = 0; lane < packetSize; ++lane) {
            for (int a = 0; a < 3; ++a) x[a][lane] = points[std::min(first + lane, points.size() - 1)][a];
        }
        std::vector<double> rows(columns * packetSize);
        const unsigned leftOut =
            (kernels.*family.kernel)(cage, x, scratch.get(), reinterpret_cast<double(*)[packetSize]>(rows.data()));
        for (std::size_t lane = 0; lane < packetSize && first + lane < points.size(); ++lane) {
            const bool isLeftOut = (leftOut >> lane & 1) != 0;
            result.leftOut.push_back(isLeftOut);
            for (std::size_t k = 0; k < columns; ++k) {
                result.rows.push_back(isLeftOut ? 0 : rows[k * packetSize + lane]);
            }
        }
    }
    return result;
}

constexpr int wellInside = 60;

/// Points well inside, and at small distances from faces, edges and vertices; some outside.
std::vector<Vec3d> placesFor(const UnitCage& cage, std::uint32_t seed)
{
    Random random(seed);
    std::vector<Vec3d> points;
    for (int i = 0; i < wellInside; ++i) points.push_back(random(0, 0.2) * random.direction());
    for (const double distance : {0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        for (int i = 0; i < 12; ++i) {
            const auto face = static_cast<std::size_t>(random(0, 1) * double(cage.faces().size()));
            const auto& at = cage.faces()[face].at;
            const auto corner = [&](std::size_t k) { return cage.points()[at[k]]; };
            const double s = random(0, 1);
            const Vec3d place = i < 4   ? corner(0)
                                : i < 8 ? (1 - s) * corner(0) + s * corner(1)
                                        : 0.4 * corner(0) + 0.3 * corner(1) + 0.3 * corner(2);
            points.push_back(place - distance * (i % 2 == 0 ? place / place.length() : random.direction()));
        }
    }
    for (const double distance : {0.0, 1e-12, 1e-9, 1e-6}) { // near planes of faces
        for (int i = 0; i < 8; ++i) {
            const auto& at = cage.faces()[static_cast<std::size_t>(random(0, 1) * double(cage.faces().size()))].at;
            const auto corner = [&](std::size_t k) { return cage.points()[at[k]]; };
            const double s = random(-2, 2), t = random(-2, 2);
            const Vec3d place = corner(0) + s * (corner(1) - corner(0)) + t * (corner(2) - corner(0));
            points.push_back(place + distance * random.direction());
        }
    }
    for (int i = 0; i < 10; ++i) points.push_back(random(0.8, 3) * random.direction());
    return points;
}

} // namespace

BOOST_AUTO_TEST_SUITE(row_kernels)

// The scalar formulas, whose own reference are the defining integrals, see test_coordinates.cpp.
BOOST_AUTO_TEST_CASE(rows_are_those_of_the_scalar_formulas)
{
    std::vector<Mesh> cages;
    for (const Kind kind : kinds) {
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            cages.push_back(randomCage(kind, seed, 0.2, seed == 2 ? 2 : 1));
        }
    }
    Mesh torus = test::torus(3, 1, 12, 6); // planes of faces go through it
    torus.triangles = triangulate(torus);
    torus.quads.clear();
    cages.push_back(torus);
    for (std::size_t index = 0; index < cages.size(); ++index) {
        const UnitCage cage(cages[index]);
        const std::shared_ptr<const KernelCage> forKernels = kernelCage(cage);
        const std::vector<Vec3d> points = placesFor(cage, static_cast<std::uint32_t>(index));
        for (const CoordinateFamily* const family : familiesFor(*forKernels)) {
            const std::size_t columns = columnsOf(*forKernels, *family);
            const CageRows exact = family->rowsIn(cage, family->info.family, nullptr);
            const Result result = rowsOf(rowKernels(), *forKernels, *family, points);
            std::vector<double> row(columns);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double* const computed = result.rows.data() + i * columns;
                const bool isDefined = exact.one(points[i], row.data());
                if (result.leftOut[i]) continue;
                BOOST_TEST_CONTEXT(family->info.name << " point " << i << " at " << points[i])
                {
                    BOOST_TEST(isDefined);
                    const bool same = std::equal(row.begin(), row.end(), computed,
                                                 [](double a, double b) { return std::abs(a - b) < 1e-8; });
                    BOOST_TEST(same);
                }
            }
            BOOST_TEST_CONTEXT(family->info.name << " cage " << index)
            {
                // The first points are well inside, but of the torus.
                const auto leftOut = std::count(result.leftOut.begin(), result.leftOut.begin() + wellInside, true);
                BOOST_TEST((leftOut == 0 || index + 1 == cages.size()));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(all_instruction_sets_give_the_same_bits)
{
    for (const Kind kind : kinds) {
        const UnitCage cage(randomCage(kind, 5, 0.2, 2));
        const std::shared_ptr<const KernelCage> forKernels = kernelCage(cage);
        const std::vector<Vec3d> points = placesFor(cage, 5);
        for (const CoordinateFamily* const family : familiesFor(*forKernels)) {
            const Result first = rowsOf(rowKernels(), *forKernels, *family, points);
            for (const Simd set : supportedSimd()) {
                const Result other = rowsOf(rowKernels(set), *forKernels, *family, points);
                BOOST_TEST_CONTEXT(family->info.name << " with " << rowKernels(set).instructions)
                {
                    BOOST_REQUIRE(other.rows.size() == first.rows.size());
                    BOOST_TEST(std::memcmp(other.rows.data(), first.rows.data(), 8 * first.rows.size()) == 0);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_row_depends_on_its_own_point_only)
{
    for (const Kind kind : kinds) {
        const UnitCage cage(randomCage(kind, 6, 0.2, 2));
        const std::shared_ptr<const KernelCage> forKernels = kernelCage(cage);
        std::vector<Vec3d> points = placesFor(cage, 6);
        for (const CoordinateFamily* const family : familiesFor(*forKernels)) {
            const std::size_t columns = columnsOf(*forKernels, *family);
            const Result together = rowsOf(rowKernels(), *forKernels, *family, points);
            for (std::size_t i = 0; i < points.size(); i += 7) {
                const Result alone = rowsOf(rowKernels(), *forKernels, *family, {points[i]});
                BOOST_TEST(std::memcmp(alone.rows.data(), together.rows.data() + i * columns, 8 * columns) == 0);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(projections)
{
    Random random(7);
    constexpr std::size_t count = 11, columns = 3 * floatLanes;
    std::vector<float> rows(count * columns), pivot(columns);
    for (float& entry : rows) entry = static_cast<float>(random(-1, 1));
    for (float& entry : pivot) entry = static_cast<float>(random(-1, 1));
    double square = 0;
    for (const float entry : pivot) square += double(entry) * double(entry);
    const auto inverseSquare = static_cast<float>(1 / square);
    std::vector<float> first;
    for (const Simd set : supportedSimd()) {
        std::vector<float> left = rows, factors(count), sizes(count);
        std::vector<float*> places;
        for (std::size_t r = 0; r < count; ++r) places.push_back(left.data() + r * columns);
        rowKernels(set).project(places.data(), count, pivot.data(), inverseSquare, columns, factors.data(),
                                sizes.data());
        for (std::size_t r = 0; r < count; ++r) {
            double product = 0, size = 0, leftProduct = 0;
            for (std::size_t k = 0; k < columns; ++k) {
                product += double(rows[r * columns + k]) * double(pivot[k]);
                leftProduct += double(left[r * columns + k]) * double(pivot[k]);
                size += std::abs(double(left[r * columns + k]));
            }
            BOOST_TEST(std::abs(double(factors[r]) - product / square) < 1e-6);
            BOOST_TEST(std::abs(leftProduct) < 1e-5);
            BOOST_TEST(std::abs(double(sizes[r]) - size) < 1e-5);
        }
        left.insert(left.end(), sizes.begin(), sizes.end());
        if (first.empty()) first = left;
        BOOST_TEST((left == first), rowKernels(set).instructions);
    }
}

BOOST_AUTO_TEST_SUITE_END()
