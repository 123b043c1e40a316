#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <limits>

#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/voxelize.h>
#include <voxelize/models.h>
#include <voxelize/reference.h>

using namespace vdbcage;
using openvdb::Coord;
using openvdb::Vec3d;
using test::HardModel;

namespace {

bool sameVoxels(const openvdb::MaskGrid& a, const openvdb::MaskGrid& b)
{
    return a.tree().hasSameTopology(b.tree());
}

/// How often the closed surface winds around `p`.
double windingNumber(const Mesh& mesh, const Vec3d& p)
{
    double angle = 0;
    for (const auto& t : triangulate(mesh)) {
        const Vec3d a = mesh.points[t[0]] - p, b = mesh.points[t[1]] - p, c = mesh.points[t[2]] - p;
        const double la = a.length(), lb = b.length(), lc = c.length();
        angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4 * detail::pi);
}

} // namespace

BOOST_AUTO_TEST_SUITE(solid)

BOOST_DATA_TEST_CASE(solid_voxels_are_those_of_the_definition, boost::unit_test::data::make(test::hardModels()), model)
{
    const detail::Frame frame = detail::makeFrame(model.mesh, model.resolution);
    const test::Reference& reference = test::referenceOf(model);
    const openvdb::MaskGrid::Ptr mask = voxelize(model.mesh, {model.resolution}).mask;
    auto accessor = mask->getConstAccessor();
    std::size_t missing = 0, extra = 0, count = 0;
    for (const Coord& ijk : frame.voxels) {
        const bool expected = reference.solid[reference.index(ijk)], got = accessor.isValueOn(ijk);
        count += expected;
        missing += expected && !got;
        extra += !expected && got;
    }
    BOOST_TEST(missing == 0U);
    BOOST_TEST(extra == 0U);
    BOOST_TEST(mask->activeVoxelCount() == count); // nothing outside the box
}

BOOST_AUTO_TEST_CASE(closed_models_are_filled_where_their_surface_winds_round)
{
    const Mesh ball = test::sphere(Vec3d(0.2, 0.1, 0.4), 1, 8);
    const Mesh models[] = {
        ball, test::box(Vec3d(-1, 0, 0.3), Vec3d(1.1, 0.7, 2)), test::torus(1, 0.35, 16, 8),
        test::joined(ball, test::transformed(ball, 0.7, Vec3d(0.9, 0, 0))), // overlapping
    };
    for (const Mesh& model : models) {
        const openvdb::MaskGrid::Ptr mask = voxelize(model, {28}).mask;
        const detail::Frame frame = detail::makeFrame(model, 28);
        auto accessor = mask->getConstAccessor();
        std::size_t wrong = 0, inside = 0;
        const test::Reference reference(model, frame);
        for (const Coord& ijk : frame.voxels) {
            if (reference.surface[reference.index(ijk)]) continue;
            const bool expected = windingNumber(model, mask->indexToWorld(ijk)) > 0.5;
            inside += expected;
            wrong += expected != accessor.isValueOn(ijk);
        }
        BOOST_TEST(inside > 500U);
        BOOST_TEST(wrong == 0U);
    }
}

BOOST_AUTO_TEST_CASE(the_inside_of_nested_shells_is_solid)
{
    const Mesh ball = test::sphere(Vec3d(0), 1, 16), inner = test::transformed(ball, 0.5, Vec3d(0));
    BOOST_TEST(sameVoxels(*voxelize(test::joined(ball, inner), {40}).mask, *voxelize(ball, {40}).mask));
}

BOOST_AUTO_TEST_CASE(orientation_does_not_matter)
{
    const Mesh ball = test::sphere(Vec3d(0), 1, 16);
    BOOST_TEST(sameVoxels(*voxelize(test::halfReversed(ball), {40}).mask, *voxelize(ball, {40}).mask));
}

