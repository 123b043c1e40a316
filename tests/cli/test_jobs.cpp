#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include <sched.h>
#include <support/process.h>
#include <support/read_json.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using test::readJson;
using test::readText;
using test::runCommand;
using test::TemporaryFolder;
using test::writeText;

namespace {

const std::string command = VDBCAGE_COMMAND;
const std::string bishop = VDBCAGE_MODELS "/bishop.obj";

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

void expectRefusal(const std::vector<std::string>& words, const std::string& mention)
{
    std::vector<std::string> all{command};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = runCommand(all);
    BOOST_TEST(result.status == 1);
    BOOST_TEST(result.err.find(mention) != std::string::npos, result.err + " lacks " + mention);
    BOOST_TEST(result.out.empty());
}

/// How many threads of a process have worked for longer than a moment, and its exit status. Libraries start some that
/// only wait.
std::pair<std::size_t, int> workingThreads(const std::vector<std::string>& words)
{
    constexpr long moment = 2; // in ticks
    const TemporaryFolder own;
    const pid_t child = test::startCommand(words, own / "out", own / "err");
    std::map<std::string, long> ticks;
    while (!test::hasEnded(child)) {
        ::sched_yield();
        std::error_code ignored;
        for (const auto& task : std::filesystem::directory_iterator(test::procFolder(child) / "task", ignored)) {
            long& most = ticks[task.path().filename()];
            most = std::max(most, test::ticks(task.path()));
        }
    }
    std::size_t working = 0;
    for (const auto& thread : ticks) working += thread.second > moment;
    return {working, test::waitFor(child)};
}

} // namespace

BOOST_AUTO_TEST_SUITE(jobs)

BOOST_AUTO_TEST_CASE(a_line_for_each_model)
{
    const TemporaryFolder folder;
    const std::string out = folder / "cages";
    const auto result = runCommand({command,
                                    "jobs",
                                    "a/body.obj",
                                    "it's a \"model\".ply",
                                    "./-x.stl",
                                    "-o",
                                    out,
                                    "--faces",
                                    "120",
                                    "--density",
                                    "box:0,0,0,1,1,1,2",
                                    "--format",
                                    "ply",
                                    "--pictures",
                                    "--threads",
                                    "2",
                                    "--progress",
                                    "lines",
                                    "--memory",
                                    "2G"});
    BOOST_TEST(result.status == 0, result.err);
    const std::string options =
        " --skip-done --faces=120 --density=box:0,0,0,1,1,1,2 --memory=2G --progress=lines --threads=2";
    const auto line = [&](const std::string& model, const std::string& name) {
        const auto file = [&](const std::string& extension) {
            const std::string path = out + "/" + name + extension;
            return name == "-x" || name == "body" ? path : "'" + path + "'";
        };
        return "vdbcage make " + model + " -o " + file(".ply") + " --report " + file(".json") + " --picture " +
               file(".png") + options;
    };
    const std::vector<std::string> expected{
        line("a/body.obj", "body"), line("'it'\\''s a \"model\".ply'", "it'\\''s a \"model\""), line("./-x.stl", "-x")};
    BOOST_TEST(linesOf(result.out) == expected, boost::test_tools::per_element());
    BOOST_TEST(std::filesystem::is_directory(out));
}

