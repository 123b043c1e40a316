// writeMoved() in the format of the original: random files are made of pieces, of which some are coordinates, so that
// the bytes of the moved file are known without a parser.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

#include <mesh/mesh_samples.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using namespace vdbcage::test;
using detail::numberText;
using openvdb::Vec3d;

namespace {

using Points = std::vector<Vec3d>;

bool same(double a, double b)
{
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool same(const Vec3d& a, const Vec3d& b)
{
    return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

bool same(const Points& a, const Points& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Vec3d& p, const Vec3d& q) { return same(p, q); });
}

std::string movedBytes(const std::string& bytes, const std::string& extension, const Points& points)
{
    const TemporaryFolder folder;
    writeText(folder / ("a" + extension), bytes);
    std::ostringstream out;
    writeMoved(folder / ("a" + extension), points, out, folder / ("b" + extension));
    return out.str();
}

Points pointsOf(const std::string& bytes, const std::string& extension)
{
    return detail::parseMesh(bytes, "a" + extension).mesh.points;
}

Mesh meshOf(const std::string& bytes, const std::string& extension)
{
    return detail::parseMesh(bytes, "a" + extension).mesh;
}

class Random {
public:
    explicit Random(unsigned seed) : bits_(seed) {}
    int below(int count) { return static_cast<int>(bits_() % static_cast<unsigned>(count)); }
    bool maybe() { return below(2) == 0; }
    double number() { return std::uniform_real_distribution<double>(-1000, 1000)(bits_); }
    template <typename List>
    auto one(const List& list)
    {
        return *(std::begin(list) + below(static_cast<int>(std::size(list))));
    }
    template <typename List>
    void shuffle(List& list)
    {
        std::shuffle(list.begin(), list.end(), bits_);
    }
    std::string bytes(int count)
    {
        std::string all;
        while (count-- > 0) all += static_cast<char>(below(256));
        return all;
    }

private:
    std::mt19937 bits_;
};

enum class Number { text, floatText, little, littleFloat, big, bigFloat };

std::string written(Number number, double value)
{
    switch (number) {
    case Number::text:
        return numberText(value);
    case Number::floatText:
        return numberText(double(float(value)));
    case Number::little:
        return littleEndian(value);
    case Number::littleFloat:
        return littleEndian(float(value));
    case Number::big:
        return bigEndian(value);
    default:
        return bigEndian(float(value));
    }
}

constexpr int none = -1;

/// A piece of a file: any text, a coordinate of a point, or a coordinate of the normal of a facet.
struct Piece {
    std::string text;
    int point = none, axis = 0;
    Number number = Number::text;
    int facet = none;
};

struct File {
    std::string extension;
    std::vector<Piece> pieces;
    Points points;                      ///< as readMesh() finds them
    std::array<bool, 3> isFloat{};      ///< whether x, y and z are floats
    std::vector<openvdb::Vec3I> facets; // of an STL

