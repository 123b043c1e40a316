#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "cages.h"
#include "meshes.h"
#include <tools/draw/stand_in.h>
#include <tools/edit/picking.h>
#include <tools/edit/selection.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec2d;
using openvdb::Vec3d;

namespace {

using Triangle = std::array<Vec3d, 3>;

/// Where the segment from a to b meets a triangle, by the volumes of tetrahedra; 0 to 1.
std::optional<double> meet(const Vec3d& a, const Vec3d& b, const Triangle& t)
{
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double above = normal.dot(a - t[0]), below = normal.dot(b - t[0]);
    if ((above > 0) == (below > 0) || above == below) return std::nullopt;
    const Vec3d d = b - a;
    double sign = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double volume = d.dot((t[i] - a).cross(t[(i + 1) % 3] - a));
        if (volume * sign < 0) return std::nullopt;
        if (volume != 0) sign = volume;
    }
    return above / (above - below);
}

/// Everything by looking at everything.
class BruteForce {
public:
    BruteForce(const Elements& elements, std::vector<Vec3d> points, const PickView& view,
               const draw::Geometry* occluder)
        : elements_(elements), points_(std::move(points)), view_(view)
    {
        for (Index face = 0; face < elements.count(Element::face); ++face) {
            const Ids corners = elements.pointsOfFace(face);
            cage_.push_back({face, {points_[corners[0]], points_[corners[1]], points_[corners[2]]}});
            if (corners.size() == 4)
                cage_.push_back({face, {points_[corners[0]], points_[corners[2]], points_[corners[3]]}});
        }
        if (occluder == nullptr) return;
        const auto at = [&](Index i) {
            const auto& p = occluder->positions()[i];
            return Vec3d(p[0], p[1], p[2]);
        };
        for (const auto& t : occluder->triangles()) model_.push_back({none, {at(t[0]), at(t[1]), at(t[2])}});
    }

    std::optional<Index> at(Element kind, const Vec2d& pixel, double radius) const
    {
        if (kind == Element::face) return faceAt(pixel);
        std::optional<Index> best;
        double least = radius, front = 0;
        for (Index id = 0; id < elements_.count(kind); ++id) {
            if (kind == Element::point && !elements_.isUsed(id)) continue;
            const auto place = kind == Element::point ? std::optional(points_[id]) : placeOnEdge(id, pixel);
            if (!place || !isThere(*place)) continue;
            const double distance = (pixelOf(*place) - pixel).length(), depth = draw::project(view_.eye, *place).z();
            const bool isNearer = distance < least || (distance == least && (!best || depth < front));
            if (!isNearer || isHidden(*place, ownFaces(kind, id))) continue;
            best = id;
            least = distance;
            front = depth;
        }
        return best;
    }

    std::vector<Index> within(Element kind, const std::vector<Vec2d>& polygon) const
    {
        std::vector<Index> ids;
        for (Index id = 0; id < elements_.count(kind); ++id) {
            auto corners = pointsOf(elements_, Selection{kind, {id}});
            if (kind == Element::face) { // a corner that is there twice counts twice
                corners.assign(elements_.pointsOfFace(id).begin(), elements_.pointsOfFace(id).end());
            }
            if (kind == Element::point && !elements_.isUsed(id)) continue;
            Vec3d middle(0.0);
            for (const Index corner : corners) middle += points_[corner] / double(corners.size());
            bool isInside = isThere(middle);
            if (kind == Element::face) {
                isInside = isInside && windsAround(pixelOf(middle), polygon);
            } else {
                for (const Index corner : corners) {
                    isInside = isInside && isThere(points_[corner]) && windsAround(pixelOf(points_[corner]), polygon);
                }
            }
            if (isInside && !isHidden(middle, ownFaces(kind, id))) ids.push_back(id);
        }
        return ids;
    }

    Vec2d pixelOf(const Vec3d& point) const
    {
        const Vec3d place = draw::project(view_.eye, point);
        return {(place.x() + 1) / 2 * view_.width, (1 - place.y()) / 2 * view_.height};
    }

private:
    struct Face {
        Index id;
        Triangle corners;
    };

