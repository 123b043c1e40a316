#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include <deform/cages.h>
#include <support/reordered.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/posed_points.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Index32;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

namespace {

/// The mesh with all points somewhere else.
Mesh posedSomehow(Mesh mesh, std::mt19937& random)
{
    test::Random number(static_cast<std::uint32_t>(random()));
    for (Vec3d& p : mesh.points) p += 0.1 * number.direction();
    return mesh;
}

/// Nothing of it is like anything else of it.
Mesh lopsidedTorus(int around = 9, int across = 6)
{
    return test::lopsided(test::torus(3, 1, around, across));
}

/// Cages as make gives them, of a model without a symmetry.
const std::vector<Mesh>& madeCages()
{
    static const std::vector<Mesh> cages = [] {
        std::vector<Mesh> made;
        const Mesh model = test::randomCage(test::Kind::both, 5, 0.3, 3);
        for (const CageFaces kind : {CageFaces::triangles, CageFaces::quads}) {
            CageOptions options;
            options.faces = 120;
            options.mesh = kind;
            options.effort = Effort::fast;
            options.resolution = 32;
            made.push_back(makeCage(model, options));
        }
        return made;
    }();
    return cages;
}

void checkRefused(const Mesh& cage, const Mesh& posed, const std::string& mention)
{
    BOOST_CHECK_EXCEPTION(posedPoints(cage, posed), InputError, [&](const InputError& error) {
        BOOST_TEST_MESSAGE(error.what());
        return std::string(error.what()).rfind("posed cage: ", 0) == 0 &&
               std::string(error.what()).find(mention) != std::string::npos;
    });
}

const std::string doNotTell = "its points are in another order than the cage's, and its faces do not tell which is "
                              "which; keep the order";
const std::string noOrder = " faces are not the cage's, and no other order of its points makes them so";

} // namespace

BOOST_AUTO_TEST_SUITE(posed_points)

BOOST_AUTO_TEST_CASE(any_order_of_points_faces_and_corners_gives_the_same_points)
{
    std::mt19937 random(1);
    std::vector<Mesh> cages = madeCages();
    cages.push_back(lopsidedTorus());
    for (const Mesh& cage : cages) {
        for (int i = 0; i < 20; ++i) {
            const Mesh posed = posedSomehow(cage, random);
            const PosedPoints kept = posedPoints(cage, test::withFacesShuffled(posed, random));
            BOOST_TEST(!kept.reordered);
            BOOST_CHECK(kept.points == posed.points);
            const Mesh other = test::reordered(posed, random);
            const PosedPoints found = posedPoints(cage, other);
            BOOST_TEST(found.reordered);
            BOOST_CHECK(found.points == posed.points);
        }
    }
}

