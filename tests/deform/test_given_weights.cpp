#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <deform/cages.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/weights_io.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::jittered;
using test::Kind;
using test::pointsInside;
using test::Random;
using test::randomCage;
using test::TemporaryFolder;

namespace {

/// Rows of numbers, row after row.
struct Matrix {
    std::size_t rows = 0, columns = 0;
    std::vector<double> numbers;

    Matrix transposed() const
    {
        Matrix result{columns, rows, {}};
        for (std::size_t k = 0; k < columns; ++k) {
            for (std::size_t i = 0; i < rows; ++i) result.numbers.push_back(numbers[i * columns + k]);
        }
        return result;
    }
};

template <typename Number>
std::string bytesOf(const std::vector<double>& numbers)
{
    std::string bytes;
    for (const double number : numbers) {
        const auto value = static_cast<Number>(number);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return bytes;
}

/// A .npy file of any header.
std::string npy(const std::string& header, const std::string& data, int version = 1)
{
    std::string bytes = "\x93NUMPY";
    bytes += char(version);
    bytes += '\0';
    for (std::size_t i = 0; i < (version == 1 ? 2U : 4U); ++i) bytes += char(header.size() >> (8 * i) & 0xFFU);
    return bytes + header + data;
}

std::string header(const std::string& type, bool fortran, const std::string& shape)
{
    return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" + shape +
           "), }          \n";
}

std::string shapeOf(const Matrix& matrix)
{
    return std::to_string(matrix.rows) + ", " + std::to_string(matrix.columns);
}

template <typename Number>
std::string npyOf(const Matrix& matrix, bool fortran, int version = 1)
{
    return npy(header(sizeof(Number) == 4 ? "<f4" : "<f8", fortran, shapeOf(matrix)),
               bytesOf<Number>(fortran ? matrix.transposed().numbers : matrix.numbers), version);
}

std::string dmatText(const Matrix& matrix)
{
    std::string text = std::to_string(matrix.columns) + ' ' + std::to_string(matrix.rows) + '\n';
    for (const double number : matrix.transposed().numbers) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g\n", number);
        text += digits;
    }
    return text;
}

std::string dmatBinary(const Matrix& matrix)
{
    return "0 0\n" + std::to_string(matrix.columns) + ' ' + std::to_string(matrix.rows) + '\n' +
           bytesOf<double>(matrix.transposed().numbers);
}

struct File {
    const char* name;
    std::string bytes;
};

/// A matrix in every way that is read.
std::vector<File> filesOf(const Matrix& matrix)
{
    std::vector<File> files;
    for (const int version : {1, 2, 3}) {
        files.push_back({"c4.npy", npyOf<float>(matrix, false, version)});
        files.push_back({"fortran4.npy", npyOf<float>(matrix, true, version)});
        files.push_back({"c8.npy", npyOf<double>(matrix, false, version)});
        files.push_back({"fortran8.npy", npyOf<double>(matrix, true, version)});
    }
    files.push_back({"text.dmat", dmatText(matrix)});
    files.push_back({"binary.DMAT", dmatBinary(matrix)});
    return files;
}

Matrix meanValues(const Mesh& cage, const std::vector<Vec3d>& points)
{
    return {points.size(), cage.points.size(), computeCoordinates(cage, points, Coordinates::meanValue)};
}

const Mesh cage = randomCage(Kind::both, 50);
const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.1, 0.2, 0.3), Vec3d(-0.4, 0, 0.2)};

/// What reading the file says; empty if it is read. What is thrown must be an IoError that names the file.
std::string messageOf(const TemporaryFolder& folder, const File& file, const Mesh& ofCage = cage,
                      const std::vector<Vec3d>& ofPoints = points)
{
    const std::string path = folder / file.name;
    test::writeText(path, file.bytes);
    try {
        const Binding binding = readWeights(path, ofCage, ofPoints);
        BOOST_TEST((binding.family() == Coordinates::given));
        for (const Vec3d& p : binding.pose(jittered(ofCage.points, 51))) BOOST_REQUIRE(std::isfinite(p.length()));
    } catch (const IoError& error) {
        const std::string message = error.what();
        BOOST_TEST(message.find(path + ": ") == 0U, message);
        return message.substr(path.size() + 2);
    }
    return "";
}