BOOST_AUTO_TEST_CASE(an_open_bowl_is_filled_to_its_rim_and_no_higher)
{
    const openvdb::MaskGrid::Ptr mask = voxelize(test::bowl(1, 40), {64}).mask;
    const auto isOn = [&](const Vec3d& p) {
        return mask->tree().isValueOn(mask->transform().worldToIndexCellCentered(p));
    };
    BOOST_TEST(isOn(Vec3d(0, 0, -0.05)));
    BOOST_TEST(isOn(Vec3d(0.7, 0, -0.3)));
    BOOST_TEST(!isOn(Vec3d(0, 0, 0.05)));
    BOOST_TEST(!isOn(Vec3d(0.9, 0, -0.9)));
}

BOOST_AUTO_TEST_CASE(a_leak_along_one_axis_fills_nothing)
{
    // A box without one of its faces, and a point far off that makes the grid go on where the rays leak out.
    for (std::size_t open = 0; open < 6; ++open) {
        Mesh model = test::box(Vec3d(0), Vec3d(1));
        model.quads.erase(model.quads.begin() + static_cast<std::ptrdiff_t>(open));
        const Vec3d far = open % 2 == 0 ? Vec3d(-3) : Vec3d(4);
        model.points.push_back(far);
        model.triangles.emplace_back(8U, 8U, 8U);
        const openvdb::MaskGrid::Ptr mask = voxelize(model, {96}).mask;
        const openvdb::Coord corner = mask->transform().worldToIndexCellCentered(far);
        BOOST_TEST(mask->tree().isValueOn(corner));
        mask->tree().setValueOff(corner);
        const openvdb::CoordBBox box = mask->evalActiveVoxelBoundingBox();
        BOOST_TEST(box.volume() <= 25U * 25U * 25U);
        BOOST_TEST(mask->activeVoxelCount() >= 24U * 25U * 25U); // but the inside is filled
    }
}

BOOST_AUTO_TEST_CASE(a_sheet_has_no_inside)
{
    // A tilted square: it is in the way of rays along all three axes.
    Mesh sheet;
    sheet.points = {{0, 0, 0}, {1, 0.2, 0.4}, {0.7, 1.2, 1.1}, {-0.3, 1, 0.7}};
    sheet.quads = {{0, 1, 2, 3}};
    const Vec3d normal = sheet.points[1].cross(sheet.points[3]).unit();
    for (const double side : {1, -1}) {
        const openvdb::MaskGrid::Ptr mask = voxelize(test::transformed(sheet, side, Vec3d(0)), {64}).mask;
        std::size_t far = 0;
        for (const openvdb::Coord& ijk : mask->evalActiveVoxelBoundingBox()) {
            if (!mask->tree().isValueOn(ijk)) continue;
            far += std::abs(normal.dot(mask->indexToWorld(ijk))) > mask->voxelSize()[0];
        }
        BOOST_TEST(mask->activeVoxelCount() > 3000U);
        BOOST_TEST(far == 0U);
    }
}