BOOST_AUTO_TEST_CASE(two_points_exchanged_are_enough)
{
    std::mt19937 random(2);
    const Mesh cage = lopsidedTorus(), posed = posedSomehow(cage, random);
    for (std::size_t i = 0; i < cage.points.size(); ++i) {
        std::vector<std::size_t> order(cage.points.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::swap(order[i], order[(i + 1 + random() % (order.size() - 1)) % order.size()]);
        const PosedPoints found = posedPoints(cage, test::withPointsIn(order, posed));
        BOOST_TEST(found.reordered);
        BOOST_CHECK(found.points == posed.points);
    }
}

BOOST_AUTO_TEST_CASE(quads_may_be_split_where_the_points_are_in_order)
{
    std::mt19937 random(3);
    const Mesh cage = madeCages().back();
    for (int i = 0; i < 20; ++i) {
        Mesh posed = posedSomehow(cage, random);
        std::vector<Vec4I> quads;
        for (const Vec4I& q : posed.quads) {
            switch (random() % 3) {
            case 0:
                quads.push_back(q);
                break;
            case 1:
                posed.triangles.insert(posed.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
                break;
            default:
                posed.triangles.insert(posed.triangles.end(), {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}});
            }
        }
        posed.quads = quads;
        posed = test::withFacesShuffled(posed, random);
        for (const auto& [rest, moved] : {std::pair(cage, posed), std::pair(posed, cage)}) {
            const PosedPoints found = posedPoints(rest, moved);
            BOOST_TEST(!found.reordered);
            BOOST_CHECK(found.points == moved.points);
        }
        // In another order it could be any diagonal.
        checkRefused(cage, test::reordered(posed, random),
                     " quads; the cage has " + std::to_string(cage.quads.size()) + "; keep the quads, or the order");
    }
}

BOOST_AUTO_TEST_CASE(quads_that_a_pose_makes_concave_stay_quads)
{
    const test::TemporaryFolder folder;
    std::mt19937 random(4);
    const Mesh cage = lopsidedTorus();
    Mesh posed = cage;
    for (Vec3d& p : posed.points) p += 0.9 * test::Random(static_cast<std::uint32_t>(random())).direction();
    const Mesh shuffledPose = test::reordered(posed, random);
    for (const auto& [name, mesh] : {std::pair("posed.obj", posed), std::pair("other.obj", shuffledPose)}) {
        writeMesh(mesh, folder / name);
        const Mesh read = readMesh(folder / name);
        BOOST_TEST(read.quads.size() < cage.quads.size());
        const PosedPoints found = posedPoints(cage, read);
        BOOST_TEST(found.reordered == (mesh.points != posed.points));
        BOOST_CHECK(found.points == posed.points);
        // And as the cage at rest, which is read too.
        const std::vector<Vec3d> back = posedPoints(read, cage).points;
        for (std::size_t i = 0; i < back.size(); ++i) {
            const auto same = std::find(posed.points.begin(), posed.points.end(), read.points[i]);
            BOOST_CHECK(back[i] == cage.points[static_cast<std::size_t>(same - posed.points.begin())]);
        }
    }
}

BOOST_AUTO_TEST_CASE(larger_polygons_may_be_split_anew_where_the_points_are_in_order)
{
    const test::TemporaryFolder folder;
    const std::string faces = "f 1 2 3 4 5\nf 10 9 8 7 6\nf 1 6 7 2\nf 2 7 8 3\nf 3 8 9 4\nf 4 9 10 5\nf 5 10 6 1\n";
    std::string text;
    for (const double z : {0.0, -1.0}) {
        for (int i = 0; i < 5; ++i) {
            text += "v " + std::to_string(std::cos(1.2566 * i)) + ' ' + std::to_string(std::sin(1.2566 * i)) + ' ' +
                    std::to_string(z) + '\n';
        }
    }
    test::writeText(folder / "cage.obj", text + faces);
    test::writeText(folder / "posed.obj", text.replace(text.find("v 0.3"), text.find("v -0.8") - text.find("v 0.3"),
                                                       "v -0.6 -0.2 0\n") +
                                              faces); // a dent
    const Mesh cage = readMesh(folder / "cage.obj"), posed = readMesh(folder / "posed.obj");
    BOOST_TEST((cage.triangles != posed.triangles));
    BOOST_TEST(!posedPoints(cage, posed).reordered);
    BOOST_TEST(!posedPoints(posed, cage).reordered);
}

BOOST_AUTO_TEST_CASE(open_cages_and_one_point_without_a_face)
{
    std::mt19937 random(5);
    Mesh cage = lopsidedTorus();
    cage.triangles.pop_back();
    cage.quads.erase(cage.quads.begin() + 20, cage.quads.begin() + 23);
    cage.points.emplace_back(9, 9, 9);
    const Mesh posed = posedSomehow(cage, random);
    for (int i = 0; i < 20; ++i) {
        const PosedPoints found = posedPoints(cage, test::reordered(posed, random));
        BOOST_TEST(found.reordered);
        BOOST_CHECK(found.points == posed.points);
    }
}

BOOST_AUTO_TEST_CASE(several_components)
{
    std::mt19937 random(6);
    const auto both = [](Mesh a, const Mesh& b) {
        const auto before = static_cast<Index32>(a.points.size());
        a.points.insert(a.points.end(), b.points.begin(), b.points.end());
        for (const Vec3I& t : b.triangles) a.triangles.push_back(t + Vec3I(before));
        for (const Vec4I& q : b.quads) a.quads.push_back(q + Vec4I(before));
        return a;
    };
    const Mesh cage = both(lopsidedTorus(9, 6), lopsidedTorus(8, 7)), posed = posedSomehow(cage, random);
    const std::vector<std::size_t> order = test::shuffled(cage.points.size(), random);
    BOOST_CHECK(posedPoints(cage, test::withPointsIn(order, posed)).points == posed.points);
    // Two of the same could be either.
    const Mesh twins = both(lopsidedTorus(), lopsidedTorus());
    BOOST_TEST(!posedPoints(twins, test::withFacesShuffled(twins, random)).reordered);
    checkRefused(twins, test::reordered(twins, random), doNotTell);
}

BOOST_AUTO_TEST_CASE(what_is_the_same_from_several_sides_is_refused)
{
    std::mt19937 random(7);
    Mesh loose = lopsidedTorus(); // two points without faces
    loose.points.resize(loose.points.size() + 2, Vec3d(9));
    Mesh fin = lopsidedTorus(); // an edge of three faces
    fin.points.emplace_back(9, 9, 9);
    fin.triangles.emplace_back(fin.quads[0][0], fin.quads[0][1], static_cast<Index32>(fin.points.size() - 1));
    for (const Mesh& cage : {test::box(Vec3d(0), Vec3d(1)), test::sphere({}, 1, 6), test::torus(3, 1, 8, 5),
                             test::randomCage(test::Kind::quads, 1), loose, fin}) {
        BOOST_TEST(!posedPoints(cage, test::withFacesShuffled(cage, random)).reordered);
        for (int i = 0; i < 5; ++i) {
            checkRefused(cage, test::reordered(cage, random), doNotTell);
        }
    }
}

BOOST_AUTO_TEST_CASE(other_faces_are_refused)
{
    std::mt19937 random(8);
    const Mesh& cage = madeCages().front();
    for (int i = 0; i < 40; ++i) {
        Mesh other = cage; // an edge of it is flipped
        const auto hasEdge = [&](Index32 a, Index32 b) {
            return std::any_of(other.triangles.begin(), other.triangles.end(), [&](const Vec3I& t) {
                const auto has = [&](Index32 p) { return t[0] == p || t[1] == p || t[2] == p; };
                return has(a) && has(b);
            });
        };
        for (bool flipped = false; !flipped;) {
            Vec3I& t = other.triangles[random() % other.triangles.size()];
            for (Vec3I& u : other.triangles) {
                for (int k = 0; k < 3 && !flipped; ++k) {
                    if (u[k] != t[1] || u[(k + 1) % 3] != t[0] || hasEdge(t[2], u[(k + 2) % 3])) continue;
                    const Index32 tip = u[(k + 2) % 3];
                    u = {t[1], t[2], tip};
                    t = {t[0], tip, t[2]};
                    flipped = true;
                }
                if (flipped) break;
            }
        }
        checkRefused(cage, other, "2 of its 1");
        checkRefused(cage, test::reordered(other, random), noOrder);
        checkRefused(other, test::reordered(cage, random), noOrder);
    }
    Mesh twice = cage;
    twice.triangles[3] = twice.triangles[5];
    checkRefused(cage, twice, '1' + (" of its " + std::to_string(faceCount(cage))) + noOrder);
    Mesh insideOut = cage;
    for (Vec3I& t : insideOut.triangles) std::swap(t[0], t[1]);
    checkRefused(cage, insideOut, noOrder);
    const Mesh torus = lopsidedTorus(9, 6), otherTorus = lopsidedTorus(6, 9);
    checkRefused(torus, otherTorus, noOrder);
}

BOOST_AUTO_TEST_CASE(other_numbers_are_refused)
{
    const Mesh box = test::box(Vec3d(0), Vec3d(1)), ball = test::sphere({}, 1, 3);
    checkRefused(box, ball,
                 "it has 14 points, 12 triangles and 6 quads; the cage has 8 points, 0 triangles and 6 quads");
    Mesh more = box;
    more.points.push_back(more.points.front());
    checkRefused(box, more, "it has 9 points, 0 triangles and 6 quads; the cage has 8 points, 0 triangles and 6 quads");
}

BOOST_AUTO_TEST_SUITE_END()