BOOST_AUTO_TEST_CASE(what_is_no_job)
{
    const TemporaryFolder folder;
    const std::string out = folder / "cages";
    expectRefusal({"jobs", "a/x.obj", "b/x.obj", "-o", out}, "b/x.obj: another model has this name too");
    expectRefusal({"jobs", "a\nb.obj", "-o", out}, "cannot have control characters");
    writeText(folder / "x.obj", "");
    expectRefusal({"jobs", folder / "x.obj", "-o", folder.path()}, "x.obj: the cage of x would replace it");
    expectRefusal({"jobs", "a.obj", "-o", out, "--faces", "3"}, "faces: '3' is not allowed");
    expectRefusal({"jobs", "a.obj", "-o", out, "--format", "vdb"}, ".obj");
    expectRefusal({"jobs", "a.obj", "-o", out, "--memory", "2X"}, "--memory: '2X' is not allowed");
    expectRefusal({"jobs", "a.obj", "-o", out, "--progress", "rarely"}, "progress: 'rarely' is neither auto nor lines");
    expectRefusal({"jobs", "a.obj", "-o", out, "--report", "x.json"}, "there is no option '--report'");
    const std::string joints = folder / "joints\n.txt";
    writeText(joints, "0 0 0\n");
    expectRefusal({"jobs", "a.obj", "-o", out, "--joints", joints}, "joints\\n.txt': a job is a line");
    expectRefusal({"jobs", "a.obj", "-o", out, "--tight", "1"}, "--tight: it needs --fit CAGE");
    const auto expectNoFit = [&](std::vector<std::string> words, const std::string& mention) {
        words.insert(words.begin(), {"jobs", "--fit", "cage.obj", "a.obj", "-o", out});
        expectRefusal(words, mention);
    };
    expectNoFit({"--tight", "2"}, "--tight: 2 is not allowed; it must be 0 to 1");
    expectNoFit({"--tight", "much"}, "--tight: 'much' is not allowed; it must be a number");
    expectNoFit({"--keep", "points:3-1"}, "'3-1' is not allowed; it must be numbers of points, as 1-20,35");
    expectNoFit({"--keep", "points:1\n2"}, "a job is a line, and cannot have control characters");
    expectNoFit({"--progress", "rarely"}, "progress: 'rarely' is neither auto nor lines");
    for (const std::string option : {"--faces=60", "--memory=2G", "--format=obj", "--pictures"}) {
        const std::string name = option.substr(0, option.find('='));
        expectNoFit({option}, name + ": it does not go with --fit; the options of vdbcage fit do");
    }
    expectNoFit({"--least", "1"}, "there is no option '--least'");
    expectNoFit({"b/a.obj"}, "b/a.obj: another model has this name too");
    expectRefusal({"jobs", "--fit", "cage.vdb", "a.obj", "-o", out}, "cage.vdb: the file name ends in \".vdb\"");
    expectRefusal({"jobs", "--fit", "ca\nge.obj", "a.obj", "-o", out}, "cannot have control characters");
    expectRefusal({"jobs", "--fit", folder / "x.obj", "a/x.obj", "-o", folder.path()},
                  "x.obj: the cage of x would replace it; choose another folder");
    BOOST_TEST(!std::filesystem::exists(out));
}