    void add(const std::string& text) { pieces.push_back({text}); }
    void addCoordinate(const std::string& text, int point, int axis, Number number)
    {
        pieces.push_back({text, point, axis, number});
    }
    std::string bytes() const
    {
        std::string all;
        for (const Piece& piece : pieces) all += piece.text;
        return all;
    }
    bool moves(int facet, const Points& to) const
    {
        const openvdb::Vec3I& corners = facets[std::size_t(facet)];
        return !same(to[corners[0]], points[corners[0]]) || !same(to[corners[1]], points[corners[1]]) ||
               !same(to[corners[2]], points[corners[2]]);
    }
    Vec3d normal(int facet, const Points& to) const
    {
        std::array<Vec3d, 3> p;
        for (int i = 0; i < 3; ++i) p[std::size_t(i)] = Vec3d(openvdb::Vec3s(to[facets[std::size_t(facet)][i]]));
        const Vec3d area = (p[1] - p[0]).cross(p[2] - p[0]);
        return area.length() > 0 ? area / area.length() : area;
    }
    std::string moved(const Points& to) const
    {
        std::string all;
        for (const Piece& piece : pieces) {
            if (piece.facet != none && moves(piece.facet, to)) {
                all += written(piece.number, normal(piece.facet, to)[piece.axis]);
            } else if (piece.point != none &&
                       !same(to[std::size_t(piece.point)][piece.axis], points[std::size_t(piece.point)][piece.axis])) {
                all += written(piece.number, to[std::size_t(piece.point)][piece.axis]);
            } else {
                all += piece.text;
            }
        }
        return all;
    }
};

/// A number in one of many forms, and its value.
std::pair<std::string, double> spelled(Random& random, bool oddForms = true)
{
    const double value = (random.below(8000) - 4000) / 8.0, tenfold = 10 * value;
    switch (random.below(oddForms ? 7 : 5)) {
    case 0:
        return {(value >= 0 ? "+" : "") + numberText(value), value};
    case 1:
        return {numberText(tenfold) + "e-1", value};
    case 2:
        return {numberText(tenfold) + "E-001", value};
    case 3:
        return {numberText(value) + (std::fmod(value, 1) != 0 ? "000" : ".00"), value};
    case 4: {
        const double any = random.number();
        return {numberText(any), any};
    }
    case 5:
        return {numberText(tenfold) + "d-1", value};
    default:
        return {numberText(tenfold) + "-e1", value};
    }
}

std::string blanks(Random& random)
{
    return random.one(std::array<const char*, 4>{" ", "  ", "\t", " \t "});
}

/// Corners of triangles, the first with different points.
std::vector<openvdb::Vec3I> randomTriangles(Random& random, int points)
{
    std::vector<openvdb::Vec3I> triangles{{0, 1, 2}};
    for (int i = random.below(6); i > 0; --i) {
        const auto corner = [&] { return openvdb::Index32(random.below(points)); };
        triangles.emplace_back(corner(), corner(), corner());
    }
    return triangles;
}

struct Property {
    std::string type, name;
    bool isList = false;
};

File randomPly(Random& random)
{
    const bool isAscii = random.maybe(), isBig = !isAscii && random.maybe();
    const std::string end = random.one(std::array<const char*, 3>{"\n", "\r\n", "\r"});
    const auto binary = [&](auto value) { return isBig ? bigEndian(value) : littleEndian(value); };
    File file;
    file.extension = ".ply";
    const int pointCount = 3 + random.below(5);
    const std::vector<openvdb::Vec3I> triangles = randomTriangles(random, pointCount);

    const auto valueOf = [&](const std::string& type, int value) -> std::string {
        if (isAscii) return std::to_string(value);
        if (type == "char" || type == "uint8") return binary(std::int8_t(value));
        if (type == "short" || type == "uint16") return binary(std::int16_t(value));
        if (type == "int" || type == "uint32") return binary(std::int32_t(value));
        if (type == "int64") return binary(std::int64_t(value));
        return type == "float" ? binary(float(value)) : binary(double(value));
    };
    const std::array<const char*, 9> types{"char",   "uint8", "short", "uint16", "int",
                                           "uint32", "int64", "float", "double"};
    const auto someProperties = [&] {
        std::vector<Property> list;
        const std::array<const char*, 6> names{"nx", "ny", "nz", "red", "xx", "Z"};
        for (const char* name : names) {
            if (random.below(3) == 0) list.push_back({random.one(types), name, random.below(4) == 0});
        }
        return list;
    };
    std::vector<Property> ofPoints = someProperties(), ofFaces = someProperties(), ofOthers = someProperties();
    if (ofOthers.empty()) ofOthers.push_back({"int", "x"});
    for (int axis = 0; axis < 3; ++axis) {
        const bool isFloat = random.maybe();
        file.isFloat[std::size_t(axis)] = isFloat;
        ofPoints.push_back({isFloat ? random.one(std::array<const char*, 2>{"float", "float32"}) : "double",
                            std::string(1, char('x' + axis))});
    }
    random.shuffle(ofPoints);
    const std::string indices = random.one(std::array<const char*, 2>{"vertex_indices", "vertex_index"});
    ofFaces.push_back({random.one(std::array<const char*, 3>{"int", "uint32", "short"}), indices, true});
    random.shuffle(ofFaces);
    const int otherCount = random.below(4);

    std::array<int, 3> order{0, 1, 2}; // vertex, face, other
    random.shuffle(order);
    const std::array<const std::vector<Property>*, 3> properties{&ofPoints, &ofFaces, &ofOthers};
    const std::array<const char*, 3> names{"vertex", "face", "edge"};
    const std::array<int, 3> counts{pointCount, int(triangles.size()), otherCount};
    file.add("ply" + end + "format " +
             (isAscii ? "ascii"
              : isBig ? "binary_big_endian"
                      : "binary_little_endian") +
             " 1.0" + end + "comment x 1 2 3" + end);
    for (const int i : order) {
        const auto e = std::size_t(i);
        file.add("element " + std::string(names[e]) + " " + std::to_string(counts[e]) + end);
        for (const Property& property : *properties[e]) {
            file.add("property " + std::string(property.isList ? "list uint8 " : "") + property.type + " " +
                     property.name + end);
        }
        if (random.maybe()) file.add("obj_info a  b " + end);
    }
    file.add("end_header" + end);

    const auto addValues = [&](const std::string& type, const std::vector<int>& values) {
        for (const int value : values) file.add((isAscii ? blanks(random) : "") + valueOf(type, value));
    };
    const auto addPoint = [&](const Property& property, int i) {
        const int axis = property.name[0] - 'x';
        const bool isFloat = file.isFloat[std::size_t(axis)];
        const auto [text, value] = spelled(random);
        double& coordinate = file.points[std::size_t(i)][axis];
        if (isAscii) {
            coordinate = value;
            file.add(blanks(random));
            file.addCoordinate(text, i, axis, isFloat ? Number::floatText : Number::text);
        } else {
            coordinate = isFloat ? double(float(value)) : value;
            const Number number = isBig     ? isFloat ? Number::bigFloat : Number::big
                                  : isFloat ? Number::littleFloat
                                            : Number::little;
            file.addCoordinate(written(number, value), i, axis, number);
        }
    };
    file.points.resize(std::size_t(pointCount));
    for (const int e : order) {
        for (int i = 0; i < counts[std::size_t(e)]; ++i) {
            for (const Property& property : *properties[std::size_t(e)]) {
                std::vector<int> values{random.below(100)};
                if (property.name == indices) {
                    const openvdb::Vec3I& t = triangles[std::size_t(i)];
                    values = {int(t[0]), int(t[1]), int(t[2])};
                } else if (e == 0 && !property.isList && property.name.size() == 1 && property.name != "Z") {
                    addPoint(property, i);
                    continue;
                } else if (property.isList) {
                    values.assign(std::size_t(random.below(4)), 7);
                }
                if (property.isList) addValues("uint8", {int(values.size())});
                addValues(property.type, values);
            }
            if (isAscii) file.add(random.below(8) == 0 ? end + " " + end : end);
        }
    }
    if (random.below(4) == 0) file.add(isAscii ? end + " " : std::string(3, '\0'));
    return file;
}

File randomOff(Random& random)
{
    const std::string end = random.one(std::array<const char*, 3>{"\n", "\r\n", "\r"});
    const auto comment = [&] { return random.below(4) == 0 ? "# 1 2 3 of x" + end : ""; };
    File file;
    file.extension = ".off";
    const int count = 3 + random.below(5);
    const std::vector<openvdb::Vec3I> triangles = randomTriangles(random, count);
    const std::string counts =
        std::to_string(count) + " " + std::to_string(triangles.size()) + (random.maybe() ? " 0" : "");
    const std::string header = random.one(std::array<const char*, 6>{"OFF", "COFF", "NOFF", "STOFF", "NCOFF", ""});
    file.add(comment() + header + (random.maybe() || header.empty() ? end : " ") + comment());
    if (!header.empty() && file.bytes().back() == end.back() && random.maybe()) file.add(comment());
    file.add(counts + end + comment());
    file.points.resize(std::size_t(count));
    for (int i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto [text, value] = spelled(random);
            file.points[std::size_t(i)][axis] = value;
            file.add(random.below(6) == 0 ? end : blanks(random));
            file.addCoordinate(text, i, axis, Number::text);
        }
        file.add((random.maybe() ? " 0 255 0 # green" : "") + end + comment());
    }
    for (const openvdb::Vec3I& t : triangles) {
        file.add("3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + "  " + std::to_string(t[2]) +
                 (random.maybe() ? " 7" : "") + end);
    }
    return file;
}

