// What data/README.md says of the models, checked on the files that the generator wrote.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <support/temporary_folder.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<int, 3>;
using Edge = std::pair<int, int>;

/// An OBJ file as the generator writes it, read by other code than the library's.
struct Model {
    explicit Model(const std::string& name)
    {
        std::istringstream file(vdbcage::test::readText(VDBCAGE_MODELS_DIR "/" + name + ".obj"));
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            std::string kind;
            words >> kind;
            if (kind == "v") {
                double x = 0;
                double y = 0;
                double z = 0;
                words >> x >> y >> z;
                points.emplace_back(x, y, z);
            } else if (kind == "f") {
                std::vector<int> face;
                for (int index = 0; words >> index;) face.push_back(index - 1);
                faces.push_back(face);
            }
            BOOST_TEST_REQUIRE((kind == "#" || words.eof()), name << ": " << line);
        }
        for (const auto& face : faces)
            for (std::size_t i = 1; i + 1 < face.size(); ++i) triangles.push_back({face[0], face[i], face[i + 1]});
    }

    const Point& at(int i) const { return points[static_cast<std::size_t>(i)]; }

    std::vector<Point> points;
    std::vector<std::vector<int>> faces;
    std::vector<Triangle> triangles; // quads split by the diagonal of corners 0 and 2
};

struct Topology {
    long boundaryEdges = 0;     // of one face
    long nonManifoldEdges = 0;  // of more than two
    long inconsistentEdges = 0; // run through twice in the same direction
    long nonManifoldPoints = 0; // whose faces make more than one fan
    long boundaryLoops = 0;
    long parts = 0; // connected by points
    long euler = 0;
    long unusedPoints = 0;

    bool closedManifold() const
    {
        return boundaryEdges == 0 && nonManifoldEdges == 0 && inconsistentEdges == 0 && nonManifoldPoints == 0;
    }
    /// Summed over all parts, of a closed manifold.
    long genus() const { return (2 * parts - euler) / 2; }
};

/// Disjoint sets of 0 .. n-1.
class Sets {
public:
    explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t(0)); }
    std::size_t find(std::size_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// True if the two were not in one set yet.
    bool join(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        parent_[a] = b;
        return a != b;
    }

private:
    std::vector<std::size_t> parent_;
};

Topology topologyOf(const Model& model)
{
    Topology result;
    std::map<Edge, std::vector<int>> directed; // faces by edge as they run through it
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const auto& face = model.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i)
            directed[{face[i], face[(i + 1) % face.size()]}].push_back(static_cast<int>(f));
    }
    std::set<int> used;
    std::set<Edge> edges;
    Sets parts(model.points.size());
    Sets loops(model.points.size());
    std::set<int> onBoundary;
    long joins = 0;
    long loopJoins = 0;
    for (const auto& [edge, faces] : directed) {
        edges.insert(std::minmax(edge.first, edge.second));
        used.insert({edge.first, edge.second});
        joins += parts.join(static_cast<std::size_t>(edge.first), static_cast<std::size_t>(edge.second));
        if (faces.size() > 1) ++result.inconsistentEdges;
        const auto back = directed.find({edge.second, edge.first});
        const std::size_t opposite = back == directed.end() ? 0 : back->second.size();
        if (faces.size() + opposite > 2 && (opposite == 0 || edge.first < edge.second)) ++result.nonManifoldEdges;
        if (faces.size() + opposite == 1) {
            ++result.boundaryEdges;
            onBoundary.insert({edge.first, edge.second});
            loopJoins += loops.join(static_cast<std::size_t>(edge.first), static_cast<std::size_t>(edge.second));
        }
    }
    result.parts = static_cast<long>(used.size()) - joins;
    result.boundaryLoops = static_cast<long>(onBoundary.size()) - loopJoins;
    result.unusedPoints = static_cast<long>(model.points.size() - used.size());
    result.euler =
        static_cast<long>(used.size()) - static_cast<long>(edges.size()) + static_cast<long>(model.faces.size());

    // The corners of the faces at a point, joined across the edges at that point.
    std::map<std::pair<int, int>, std::size_t> cornerOf; // by point and face
    std::map<int, long> fans;
    for (std::size_t f = 0; f < model.faces.size(); ++f)
        for (const int point : model.faces[f])
            if (cornerOf.emplace(std::pair(point, static_cast<int>(f)), cornerOf.size()).second) ++fans[point];
    Sets corners(cornerOf.size());
    for (const auto& [edge, faces] : directed) {
        const auto back = directed.find({edge.second, edge.first});
        if (back == directed.end() || edge.first > edge.second) continue;
        for (const int point : {edge.first, edge.second})
            for (const int a : faces)
                for (const int b : back->second)
                    fans[point] -= corners.join(cornerOf[{point, a}], cornerOf[{point, b}]);
    }
    for (const auto& fan : fans) result.nonManifoldPoints += fan.second > 1;
    return result;
}

bool degenerate(const Model& model, const Triangle& t)
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
           CGAL::collinear(model.at(t[0]), model.at(t[1]), model.at(t[2]));
}