// By the shell, as farms run them.
BOOST_AUTO_TEST_CASE(jobs_run_once_and_failed_ones_again)
{
    const TemporaryFolder folder;
    const std::string out = folder / "the cages", good = folder / "good.obj", bad = folder / "bad one.obj";
    std::filesystem::copy_file(bishop, good);
    writeText(bad, "v 0 0\n");
    const auto listed =
        runCommand({command, "jobs", good, bad, "-o", out, "--faces", "60", "--effort", "fast", "--command", command});
    BOOST_REQUIRE(listed.status == 0);
    const std::vector<std::string> lines = linesOf(listed.out);
    BOOST_REQUIRE(lines.size() == 2U);
    const auto run = [&](std::size_t i) { return runCommand({"sh", "-c", lines[i]}); };
    BOOST_TEST(run(0).status == 0);
    const std::string cage = readText(out + "/good.obj"), report = readText(out + "/good.json");
    BOOST_TEST(readJson(out + "/good.json")["check"]["bounding"] == true);

    const auto failed = run(1);
    BOOST_TEST(failed.status == 1);
    BOOST_TEST(!std::filesystem::exists(out + "/bad one.obj"));
    const nlohmann::json failure = readJson(out + "/bad one.json");
    BOOST_TEST(failure["exit_status"] == 1);
    BOOST_TEST(failed.err == "vdbcage: error: " + failure["error"].get<std::string>() + "\n");
    BOOST_TEST(failure["models"][0]["file"] == bad);
    BOOST_TEST(failure["options"]["faces"] == 60);

    const auto again = run(0);
    BOOST_TEST(again.status == 0);
    BOOST_TEST(again.err == out + "/good.obj: was done before\n");
    BOOST_TEST((readText(out + "/good.json") == report));
    BOOST_TEST(run(1).status == 1);
    std::filesystem::copy_file(bishop, bad, std::filesystem::copy_options::overwrite_existing);
    BOOST_TEST(run(1).status == 0);
    BOOST_TEST(readJson(out + "/bad one.json")["error"].is_null());

    // Where anything is another, or gone, it is done anew.
    const auto isDoneAnew = [&] { return run(0).err.find("certified bounding") != std::string::npos; };
    BOOST_TEST(!isDoneAnew());
    std::filesystem::remove(out + "/good.obj");
    BOOST_TEST(isDoneAnew());
    BOOST_TEST((readText(out + "/good.obj") == cage));
    for (const char* broken : {"{", "", "[]", "{\"cage\": 5, \"inputs\": null}"}) {
        writeText(out + "/good.json", broken);
        BOOST_TEST(isDoneAnew(), broken);
    }
    writeText(good, readText(good) + "# changed\n");
    BOOST_TEST(isDoneAnew());
    BOOST_TEST(!isDoneAnew());
    const auto others = runCommand({"sh", "-c", lines[0] + " --smooth 1"});
    BOOST_TEST(others.err.find("certified bounding") != std::string::npos, others.err);
    expectRefusal({"make", good, "-o", folder / "x.obj", "--skip-done"}, "--skip-done needs --report");
    const std::string picture = folder / "p.png"; // what is asked for beside must be there, too
    const auto drawn = [&] { return runCommand({"sh", "-c", lines[0] + " --smooth 1 --picture " + picture}).err; };
    BOOST_TEST(drawn().find("certified bounding") != std::string::npos);
    BOOST_TEST(drawn().find("was done before") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_line_of_fit_for_each_model)
{
    const TemporaryFolder folder;
    const std::string out = folder / "fits";
    const auto result = runCommand({command, "jobs", "--fit", "a cage.ply", "a/body.obj", "b/the body.stl", "-o", out,
                                    "--command", "/opt/vdbcage", "--keep", "points:1-20,35", "--tight=0.7", "--threads",
                                    "2", "--progress", "lines"});
    BOOST_TEST(result.status == 0, result.err);
    const std::string start = "/opt/vdbcage fit 'a cage.ply' ";
    const std::string options = " --skip-done --tight=0.7 --keep=points:1-20,35 --progress=lines --threads=2";
    const std::vector<std::string> expected{
        start + "a/body.obj -o " + out + "/body.ply --report " + out + "/body.json" + options,
        start + "'b/the body.stl' -o '" + out + "/the body.ply' --report '" + out + "/the body.json'" + options};
    BOOST_TEST(linesOf(result.out) == expected, boost::test_tools::per_element());
    BOOST_TEST(std::filesystem::is_directory(out));
}

// By the shell, as farms run them.
BOOST_AUTO_TEST_CASE(fits_run_once_and_again_where_anything_changed)
{
    const TemporaryFolder folder;
    const std::string cage = folder / "a cage.obj", out = folder / "the fits", kept = folder / "kept.txt";
    const std::vector<std::string> names{"ball", "wide ball"};
    const std::vector<std::string> models{folder / "ball.obj", folder / "wide ball.obj"};
    writeMesh(test::sphere({0, 0, 0}, 0.9, 4), cage);
    writeMesh(test::sphere({0.1, 0, 0}, 1, 8), models[0]);
    writeMesh(test::sphere({0, 0.2, 0}, 1.3, 8), models[1]);
    const auto listed =
        runCommand({command, "jobs", "--fit", cage, models[0], models[1], "-o", out, "--command", command});
    BOOST_TEST_REQUIRE(listed.status == 0, listed.err);
    const std::vector<std::string> lines = linesOf(listed.out);
    BOOST_TEST_REQUIRE(lines.size() == 2U);
    const auto file = [&](std::size_t i, const char* extension) { return out + "/" + names[i] + extension; };
    const auto run = [&](std::size_t i, const std::string& more = "") {
        return runCommand({"sh", "-c", lines[i] + more});
    };
    const auto isDoneAnew = [&](std::size_t i, const std::string& more = "") {
        const auto result = run(i, more);
        BOOST_TEST(result.status == 0, result.err);
        const bool wasDone = result.err == file(i, ".obj") + ": was done before\n";
        BOOST_TEST((result.out.find(": bounding\n") != std::string::npos) == !wasDone, result.out + result.err);
        return !wasDone;
    };
    for (std::size_t i = 0; i < 2; ++i) {
        BOOST_TEST(isDoneAnew(i));
        BOOST_TEST(checkCage(readMesh(file(i, ".obj")), readMesh(models[i])).bounding());
        BOOST_TEST(readJson(file(i, ".json"))["fitted"] == file(i, ".obj"));
    }
    const std::string fitted = readText(file(0, ".obj")), report = readText(file(0, ".json"));
    for (const char* more : {"", " -q", " --threads 2"}) {
        const auto again = run(0, more);
        BOOST_TEST(again.status == 0);
        BOOST_TEST(again.out.empty(), again.out);
        BOOST_TEST((readText(file(0, ".json")) == report));
    }
    BOOST_TEST(!isDoneAnew(1));
    const auto listing = runCommand({command, "report", out});
    BOOST_TEST(listing.status == 0, listing.err);
    BOOST_TEST(listing.out.find("2 jobs: 2 certified\n") != std::string::npos, listing.out);

    std::filesystem::remove(file(0, ".obj"));
    BOOST_TEST(isDoneAnew(0));
    BOOST_TEST((readText(file(0, ".obj")) == fitted));
    for (const char* broken : {"{", "", "[]", "{\"fitted\": 5, \"inputs\": null}"}) {
        writeText(file(0, ".json"), broken);
        BOOST_TEST(isDoneAnew(0), broken);
    }
    BOOST_TEST(isDoneAnew(0, " --tight 1"));
    BOOST_TEST(!isDoneAnew(0, " --tight 1"));
    writeText(models[0], readText(models[0]) + "# changed\n");
    BOOST_TEST(isDoneAnew(0));
    BOOST_TEST(!isDoneAnew(0));
    BOOST_TEST(!isDoneAnew(1)); // has another model
    writeText(cage, readText(cage) + "# changed\n");
    for (std::size_t i = 0; i < 2; ++i) {
        BOOST_TEST(isDoneAnew(i));
        BOOST_TEST(!isDoneAnew(i));
    }

    // One that failed is tried again, and the change of a file of --keep counts.
    const std::string keep = " --keep '" + kept + "'";
    writeText(kept, "0-" + std::to_string(readMesh(cage).points.size() - 1));
    for (int i = 0; i < 2; ++i) {
        const auto failed = run(0, keep);
        BOOST_TEST(failed.status == 1);
        const nlohmann::json failure = readJson(file(0, ".json"));
        BOOST_TEST(failure["exit_status"] == 1);
        BOOST_TEST(failed.err == "vdbcage: error: " + failure["error"].get<std::string>() + "\n");
    }
    const auto told = runCommand({command, "report", out});
    BOOST_TEST(told.status == 2);
    BOOST_TEST(told.out.find("2 jobs: 1 certified, 1 failed\n") != std::string::npos, told.out);
    std::filesystem::copy_file(cage, models[0], std::filesystem::copy_options::overwrite_existing);
    writeMesh(test::sphere({0, 0, 0}, 1.5, 4), cage);
    writeText(kept, "0");
    BOOST_TEST(isDoneAnew(0, keep));
    BOOST_TEST(!isDoneAnew(0, keep));
    writeText(kept, "1");
    BOOST_TEST(isDoneAnew(0, keep));
    expectRefusal({"fit", cage, models[0], "-o", folder / "x.obj", "--skip-done"}, "--skip-done needs --report");
}

BOOST_AUTO_TEST_CASE(reports_of_many_jobs)
{
    const TemporaryFolder folder;
    const std::string out = folder / "out", csv = folder / "all.csv", html = folder / "all.html";
    std::filesystem::create_directory(out);
    const auto make = [&](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> words{
            command,    "make", bishop, "-o", out + "/" + name + ".obj", "--report", out + "/" + name + ".json",
            "--effort", "fast", "-q"};
        words.insert(words.end(), options.begin(), options.end());
        BOOST_TEST(runCommand(words).status == 0);
    };
    make("tight", {"--faces", "200", "--picture", out + "/tight.png"});
    make("loose", {"--faces", "20"});
    BOOST_TEST(runCommand({command, "report", out}).status == 0);
    const std::string bad = folder / "a, \"b\" <c>.obj";
    writeText(bad, "v 0 0\n");
    runCommand({command, "make", bad, "-o", out + "/bad.obj", "--report", out + "/bad.json"});
    writeText(out + "/other.json", "{\"vdbcage\": 1}");
    writeText(out + "/empty.json", "");

    const auto told = runCommand({command, "report", out, "--csv", csv, "--html", html});
    BOOST_TEST(told.status == 2);
    const std::vector<std::string> lines = linesOf(told.out);
    BOOST_REQUIRE(lines.size() == 5U);
    const std::string failure = readJson(out + "/bad.json")["error"];
    BOOST_TEST(lines[1] == "bad    FAILED   1  " + failure);
    BOOST_TEST(lines[2].find("loose  certified") == 0U);
    BOOST_TEST(lines[3].find("tight  certified") == 0U);
    BOOST_TEST(lines[4] == "3 jobs: 2 certified, 1 failed");

    const std::vector<std::string> rows = linesOf(readText(csv));
    BOOST_REQUIRE(rows.size() == 4U);
    BOOST_TEST(std::count(rows[0].begin(), rows[0].end(), ',') == 13);
    BOOST_TEST(rows[1].find(",\"" + folder.path().string() + "/a, \"\"b\"\" <c>.obj\",1,") != std::string::npos,
               rows[1]);
    BOOST_TEST(std::count(rows[3].begin(), rows[3].end(), ',') == 13);
    BOOST_TEST(rows[3].find(",0,,true,") != std::string::npos, rows[3]);

    const std::string page = readText(html);
    BOOST_TEST(page.find("&lt;c&gt;.obj") != std::string::npos);
    BOOST_TEST(page.find("<c>") == std::string::npos);
    BOOST_TEST(page.find(">bad<") < page.find(">loose<"));
    BOOST_TEST(page.find(">loose<") < page.find(">tight<"));
    BOOST_TEST(page.find(">tight<") != std::string::npos);
    const auto picture = page.find("<img ");
    const auto data = page.find("src=\"data:image/png;base64,iVBORw0KGgo"); // how every PNG begins
    BOOST_TEST(data != std::string::npos);
    BOOST_TEST(data > picture);
    BOOST_TEST(page.find("<img ", picture + 1) == std::string::npos);
    for (const char* link : {"src=\"http", "href=", "url("}) BOOST_TEST(page.find(link) == std::string::npos, link);

    BOOST_TEST(runCommand({command, "report", out + "/tight.json"}).status == 0);
    expectRefusal({"report", "--csv", out + "/tight.json", out}, "tight.json: the name must end in .csv");
    std::filesystem::copy_file(out + "/tight.json", folder / "tight.csv");
    expectRefusal({"report", folder / "tight.csv", "--csv", folder / "tight.csv"}, "tight.csv");
    // What lies beside the report of a failure is of an earlier cage.
    std::filesystem::copy_file(out + "/tight.png", out + "/bad.png");
    runCommand({command, "report", out, "--html", folder / "again.html"});
    BOOST_TEST((readText(folder / "again.html") == page));
    writeMesh(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}, folder / "open.obj");
    BOOST_TEST(runCommand({command, "make", folder / "open.obj", "-o", folder / "open.ply", "--report",
                           folder / "open.json", "--faces", "20"})
                   .status == 0);
    const std::string open = runCommand({command, "report", folder / "open.json", "--csv", folder / "open.csv"}).out;
    BOOST_TEST(std::regex_search(open, std::regex(" % +- +[0-9.]+ +[0-9]+\n")), open);
    // The volume is empty, between distance and angle.
    const std::string openRow = readText(folder / "open.csv");
    BOOST_TEST(std::regex_search(openRow, std::regex(",true,[0-9]+,[0-9]+,[^,]+,[^,]+,,[0-9]")), openRow);
    expectRefusal({"report", out + "/other.json"}, "other.json: it is no report of vdbcage make or fit");
    expectRefusal({"report", folder / "none"}, "none: cannot be read");
    std::filesystem::create_directory(folder / "nothing");
    expectRefusal({"report", folder / "nothing"}, "there are no reports of vdbcage make or fit");
    writeText(out + "/tight.png", "PNG");
    expectRefusal({"report", out, "--html", html}, "tight.png: it is no PNG picture");
    BOOST_TEST((readText(html) == page));
}

