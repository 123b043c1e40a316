#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <set>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <support/shapes.h>
#include <support/topology_count.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/held_by.h>

using namespace vdbcage;

// A reference that constructs the intersections with exact numbers and looks at them, for every pair.
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Index = openvdb::Index32;
using Face = std::vector<Index>;
using Edge = std::pair<Index, Index>;

Point at(const Mesh& mesh, Index i)
{
    return {mesh.points[i][0], mesh.points[i][1], mesh.points[i][2]};
}

Kernel::Triangle_3 triangle(const Mesh& mesh, const Face& t)
{
    return {at(mesh, t[0]), at(mesh, t[1]), at(mesh, t[2])};
}

bool isDegenerate(const Mesh& mesh, const Face& t)
{
    return triangle(mesh, t).is_degenerate();
}

std::vector<Face> trianglesOf(const Face& f)
{
    if (f.size() == 3) return {f};
    return {{f[0], f[1], f[2]}, {f[0], f[2], f[3]}, {f[0], f[1], f[3]}, {f[1], f[2], f[3]}};
}

std::set<Edge> edgesOf(const Face& f)
{
    std::set<Edge> edges;
    for (std::size_t i = 0; i < f.size(); ++i) edges.insert(std::minmax(f[i], f[(i + 1) % f.size()]));
    return edges;
}

bool sameSegment(const Kernel::Segment_3& s, const Point& a, const Point& b)
{
    return (s.source() == a && s.target() == b) || (s.source() == b && s.target() == a);
}

// The intersection of the triangles is not made up of the corners and edges that the faces have in common.
bool collide(const Mesh& mesh, const Face& f, const Face& g, const Face& s, const Face& t)
{
    const auto meet = CGAL::intersection(triangle(mesh, s), triangle(mesh, t));
    if (!meet) return false;
    if (const Point* p = detail::heldBy<Point>(*meet)) {
        return std::none_of(s.begin(), s.end(),
                            [&](Index i) { return at(mesh, i) == *p && std::find(t.begin(), t.end(), i) != t.end(); });
    }
    if (const auto* segment = detail::heldBy<Kernel::Segment_3>(*meet)) {
        const std::set<Edge> ofF = edgesOf(f), ofG = edgesOf(g), ofS = edgesOf(s), ofT = edgesOf(t);
        for (const Edge& edge : ofF) {
            if (ofG.count(edge) && ofS.count(edge) && ofT.count(edge) &&
                sameSegment(*segment, at(mesh, edge.first), at(mesh, edge.second))) {
                return false;
            }
        }
    }
    return true;
}

bool isFolded(const Mesh& mesh, const Face& quad)
{
    const std::vector<Face> parts = trianglesOf(quad);
    for (const std::size_t first : {0U, 2U}) {
        const auto meet = CGAL::intersection(triangle(mesh, parts[first]), triangle(mesh, parts[first + 1]));
        if (!meet || !detail::heldBy<Kernel::Segment_3>(*meet)) return true; // more than the diagonal
    }
    return false;
}

struct Shape { // a triangle, segment or point
    Shape(const Mesh& mesh, const Face& t) : corners{at(mesh, t[0]), at(mesh, t[1]), at(mesh, t[2])}
    {
        std::sort(corners.begin(), corners.end());
        if (corners[0] == corners[2])
            dimension = 0;
        else if (CGAL::collinear(corners[0], corners[1], corners[2]))
            dimension = 1;
    }
    template <typename Other>
    bool meets(const Other& other) const
    {
        if (dimension == 0) return other.meets(corners[0]);
        if (dimension == 1) return other.meets(Kernel::Segment_3(corners[0], corners[2]));
        return other.meets(Kernel::Triangle_3(corners[0], corners[1], corners[2]));
    }
    std::vector<Point> corners;
    int dimension = 2;
};

template <typename A>
struct Against {
    template <typename B>
    bool meets(const B& b) const
    {
        return CGAL::do_intersect(a, b);
    }
    bool meets(const Point& b) const { return has(a, b); }
    static bool has(const Point& x, const Point& p) { return x == p; }
    template <typename X>
    static bool has(const X& x, const Point& p)
    {
        return x.has_on(p);
    }
    A a;
};
template <>
template <typename B>
bool Against<Point>::meets(const B& b) const
{
    return has(b, a);
}

struct Second {
    const Shape& shape;
    template <typename A>
    bool meets(const A& a) const
    {
        return shape.meets(Against<A>{a});
    }
};

bool shapesMeet(const Shape& a, const Shape& b)
{
    return a.meets(Second{b});
}