/// Rows that no smooth function of the points makes, each with the sum 1.
enum class Rows { random, nearOne, falling, few, recursive };
constexpr Rows anyRows[] = {Rows::random, Rows::nearOne, Rows::falling, Rows::few, Rows::recursive};

std::vector<float> makeRows(Rows kind, std::size_t count, std::size_t columns, std::uint32_t seed)
{
    Random random(seed);
    std::vector<double> one;
    for (std::size_t k = 0; k < columns; ++k) one.push_back(random(0, 1));
    std::vector<float> rows;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<double> row(columns, 0.0);
        for (std::size_t k = 0; k < columns; ++k) {
            const double fall = double(k) / double(columns);
            if (kind == Rows::random) row[k] = random(0, 1);
            if (kind == Rows::nearOne) row[k] = one[k] + 1e-6 * random(-1, 1);
            if (kind == Rows::falling) row[k] = one[k] + random(-1, 1) * std::pow(10, -6 * fall);
            if (kind == Rows::few && random(0, 1) < 3 / double(columns)) row[k] = random(0, 1);
        }
        if (kind == Rows::recursive && i > 0) {
            // Rows of which the last is a combination of the others whose factors grow by half from one to the next.
            const std::size_t pairs = columns / 2, step = (i - 1) % (pairs + 1);
            constexpr double c = 0.5;
            for (std::size_t k = 0; k <= std::min(step, pairs - 1); ++k) {
                const double entry = std::pow(1 - c, double(k)) * (k == step ? 1 : -0.95 * c);
                row[2 * k] = entry;
                row[2 * k + 1] = -entry;
            }
        }
        double sum = 0;
        for (const double weight : row) sum += weight;
        if (kind == Rows::recursive || !(sum > 0)) {
            row[columns - 1] += 1 - sum;
            sum = 1;
        }
        for (const double weight : row) rows.push_back(static_cast<float>(weight / sum));
    }
    return rows;
}

} // namespace

BOOST_AUTO_TEST_SUITE(given_weights)

BOOST_AUTO_TEST_CASE(a_matrix_poses_as_the_binding_that_it_is_from)
{
    const TemporaryFolder folder;
    for (const Kind kind : test::kinds) {
        const Mesh some = randomCage(kind, 52, 0.1, 2);
        std::vector<Vec3d> many = pointsInside(some, 53, 300);
        for (int i = 0; i < 300; ++i) many.push_back(many[1] + 1e-4 * i * many[2]); // some are combinations
        const Binding expected(some, many, Coordinates::meanValue);
        BOOST_TEST(expected.weightBytes() < 4 * many.size() * expected.handles());
        const std::vector<Vec3d> pose = jittered(some.points, 54);
        const std::vector<Vec3d> posed = expected.pose(pose);
        for (const File& file : filesOf(meanValues(some, many))) {
            test::writeText(folder / file.name, file.bytes);
            const Binding binding = readWeights(folder / file.name, some, many);
            BOOST_TEST((binding.family() == Coordinates::given));
            BOOST_TEST(binding.handles() == some.points.size());
            BOOST_TEST((binding.pose(pose) == posed), file.name); // bit by bit: they are the same floats
            BOOST_TEST((binding.pose(some.points) == many));
        }
    }
}

