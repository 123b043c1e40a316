#include <boost/test/unit_test.hpp>

#include <csignal>
#include <set>

#include <sys/resource.h>

#include <support/says.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
namespace fs = std::filesystem;
using test::readText;
using test::says;
using test::TemporaryFolder;
using test::writeText;

BOOST_AUTO_TEST_SUITE(atomic_file)

BOOST_AUTO_TEST_CASE(writes_and_replaces)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    writeFileAtomically(path, [](std::ostream& out) { out << "one"; });
    BOOST_TEST(readText(path) == "one");
    writeFileAtomically(path, [](std::ostream& out) { out << "two"; });
    BOOST_TEST(readText(path) == "two");
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(a_writer_that_throws_leaves_the_old_file_and_nothing_else)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    writeText(path, "old");
    BOOST_CHECK_THROW(writeFileAtomically(path,
                                          [](std::ostream& out) {
                                              out << "half";
                                              throw Cancelled();
                                          }),
                      Cancelled);
    BOOST_TEST(readText(path) == "old");
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(errors_name_the_path)
{
    const TemporaryFolder folder;
    const auto nothing = [](std::ostream&) {};
    BOOST_CHECK_EXCEPTION(writeFileAtomically(folder / "no/such/a.txt", nothing), IoError, says("no/such"));
    BOOST_CHECK_EXCEPTION(writeFileAtomically(folder.path(), nothing), IoError, says("is a directory"));
    BOOST_TEST(folder.entries() == 0U);
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_an_error_and_leaves_nothing)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.txt";
    BOOST_CHECK_THROW(writeFileAtomically(path, [](std::ostream& out) { out.setstate(std::ios::badbit); }), IoError);
    BOOST_TEST(folder.entries() == 0U);
}

BOOST_AUTO_TEST_CASE(permissions_are_those_of_an_ordinary_file)
{
    const TemporaryFolder folder;
    writeText(folder / "plain.txt", "x");
    writeFileAtomically(folder / "ours.txt", [](std::ostream& out) { out << "x"; });
    BOOST_CHECK(std::filesystem::status(folder / "plain.txt").permissions() ==
                std::filesystem::status(folder / "ours.txt").permissions());
}

BOOST_AUTO_TEST_CASE(a_file_that_is_replaced_gives_its_permissions)
{
    const TemporaryFolder folder;
    const auto path = folder / "private.txt";
    for (const fs::perms mode : {fs::perms::owner_read | fs::perms::owner_write, fs::perms::owner_all}) {
        writeText(path, "old");
        fs::permissions(path, mode);
        writeFileAtomically(path, [](std::ostream& out) { out << "new"; });
        BOOST_CHECK(fs::status(path).permissions() == mode);
        BOOST_TEST(readText(path) == "new");
    }
}

BOOST_AUTO_TEST_CASE(a_symbolic_link_stays_one)
{
    const TemporaryFolder folder;
    fs::create_directory(folder / "far");
    const auto target = folder / "far/a.txt", link = folder / "link.txt", loop = folder / "loop.txt";
    writeText(target, "old");
    fs::create_symlink("far/a.txt", link);
    writeFileAtomically(link, [](std::ostream& out) { out << "new"; });
    BOOST_TEST(fs::is_symlink(link));
    BOOST_TEST(readText(target) == "new");
    fs::create_symlink("loop.txt", loop);
    BOOST_CHECK_EXCEPTION(writeFileAtomically(loop, [](std::ostream&) {}), IoError,
                          says("loop.txt: cannot be written"));
    BOOST_TEST(fs::is_symlink(loop));
}

BOOST_AUTO_TEST_CASE(writers_can_seek)
{
    const TemporaryFolder folder;
    const auto path = folder / "a.bin";
    const std::string filling(200000, '.');
    writeFileAtomically(path, [&](std::ostream& out) {
        out << "????" << filling;
        const auto end = out.tellp();
        BOOST_TEST(end == std::ostream::pos_type(200004));
        out.seekp(0);
        out << "head";
        out.seekp(end);
        out << "tail";
    });
    BOOST_CHECK(readText(path) == "head" + filling + "tail");
}