// By a segment to a far point; another one if it meets an edge.
int winding(const Mesh& mesh, const std::vector<Face>& triangles, const Point& p)
{
    for (int attempt = 0;; ++attempt) {
        const Point far = p + Kernel::Vector_3(1000003 + 7919 * attempt, 17 + 31 * attempt, 101 - 13 * attempt);
        int sum = 0;
        bool clean = true;
        for (const Face& t : triangles) {
            const Point a = at(mesh, t[0]), b = at(mesh, t[1]), c = at(mesh, t[2]);
            const int from = CGAL::orientation(a, b, c, p), to = CGAL::orientation(a, b, c, far);
            const int x = CGAL::orientation(p, far, a, b), y = CGAL::orientation(p, far, b, c),
                      z = CGAL::orientation(p, far, c, a);
            if (from * to < 0 && x == y && y == z && x != 0) sum += to;
            const bool within = (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
            if (within && (x == 0 || y == 0 || z == 0)) clean = false;
        }
        if (clean) return sum;
    }
}

struct Expected {
    std::size_t degenerate = 0, self = 0, contact = 0, outside = 0, between = 0;
    std::set<std::uint32_t> bad;
};

Expected reference(const Mesh& cage, const Mesh& model)
{
    Expected result;
    const auto faces = test::polygons(cage);
    std::vector<Shape> modelShapes;
    std::set<Index> modelVertices;
    for (const Face& f : test::polygons(model)) {
        for (const Face& t : trianglesOf(f)) modelShapes.emplace_back(model, t);
        modelVertices.insert(f.begin(), f.end());
    }
    std::vector<Face> firstDiagonals, all;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        const std::vector<Face> parts = trianglesOf(faces[i]);
        firstDiagonals.insert(firstDiagonals.end(), parts.begin(), parts.begin() + (parts.size() + 1) / 2);
        all.insert(all.end(), parts.begin(), parts.end());
        const auto flat = [&](const Face& t) { return isDegenerate(cage, t); };
        if (std::any_of(parts.begin(), parts.end(), flat)) {
            ++result.degenerate;
            result.bad.insert(i);
        } else if (faces[i].size() == 4 && isFolded(cage, faces[i])) {
            ++result.self;
            result.bad.insert(i);
        }
        if (std::any_of(parts.begin(), parts.end(), [&](const Face& t) {
                const Shape shape(cage, t);
                return std::any_of(modelShapes.begin(), modelShapes.end(),
                                   [&](const Shape& other) { return shapesMeet(shape, other); });
            })) {
            ++result.contact;
            result.bad.insert(i);
        }
        for (std::uint32_t k = i + 1; k < faces.size(); ++k) {
            bool pair = false;
            for (const Face& s : parts) {
                for (const Face& t : trianglesOf(faces[k])) {
                    pair = pair || (!flat(s) && !flat(t) && collide(cage, faces[i], faces[k], s, t));
                }
            }
            if (!pair) continue;
            ++result.self;
            result.bad.insert({i, k});
        }
    }
    const bool cycle = test::countTopology(cage).openEdges == 0;
    for (const Index v : modelVertices) {
        const Point p = at(model, v);
        const bool on = std::any_of(all.begin(), all.end(), [&](const Face& t) {
            return shapesMeet(Shape(cage, t), Shape(model, {v, v, v}));
        });
        bool between = false;
        for (std::uint32_t i = 0; cycle && !on && i < faces.size(); ++i) {
            if (faces[i].size() == 3) continue;
            const Kernel::Tetrahedron_3 tetrahedron(at(cage, faces[i][0]), at(cage, faces[i][1]), at(cage, faces[i][2]),
                                                    at(cage, faces[i][3]));
            if (tetrahedron.is_degenerate() || !tetrahedron.has_on_bounded_side(p)) continue;
            between = true;
            result.bad.insert(i);
        }
        if (between) ++result.between;
        if (on || between || !cycle || winding(cage, firstDiagonals, p) != 1) ++result.outside;
    }
    return result;
}

