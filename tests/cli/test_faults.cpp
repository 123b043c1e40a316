// Signals at any time, allocations and threads that fail, disks that fill up: no crash, the old or the new file whole,
// nothing left. VDBCAGE_FAULTS=N multiplies the numbers of runs by N.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

#include <sched.h>

#include <support/process.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/deform/weights_io.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/volume/vdb_io.h>

using namespace vdbcage;
using test::hasEnded;
using test::runCommand;
using test::TemporaryFolder;
using test::ticks;
namespace fs = std::filesystem;

namespace {

const std::string command = VDBCAGE_COMMAND;

int times(int runs)
{
    const char* more = std::getenv("VDBCAGE_FAULTS");
    return runs * (more ? std::atoi(more) : 1);
}

using Contents = std::map<std::string, std::string>;

/// A command that works on what a Folder has.
struct Work {
    std::string name;
    std::vector<std::string> words; // @ stands for the folder
    bool isDrawn = false;           // by drivers, which do not all live through a lack of memory
};

/// Each is done some twenty times. Those that take longest have few voxels: two starts side by side, voxels as wide as
/// the surface asks for, and half of a resolution beside it are in quicker ones.
std::vector<Work> works()
{
    std::vector<Work> all{
        {"few faces",
         {"make", "@model.obj", "-o", "@o.obj", "--faces", "60", "--effort", "fast", "--report", "@r.json"}},
        {"halves", {"make", "@model.obj", "-o", "@o.obj", "--faces", "100", "--effort", "fast", "--resolution", "48"}},
        {"best", {"make", "@model.obj", "-o", "@o.obj", "--faces", "100", "--effort", "best", "--resolution", "24"}},
        {"fair quads",
         {"make", "@model.obj", "-o", "@o.obj", "--mesh", "quads", "--faces", "100", "--resolution", "24", "--symmetry",
          "auto", "--picture", "@p.png"},
         true},
        {"stages",
         {"make", "@model.obj", "-o", "@o.obj", "--effort", "fast", "--stages", "@st", "--report", "@r.json"}},
        {"check", {"check", "@cage.obj", "@model.obj", "--report", "@r.json"}},
        {"fit", {"fit", "@cage.obj", "@model.obj", "-o", "@o.obj", "--report", "@r.json"}},
        {"bind mlc", {"bind", "@cage.obj", "@model.obj", "-o", "@w.npy", "--coordinates", "mlc"}},
        {"bind harmonic",
         {"bind", "@cage.obj", "@model.obj", "-o", "@w.npy", "--coordinates", "harmonic", "--resolution", "16"}},
        {"bind biharmonic", {"bind", "@few.obj", "@model.obj", "-o", "@w.npy", "--coordinates", "biharmonic"}},
        {"bind somigliana", {"bind", "@few.obj", "@model.obj", "-o", "@w.npy", "--coordinates", "somigliana"}},
        {"deform", {"deform", "@cage.obj", "@pose.%02d.obj", "@model.obj", "-o", "@d.%02d.obj"}},
        {"deform by weights",
         {"deform", "@cage.obj", "@pose.%02d.obj", "@model.obj", "-o", "@d.%02d.obj", "--weights", "@mvc.npy"}},
        {"render", {"render", "@model.obj", "@cage.obj", "/", "@solid.vdb", "-o", "@p.png"}, true}};
    if (VDBCAGE_HAS_GPL_PART) all.push_back({"repair", {"repair", "@open.obj", "-o", "@o.obj"}});
    return all;
}

Work workNamed(const std::string& name)
{
    for (const Work& work : works()) {
        if (work.name == name) return work;
    }
    throw std::logic_error("there is no such work");
}

/// A folder with a model, its cage, poses, a volume, and old files where outputs go.
class Folder {
public:
    Folder()
    {
        const Mesh model = test::joined(test::sphere({0, 0, 0}, 1, 24), test::torus(2, 0.2, 64, 16));
        writeMesh(model, folder_ / "model.obj");
        const Mesh cage = test::sphere({0, 0, 0}, 3.5, 10);
        writeMesh(cage, folder_ / "cage.obj");
        Mesh open = test::sphere({0, 0, 0}, 3.5, 6);
        writeMesh(open, folder_ / "few.obj");
        open.quads.resize(open.quads.size() - 5);
        writeMesh(open, folder_ / "open.obj");
        writeWeights(cage, model.points, Coordinates::meanValue,
                     computeWeights(cage, model.points, Coordinates::meanValue), folder_ / "mvc.npy");
        for (int i = 0; i < 6; ++i) {
            writeMesh(test::transformed(cage, 1 + 0.1 * i, {0, 0, 0}),
                      folder_ / ("pose.0" + std::to_string(i) + ".obj"));
        }
        const auto solid = openvdb::MaskGrid::create();
        solid->sparseFill(openvdb::CoordBBox(openvdb::Coord(-10), openvdb::Coord(10)), true);
        writeVdb(*solid, folder_ / "solid.vdb");
        for (const char* name : {"o.obj", "r.json", "p.png", "w.npy", "d.00.obj", "d.03.obj"})
            test::writeText(folder_ / name, "old");
        start_ = contents();
    }