    bool isCut(const Vec3d& p) const { return view_.section && view_.section->normal.dot(p) < view_.section->offset; }
    bool isThere(const Vec3d& p) const { return draw::project(view_.eye, p).z() >= view_.eye.nearest && !isCut(p); }

    std::vector<Index> ownFaces(Element kind, Index id) const
    {
        std::vector<Index> own;
        for (Index face = 0; face < elements_.count(Element::face); ++face) {
            const Ids sides = elements_.edgesOfFace(face), corners = elements_.pointsOfFace(face);
            const bool isOwn = kind == Element::face   ? face == id
                               : kind == Element::edge ? std::count(sides.begin(), sides.end(), id) > 0
                                                       : std::count(corners.begin(), corners.end(), id) > 0;
            if (isOwn) own.push_back(face);
        }
        return own;
    }

    /// The line of sight through a pixel, from where the picture begins.
    std::pair<Vec3d, Vec3d> sight(const Vec2d& pixel) const
    {
        const auto ray = draw::rayThrough(view_.eye, 2 * pixel.x() / view_.width - 1, 1 - 2 * pixel.y() / view_.height);
        const double step = 1 / -view_.eye.back.dot(ray.direction);
        return {ray.from + view_.eye.nearest * step * ray.direction, ray.direction};
    }

    bool isHidden(const Vec3d& place, const std::vector<Index>& own) const
    {
        if (view_.seeThrough) return false;
        const Vec3d from = sight(pixelOf(place)).first;
        const double length = (place - from).length();
        const auto hides = [&](const Face& face) {
            const auto where = meet(from, place, face.corners);
            return where && *where * length < length - 1e-6 && !isCut(from + *where * (place - from)) &&
                   std::count(own.begin(), own.end(), face.id) == 0;
        };
        return std::any_of(cage_.begin(), cage_.end(), hides) || std::any_of(model_.begin(), model_.end(), hides);
    }

    std::optional<Index> faceAt(const Vec2d& pixel) const
    {
        const auto [from, direction] = sight(pixel);
        const Vec3d to = from + 100 * direction;
        std::optional<Index> first;
        double least = 2;
        for (const Face& face : cage_) {
            const auto where = meet(from, to, face.corners);
            if (!where || !(*where < least) || isCut(from + *where * (to - from))) continue;
            least = *where;
            first = face.id;
        }
        if (!first || view_.seeThrough) return first;
        for (const Face& face : model_) {
            const auto where = meet(from, to, face.corners);
            if (where && 100 * *where < 100 * least - 1e-6 && !isCut(from + *where * (to - from))) return std::nullopt;
        }
        return first;
    }

    /// The point of an edge that looks nearest to a pixel: halving tells which way it gets nearer.
    std::optional<Vec3d> placeOnEdge(Index edge, const Vec2d& pixel) const
    {
        const Vec3d a = points_[elements_.edges()[edge].first], b = points_[elements_.edges()[edge].second];
        const auto at = [&](double t) { return a + t * (b - a); };
        // The part that is there: up to two cuts, each found by halving.
        double first = 0, last = 1;
        const auto cut = [&](const auto& isOn) {
            if (isOn(a) && isOn(b)) return true;
            if (!isOn(a) && !isOn(b)) return false;
            double in = isOn(a) ? 0 : 1, out = 1 - in;
            for (int i = 0; i < 200; ++i) (isOn(at((in + out) / 2)) ? in : out) = (in + out) / 2;
            if (isOn(a)) {
                last = std::min(last, in);
            } else {
                first = std::max(first, in);
            }
            return true;
        };
        if (!cut([&](const Vec3d& p) { return draw::project(view_.eye, p).z() >= view_.eye.nearest; })) return {};
        if (!cut([&](const Vec3d& p) { return !isCut(p); })) return {};
        if (first > last) return {};
        const Vec2d along = pixelOf(at(last)) - pixelOf(at(first));
        for (int i = 0; i < 200; ++i) {
            const double middle = (first + last) / 2;
            (along.dot(pixel - pixelOf(at(middle))) > 0 ? first : last) = middle;
        }
        return at(first);
    }