File randomObj(Random& random)
{
    const std::string end = random.one(std::array<const char*, 3>{"\n", "\r\n", "\r"});
    File file;
    file.extension = ".obj";
    const int count = 3 + random.below(5);
    file.points.resize(std::size_t(count));
    for (int i = 0; i < count; ++i) {
        file.add("v");
        for (int axis = 0; axis < 3; ++axis) {
            const auto [text, value] = spelled(random);
            file.points[std::size_t(i)][axis] = value;
            file.add(random.below(6) == 0 ? " \\" + end + "\t" : blanks(random));
            file.addCoordinate(text, i, axis, Number::text);
        }
        file.add((random.maybe() ? " 1 0.5 0" : "") + end + (random.maybe() ? "vt 0 1" + end : "# v 1 2 3" + end));
    }
    for (const openvdb::Vec3I& t : randomTriangles(random, count)) {
        file.add("f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + "  " + std::to_string(t[2] + 1) +
                 end);
    }
    return file;
}

/// Triangles of points that are used, in the order of their first use, as the reader numbers them.
std::vector<openvdb::Vec3I> randomFacets(Random& random, int& points)
{
    std::vector<openvdb::Vec3I> facets{{0, 1, 2}};
    points = 3;
    for (int i = random.below(6); i > 0; --i) {
        openvdb::Vec3I facet;
        for (int corner = 0; corner < 3; ++corner) {
            facet[corner] = openvdb::Index32(random.below(points + 1));
            points = std::max(points, int(facet[corner]) + 1);
        }
        facets.push_back(facet);
    }
    return facets;
}