BOOST_AUTO_TEST_CASE(a_point_moves_by_its_weights_times_what_the_cage_moves)
{
    const Mesh open{{Vec3d(0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}, {{0, 1, 2}, {0, 1, 3}}, {}};
    const std::vector<Vec3d> two{Vec3d(5, 5, 5), Vec3d(-3, 0, 9)}; // where the weights do not put them
    const Matrix weights{2, 4, {0.5, 0.25, 0, 0.25, -1, 2, 0.5, -0.5}};
    const TemporaryFolder folder;
    for (const File& file : filesOf(weights)) {
        test::writeText(folder / file.name, file.bytes);
        const Binding binding = readWeights(folder / file.name, open, two);
        std::vector<Vec3d> pose = open.points;
        pose[1] += Vec3d(0, 8, 0);
        pose[3] += Vec3d(4, 0, 0);
        BOOST_TEST((binding.pose(pose) == std::vector<Vec3d>{Vec3d(6, 7, 5), Vec3d(-5, 16, 9)}), file.name);
        pose = open.points;
        for (Vec3d& p : pose) p += Vec3d(2, -1, 0.5);
        BOOST_TEST((binding.pose(pose) == std::vector<Vec3d>{Vec3d(7, 4, 5.5), Vec3d(-1, -1, 9.5)}), file.name);
    }
    BOOST_TEST(cageHandles(open, open.points, Coordinates::given).size() == 4U);
}

BOOST_AUTO_TEST_CASE(headers_are_read_however_they_are_written)
{
    const TemporaryFolder folder;
    const Matrix matrix = meanValues(cage, points);
    const std::string data = bytesOf<double>(matrix.numbers), shape = shapeOf(matrix);
    for (const std::string& text : {"{'shape': (" + shape + "), 'fortran_order': False, 'descr': '<f8'}",
                                    "{\"descr\":\"<f8\",\"fortran_order\":False,\"shape\":(" + shape + ",)}",
                                    "  { 'fortran_order' : False , 'descr' : '<f8' , 'shape' : ( 3L , " +
                                        std::to_string(cage.points.size()) + "L ) , }  \n"}) {
        BOOST_TEST(messageOf(folder, {"w.npy", npy(text, data)}) == "");
    }
    std::string text = dmatText(matrix);
    for (std::size_t i = text.find('\n') + 1; i < text.size(); ++i) { // all in one line, but for the last
        if (text[i] == '\n' && i + 1 < text.size()) text[i] = ' ';
    }
    BOOST_TEST(messageOf(folder, {"w.dmat", text}) == "");
    BOOST_TEST(messageOf(folder, {"w.dmat", text + " \n\n"}) == "");
    BOOST_TEST(readWeights(folder / "w.dmat", cage, points).points().size() == 3U);
    const Matrix none{0, cage.points.size(), {}};
    for (const File& file : filesOf(none)) {
        test::writeText(folder / file.name, file.bytes);
        BOOST_TEST(readWeights(folder / file.name, cage, {}).points().empty());
    }
}

BOOST_AUTO_TEST_CASE(every_truncation_is_refused)
{
    const TemporaryFolder folder;
    for (const File& file : filesOf(meanValues(cage, points))) {
        BOOST_TEST(messageOf(folder, file) == "");
        for (std::size_t size = 0; size < file.bytes.size(); ++size) {
            const std::string message = messageOf(folder, {file.name, file.bytes.substr(0, size)});
            BOOST_TEST(message != "", file.name << " cut to " << size);
        }
        BOOST_TEST(messageOf(folder, {file.name, file.bytes + "x"}).find(" behind the ") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(any_bytes_are_read_or_refused)
{
    const TemporaryFolder folder;
    Random random(55);
    const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random(0, double(end))); };
    std::size_t read = 0, refused = 0;
    for (const File& file : filesOf(meanValues(cage, points))) {
        for (int i = 0; i < 300; ++i) {
            std::string bytes = file.bytes;
            const std::size_t part = i % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 110);
            for (std::size_t n = 1 + below(3); n > 0; --n) {
                const std::size_t at = below(part);
                if (i % 3 == 0) bytes[at] = char(below(256));
                if (i % 3 == 1) bytes[at] = "0123456789 ,()'{}:\n"[below(19)];
                if (i % 3 == 2) bytes.erase(at, 1 + below(4)).insert(below(bytes.size()), 1, char(below(256)));
            }
            ++(messageOf(folder, {file.name, bytes}).empty() ? read : refused);
        }
    }
    BOOST_TEST(read > 100U);
    BOOST_TEST(refused > 1000U);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused_by_name)
{
    const TemporaryFolder folder;
    const Matrix good = meanValues(cage, points);
    BOOST_REQUIRE(good.columns == 26U);
    const auto expect = [&](const Matrix& matrix, const std::string& message) {
        for (const File& file : filesOf(matrix)) BOOST_TEST(messageOf(folder, file) == message);
    };
    Matrix wrong = good;
    wrong.rows = 2;
    wrong.numbers.resize(2 * 26);
    expect(wrong, "it has 2 rows; rows: the model has 3 points");
    wrong = {3, 1, {1, 1, 1}};
    expect(wrong, "it has 1 column; columns: the cage has 26 points");
    expect(good.transposed(), "it is transposed: it has 26 rows and 3 columns; rows are the model's 3 points, columns "
                              "the cage's 26");
    for (const double by : {0.0009, -0.0009}) {
        wrong = good;
        wrong.numbers[26 + 7] += by;
        expect(wrong, "");
    }
    const auto expectPart = [&](const Matrix& matrix, const std::string& start, const std::string& end) {
        for (const File& file : filesOf(matrix)) {
            const std::string message = messageOf(folder, file);
            BOOST_TEST(message.find(start) != std::string::npos, file.name << ": " << message);
            BOOST_TEST(message.find(end) != std::string::npos, file.name << ": " << message);
        }
    };
    const std::string sums = "; it must be 1 within 0.001, so that the model moves along with the cage";
    wrong = good;
    wrong.numbers[26 + 7] += 0.0011;
    expectPart(wrong, "row 1: its weights have the sum 1.001", sums);
    for (double& number : wrong.numbers) number = 0;
    expectPart(wrong, "row 0: its weights have the sum 0", sums);
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        wrong = good;
        wrong.numbers[2 * 26 + 5] = value;
        for (const File& file : filesOf(wrong)) {
            const std::string number = std::isnan(value) ? "nan" : "inf";
            BOOST_TEST(
                messageOf(folder, file) ==
                (std::string(file.name) == "text.dmat" // column 5, row 2, behind the first line
                     ? "line 19: the weight is \"" + number + "\"; coordinates must be finite"
                     : "row 2: the weight in column 5 is " + number + " in single precision; weights must be finite"));
        }
    }
    wrong.numbers[2 * 26 + 5] = 1e300; // finite, but not as a float
    for (const File& file : filesOf(wrong)) {
        BOOST_TEST(messageOf(folder, file) ==
                   "row 2: the weight in column 5 is inf in single precision; weights must be finite");
    }

    const std::string data = bytesOf<double>(good.numbers);
    const auto expectNpy = [&](const std::string& bytes, const std::string& message) {
        BOOST_TEST(messageOf(folder, {"w.npy", bytes}) == message);
    };
    for (const char* type : {">f8", ">f4", "<i4", "|u1", "<f2", "<c8", "|S8", "|O"}) {
        expectNpy(npy(header(type, false, "3, 26"), data),
                  std::string("its numbers are \"") + type + "\"; weights are '<f4' or '<f8'");
    }
    expectNpy(npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3, 26), }\n", data),
              "it holds records; weights are plain numbers, '<f4' or '<f8'");
    expectNpy(npy(header("<f8", false, "78,"), data), "it has 1 dimension (78); weights have 2, points x cage points");
    expectNpy(npy(header("<f8", false, "3, 26, 1"), data),
              "it has 3 dimensions (3 x 26 x 1); weights have 2, points x cage points");
    expectNpy(npy(header("<f8", false, ""), data), "it has 0 dimensions (no); weights have 2, points x cage points");
    expectNpy(npy(header("<f8", false, "3, 26"), data + "abc"),
              "it has 3 bytes behind the weights; it should end there");
    expectNpy(npy(header("<f8", false, "3, 26"), data.substr(1)),
              "it is truncated: 3 rows of 26 columns need 624 bytes; it has 623");
    expectNpy(npy(header("<f8", false, "3, 26"), data, 4),
              "it is a NumPy file of version 4.0; 1.0, 2.0 and 3.0 are read");
    for (const char* text :
         {"", "{}", "{'descr': '<f8', 'fortran_order': False, }",
          "{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 26)}",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (3, -26)}",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 99999999999999999999)}",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (3 26)}", "{'descr': '<f8' 'fortran_order': False}",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 26)} x",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 26), 'more': 'x'}"}) {
        const std::string message = messageOf(folder, {"w.npy", npy(text, data)});
        BOOST_TEST(message.find("it has no header of a NumPy array, but \"") == 0U, text << ": " << message);
    }
    expectNpy("3 26\n", "it is not a weights file: neither NumPy's (.npy) nor named .dmat");

    const auto expectDmat = [&](const std::string& bytes, const std::string& message) {
        BOOST_TEST(messageOf(folder, {"w.dmat", bytes}) == message);
    };
    expectDmat("", "the file is empty; copy or export it again");
    expectDmat("weights\n",
               "line 1: the number of columns is \"weights\", which is not an integer; write a whole number");
    expectDmat("26\n3\n", "line 1: the number of rows is missing; add it, or export the file again");
    expectDmat("26 3 1\n", "line 1: the first line must be COLUMNS ROWS, and nothing behind it");
    expectDmat("-26 3\n", "line 1: the number of columns is -26; it must not be negative");
    expectDmat("26 3\n0.5 0.x",
               "it is truncated: 3 rows of 26 columns need 78 numbers, and a line end behind the last");
    std::string text = dmatText(good);
    expectDmat(text + "7\n", "line 80: there is \"7\" behind the last weight");
    text[5] = 'x';
    expectDmat(text, "line 2: the weight is " + ("\"" + text.substr(5, text.find('\n', 5) - 5) + "\"") +
                         ", which is not a number; numbers are written like 12, -0.5 and 3e-2");
    expectDmat("0 0\n26 3\r\n" + bytesOf<double>(good.transposed().numbers),
               "line 2: the second line must be COLUMNS ROWS, and nothing behind it");
    BOOST_CHECK_THROW(readWeights(folder / "none.dmat", cage, points), IoError);
    BOOST_CHECK_THROW(readWeights(folder.path(), cage, points), IoError);
}