BOOST_AUTO_TEST_CASE(open_models_get_mirrored_voxels_when_mirrored)
{
    const Mesh bowl = test::bowl(1, 24);
    Mesh tilted = bowl;
    for (Vec3d& p : tilted.points) p = Vec3d(p.x() + 0.5 * p.z(), p.y() - 0.25 * p.x(), p.z() + 0.75 * p.y());
    constexpr int resolution = 41; // with no point of the bowl's rim in the middle of a voxel
    for (const Mesh& model :
         {bowl, tilted, test::joined(tilted, test::transformed(tilted, -0.7, Vec3d(0.3, 0, 0.2)))}) {
        const openvdb::MaskGrid::Ptr mask = voxelize(model, {resolution}).mask;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Mesh mirrored = model;
            for (Vec3d& p : mirrored.points) p(static_cast<int>(axis)) *= -1;
            const openvdb::MaskGrid::Ptr other = voxelize(mirrored, {resolution}).mask;
            BOOST_TEST(other->activeVoxelCount() == mask->activeVoxelCount());
            std::size_t different = 0;
            for (const openvdb::Coord& ijk : mask->evalActiveVoxelBoundingBox()) {
                openvdb::Coord across = ijk;
                across[axis] = resolution - ijk[axis];
                different += other->tree().isValueOn(across) != mask->tree().isValueOn(ijk);
            }
            BOOST_TEST(different == 0U);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_box_gets_as_many_voxels_on_both_sides)
{
    for (const int resolution : {1, 2, 7, 8, 64}) {
        const openvdb::MaskGrid::Ptr mask = voxelize(test::box(Vec3d(5), Vec3d(7, 6.3, 5.9)), {resolution}).mask;
        const openvdb::CoordBBox box = mask->evalActiveVoxelBoundingBox();
        BOOST_TEST(box.min().x() == 0);
        BOOST_TEST(box.max().x() == resolution);
        for (std::size_t axis = 0; axis < 3; ++axis) BOOST_TEST(box.min()[axis] + box.max()[axis] == resolution);
        BOOST_TEST(mask->activeVoxelCount() == box.volume());
        BOOST_TEST(mask->voxelSize().x() == 2.0 / resolution);
        BOOST_TEST((mask->indexToWorld(Vec3d(0.5 * resolution)) - Vec3d(6, 5.65, 5.45)).length() < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(two_threads_find_what_one_finds)
{
    for (const HardModel& model : test::hardModels()) {
        openvdb::MaskGrid::Ptr masks[2];
        for (const std::size_t threads : {1U, 2U}) {
            const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
            masks[threads - 1] = voxelize(model.mesh, {3 * model.resolution}).mask;
        }
        BOOST_TEST(sameVoxels(*masks[0], *masks[1]), model.name);
    }
}

BOOST_AUTO_TEST_CASE(moving_and_scaling_the_model_changes_no_voxel)
{
    // By powers of two and by whole numbers, so that the model itself is moved and scaled without rounding.
    Mesh model = test::soup(11, 40, 4, 1, false);
    for (Vec3d& p : model.points) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 0x1p20) * 0x1p-20;
    }
    for (const int resolution : {32, 50}) {
        const openvdb::MaskGrid::Ptr mask = voxelize(model, {resolution}).mask;
        for (const double scale : {0x1p-300, 0x1p-20, 0x1p-1, 1.0, 0x1p20, 0x1p300}) {
            for (const Vec3d& move : {Vec3d(0), Vec3d(-1000, 77, 12345)}) {
                const Mesh moved = test::transformed(test::transformed(model, 1, move), scale, Vec3d(0));
                const openvdb::MaskGrid::Ptr other = voxelize(moved, {resolution}).mask;
                BOOST_TEST(sameVoxels(*mask, *other));
                BOOST_TEST(other->voxelSize().x() == scale * mask->voxelSize().x());
                const Vec3d corner(3, 0, 7), there = scale * (mask->indexToWorld(corner) + move);
                BOOST_TEST((other->indexToWorld(corner) - there).length() < 1e-10 * scale);
                BOOST_TEST((other->worldToIndex(there) - corner).length() < 1e-8);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(inexact_moves_and_scales_change_no_voxel_of_a_box)
{
    const Mesh model = test::box(Vec3d(0), Vec3d(1, 0.75, 0.5));
    const openvdb::MaskGrid::Ptr mask = voxelize(model, {100}).mask;
    for (const double scale : {1e-6, 0.1, 3.0, 1e6}) {
        for (const Vec3d& move : {Vec3d(0), Vec3d(-1000, 0.1, 1e6)}) {
            BOOST_TEST(sameVoxels(*mask, *voxelize(test::transformed(model, scale, scale * move), {100}).mask));
        }
    }
}

BOOST_AUTO_TEST_CASE(points_that_no_face_uses_do_not_count)
{
    Mesh model = test::sphere(Vec3d(0), 1, 8);
    const openvdb::MaskGrid::Ptr mask = voxelize(model, {20}).mask;
    model.points.emplace_back(1e308, -1e308, std::numeric_limits<double>::quiet_NaN());
    model.points.emplace_back(0, std::numeric_limits<double>::infinity(), 50);
    BOOST_TEST(sameVoxels(*mask, *voxelize(model, {20}).mask));
}

BOOST_AUTO_TEST_CASE(every_question_can_cancel)
{
    // With several threads the number of questions varies by a few.
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const Mesh model = test::joined(test::sphere(Vec3d(0), 1, 60), test::soup(3, 30, 10, 2, false));
    constexpr int many = 1 << 20;
    test::StopAt counter(many);
    const openvdb::MaskGrid::Ptr mask = voxelize(model, {64}, &counter).mask;
    BOOST_TEST(sameVoxels(*mask, *voxelize(model, {64}).mask));
    const int asked = test::questions(counter, many);
    BOOST_TEST(asked > 30);
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(voxelize(model, {64}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(voxels_are_laid_out_by_the_box_that_is_given)
{
    const Mesh model = test::sphere(Vec3d(0.5, -1, 2), 1, 9);
    VoxelizeOptions options{20, Voxelizer::cpu, boundingBox(model)};
    const auto own = voxelize(model, {20}).mask;
    BOOST_CHECK(sameVoxels(*own, *voxelize(model, options).mask));
    // A side of 4 instead of 2, twice the voxels, from the same low corner on x: equal ones, moved by half of what was
    // added before them on the other axes.
    options.box->max() += Vec3d(2, 1, 1);
    options.box->min() -= Vec3d(0, 1, 1);
    options.resolution = 40;
    const auto moved = voxelize(model, options).mask;
    std::size_t found = 0;
    for (auto voxel = own->tree().cbeginValueOn(); voxel; ++voxel) {
        openvdb::CoordBBox box;
        voxel.getBoundingBox(box);
        for (auto at = box.begin(); at; ++at) found += moved->tree().isValueOn((*at).offsetBy(0, 10, 10));
    }
    BOOST_TEST(found == own->activeVoxelCount());
    BOOST_TEST(found == moved->activeVoxelCount());
    BOOST_TEST((moved->indexToWorld(Vec3d(20)) - Vec3d(1.5, -1, 2)).length() < 1e-12); // the middle of the box
    options.box->max()[1] -= 1.5;
    BOOST_CHECK_THROW(voxelize(model, options), InputError);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_voxelized_is_refused_with_the_value_and_what_is_allowed)
{
    const Mesh model = test::box(Vec3d(0), Vec3d(1));
    const auto message = [](const Mesh& mesh, const VoxelizeOptions& options) -> std::string {
        try {
            voxelize(mesh, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const auto names = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    for (const int resolution : {-1, 0, 4097, std::numeric_limits<int>::max()}) {
        const std::string text = message(model, {resolution});
        BOOST_TEST(names(text, "resolution: " + std::to_string(resolution) + " is not allowed"), text);
        BOOST_TEST(names(text, "1 to 4096"), text);
    }
    BOOST_TEST(names(message(Mesh(), {}), "model: it has no faces"));
    BOOST_TEST(names(message(test::transformed(model, 1e-101, Vec3d(0)), {}), "model: its longest side is 1e-101"));
    BOOST_TEST(names(message(test::transformed(model, 1e101, Vec3d(0)), {}), "1e+100 is allowed"));
    BOOST_TEST(names(message(test::transformed(model, 1e308, Vec3d(0.8e308, 0, 0)), {}), "inf"));
    BOOST_TEST(names(message(test::transformed(model, 1e308, Vec3d(-0.9e308)), {}), "1e+308"));
    const Mesh far = test::transformed(model, 1, Vec3d(0x1p37 / 100, 0, 0));
    BOOST_TEST(message(far, {99}).empty());
    BOOST_TEST(names(message(far, {101}), "at resolution 101 it must be at least 1.01"));
    Mesh bad = model;
    bad.points[3].y() = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(names(message(bad, {}), "coordinates must be finite"));
    BOOST_TEST(sameVoxels(*voxelize(model, {16, Voxelizer::cpu}).mask, *voxelize(model, {16}).mask));
}

BOOST_AUTO_TEST_SUITE_END()