File randomAsciiStl(Random& random)
{
    const std::string end = random.one(std::array<const char*, 3>{"\n", "\r\n", "\r"});
    const bool isLarge = random.maybe();
    const auto word = [&](std::string text) {
        if (isLarge)
            std::transform(text.begin(), text.end(), text.begin(), [](char c) { return char(std::toupper(c)); });
        return text;
    };
    File file;
    file.extension = ".stl";
    file.isFloat = {true, true, true};
    int count = 0;
    file.facets = randomFacets(random, count);
    std::vector<std::array<std::array<std::string, 2>, 3>> texts; // two forms of each coordinate
    for (int i = 0; i < count; ++i) {
        texts.emplace_back();
        file.points.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
            const auto [text, value] = spelled(random);
            file.points.back()[axis] = value;
            texts.back()[std::size_t(axis)] = {text, numberText(value)};
        }
    }
    file.add(word("solid") + " vertex 1 2 3" + end);
    for (int f = 0; f < int(file.facets.size()); ++f) {
        if (random.below(4) == 0) file.add("# colour 1 2 3" + end);
        if (f > 0 && random.below(4) == 0) file.add(word("endsolid") + " a" + end + word("solid") + end);
        file.add("  " + word("facet normal"));
        for (int axis = 0; axis < 3; ++axis) {
            file.add(blanks(random));
            Piece piece{random.one(std::array<const char*, 4>{"nan", "-0", "1e0", "oops"})};
            piece.axis = axis;
            piece.facet = f;
            piece.number = Number::floatText;
            file.pieces.push_back(piece);
        }
        file.add(end + "\t" + word("outer loop") + end);
        for (int corner = 0; corner < 3; ++corner) {
            const int point = int(file.facets[std::size_t(f)][corner]);
            file.add(word("vertex"));
            for (int axis = 0; axis < 3; ++axis) {
                file.add(blanks(random));
                const std::string text = random.one(texts[std::size_t(point)][std::size_t(axis)]);
                file.addCoordinate(text, point, axis, Number::floatText);
            }
            file.add(end);
        }
        file.add(word("endloop") + " " + word("endfacet") + end);
    }
    file.add(word("endsolid") + " v" + end);
    return file;
}