BOOST_AUTO_TEST_CASE(given_weights_are_no_family_that_can_be_computed)
{
    BOOST_TEST(coordinatesName(Coordinates::given) == std::string("given"));
    BOOST_CHECK_EXCEPTION(coordinatesNamed("given"), InputError, [](const InputError& error) {
        return error.what() == "coordinates: 'given' is not a family; " + test::thereAreFamilies();
    });
    const auto isClear = [](const InputError& error) {
        return error.what() ==
               "coordinates: 'given' weights were made elsewhere and cannot be computed; " + test::thereAreFamilies();
    };
    BOOST_CHECK_EXCEPTION(computeCoordinates(cage, points, Coordinates::given), InputError, isClear);
    BOOST_CHECK_EXCEPTION(computeWeights(cage, points, Coordinates::given), InputError, isClear);
    BOOST_CHECK_EXCEPTION(Binding(cage, points, Coordinates::given), InputError, isClear);
}

BOOST_AUTO_TEST_CASE(programs_may_bind_write_and_read_given_weights)
{
    const TemporaryFolder folder;
    const std::string path = folder / "w.npy";
    std::vector<float> weights = computeWeights(cage, points, Coordinates::meanValue);
    const Binding binding(cage, points, Coordinates::given, weights);
    writeWeights(cage, points, Coordinates::given, weights, path);
    const Binding back = readWeights(path, cage, points);
    BOOST_TEST((back.family() == Coordinates::given));
    const std::vector<Vec3d> pose = jittered(cage.points, 56);
    BOOST_TEST((back.pose(pose) == binding.pose(pose)));
    BOOST_TEST((binding.pose(pose) == Binding(cage, points, Coordinates::meanValue).pose(pose)));
    BOOST_TEST(messageOf(folder, {"w.npy", test::readText(path)}, randomCage(Kind::both, 57)) ==
               "it was made for another cage");

    weights[26 + 3] += 0.01F;
    BOOST_CHECK_EXCEPTION(Binding(cage, points, Coordinates::given, weights), InputError, [](const InputError& error) {
        return std::string(error.what()).find("weights: row 1: its weights have the sum 1.0") == 0U;
    });
    writeWeights(cage, points, Coordinates::given, weights, path);
    BOOST_TEST(messageOf(folder, {"w.npy", test::readText(path)}).find("row 1: its weights have the sum 1.0") == 0U);
    weights[3] = std::nanf("");
    BOOST_CHECK_EXCEPTION(Binding(cage, points, Coordinates::given, weights), InputError, [](const InputError& error) {
        return std::string(error.what()) ==
               "weights: row 0: the weight in column 3 is nan in single precision; weights must be finite";
    });
    weights.pop_back();
    BOOST_CHECK_THROW(Binding(cage, points, Coordinates::given, weights), InputError);
}