BOOST_AUTO_TEST_CASE(progress_in_lines)
{
    const TemporaryFolder folder;
    const auto result = runCommand({command, "make", bishop, "-o", folder / "cage.obj", "--faces", "100", "--effort",
                                    "fast", "-q", "--progress", "lines"});
    BOOST_TEST(result.status == 0);
    BOOST_TEST(result.err.empty(), result.err);
    const std::vector<std::string> lines = linesOf(result.out);
    int last = -1;
    BOOST_TEST(lines.size() > 10U);
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
        std::smatch match;
        BOOST_REQUIRE(std::regex_match(lines[i], match, std::regex("Progress: ([0-9]+)%")));
        const int percent = std::stoi(match[1]);
        BOOST_TEST(percent > last);
        BOOST_TEST(lines[i + 1] == "ALF_PROGRESS " + std::to_string(percent) + "%");
        last = percent;
    }
    BOOST_TEST(last == 100);
    writeText(folder / "bad.obj", "v 0 0\n");
    const auto bad =
        runCommand({command, "make", folder / "bad.obj", "-o", folder / "cage.obj", "--progress", "lines"});
    BOOST_TEST(bad.status == 1);
    BOOST_TEST(bad.out.find("100%") == std::string::npos, bad.out);
    expectRefusal({"make", bishop, "-o", folder / "cage.obj", "--progress", "rarely"},
                  "progress: 'rarely' is neither auto nor lines");
}