File randomBinaryStl(Random& random)
{
    File file;
    file.extension = ".stl";
    file.isFloat = {true, true, true};
    int count = 0;
    file.facets = randomFacets(random, count);
    for (int i = 0; i < count; ++i) {
        const auto value = [&] { return double(float(random.number())); };
        const double x = value(), y = value(), z = value();
        file.points.emplace_back(x, y, z);
    }
    file.add((random.maybe() ? "solid" : "\xFF\xFE") + random.bytes(75));
    if (file.pieces.back().text.size() < 80) file.add(std::string(80 - file.pieces.back().text.size(), '\1'));
    file.add(littleEndian(std::uint32_t(file.facets.size())));
    for (int f = 0; f < int(file.facets.size()); ++f) {
        for (int axis = 0; axis < 3; ++axis) {
            Piece piece{random.bytes(4)};
            piece.axis = axis;
            piece.facet = f;
            piece.number = Number::littleFloat;
            file.pieces.push_back(piece);
        }
        for (int corner = 0; corner < 3; ++corner) {
            const int point = int(file.facets[std::size_t(f)][corner]);
            for (int axis = 0; axis < 3; ++axis) {
                const double value = file.points[std::size_t(point)][axis];
                file.addCoordinate(littleEndian(float(value)), point, axis, Number::littleFloat);
            }
        }
        file.add(random.bytes(2));
    }
    return file;
}

constexpr std::array<File (*)(Random&), 5> makers{randomPly, randomOff, randomObj, randomAsciiStl, randomBinaryStl};

/// Moves some points, of these some in one direction only.
Points someMoved(Random& random, Points points)
{
    for (Vec3d& p : points) {
        const int kind = random.below(5);
        if (kind < 3) p[kind] = random.number();
        if (kind == 3) p = Vec3d(random.number(), random.number(), random.number());
    }
    return points;
}

} // namespace

BOOST_AUTO_TEST_SUITE(moved_files)

BOOST_AUTO_TEST_CASE(only_coordinates_change)
{
    for (unsigned seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const File file = makers[seed % makers.size()](random);
        const std::string bytes = file.bytes();
        BOOST_TEST_CONTEXT("seed " << seed)
        {
            BOOST_TEST_REQUIRE(same(pointsOf(bytes, file.extension), file.points)); // the file is as it was meant
            const Points to = someMoved(random, file.points);
            const std::string moved = movedBytes(bytes, file.extension, to);
            BOOST_TEST_REQUIRE((moved == file.moved(to)));
            const Mesh before = meshOf(bytes, file.extension), after = meshOf(moved, file.extension);
            BOOST_TEST((after.triangles == before.triangles));
            Points expected = to;
            for (std::size_t i = 0; i < to.size(); ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    const bool stays = same(to[i][axis], file.points[i][axis]);
                    if (file.isFloat[std::size_t(axis)] && !stays) expected[i][axis] = double(float(to[i][axis]));
                }
            }
            BOOST_TEST(same(after.points, expected));
            BOOST_TEST((movedBytes(moved, file.extension, after.points) == moved));
        }
    }
}