/// The bound that binding.h states, for rows that no smooth function of the points makes.
BOOST_AUTO_TEST_CASE(combinations_of_any_rows_are_within_their_bound)
{
    constexpr std::size_t count = 250; // one block
    Random random(58);
    std::size_t combined = 0;
    for (const std::size_t columns : {33U, 48U, 64U, 112U, 240U}) {
        Mesh some = randomCage(Kind::triangles, 59, 0.1);
        BOOST_REQUIRE(some.points.size() <= columns);
        while (some.points.size() < columns) some.points.push_back(random(0, 1) * random.direction());
        openvdb::BBoxd box;
        for (const openvdb::Vec3I& t : some.triangles) box.expand(some.points[t[0]]);
        const double size = box.extents()[int(box.maxExtent())];
        std::vector<Vec3d> many;
        while (many.size() < count) many.push_back(random(0, 0.7) * random.direction());
        for (const Rows kind : anyRows) {
            const std::vector<float> rows = makeRows(kind, count, columns, 60);
            const Binding bound(some, many, Coordinates::given, rows);
            combined += bound.weightBytes() != sizeof(float) * 256 * columns ? 1 : 0; // all of whole groups
            BOOST_TEST((bound.pose(some.points) == many));
            std::vector<double> sizes(count, 0.0), sums(count, 0.0);
            for (std::size_t i = 0; i < count * columns; ++i) sizes[i / columns] += std::abs(double(rows[i]));
            const auto offBy = [&](const std::vector<Vec3d>& pose, std::size_t i, const std::vector<Vec3d>& posed) {
                Vec3d expected = many[i];
                for (std::size_t k = 0; k < columns; ++k) {
                    expected += double(rows[i * columns + k]) * (pose[k] - some.points[k]);
                }
                return (posed[i] - expected).length() / sizes[i] / size;
            };
            const std::vector<Vec3d> pose = jittered(some.points, 61, size);
            const std::vector<Vec3d> posed = bound.pose(pose);
            double most = 0;
            for (std::size_t i = 0; i < count; ++i) most = std::max(most, offBy(pose, i, posed));
            BOOST_TEST(most < 1e-6, "rows of kind " << int(kind) << ", " << columns << " columns: " << most);
            // Point by point of the cage: what the moves add up to if all signs are the worst.
            for (std::size_t k = 0; k < columns; ++k) {
                std::vector<Vec3d> moved = some.points;
                moved[k].x() += size;
                const std::vector<Vec3d> posedByOne = bound.pose(moved);
                for (std::size_t i = 0; i < count; ++i) sums[i] += offBy(moved, i, posedByOne);
            }
            const double worst = *std::max_element(sums.begin(), sums.end());
            BOOST_TEST(worst < 1e-6, "rows of kind " << int(kind) << ", " << columns << " columns: " << worst);
            BOOST_TEST_MESSAGE("rows of kind " << int(kind) << ", " << columns << " columns: off by " << most
                                               << ", at worst " << worst << ", held "
                                               << double(bound.weightBytes()) / double(4 * count * columns));
        }
    }
    BOOST_TEST(combined > 8U); // else nothing was looked at
}

BOOST_AUTO_TEST_SUITE_END()
