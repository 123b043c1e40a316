#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include <tools/edit/motion.h>
#include <tools/view/picture/gizmo.h>

using namespace vdbcage;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace {

struct Random {
    std::mt19937 bits;
    double real(double least, double most) { return std::uniform_real_distribution<double>(least, most)(bits); }
    Vec3d vector() { return {real(-1, 1), real(-1, 1), real(-1, 1)}; }
};

GizmoFrame anyFrame(Random& random)
{
    draw::Camera camera;
    camera.view.azimuthDegrees = random.real(-180, 180);
    camera.view.elevationDegrees = random.real(-89, 89);
    camera.projection = random.bits() % 2 == 0 ? draw::Projection::perspective : draw::Projection::orthographic;
    GizmoFrame frame;
    frame.width = 640;
    frame.height = 480;
    const std::vector<draw::Vec3f> seen{{-1, -1, -1}, {1, 1, 1}, {-1, 1, 0}, {1, -1, 0}, {0, 0, 0}};
    frame.eye = draw::eyeOf(camera, 640.0 / 480, {&seen});
    frame.origin = 0.3 * random.vector();
    const Vec3d x = random.vector().unit(), y = x.cross(random.vector()).unit();
    frame.axes = {x, y, x.cross(y)};
    return frame;
}

/// The middle of a stroke, or of an area.
Pixel middleOf(const GizmoPart& part)
{
    if (!part.isFilled) return part.line[part.line.size() / 2];
    Pixel sum{};
    for (const Pixel& p : part.line) {
        for (std::size_t k = 0; k < 2; ++k) sum[k] += p[k] / static_cast<double>(part.line.size());
    }
    return sum;
}

double distance(const Pixel& a, const Pixel& b)
{
    return std::hypot(a[0] - b[0], a[1] - b[1]);
}

} // namespace

BOOST_AUTO_TEST_SUITE(gizmo)

BOOST_AUTO_TEST_CASE(what_is_seen_can_be_grabbed)
{
    Random random;
    for (int i = 0; i < 300; ++i) {
        const GizmoFrame frame = anyFrame(random);
        for (const Tool tool : {Tool::move, Tool::rotate, Tool::scale}) {
            const auto parts = gizmoParts(frame, tool);
            BOOST_TEST_REQUIRE(!parts.empty());
            for (const GizmoPart& part : parts) BOOST_TEST(handleAt(parts, 1, middleOf(part)).has_value());
            // What is in front wins.
            BOOST_CHECK(*handleAt(parts, 1, middleOf(parts.back())) == parts.back().handle);
            BOOST_TEST(!handleAt(parts, 1, {-500, -500}));
        }
        BOOST_TEST(gizmoParts(frame, Tool::select).empty());
        GizmoFrame behind = frame;
        behind.origin = frame.eye.position + frame.eye.back;
        if (frame.eye.projection == draw::Projection::perspective) {
            BOOST_TEST(gizmoParts(behind, Tool::move).empty());
        }
    }
}

BOOST_AUTO_TEST_CASE(what_is_moved_stays_under_the_pointer)
{
    Random random;
    for (int i = 0; i < 300; ++i) {
        const GizmoFrame frame = anyFrame(random);
        const Pixel from = pixelOf(frame, frame.origin);
        const Pixel to{from[0] + random.real(-60, 60), from[1] + random.real(-60, 60)};
        const auto end = [&](const Handle& handle) {
            const Vec3d by = draggedAmount(frame, Tool::move, handle, from, to).values;
            Vec3d moved = frame.origin;
            for (int k = 0; k < 3; ++k) moved += frame.axes[static_cast<std::size_t>(k)] * by[k];
            return moved;
        };
        BOOST_TEST(distance(pixelOf(frame, end({})), to) < 1e-6);
        for (const GizmoPart& part : gizmoParts(frame, Tool::move)) {
            const int axis = part.handle.axis;
            const Vec3d moved = end(part.handle) - frame.origin;
            if (part.handle.kind == Handle::Kind::plane) {
                BOOST_TEST(distance(pixelOf(frame, end(part.handle)), to) < 1e-5);
                BOOST_TEST(std::abs(moved.dot(frame.axes[static_cast<std::size_t>(axis)])) < 1e-12);
            } else if (part.handle.kind == Handle::Kind::axis) {
                // As near to the pointer as the axis comes.
                BOOST_TEST(moved.cross(frame.axes[static_cast<std::size_t>(axis)]).length() < 1e-12);
                const Vec3d& along = frame.axes[static_cast<std::size_t>(axis)];
                const Pixel a = pixelOf(frame, end(part.handle) - along * 1e-3);
                const Pixel b = pixelOf(frame, end(part.handle) + along * 1e-3);
                BOOST_TEST(distance(pixelOf(frame, end(part.handle)), to) <
                           std::max(distance(a, to), distance(b, to)) + 1);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(what_is_turned_follows_the_pointer_around_the_middle)
{
    Random random;
    int checked = 0;
    for (int i = 0; i < 300; ++i) {
        const GizmoFrame frame = anyFrame(random);
        const Vec3d axis = rotationAxis(frame, {});
        const Vec3d side = axis.cross(random.vector()).unit() * 0.2;
        const double degrees = random.real(-170, 170);
        const auto turned = edit::moved({frame.origin + side}, {1}, edit::Rotate{axis, degrees, frame.origin});
        const Pixel from = pixelOf(frame, frame.origin + side), to = pixelOf(frame, turned[0]);
        const double got = draggedAmount(frame, Tool::rotate, {}, from, to).values[0];
        BOOST_TEST(std::abs(got - degrees) < 15); // perspective bends the circle a little
        for (int k = 0; k < 3; ++k) {
            const Handle handle{Handle::Kind::axis, k};
            const double part = draggedAmount(frame, Tool::rotate, handle, from, to).values[0];
            BOOST_TEST(std::isfinite(part));
            const double back = draggedAmount(frame, Tool::rotate, handle, to, from).values[0];
            BOOST_TEST(std::abs(part + back) < 1e-9);
        }
        ++checked;
    }
    BOOST_TEST(checked == 300);
}

BOOST_AUTO_TEST_CASE(scaling_is_by_how_much_farther_the_pointer_is)
{
    Random random;
    for (int i = 0; i < 300; ++i) {
        const GizmoFrame frame = anyFrame(random);
        const Pixel centre = pixelOf(frame, frame.origin);
        const Pixel from{centre[0] + 50, centre[1]}, to{centre[0], centre[1] - 75};
        const Vec3d all = draggedAmount(frame, Tool::scale, {}, from, to).values;
        for (int k = 0; k < 3; ++k) BOOST_TEST(std::abs(all[k] - 1.5) < 1e-12);
        for (int k = 0; k < 3; ++k) {
            const Vec3d two = draggedAmount(frame, Tool::scale, {Handle::Kind::plane, k}, from, to).values;
            BOOST_TEST(two[k] == 1);
            BOOST_TEST(std::abs(two[(k + 1) % 3] - 1.5) < 1e-12);
            const Vec3d one = draggedAmount(frame, Tool::scale, {Handle::Kind::axis, k}, from, from).values;
            BOOST_TEST((one == Vec3d(1)));
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