// Small whole coordinates: most of the special cases there are come up all the time.
struct Random {
    explicit Random(unsigned seed) : engine(seed) {}
    unsigned below(unsigned n) { return static_cast<unsigned>(engine() % n); }
    openvdb::Vec3d lattice(unsigned n) { return openvdb::Vec3d(below(n), below(n), below(n)); }
    Mesh soup(unsigned points, unsigned faces, unsigned side)
    {
        Mesh mesh;
        for (unsigned i = 0; i < points; ++i) mesh.points.push_back(lattice(side));
        for (unsigned i = 0; i < faces; ++i) {
            if (below(3))
                mesh.triangles.emplace_back(below(points), below(points), below(points));
            else
                mesh.quads.emplace_back(below(points), below(points), below(points), below(points));
        }
        return mesh;
    }
    // A closed surface with its points moved to near lattice places; quads of it split at random.
    Mesh surface(double size, unsigned shake)
    {
        Mesh whole = below(2) ? test::sphere({}, 1, 3 + static_cast<int>(below(2)))
                              : (below(2) ? test::box({-1, -1, -1}, {1, 1, 1}) : test::torus(1, 0.5, 4, 3));
        Mesh mesh{{}, whole.triangles, {}};
        for (const openvdb::Vec3d& p : whole.points) {
            openvdb::Vec3d q;
            for (int i = 0; i < 3; ++i) q[i] = std::round(p[i] * size) + (below(3) ? 0.0 : below(shake + 1));
            mesh.points.push_back(q);
        }
        for (const openvdb::Vec4I& q : whole.quads) {
            if (below(2)) {
                mesh.quads.push_back(q);
            } else {
                mesh.triangles.emplace_back(q[0], q[1], q[2]);
                mesh.triangles.emplace_back(q[0], q[2], q[3]);
            }
        }
        return mesh;
    }
    std::mt19937 engine;
};

// How often each thing came up, to see that the cases are worth their while.
struct Seen {
    int degenerate = 0, self = 0, contact = 0, outside = 0, between = 0, bounding = 0;
};

void compare(const Mesh& cage, const Mesh& model, Seen& seen)
{
    CheckOptions options;
    options.measure = false;
    const CageCheck result = checkCage(cage, model, options);
    const Expected expected = reference(cage, model);
    BOOST_TEST(result.degenerateFaces == expected.degenerate);
    BOOST_TEST(result.selfIntersections == expected.self);
    BOOST_TEST(result.contactFaces == expected.contact);
    BOOST_TEST(result.modelVerticesOutside == expected.outside);
    BOOST_TEST(result.badFaces == std::vector<std::uint32_t>(expected.bad.begin(), expected.bad.end()),
               boost::test_tools::per_element());
    seen.degenerate += expected.degenerate > 0;
    seen.self += expected.self > 0;
    seen.contact += expected.contact > 0;
    seen.outside += expected.outside > 0;
    seen.between += expected.between > 0;
    seen.bounding += result.bounding();
}

} // namespace

BOOST_AUTO_TEST_SUITE(check_random, *boost::unit_test::label("property"))

BOOST_AUTO_TEST_CASE(soups_agree_with_exact_constructions)
{
    Seen seen;
    for (unsigned seed = 0; seed < 150; ++seed) {
        Random random(seed);
        const Mesh cage = random.soup(6 + random.below(5), 2 + random.below(6), 3 + random.below(3));
        const Mesh model = random.soup(5, 1 + random.below(3), 3 + random.below(3));
        BOOST_TEST_CONTEXT("seed " << seed)
        {
            compare(cage, model, seen);
        }
    }
    BOOST_TEST(seen.degenerate > 20);
    BOOST_TEST(seen.self > 50);
    BOOST_TEST(seen.contact > 50);
}

BOOST_AUTO_TEST_CASE(surfaces_agree_with_exact_constructions)
{
    Seen seen;
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(1000 + seed);
        const Mesh cage = random.surface(4, random.below(4));
        Mesh model;
        switch (random.below(3)) {
        case 0:
            model = random.soup(4, 2, 4);
            break;
        case 1:
            model = random.surface(2, 1);
            break;
        default: // points all over the place
            for (unsigned i = 0; i < 12; ++i) {
                model.points.push_back(random.lattice(16) - openvdb::Vec3d(7));
                model.triangles.emplace_back(i, i, i);
            }
        }
        const openvdb::Vec3d move = random.below(3) ? openvdb::Vec3d(-1, 0, 1) : openvdb::Vec3d(0.5, 0.25, 0.125);
        model = test::transformed(model, random.below(2) ? 0.5 : 1, move);
        BOOST_TEST_CONTEXT("seed " << seed)
        {
            compare(cage, model, seen);
        }
    }
    BOOST_TEST(seen.self > 10);
    BOOST_TEST(seen.contact > 20);
    BOOST_TEST(seen.outside > 20);
    BOOST_TEST(seen.bounding > 3);
    BOOST_TEST(seen.between > 3);
}

BOOST_AUTO_TEST_SUITE_END()