    std::vector<std::string> words(const Work& work) const
    {
        std::vector<std::string> all{command};
        for (std::string word : work.words) {
            if (word[0] == '@') word.replace(0, 1, folder_.path().string() + "/");
            all.push_back(word);
        }
        return all;
    }

    /// Whether all is as before the command, or all as after it, whose outputs are whole then: never something between.
    /// A report may tell of a failure with exit status `status`, if that is not 0.
    boost::test_tools::predicate_result isOldOrNew(const Contents& finished, int status = 0) const
    {
        Contents now = contents();
        std::string& report = now[(folder_ / "r.json").string()];
        const std::string failure = "\n  \"exit_status\": " + std::to_string(status) + ",\n";
        if (status != 0 && report.find(failure) != std::string::npos) report = "old";
        if (now == start_) return true;
        // What differs from run to run: times in reports, identifiers in .vdb files.
        const auto isSame = [&](const std::string& name, const std::string& text) {
            const auto expected = finished.find(name);
            if (expected == finished.end()) return false;
            const std::string extension = fs::path(name).extension();
            return extension == ".json"  ? (text == "old") == (expected->second == "old")
                   : extension == ".vdb" ? text.size() == expected->second.size()
                                         : text == expected->second;
        };
        boost::test_tools::predicate_result answer(now.size() == finished.size());
        answer.message() << now.size() << " files for " << start_.size() << " or " << finished.size();
        for (const auto& [name, text] : now) {
            if (isSame(name, text)) continue;
            answer = false;
            answer.message() << ", " << name << " of " << text.size() << " bytes";
        }
        return answer;
    }

    void reset() const
    {
        for (const auto& [name, text] : contents()) {
            if (start_.count(name) == 0) fs::remove_all(name);
        }
        for (const auto& [name, text] : start_) test::writeText(name, text);
    }

    Contents contents() const
    {
        Contents all;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
            all[entry.path().string()] = entry.is_regular_file() ? test::readText(entry.path()) : "";
        }
        return all;
    }

private:
    TemporaryFolder folder_;
    Contents start_;
};

/// What stands behind a word in /proc/PID/FILE.
std::string procValue(pid_t process, const char* file, const std::string& word)
{
    const std::string text = test::readText(test::procFolder(process) / file);
    const auto at = text.find(word);
    return at == std::string::npos ? "" : text.substr(at + word.size(), text.find('\n', at) - at - word.size());
}

/// Starts `words`, sends `signal` once the command listens and `isTime` says so, and waits for its end.
test::CommandResult runSignalled(const std::vector<std::string>& words, int signal,
                                 const std::function<bool(pid_t)>& isTime)
{
    const TemporaryFolder own;
    const pid_t child = test::startCommand(words, own / "out", own / "err");
    const auto listens = [&] {
        const std::string caught = procValue(child, "status", "SigCgt:");
        return !caught.empty() && (std::stoull(caught, nullptr, 16) >> (SIGTERM - 1) & 1U) != 0;
    };
    while (!hasEnded(child) && !listens()) ::sched_yield();
    while (!hasEnded(child) && !isTime(child)) ::sched_yield();
    ::kill(child, signal);
    test::CommandResult result;
    result.status = test::waitFor(child);
    result.out = test::readText(own / "out");
    result.err = test::readText(own / "err");
    return result;
}