    static bool windsAround(const Vec2d& p, const std::vector<Vec2d>& polygon)
    {
        int crossings = 0; // of the half line downwards
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            if ((a.x() <= p.x()) == (b.x() <= p.x())) continue;
            crossings += a.y() + (b.y() - a.y()) * (p.x() - a.x()) / (b.x() - a.x()) > p.y();
        }
        return crossings % 2 == 1;
    }

    const Elements& elements_;
    std::vector<Vec3d> points_;
    PickView view_;
    std::vector<Face> cage_, model_;
};

/// A cage and a model in it, as they are drawn.
struct Scene {
    Scene(const Mesh& cageMesh, const Mesh* modelMesh)
        : elements(cageMesh), frame(boundingBox(cageMesh)), cage(cageMesh, frame, 0)
    {
        for (const Vec3d& p : cageMesh.points) points.push_back(frame.toDrawing(p));
        if (modelMesh == nullptr) return;
        model.emplace(*modelMesh, frame, 30);
        occluder.emplace(*model);
    }
    const draw::Geometry* modelOrNull() const { return model ? &*model : nullptr; }
    const Occluder* occluderOrNull() const { return occluder ? &*occluder : nullptr; }

    Elements elements;
    draw::Frame frame;
    draw::Geometry cage;
    std::vector<Vec3d> points;
    std::optional<draw::Geometry> model;
    std::optional<Occluder> occluder;
};

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    bool chance(int share) { return engine_() % unsigned(share) == 0; }
    Vec3d unit()
    {
        for (;;) {
            const Vec3d v((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (v.length() < 1 && v.length() > 0.1) return v.unit();
        }
    }

private:
    std::mt19937 engine_;
};

/// From afar, near by and from within; perspective or not.
PickView someView(const Scene& scene, Random& random)
{
    PickView view;
    view.width = random(200, 1500);
    view.height = random(200, 1500);
    draw::Camera camera;
    camera.view = {random(-180, 180), random(-90, 90), random.chance(2) ? draw::UpAxis::y : draw::UpAxis::z};
    camera.projection = random.chance(2) ? draw::Projection::perspective : draw::Projection::orthographic;
    camera.target = random(0, 0.5) * random.unit();
    camera.distance = std::exp(random(-1.5, 2));
    view.eye = draw::eyeOf(camera, view.width / view.height, {&scene.cage.positions()});
    return view;
}

std::vector<Vec2d> boxOf(const Vec2d& a, const Vec2d& b)
{
    return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

std::vector<Vec2d> wholePanel(const PickView& view)
{
    return boxOf({0, 0}, {view.width, view.height});
}

PickView frontOf(const Scene& scene, double azimuth, double elevation, draw::Projection projection)
{
    PickView view;
    view.width = view.height = 500;
    const draw::PointSets seen{&scene.cage.positions()};
    view.eye = draw::eyeOf(draw::fit({azimuth, elevation, draw::UpAxis::y}, projection, seen, 1), 1, seen);
    return view;
}

} // namespace

BOOST_AUTO_TEST_SUITE(picking)

BOOST_AUTO_TEST_CASE(picks_are_those_of_looking_at_everything)
{
    struct Case {
        const char* model;
        int faces;
        CageFaces kind;
    };
    std::size_t picked[3] = {}, missed[3] = {}, lassoed[3] = {};
    unsigned seed = 0;
    for (const Case& c : {Case{"creature", 200, CageFaces::triangles}, Case{"botijo", 200, CageFaces::triquad},
                          Case{"bishop", 100, CageFaces::triangles}}) {
        auto& source = test::caged(c.model);
        const Mesh coarse = draw::standIn(source.model(), 1500).mesh;
        const Scene scene(source.cage(c.faces, c.kind), &coarse), alone(source.cage(c.faces, c.kind), nullptr);
        for (int run = 0; run < 334; ++run) {
            Random random(++seed);
            const Scene& shown = random.chance(3) ? alone : scene;
            PickView view = someView(shown, random);
            view.seeThrough = random.chance(5);
            if (random.chance(3)) view.section = draw::Section{random.unit(), random(-0.5, 0.5)};
            const Picking picking(shown.elements, shown.points, view, shown.occluderOrNull());
            const BruteForce expected(shown.elements, shown.points, view, shown.modelOrNull());
            const auto place = [&] { return Vec2d(random(0, view.width), random(0, view.height)); };
            for (int click = 0; click < 3; ++click) {
                const Vec2d pixel = place();
                const double radius = random(1, 40);
                for (const Element kind : test::elementKinds) {
                    const auto result = picking.at(kind, pixel.x(), pixel.y(), radius);
                    BOOST_TEST_CONTEXT("seed " << seed << ", " << elementsName(kind))
                    {
                        BOOST_CHECK(result == expected.at(kind, pixel, radius));
                    }
                    ++(result ? picked : missed)[int(kind)];
                }
            }
            std::vector<Vec2d> lasso;
            for (int corner = 0; corner < 7; ++corner) lasso.push_back(place());
            for (const auto& polygon : {boxOf(place(), place()), lasso}) {
                for (const Element kind : test::elementKinds) {
                    const auto result = picking.within(kind, polygon);
                    BOOST_TEST_CONTEXT("seed " << seed << ", " << elementsName(kind))
                    {
                        BOOST_TEST(result == expected.within(kind, polygon), boost::test_tools::per_element());
                    }
                    lassoed[int(kind)] += result.size();
                }
            }
        }
    }
    for (const int kind : {0, 1, 2}) { // the views show something, and hide something
        BOOST_TEST(picked[kind] > 100U);
        BOOST_TEST(missed[kind] > 100U);
        BOOST_TEST(lassoed[kind] > 1000U);
    }
}

BOOST_AUTO_TEST_CASE(of_a_convex_cage_what_has_a_face_towards_the_eye_is_seen)
{
    Mesh mesh = test::sphere({0, 0, 0}, 1, 5);
    for (Vec3d& p : mesh.points) p *= Vec3d(1, 2, 1.5);
    const Scene scene(mesh, nullptr);
    for (unsigned seed = 0; seed < 200; ++seed) {
        Random random(seed);
        PickView view = frontOf(scene, random(-180, 180), random(-80, 80),
                                seed % 2 == 0 ? draw::Projection::perspective : draw::Projection::orthographic);
        const Picking picking(scene.elements, scene.points, view);
        Selection facing{Element::face, {}};
        double edgewise = 1; // how close a face is to being seen from its side
        for (Index face = 0; face < scene.elements.count(Element::face); ++face) {
            const Ids corners = scene.elements.pointsOfFace(face);
            const Vec3d a = scene.points[corners[0]];
            const Vec3d normal = (scene.points[corners[1]] - a).cross(scene.points[corners[2]] - a).unit();
            const Vec3d towards =
                view.eye.projection == draw::Projection::perspective ? (view.eye.position - a).unit() : view.eye.back;
            edgewise = std::min(edgewise, std::abs(normal.dot(towards)));
            if (normal.dot(towards) > 0) facing.ids.push_back(face);
        }
        if (edgewise < 1e-4) continue;
        for (const Element kind : test::elementKinds) {
            std::vector<Index> seen = facing.ids; // an element with a face that is seen
            if (kind != Element::face) {
                seen.clear();
                for (Index id = 0; id < scene.elements.count(kind); ++id) {
                    const Ids own =
                        kind == Element::point ? scene.elements.facesOfPoint(id) : scene.elements.facesOfEdge(id);
                    const bool isSeen = std::any_of(own.begin(), own.end(), [&](Index face) {
                        return std::binary_search(facing.ids.begin(), facing.ids.end(), face);
                    });
                    if (isSeen) seen.push_back(id);
                }
            }
            BOOST_TEST(picking.within(kind, wholePanel(view)) == seen, boost::test_tools::per_element());
        }
        view.seeThrough = true;
        const Picking through(scene.elements, scene.points, view);
        for (const Element kind : test::elementKinds) {
            BOOST_TEST(through.within(kind, wholePanel(view)) == all(scene.elements, kind).ids,
                       boost::test_tools::per_element());
        }
    }
}

BOOST_AUTO_TEST_CASE(the_nearest_within_the_radius_is_picked)
{
    const Scene scene(test::box({0, 0, 0}, {1, 1, 1}), nullptr);
    const PickView view = frontOf(scene, 0, 0, draw::Projection::orthographic); // 4 points in front, 4 behind them
    const Picking picking(scene.elements, scene.points, view);
    const Vec3d corner = draw::project(view.eye, scene.points[7]); // (1, 1, 1): right, above, in front
    const double x = 250 * (1 + corner.x()), y = 250 * (1 - corner.y());
    BOOST_CHECK(picking.at(Element::point, x - 3, y + 4, 5.01) == 7U);
    BOOST_CHECK(!picking.at(Element::point, x - 3, y + 4, 4.99));
    BOOST_CHECK(picking.at(Element::edge, x - 3, y + 20, 5) == scene.elements.edgeBetween(5, 7));
    BOOST_CHECK(picking.at(Element::edge, x - 20, y + 3, 5) == scene.elements.edgeBetween(6, 7));
    BOOST_CHECK(picking.at(Element::face, x - 3, y + 4, 0) == 5U);
    BOOST_CHECK(!picking.at(Element::face, x + 3, y + 4, 100));
    BOOST_CHECK(!picking.at(Element::point, std::numeric_limits<double>::quiet_NaN(), y, 5));
    BOOST_TEST(picking.within(Element::point, {}).empty());
}

BOOST_AUTO_TEST_CASE(a_model_hides_and_a_section_opens)
{
    const Mesh inner = test::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8});
    const Scene scene(test::box({0, 0, 0}, {1, 1, 1}), &inner);
    PickView view = frontOf(scene, 0, 0, draw::Projection::orthographic);
    const auto faceInTheMiddle = [&](const Occluder* occluder) {
        return Picking(scene.elements, scene.points, view, occluder).at(Element::face, 250, 250, 0);
    };
    BOOST_CHECK(faceInTheMiddle(scene.occluderOrNull()) == 5U); // the front, z = 1
    view.section = draw::Section{{0, 0, -1}, -0.5};             // cuts off the cage's front, not the model's
    BOOST_CHECK(!faceInTheMiddle(scene.occluderOrNull()));
    BOOST_CHECK(faceInTheMiddle(nullptr) == 4U);
    view.section->offset = 0.5; // and now all of the model
    BOOST_CHECK(faceInTheMiddle(scene.occluderOrNull()) == 4U);
    const Picking behind(scene.elements, scene.points, view, scene.occluderOrNull());
    BOOST_TEST(behind.within(Element::point, wholePanel(view)) == (std::vector<Index>{0, 1, 2, 3}),
               boost::test_tools::per_element());
    view.seeThrough = true;
    view.section->offset = -0.5;
    BOOST_CHECK(faceInTheMiddle(scene.occluderOrNull()) == 4U);
}

BOOST_AUTO_TEST_CASE(points_must_fit_the_cage)
{
    const Scene scene(test::box({0, 0, 0}, {1, 1, 1}), nullptr);
    const PickView view = frontOf(scene, 0, 0, draw::Projection::perspective);
    auto points = scene.points;
    points[3].x() = std::numeric_limits<double>::infinity();
    BOOST_CHECK_THROW(Picking(scene.elements, points, view), InputError);
    points.pop_back();
    BOOST_CHECK_THROW(Picking(scene.elements, points, view), InputError);
}

BOOST_AUTO_TEST_CASE(any_soup_can_be_picked)
{
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Mesh mesh = test::randomFaces(seed);
        const Elements elements(mesh);
        Random random(seed);
        PickView view;
        view.width = view.height = 300;
        draw::Camera camera;
        camera.distance = random(0.1, 4);
        view.eye = draw::eyeOf(camera, 1, {});
        const Picking picking(elements, mesh.points, view);
        const BruteForce expected(elements, mesh.points, view, nullptr);
        for (const Element kind : test::elementKinds) {
            BOOST_TEST(picking.within(kind, wholePanel(view)) == expected.within(kind, wholePanel(view)),
                       boost::test_tools::per_element());
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
