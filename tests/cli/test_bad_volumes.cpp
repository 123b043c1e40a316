// Bad volumes give exit status 1 and one clear line, from little memory; odd ones are drawn or refused, never more.

#include <boost/test/unit_test.hpp>

#include <volume/vdb_samples.h>

#include <algorithm>
#include <limits>

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <support/run_command.h>

using namespace vdbcage;
using namespace vdbcage::test;
using detail::ByteField;
using openvdb::Coord;

namespace {

struct Outcome {
    int status;
    std::string out, err;
    long kilobytes; ///< resident at most
};

#ifdef __SANITIZE_ADDRESS__ // ten times slower, and what it knows of all memory is resident, too
constexpr const char* mostSeconds = "600";
constexpr long mostKilobytes = 4000000;
#else
constexpr const char* mostSeconds = "60"; // far more than it takes: it ends what hangs
constexpr long mostKilobytes = 2000000;
#endif

/// Runs the command with `words` in a folder of its own that has a model.
Outcome outcomeOf(const TemporaryFolder& folder, std::vector<std::string> words)
{
    words.insert(words.begin(), {"timeout", mostSeconds, VDBCAGE_COMMAND});
    const pid_t child = startCommand(words, folder / "out", folder / "err");
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readText(folder / "out"),
            readText(folder / "err"), usage.ru_maxrss};
}

Outcome drawn(const std::filesystem::path& volume)
{
    const TemporaryFolder folder;
    return outcomeOf(folder, {"render", volume, "-o", folder / "picture.png"});
}

Outcome usedAsScaleField(const std::filesystem::path& volume)
{
    const TemporaryFolder folder;
    const std::string model = folder / "model.obj";
    writeText(model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    return outcomeOf(folder, {"make", model, "-o", folder / "cage.obj", "--resolution", "16", "--scale-field", volume});
}

std::vector<Outcome> outcomesOf(const std::filesystem::path& volume)
{
    return {drawn(volume), usedAsScaleField(volume)};
}

/// \return kilobytes
long expectRefusal(const std::filesystem::path& volume, const std::string& mention)
{
    long most = 0;
    for (const Outcome& outcome : outcomesOf(volume)) {
        BOOST_TEST(outcome.status == 1);
        BOOST_TEST(outcome.out.empty());
        BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
        BOOST_TEST(outcome.err.rfind("vdbcage: error: " + volume.string() + ": ", 0) == 0U, outcome.err);
        BOOST_TEST(outcome.err.find(mention) != std::string::npos, outcome.err + " lacks " + mention);
        most = std::max(most, outcome.kilobytes);
    }
    return most;
}

openvdb::FloatGrid::Ptr smallGrid(const char* name = "density")
{
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(0);
    for (int i = 0; i < 60; ++i) grid->tree().setValue(Coord(i % 4, i / 4 % 4, i / 16), 1 + static_cast<float>(i % 2));
    grid->setName(name);
    return grid;
}

std::vector<ByteField> fieldsOf(const std::string& bytes)
{
    std::vector<ByteField> fields;
    detail::parseVdb(bytes, "", "density", detail::VdbValues::scalars, &fields);
    return fields;
}

} // namespace

BOOST_AUTO_TEST_SUITE(bad_volumes)

// OpenVDB 10.0.1 writes over its heap.
BOOST_AUTO_TEST_CASE(one_length_of_a_chunk_changed)
{
    const TemporaryFolder folder;
    const std::string bytes = vdbBytes({smallGrid()}, openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC);
    const std::vector<std::size_t> lengths = chunkLengths(bytes, fieldsOf(bytes));
    BOOST_REQUIRE(!lengths.empty());
    for (const std::int64_t length : {std::int64_t{-9000}, std::int64_t{-0x7FFFFFFF}, std::int64_t{9000},
                                      std::int64_t{0x7FFFFFFF}, std::numeric_limits<std::int64_t>::max()}) {
        // More bytes after it: they were what was written.
        writeText(folder / "a.vdb", withValue(bytes, lengths.back(), length) + std::string(20000, '\x55'));
        expectRefusal(folder / "a.vdb", "the length of a chunk of 240 bytes is " + std::to_string(length));
    }
    writeText(folder / "a.vdb", withValue(bytes, lengths.back() + 7, '\xFF')); // one byte
    expectRefusal(folder / "a.vdb", "the length of a chunk of 240 bytes is -");
}

