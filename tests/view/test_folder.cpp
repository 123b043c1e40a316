#include <boost/test/unit_test.hpp>

#include <filesystem>

#include <support/temporary_folder.h>
#include <tools/view/files/folder.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace {

std::string namesOf(const std::vector<FolderEntry>& entries)
{
    std::string names;
    for (const FolderEntry& entry : entries) names += entry.name + (entry.isFolder ? "/ " : " ");
    return names;
}

} // namespace

BOOST_AUTO_TEST_SUITE(folder)

BOOST_AUTO_TEST_CASE(folders_come_first_and_names_are_sorted_whatever_their_case)
{
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "zoo.obj");
    std::filesystem::create_directory(folder / ".hidden");
    for (const char* name : {"b.OBJ", "A.ply", "c.txt", ".d.obj"}) test::writeText(folder / name, "12345");
    BOOST_TEST(namesOf(listFolder(folder.path(), {}, "")) == "zoo.obj/ A.ply b.OBJ c.txt ");
    BOOST_TEST(namesOf(listFolder(folder.path(), {".obj", ".ply"}, "")) == "zoo.obj/ A.ply b.OBJ ");
    BOOST_TEST(namesOf(listFolder(folder.path(), {".obj", ".ply"}, "B.")) == "b.OBJ ");
    BOOST_TEST(namesOf(listFolder(folder.path(), {".obj"}, ".d")) == ".d.obj ");
    BOOST_TEST(listFolder(folder.path(), {}, "c.txt").front().bytes == 5u);
    BOOST_CHECK_THROW(listFolder(folder / "none", {}, ""), IoError);
    BOOST_CHECK_THROW(listFolder(folder / "c.txt", {}, ""), IoError);
}

BOOST_AUTO_TEST_CASE(recent_files_are_the_newest_first_and_those_that_are_there)
{
    const test::TemporaryFolder folder;
    const auto list = folder / "config" / "recent";
    BOOST_TEST(recentFiles(list).empty());
    for (int i = 0; i < 14; ++i) {
        const auto file = folder / (std::to_string(i) + ".obj");
        test::writeText(file, "x");
        addRecentFile(list, file);
    }
    addRecentFile(list, folder / "9.obj");
    auto files = recentFiles(list);
    BOOST_TEST_REQUIRE(files.size() == 10u);
    BOOST_TEST(files[0].filename() == "9.obj");
    BOOST_TEST(files[1].filename() == "13.obj");
    BOOST_TEST(files[9].filename() == "4.obj");
    std::filesystem::remove(folder / "13.obj");
    BOOST_TEST(recentFiles(list)[1].filename() == "12.obj");
    test::writeText(folder / "file", "x");
    addRecentFile(folder / "file" / "recent", folder / "9.obj"); // cannot be written: nothing happens
    addRecentFile({}, folder / "9.obj");
}

BOOST_AUTO_TEST_SUITE_END()
