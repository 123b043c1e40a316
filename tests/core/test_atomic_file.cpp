#include <boost/test/unit_test.hpp>

#include <support/temporary_folder.h>
#include <vdbcage/core/atomic_file.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using test::readText;
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
    BOOST_CHECK_THROW(writePathAtomically(path, [](const auto&) { throw Cancelled(); }), Cancelled);
    BOOST_TEST(readText(path) == "old");
    BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(errors_name_the_path)
{
    const TemporaryFolder folder;
    const auto nothing = [](std::ostream&) {};
    const auto names = [](const std::string& text) {
        return [text](const IoError& error) { return std::string(error.what()).find(text) != std::string::npos; };
    };
    BOOST_CHECK_EXCEPTION(writeFileAtomically(folder / "no/such/a.txt", nothing), IoError, names("no/such"));
    BOOST_CHECK_EXCEPTION(writeFileAtomically(folder.path(), nothing), IoError, names("is a directory"));
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

BOOST_AUTO_TEST_SUITE_END()