BOOST_AUTO_TEST_CASE(gigabytes_are_announced)
{
    const TemporaryFolder folder;
    writeText(folder / "a.vdb", "short");
    const long usual = expectRefusal(folder / "a.vdb", "is not a .vdb file, or is truncated");
    const std::string bytes = vdbBytes({smallGrid()}, 6, false);
    const std::vector<ByteField> fields = fieldsOf(bytes);
    std::vector<std::size_t> positions = chunkLengths(bytes, fields);
    for (const ByteField& field : fields) {
        std::uint32_t old = 0;
        std::memcpy(&old, bytes.data() + field.position, sizeof(old));
        if (field.size == sizeof(old) && old < 1000) positions.push_back(field.position); // it can be a count
    }
    int refused = 0;
    for (const std::size_t position : positions) {
        writeText(folder / "a.vdb", withValue(bytes, position, 0x70000000));
        const Outcome outcome = drawn(folder / "a.vdb");
        if (outcome.status == 0) continue; // a number that is not used, or a transform
        ++refused;
        BOOST_TEST(outcome.status == 1, "byte " << position << ": " << outcome.err);
        BOOST_TEST(outcome.kilobytes < usual + 8000, "byte " << position);
    }
    BOOST_TEST(refused > 30);
}

BOOST_AUTO_TEST_CASE(what_is_no_file)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.vdb";
    writeText(path, "");
    expectRefusal(path, "the file is empty");
    std::filesystem::remove(path);
    expectRefusal(path, "No such file");
    BOOST_REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    expectRefusal(path, "is not a regular file");
    std::filesystem::remove(path);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    BOOST_REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
    expectRefusal(path, "is not a regular file");
    ::close(socket);
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/zero", path);
    expectRefusal(path, "is not a regular file");
    std::filesystem::remove(path);
    std::filesystem::create_symlink(path, path);
    expectRefusal(path, "Too many levels of symbolic links");
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    expectRefusal(path, "is a directory");
}

BOOST_AUTO_TEST_CASE(grids_at_the_ends_of_space_and_grids_that_fill_it)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.vdb";
    const auto expectCannotBeDrawn = [&](const openvdb::FloatGrid& grid, const std::string& mention) {
        writeText(path, vdbBytes({grid.copyGrid()}, 6));
        const std::vector<Outcome> outcomes = outcomesOf(path);
        BOOST_TEST(outcomes[0].status == 1);
        BOOST_TEST(std::count(outcomes[0].err.begin(), outcomes[0].err.end(), '\n') == 1, outcomes[0].err);
        BOOST_TEST(outcomes[0].err.find(mention) != std::string::npos, outcomes[0].err);
        BOOST_TEST(outcomes[0].kilobytes < mostKilobytes);
        // As a scale field it is what it says.
        BOOST_TEST(outcomes[1].status == 0, outcomes[1].err);
    };
    for (const Coord& end : {Coord::min(), Coord::max(), Coord(0, 1 << 30, 0), Coord(0, 0, -(1 << 30) - 1)}) {
        const auto grid = smallGrid();
        grid->tree().setValue(end, 1);
        expectCannotBeDrawn(*grid, "2^30");
    }
    const auto ends = smallGrid();
    ends->tree().addTile(3, Coord::max(), 1, true);
    ends->tree().addTile(3, Coord::min(), 1, true);
    expectCannotBeDrawn(*ends, "2^30");
    const auto one = smallGrid();
    one->tree().addTile(3, Coord(4096, 0, 0), 1, true);
    expectCannotBeDrawn(*one, "too large");
    const auto many = smallGrid();
    for (int i = 0; i < 1000; ++i) {
        many->tree().addTile(3, Coord(4096 * (i % 10), 4096 * (i / 10 % 10), 4096 * (i / 100)), 1, true);
    }
    expectCannotBeDrawn(*many, "too large");
    const auto tiny = smallGrid(); // the model is beyond all its coordinates
    tiny->setTransform(openvdb::math::Transform::createLinearTransform(1e-4));
    openvdb::Mat4d far = openvdb::Mat4d::identity();
    far.setTranslation(openvdb::Vec3d(1e12, 0, 0));
    tiny->transform().postMult(far);
    writeText(path, vdbBytes({tiny}, 6));
    for (const Outcome& outcome : outcomesOf(path)) BOOST_TEST(outcome.status <= 1, outcome.err);
}

BOOST_AUTO_TEST_CASE(values_that_are_not_finite)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.vdb";
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const auto grid = smallGrid();
        grid->tree().setValue(Coord(2, 2, 2), value);
        writeText(path, vdbBytes({grid}, 6));
        const std::vector<Outcome> outcomes = outcomesOf(path);
        BOOST_TEST(outcomes[0].status == 0, outcomes[0].err); // neither above one half, or above it
        BOOST_TEST(outcomes[1].status == 1);
        BOOST_TEST(outcomes[1].err == "vdbcage: error: the scale field has a value that is not finite\n");
    }
}

BOOST_AUTO_TEST_SUITE_END()