long degenerateTriangles(const Model& model)
{
    return std::count_if(model.triangles.begin(), model.triangles.end(),
                         [&](const Triangle& t) { return degenerate(model, t); });
}

/// Do two triangles without degeneracy meet in more than the corners they share?
bool intersect(const Model& model, Triangle a, Triangle b)
{
    // Shared corners to the front, in the same order.
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
        const auto found = std::find(b.begin() + shared, b.end(), a[static_cast<std::size_t>(i)]);
        if (found == b.end()) continue;
        std::swap(*found, b[static_cast<std::size_t>(shared)]);
        std::swap(a[static_cast<std::size_t>(i)], a[static_cast<std::size_t>(shared)]);
        ++shared;
    }
    const auto triangle = [&](const Triangle& t) {
        return Kernel::Triangle_3(model.at(t[0]), model.at(t[1]), model.at(t[2]));
    };
    if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
    if (shared == 1) // then one's far edge meets the other
        return CGAL::do_intersect(triangle(a), Kernel::Segment_3(model.at(b[1]), model.at(b[2]))) ||
               CGAL::do_intersect(triangle(b), Kernel::Segment_3(model.at(a[1]), model.at(a[2])));
    if (shared == 2) // then one is folded onto the other
        return CGAL::coplanar(model.at(a[0]), model.at(a[1]), model.at(a[2]), model.at(b[2])) &&
               CGAL::coplanar_orientation(model.at(a[0]), model.at(a[1]), model.at(a[2]), model.at(b[2])) ==
                   CGAL::POSITIVE;
    return true;
}

/// Pairs of triangles that intersect; degenerate ones are left out. Sweeps along X over their boxes.
long selfIntersections(const Model& model)
{
    struct Box {
        std::array<double, 3> low, high;
        std::size_t triangle;
    };
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < model.triangles.size(); ++i) {
        const Triangle& t = model.triangles[i];
        if (degenerate(model, t)) continue;
        Box box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, i};
        for (const int corner : t) {
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t k = static_cast<std::size_t>(axis);
                box.low[k] = std::min(box.low[k], model.at(corner)[axis]);
                box.high[k] = std::max(box.high[k], model.at(corner)[axis]);
            }
        }
        boxes.push_back(box);
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.low[0] < b.low[0]; });
    long count = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low[0] <= boxes[i].high[0]; ++j) {
            const bool apart = boxes[i].high[1] < boxes[j].low[1] || boxes[j].high[1] < boxes[i].low[1] ||
                               boxes[i].high[2] < boxes[j].low[2] || boxes[j].high[2] < boxes[i].low[2];
            if (!apart)
                count += intersect(model, model.triangles[boxes[i].triangle], model.triangles[boxes[j].triangle]);
        }
    }
    return count;
}

double volume(const Model& model)
{
    double sum = 0;
    for (const Triangle& t : model.triangles)
        sum += CGAL::to_double(CGAL::volume(Point(0, 0, 0), model.at(t[0]), model.at(t[1]), model.at(t[2])));
    return sum;
}

/// Height above the ground and longest side of the box.
std::pair<double, double> groundAndSize(const Model& model)
{
    CGAL::Bbox_3 box;
    for (const Point& p : model.points) box += p.bbox();
    return {box.ymin(), std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()})};
}

std::size_t quads(const Model& model)
{
    return static_cast<std::size_t>(
        std::count_if(model.faces.begin(), model.faces.end(), [](const auto& face) { return face.size() == 4; }));
}

} // namespace

BOOST_AUTO_TEST_SUITE(data)

BOOST_AUTO_TEST_CASE(the_committed_files_are_what_the_generator_writes)
{
    int compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(VDBCAGE_SOURCE_DIR "/data")) {
        if (entry.path().extension() != ".obj") continue;
        const auto made = std::filesystem::path(VDBCAGE_MODELS_DIR) / entry.path().filename();
        BOOST_TEST((vdbcage::test::readText(entry.path()) == vdbcage::test::readText(made)), entry.path());
        ++compared;
    }
    BOOST_TEST(compared == 5);
}

BOOST_AUTO_TEST_CASE(bishop)
{
    const Model model("bishop");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() == 16310U);
    BOOST_TEST(topology.closedManifold());
    BOOST_TEST(topology.parts == 1);
    BOOST_TEST(topology.genus() == 0);
    BOOST_TEST(topology.unusedPoints == 0);
    BOOST_TEST(degenerateTriangles(model) == 0);
    BOOST_TEST(selfIntersections(model) == 0);
    BOOST_TEST(volume(model) > 0);
    BOOST_TEST(groundAndSize(model).first == 0);
    BOOST_TEST(std::fabs(groundAndSize(model).second - 7.84) < 0.01);

    // The slot goes to the middle of the head: the axis is free there, and not above and below.
    const auto onAxis = [&](double y) {
        long crossings = 0;
        const Kernel::Segment_3 ray(Point(0.0123, y, 0.0045), Point(0.0123, 100, 0.0045));
        for (const Triangle& t : model.triangles)
            crossings += CGAL::do_intersect(Kernel::Triangle_3(model.at(t[0]), model.at(t[1]), model.at(t[2])), ray);
        return crossings % 2 == 1;
    };
    BOOST_TEST(onAxis(6.0));
    BOOST_TEST(!onAxis(6.27));
    BOOST_TEST(onAxis(6.6));
}