BOOST_AUTO_TEST_CASE(points_equal_to_those_of_the_file_leave_its_bytes)
{
    for (const Sample& each : samples()) {
        BOOST_TEST_CONTEXT(each.kind)
        {
            const Points points = pointsOf(each.bytes, each.extension);
            BOOST_TEST((movedBytes(each.bytes, each.extension, points) == each.bytes));
        }
    }
    std::string utf16 = "\xFF\xFE";
    for (const char c : samples()[0].bytes) utf16 += {c, '\0'};
    BOOST_TEST((movedBytes(utf16, ".obj", pointsOf(utf16, ".obj")) == utf16));
    const std::string integers = replaced(replaced(asciiPlyPyramid(), "float", "int"), "0.", "");
    BOOST_TEST((movedBytes(integers, ".ply", pointsOf(integers, ".ply")) == integers));
}

BOOST_AUTO_TEST_CASE(zero_and_minus_zero_differ_but_are_one_point_of_an_stl)
{
    const std::string facets = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                               "endfacet\nfacet normal 0 0 7\nouter loop\nvertex -0 1 0\nvertex 1 -0 0\n"
                               "vertex 1 1 -0.0\nendloop\nendfacet\n";
    const std::string stl = "solid\n" + facets + "endsolid\n";
    Points points = pointsOf(stl, ".stl");
    BOOST_TEST_REQUIRE(points.size() == 4U);
    BOOST_TEST(movedBytes(stl, ".stl", points) == stl);
    points[1].x() = 2; // the other numbers of this point, -0 among them, stay as they are written
    const std::string moved = replaced(replaced(stl, "vertex 1 0 0", "vertex 2 0 0"), "vertex 1 -0 0", "vertex 2 -0 0");
    const std::string normal = movedBytes(stl, ".stl", points);
    BOOST_TEST(replaced(normal, "normal 0 0 1", "normal 0 0 7") == replaced(moved, "normal 0 0 1", "normal 0 0 7"));

    const std::string off = "OFF\n3 1\n0 0 -0\n1 0 0\n0 1 0\n3 0 1 2\n";
    BOOST_TEST(movedBytes(off, ".off", {{-0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) ==
               "OFF\n3 1\n-0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
}

BOOST_AUTO_TEST_CASE(the_normal_of_a_facet_without_area_is_zero)
{
    const std::string stl = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                            "endfacet\nendsolid\n";
    BOOST_TEST(movedBytes(stl, ".stl", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) ==
               replaced(replaced(stl, "vertex 0 1 0", "vertex 2 0 0"), "normal 0 0 1", "normal 0 0 0"));
}

BOOST_AUTO_TEST_CASE(normals_of_an_obj_stay_where_no_point_moves)
{
    const std::string before =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvn 0.0 0e7 +2\nvn 0 0 2\nf 1//1 2//1 3//1\n"
        "f 4//2 5//2 6//2\n";
    Points points = pointsOf(before, ".obj");
    points[5].z() = 3;
    const std::string moved = movedBytes(before, ".obj", points);
    const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 3\nvn 0.0 0e7 +2\nvn ";
    BOOST_TEST(moved.substr(0, start.size()) == start);
    BOOST_TEST(moved.find("vn 0 0 2") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(normals_of_an_obj_that_are_no_directions_stay)
{
    const std::string end = "f 1//1 2//2 3//3\nf 1//4 2//5 3//4\n";
    const std::string before =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 nan\nvn 1e999 0 1\nvn 0 0\nvn red\nvn 0 0 1\n" + end;
    // A quarter turn about x.
    BOOST_TEST(movedBytes(before, ".obj", {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}) ==
               "v 0 0 0\nv 1 0 0\nv 0 0 1\nvn nan 0 nan\nvn 1e999 0 1\nvn 0 0\nvn red\nvn 0 -1 0\n" + end);
}

BOOST_AUTO_TEST_CASE(polygons_and_colours_of_a_ply_stay)
{
    const Points points = pointsOf(asciiPlyPyramid(), ".ply");
    Points up = points;
    for (Vec3d& p : up) p.z() += 0.1;
    const std::string moved = movedBytes(asciiPlyPyramid(), ".ply", up);
    const std::string tenth = numberText(double(0.1F)), top = numberText(double(float(0.75 + 0.1)));
    BOOST_TEST(moved == replaced(replaced(replaced(replaced(replaced(asciiPlyPyramid(), "0.75", top), "0 0 0 255",
                                                            "0 0 " + tenth + " 255"),
                                                   "1 0 0 255", "1 0 " + tenth + " 255"),
                                          "1 1 0 255", "1 1 " + tenth + " 255"),
                                 "0 1 0 255", "0 1 " + tenth + " 255"));
    BOOST_TEST(meshOf(moved, ".ply").quads.size() == 1U);
}

BOOST_AUTO_TEST_CASE(integers_become_doubles)
{
    const std::string integers =
        replaced(replaced(asciiPlyPyramid(), "property float y", "property int y"), "0.5 0.5", "0.5 1");
    Points points = pointsOf(integers, ".ply");
    for (Vec3d& p : points) p += Vec3d(0.1, 0.2, 0.3);
    const std::string moved = movedBytes(integers, ".ply", points);
    BOOST_TEST(same(pointsOf(moved, ".ply"), points));
    BOOST_TEST(moved.find("property double y") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_precision_of_a_moved_file_is_known_before)
{
    const TemporaryFolder folder;
    const auto plyOf = [&](const std::string& name, const std::string& from, const std::string& to) {
        writeText(folder / name, replaced(asciiPlyPyramid(), from, to));
        return folder / name;
    };
    const auto floats = plyOf("floats.ply", "float", "float"), doubles = plyOf("doubles.PLY", "float", "double"),
               mixed = plyOf("mixed.ply", "float y", "double y"), integers = plyOf("integers.ply", "float y", "int y");
    writeText(folder / "model.obj", samples()[0].bytes);
    BOOST_TEST((movedPrecision(floats, "b.ply") == Precision::float32));
    BOOST_TEST((movedPrecision(floats, "b.PLY") == Precision::float32));
    BOOST_TEST((movedPrecision(floats, "b.off") == Precision::float64));
    BOOST_TEST((movedPrecision(floats, "b.stl") == Precision::float32));
    BOOST_TEST((movedPrecision(doubles, "b.ply") == Precision::float64));
    BOOST_TEST((movedPrecision(mixed, "b.ply") == Precision::float32));
    BOOST_TEST((movedPrecision(integers, "b.ply") == Precision::float64));
    BOOST_TEST((movedPrecision(folder / "model.obj", "b.obj") == Precision::float64));
    BOOST_TEST((movedPrecision(folder / "model.obj", "b.ply") == Precision::float64));
    BOOST_TEST((movedPrecision("none.stl", "b.stl") == Precision::float32));
    BOOST_CHECK_THROW(movedPrecision(floats, "b.xyz"), IoError);
    BOOST_CHECK_THROW(movedPrecision(folder / "none.ply", "b.ply"), IoError);
    writeText(folder / "bad.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n");
    BOOST_CHECK_THROW(movedPrecision(folder / "bad.ply", "b.ply"), IoError);
}

BOOST_AUTO_TEST_CASE(coordinates_that_do_not_fit_are_refused)
{
    for (const Sample& each : samples()) {
        BOOST_TEST_CONTEXT(each.kind)
        {
            Points points = pointsOf(each.bytes, each.extension);
            points[2].y() = -1e39;
            const std::string kind = each.kind;
            const bool isFloat =
                kind == "ascii ply" || kind == "big endian ply" || kind.find("stl") != std::string::npos;
            const auto isTold = [](const IoError& error) {
                return std::string(error.what()).find("the y coordinate of point 2 is -1e+39, which does not fit") !=
                       std::string::npos;
            };
            if (isFloat) {
                BOOST_CHECK_EXCEPTION(movedBytes(each.bytes, each.extension, points), IoError, isTold);
            } else {
                BOOST_TEST(same(pointsOf(movedBytes(each.bytes, each.extension, points), each.extension), points));
            }
            points.pop_back();
            BOOST_CHECK_THROW(movedBytes(each.bytes, each.extension, points), InputError);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