#ifdef VDBCAGE_FAILING_CALLS
std::vector<std::string> withFailing(const std::string& what, const std::vector<std::string>& words)
{
    std::vector<std::string> all{"env", "LD_PRELOAD=" VDBCAGE_FAILING_CALLS, what};
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

bool isOneErrorLine(const std::string& text)
{
    return text.rfind("vdbcage: error: ", 0) == 0 && std::count(text.begin(), text.end(), '\n') == 1 &&
           text.back() == '\n';
}
#endif

} // namespace

BOOST_AUTO_TEST_SUITE(faults)

BOOST_AUTO_TEST_CASE(signals_at_any_time)
{
    const Folder folder;
    std::mt19937 random(1);
    int cancelled = 0, runs = 0;
    for (const Work& work : works()) {
        const auto words = folder.words(work);
        // How much work there is, in ticks of its time, so that moments are spread over all of it.
        const TemporaryFolder own;
        long most = 0;
        const pid_t whole = test::startCommand(words, own / "out", own / "err");
        while (!hasEnded(whole)) most = std::max(most, ticks(test::procFolder(whole)));
        BOOST_TEST(test::waitFor(whole) == 0, work.name + ": " + test::readText(own / "err"));
        const Contents finished = folder.contents();
        for (int run = 0; run < times(4); ++run, ++runs) {
            folder.reset();
            const int signal = std::array{SIGINT, SIGTERM, SIGHUP, SIGPIPE}[random() % 4];
            // In the middle of the work, or where files are.
            const bool byFiles = run % 2 == 1;
            const long moment = static_cast<long>(random() % static_cast<unsigned long>(most + 1));
            const std::size_t files = folder.contents().size() + 1 + random() % 3;
            const auto result = runSignalled(words, signal, [&](pid_t process) {
                return byFiles ? folder.contents().size() >= files : ticks(test::procFolder(process)) >= moment;
            });
            BOOST_TEST_CONTEXT(work.name << ", signal " << signal << " at " << (byFiles ? "file " : "tick ")
                                         << (byFiles ? static_cast<long>(files) : moment))
            {
                const int status = signal == SIGTERM ? 143 : 130;
                BOOST_TEST((result.status == status || result.status == 0), result.status);
                if (result.status == status) BOOST_TEST(result.err == "vdbcage: error: cancelled\n");
                BOOST_TEST(folder.isOldOrNew(finished, result.status));
                BOOST_TEST((result.status != 0 || folder.contents().size() == finished.size()));
            }
            cancelled += result.status > 128;
        }
        folder.reset();
    }
    BOOST_TEST_MESSAGE(cancelled << " of " << runs << " runs were cancelled");
    BOOST_TEST(cancelled > runs / 8); // else the moments are chosen badly
}

BOOST_AUTO_TEST_CASE(drawing_stops_when_it_is_told_to)
{
    const Folder folder;
    auto words =
        folder.words({"render", {"render", "@model.obj", "@cage.obj", "-o", "@p.png", "--size", "12000x12000"}});
    const auto result =
        runSignalled(words, SIGINT, [&](pid_t process) { return ticks(test::procFolder(process)) > 20; });
    BOOST_TEST(result.status == 130);
    BOOST_TEST(result.err == "vdbcage: error: cancelled\n");
    BOOST_TEST(folder.isOldOrNew({}));
}

BOOST_AUTO_TEST_CASE(a_hang_up_that_the_caller_ignores_is_ignored)
{
    const Folder folder;
    auto words = folder.words(workNamed("check"));
    words.insert(words.begin(), "nohup");
    const auto result = runSignalled(words, SIGHUP, [](pid_t) { return true; });
    BOOST_TEST(result.status == 0, result.err);
}

#ifdef VDBCAGE_FAILING_CALLS

/// What `work` asks for: how many allocations, and how many bytes it writes into files.
struct Asked {
    unsigned long allocations = 0, bytes = 0;
};
Asked countAsked(const std::vector<std::string>& words)
{
    const TemporaryFolder own;
    const auto result = runCommand(withFailing("COUNT=" + (own / "count").string(), words));
    BOOST_TEST(result.status == 0, result.err);
    Asked asked;
    std::ifstream(own / "count") >> asked.allocations >> asked.bytes;
    return asked;
}