BOOST_AUTO_TEST_CASE(bench)
{
    const Model model("bench");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() == 130812U);
    BOOST_TEST(quads(model) == model.faces.size());
    BOOST_TEST(topology.closedManifold());
    BOOST_TEST(topology.parts == 75);
    BOOST_TEST(topology.genus() == 0);
    BOOST_TEST(degenerateTriangles(model) == 0);
    BOOST_TEST(selfIntersections(model) > 1000); // the parts run through each other
    BOOST_TEST(volume(model) > 0);
    BOOST_TEST(groundAndSize(model).first == 0);
    BOOST_TEST(groundAndSize(model).second == 150);
}

BOOST_AUTO_TEST_CASE(botijo)
{
    const Model model("botijo");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() > 10000U);
    BOOST_TEST(model.triangles.size() < 25000U);
    BOOST_TEST(topology.closedManifold());
    BOOST_TEST(topology.parts == 1);
    BOOST_TEST(topology.genus() == 5);
    BOOST_TEST(topology.unusedPoints == 0);
    BOOST_TEST(degenerateTriangles(model) == 0);
    BOOST_TEST(selfIntersections(model) == 0);
    BOOST_TEST(volume(model) > 0);
}

BOOST_AUTO_TEST_CASE(creature)
{
    const Model model("creature");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() > 20000U);
    BOOST_TEST(model.triangles.size() < 50000U);
    BOOST_TEST(quads(model) == model.faces.size());
    BOOST_TEST(topology.closedManifold());
    BOOST_TEST(topology.parts == 1);
    BOOST_TEST(topology.genus() == 0);
    BOOST_TEST(topology.unusedPoints == 0);
    BOOST_TEST(degenerateTriangles(model) == 0);
    BOOST_TEST(selfIntersections(model) == 0);
    BOOST_TEST(volume(model) > 0);
    // No slivers: in each triangle the height is more than a sixth of the longest side.
    long slivers = 0;
    for (const Triangle& t : model.triangles) {
        const double longest = std::max({CGAL::squared_distance(model.at(t[0]), model.at(t[1])),
                                         CGAL::squared_distance(model.at(t[1]), model.at(t[2])),
                                         CGAL::squared_distance(model.at(t[2]), model.at(t[0]))});
        const double area = std::sqrt(CGAL::squared_area(model.at(t[0]), model.at(t[1]), model.at(t[2])));
        slivers += 2 * area < longest / 6;
    }
    BOOST_TEST(slivers == 0);
}

BOOST_AUTO_TEST_CASE(open_shell)
{
    const Model model("open_shell");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() > 2000U);
    BOOST_TEST(model.triangles.size() < 8000U);
    BOOST_TEST(topology.parts == 1);
    BOOST_TEST(topology.boundaryLoops == 3); // the rim, and a slit for each arm
    BOOST_TEST(topology.euler == -1);        // a disc with two holes
    BOOST_TEST(topology.nonManifoldEdges == 0);
    BOOST_TEST(topology.inconsistentEdges == 0);
    BOOST_TEST(topology.nonManifoldPoints == 0);
    BOOST_TEST(topology.unusedPoints == 0);
    BOOST_TEST(degenerateTriangles(model) == 0);
    BOOST_TEST(selfIntersections(model) == 0);
}

BOOST_AUTO_TEST_CASE(soup_has_every_fault)
{
    const Model model("soup");
    const Topology topology = topologyOf(model);
    BOOST_TEST(model.triangles.size() > 500U);
    BOOST_TEST(model.triangles.size() < 5000U);
    BOOST_TEST(topology.parts > 10);
    BOOST_TEST(topology.boundaryEdges > 10);
    BOOST_TEST(topology.nonManifoldEdges > 10);
    BOOST_TEST(topology.inconsistentEdges > 10);
    BOOST_TEST(topology.unusedPoints > 10);
    BOOST_TEST(selfIntersections(model) > 1000);
    long repeated = 0; // a corner twice
    long flat = 0;     // corners of their own, but no area
    std::map<std::vector<int>, int> copies;
    for (const Triangle& t : model.triangles) {
        const std::set<int> corners(t.begin(), t.end());
        repeated += corners.size() < 3;
        flat += corners.size() == 3 && degenerate(model, t);
    }
    for (auto face : model.faces) {
        std::sort(face.begin(), face.end());
        ++copies[face];
    }
    BOOST_TEST(repeated > 10);
    BOOST_TEST(flat > 10);
    BOOST_TEST(std::count_if(copies.begin(), copies.end(), [](const auto& c) { return c.second > 1; }) > 10);
    BOOST_TEST(groundAndSize(model).second < 30); // one heap
}

BOOST_AUTO_TEST_SUITE_END()