BOOST_AUTO_TEST_CASE(a_failed_write_says_why)
{
    const TemporaryFolder folder;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{1000, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    std::string text;
    try {
        writeFileAtomically(folder / "a.txt", [](std::ostream& out) { out << std::string(2000, '.'); });
    } catch (const IoError& error) {
        text = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
    BOOST_TEST(text == (folder / "a.txt").string() + ": cannot be written: File too large");
    BOOST_TEST(folder.entries() == 0U);
}

BOOST_AUTO_TEST_CASE(a_set_appears_together)
{
    const TemporaryFolder folder;
    writeText(folder / "b.txt", "old b");
    PendingFiles files;
    for (const char* name : {"a.txt", "b.txt", "c.txt"}) {
        files.add(folder / name, [&](std::ostream& out) { out << "new " << name; });
        BOOST_TEST(!fs::exists(folder / "a.txt"));
        BOOST_TEST(readText(folder / "b.txt") == "old b");
    }
    files.commit();
    for (const char* name : {"a.txt", "b.txt", "c.txt"})
        BOOST_TEST(readText(folder / name) == std::string("new ") + name);
    BOOST_TEST(folder.entries() == 3U);
}

BOOST_AUTO_TEST_CASE(a_set_that_cannot_be_finished_is_taken_back)
{
    const TemporaryFolder folder;
    const auto made = folder / "made.txt", replaced = folder / "replaced.txt", blocked = folder / "blocked.txt";
    writeText(replaced, "old");
    PendingFiles files;
    for (const auto& path : {made, replaced, blocked}) {
        files.add(path, [](std::ostream& out) { out << "new"; });
    }
    fs::create_directory(blocked); // after it was found to be free
    BOOST_CHECK_EXCEPTION(files.commit(), IoError, says("blocked.txt: cannot be written: Is a directory"));
    BOOST_TEST(!fs::exists(made));
    BOOST_TEST(readText(replaced) == "old");
    BOOST_TEST(folder.entries() == 2U);
}

BOOST_AUTO_TEST_CASE(only_what_was_made_is_touched)
{
    const TemporaryFolder folder;
    const auto temporary = [&] {
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (entry.path().filename().string()[0] == '.') return entry.path();
        }
        return fs::path();
    };
    for (const bool commits : {false, true}) {
        fs::path other;
        {
            PendingFiles files;
            files.add(folder / "a.txt", [](std::ostream& out) { out << "new"; });
            other = temporary();
            BOOST_REQUIRE(!other.empty());
            fs::remove(other); // somebody else takes the name
            fs::create_directory(other);
            if (commits) BOOST_CHECK_THROW(files.commit(), IoError);
        }
        BOOST_TEST(fs::is_directory(other));
        BOOST_TEST(!fs::exists(folder / "a.txt"));
        fs::remove(other);
    }
}

BOOST_AUTO_TEST_CASE(temporary_names_are_never_the_same)
{
    const TemporaryFolder folder;
    std::set<std::string> names;
    for (int i = 0; i < 100; ++i) {
        PendingFiles files;
        files.add(folder / "a.txt", [](std::ostream&) {});
        for (const auto& entry : fs::directory_iterator(folder.path())) names.insert(entry.path().filename());
    }
    BOOST_TEST(names.size() == 100U);
}

BOOST_AUTO_TEST_CASE(names_that_are_too_long_are_refused_before_anything_is_written)
{
    const TemporaryFolder folder;
    requireWritable(folder / std::string(250, 'a'));
    writeFileAtomically(folder / std::string(250, 'a'), [](std::ostream& out) { out << "x"; });
    BOOST_CHECK_EXCEPTION(requireWritable(folder / std::string(256, 'a')), IoError, says("File name too long"));
    std::string deep = folder.path();
    while (deep.size() + 201 < 4090) {
        deep += '/' + std::string(200, 'd');
        fs::create_directory(deep);
    }
    const std::string longest = deep + '/' + std::string(4095 - deep.size() - 1, 'a');
    if (longest.size() < deep.size() + 20) BOOST_CHECK_EXCEPTION(requireWritable(longest), IoError, says("too long"));
}

BOOST_AUTO_TEST_SUITE_END()