BOOST_AUTO_TEST_CASE(one_thread)
{
    const TemporaryFolder folder;
    const auto words = [&](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> all{command, "make",     bishop, "-o",        folder / (name + ".obj"), "--faces",
                                     "100",   "--effort", "fast", "--picture", folder / (name + ".png")};
        all.insert(all.end(), options.begin(), options.end());
        return all;
    };
    for (const char* voxelizer : {"cpu", "gl"}) {
        const auto [one, status] = workingThreads(words("one", {"--threads", "1", "--voxelizer", voxelizer}));
        BOOST_TEST(status == 0);
        BOOST_TEST(one == 1U, voxelizer << ": " << one << " threads");
        const auto [two, statusOfTwo] = workingThreads(words("two", {"--threads", "2", "--voxelizer", voxelizer}));
        BOOST_TEST(statusOfTwo == 0);
        if (std::thread::hardware_concurrency() > 1) BOOST_TEST(two > 1U); // so more would be seen
        BOOST_TEST((readText(folder / "one.obj") == readText(folder / "two.obj")));
        BOOST_TEST((readText(folder / "one.png") == readText(folder / "two.png")));
    }
    expectRefusal({"check", bishop, bishop, "--threads", "0"}, "threads: 0 is not allowed; it must be 1 to 1024");
}

BOOST_AUTO_TEST_SUITE_END()
