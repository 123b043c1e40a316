#include <boost/test/unit_test.hpp>

#include <cstring>
#include <utility>

#include <sys/stat.h>

#include <deform/cages.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/weights_io.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::Kind;
using test::randomCage;
using test::TemporaryFolder;

namespace {

const Mesh cage = randomCage(Kind::both, 30);
const std::vector<Vec3d> points{Vec3d(0), Vec3d(0.1, 0.2, 0.3), Vec3d(-0.4, 0, 0.2)};

std::string messageOf(const std::filesystem::path& path, const Mesh& other, const std::vector<Vec3d>& otherPoints)
{
    try {
        readWeights(path, other, otherPoints);
    } catch (const IoError& error) {
        return error.what();
    }
    return "";
}

} // namespace

BOOST_AUTO_TEST_SUITE(weights_io)

BOOST_AUTO_TEST_CASE(reads_back_what_was_written)
{
    const TemporaryFolder folder;
    for (const Coordinates family : {Coordinates::meanValue, Coordinates::green, Coordinates::maximumLikelihood}) {
        writeWeights(cage, points, family, computeWeights(cage, points, family), folder / "w.npy");
        const Binding back = readWeights(folder / "w.npy", cage, points);
        BOOST_TEST((back.family() == family));
        std::vector<Vec3d> posed = cage.points;
        for (Vec3d& p : posed) p.x() += p.y() * p.z();
        BOOST_TEST((back.pose(posed) == Binding(cage, points, family).pose(posed)));
    }
    writeWeights(cage, {}, Coordinates::green, {}, folder / "none.npy");
    BOOST_TEST(readWeights(folder / "none.npy", cage, {}).points().empty());
}

BOOST_AUTO_TEST_CASE(is_the_numpy_file_that_is_documented)
{
    const TemporaryFolder folder;
    for (const auto& [family, name] : {std::pair{Coordinates::green, std::string("green\0\0\0", 8)},
                                       {Coordinates::biharmonic, std::string("biharmonic\0\0\0\0\0\0", 16)}}) {
        const std::vector<float> written = computeWeights(cage, points, family);
        const std::size_t handles = handleCount(cage, family);
        writeWeights(cage, points, family, written, folder / "w.npy");
        const std::string bytes = test::readText(folder / "w.npy");
        BOOST_REQUIRE(bytes.size() > 10U);
        BOOST_TEST(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
        const std::size_t header =
            10 + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
        BOOST_TEST(header % 64 == 0U);
        std::string text = bytes.substr(10, header - 10);
        BOOST_TEST(text.back() == '\n');
        text.erase(text.find_last_not_of(" \n") + 1);
        BOOST_TEST(text == "{'descr': [('family', '|S" + std::to_string(name.size()) +
                               "'), ('cage_hash', '<u8'), ('points_hash', '<u8'), ('weights', '<f4', (3, " +
                               std::to_string(handles) + "))], 'fortran_order': False, 'shape': (), }");
        const std::size_t begin = header + name.size() + 16; // of the weights, behind two hashes
        BOOST_REQUIRE(bytes.size() == begin + 4 * 3 * handles);
        BOOST_TEST(bytes.substr(header, name.size()) == name);
        std::vector<float> weights(3 * handles);
        std::memcpy(weights.data(), bytes.data() + begin, weights.size() * sizeof(float));
        BOOST_TEST((weights == written));
    }
}

BOOST_AUTO_TEST_CASE(refuses_what_does_not_fit)
{
    const TemporaryFolder folder;
    const std::string path = folder / "w.npy";
    const std::vector<float> weights = computeWeights(cage, points, Coordinates::meanValue);
    BOOST_CHECK_THROW(writeWeights(cage, points, Coordinates::green, weights, path), InputError);
    BOOST_TEST(!std::filesystem::exists(path));
    writeWeights(cage, points, Coordinates::meanValue, weights, path);
    Mesh other = cage;
    other.points[3].x() += 1e-9;
    BOOST_TEST(messageOf(path, other, points) == path + ": it was made for another cage");
    other = cage;
    std::swap(other.triangles[0], other.triangles[1]);
    BOOST_TEST(messageOf(path, other, points) == path + ": it was made for another cage");
    BOOST_TEST(messageOf(path, cage, {points[0], points[1]}) == path + ": it was made for another model");
    BOOST_TEST(messageOf(path, cage, {points[1], points[0], points[2]}) == path + ": it was made for another model");

    const std::string bytes = test::readText(path);
    for (std::size_t size = 0; size < bytes.size(); size += 7) { // cut off anywhere
        test::writeText(path, bytes.substr(0, size));
        BOOST_TEST(messageOf(path, cage, points).find(path + ": it is ") == 0U);
    }
    test::writeText(path, "solid\n");
    BOOST_TEST(messageOf(path, cage, points) ==
               path + ": it is not a weights file: neither NumPy's (.npy) nor named .dmat");
    BOOST_TEST(!messageOf(folder / "none.npy", cage, points).empty());
    BOOST_TEST(!messageOf(folder.path(), cage, points).empty());
}

BOOST_AUTO_TEST_CASE(refuses_what_is_not_a_whole_file_of_its_size)
{
    const TemporaryFolder folder;
    const std::string path = folder / "w.npy";
    writeWeights(cage, points, Coordinates::meanValue, computeWeights(cage, points, Coordinates::meanValue), path);
    const std::string bytes = test::readText(path);
    test::writeText(path, bytes + "x");
    BOOST_TEST(messageOf(path, cage, points) == path + ": it has 1 bytes behind the weights; it should end there");
    test::writeText(path, bytes.substr(0, bytes.size() - 1));
    BOOST_TEST(messageOf(path, cage, points) == path + ": it is truncated");

    const std::string pipe = folder / "pipe.npy"; // to open it would wait for a writer
    BOOST_REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    BOOST_TEST(messageOf(pipe, cage, points) == pipe + ": is not a regular file");
    BOOST_TEST(messageOf("/dev/zero", cage, points) == "/dev/zero: is not a regular file");

    const std::string loop = folder / "loop.npy";
    std::filesystem::create_symlink(loop, loop);
    BOOST_TEST(messageOf(loop, cage, points) == loop + ": cannot be read: Too many levels of symbolic links");
    BOOST_TEST(messageOf(folder / "none.npy", cage, points) ==
               (folder / "none.npy").string() + ": cannot be read: No such file or directory");
    BOOST_TEST(messageOf(folder.path(), cage, points) == folder.path().string() + ": is a directory; a file is needed");
}

BOOST_AUTO_TEST_SUITE_END()