/// `runs` numbers from 1 to `count`, in equal steps from the middle of the first one on.
std::vector<unsigned long> swept(unsigned long count, int runs)
{
    std::vector<unsigned long> all;
    for (int run = 0; run < runs; ++run) {
        const double at = (run + 0.5) / runs * static_cast<double>(count);
        all.push_back(std::max(1UL, static_cast<unsigned long>(at)));
    }
    return all;
}

BOOST_AUTO_TEST_CASE(an_allocation_that_fails)
{
    const Folder folder;
    int runs = 0, failed = 0;
    for (const Work& work : works()) {
        if (work.isDrawn) continue;
        folder.reset();
        const auto words = folder.words(work);
        const unsigned long allocations = countAsked(words).allocations;
        const Contents finished = folder.contents();
        BOOST_TEST(allocations > 1000U);
        // Over all, where little has been done yet, and where files are written.
        std::vector<unsigned long> places = swept(allocations, times(4));
        for (const unsigned long early : swept(1000, times(2))) places.push_back(early);
        for (const unsigned long late : swept(1000, times(2))) places.push_back(allocations - 1000 + late);
        // Exact numbers are made in a hundredth of its time; CGAL's own for that freed what they never had.
        if (work.name == "repair") {
            for (const unsigned long place : swept(allocations, 120)) places.push_back(place);
        }
        for (std::size_t i = 0; i < places.size(); ++i, ++runs) {
            folder.reset();
            const bool goesOn = i % 2 == 1;
            const std::string fault =
                (goesOn ? "FAIL_ALLOCATIONS_FROM=" : "FAIL_ALLOCATION=") + std::to_string(places[i]);
            const auto result = runCommand(withFailing(fault, words));
            BOOST_TEST_CONTEXT(work.name << ", " << fault << ": " << result.status << " " << result.err)
            {
                BOOST_TEST(folder.isOldOrNew(finished, result.status));
                // Some libraries can do without what they asked for. What fails before main is the loader's to tell.
                const bool isLoader = result.status == 127 ||
                                      result.err.find("error while loading shared libraries") != std::string::npos;
                BOOST_TEST((result.status == 0 || isLoader || (result.status == 75 && isOneErrorLine(result.err))));
            }
            failed += result.status == 75;
        }
    }
    BOOST_TEST_MESSAGE(failed << " of " << runs << " runs lacked memory");
    BOOST_TEST(failed > runs / 2);
}

BOOST_AUTO_TEST_CASE(disks_that_are_full)
{
    const Folder folder;
    int runs = 0, failed = 0;
    for (const Work& work : works()) {
        folder.reset();
        const auto words = folder.words(work);
        const unsigned long bytes = countAsked(words).bytes;
        const Contents finished = folder.contents();
        BOOST_TEST(bytes > 100U);
        std::vector<unsigned long> places = swept(bytes, times(3));
        places.insert(places.begin(), 0);
        for (std::size_t i = 0; i < places.size(); ++i, ++runs) {
            folder.reset();
            const auto result = runCommand(withFailing("FULL_DISK=" + std::to_string(places[i]), words));
            BOOST_TEST_CONTEXT(work.name << ", full after byte " << places[i] << " of " << bytes << ": "
                                         << result.status << " " << result.err)
            {
                BOOST_TEST((result.status == 75 && isOneErrorLine(result.err)));
                BOOST_TEST(result.err.find("No space left on device") != std::string::npos);
                BOOST_TEST(folder.isOldOrNew({}, result.status));
            }
            failed += result.status == 75;
        }
    }
    BOOST_TEST_MESSAGE(failed << " of " << runs << " runs lacked room on the disk");
}

BOOST_AUTO_TEST_CASE(threads_that_cannot_be_started)
{
    const Folder folder;
    for (const char* name : {"few faces", "render"}) {
        const Work work = workNamed(name);
        const auto words = folder.words(work);
        for (int most = 0; most <= 24; most += most < 8 ? 1 : 4) {
            folder.reset();
            const auto result = runCommand(withFailing("MOST_THREADS=" + std::to_string(most), words));
            BOOST_TEST_CONTEXT(work.name << ", at most " << most << " threads"
                                         << ": " << result.status << " " << result.err)
            {
                BOOST_TEST((result.status == 0 || (result.status == 75 && isOneErrorLine(result.err))));
                if (result.status != 0) BOOST_TEST(folder.isOldOrNew({}, result.status));
            }
        }
    }
}

#endif

BOOST_AUTO_TEST_SUITE_END()
