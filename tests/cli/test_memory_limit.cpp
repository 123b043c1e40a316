#include <boost/test/unit_test.hpp>

#include <limits>

#include <support/temporary_folder.h>
#include <tools/cli/memory_limit.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using cli::memoryAtHand;
using cli::memoryLimit;
using test::TemporaryFolder;

namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

/// A made-up root folder with these files.
class Root {
public:
    void write(const std::string& file, const std::string& text) const
    {
        const auto path = folder_.path() / file;
        std::filesystem::create_directories(path.parent_path());
        test::writeText(path, text);
    }
    std::size_t atHand() const { return cli::memoryAtHand(folder_.path()); }

private:
    TemporaryFolder folder_;
};

} // namespace

BOOST_AUTO_TEST_SUITE(memory_limit)

BOOST_AUTO_TEST_CASE(sizes_are_bytes_or_have_a_unit)
{
    BOOST_TEST(cli::memoryLimit("4000000000") == 4000000000U);
    BOOST_TEST(cli::memoryLimit("2K") == 2048U);
    BOOST_TEST(cli::memoryLimit("512M") == 512U << 20U);
    BOOST_TEST(cli::memoryLimit("4G") == std::size_t{4} << 30U);
    BOOST_TEST(cli::memoryLimit("1.5G") == std::size_t{3} << 29U);
    BOOST_TEST(cli::memoryLimit("1T") == std::size_t{1} << 40U);
    BOOST_TEST(cli::memoryLimit("off") == unlimited);
    for (const char* bad : {"", "G", "4Q", "4GB", "4 G", "-1G", "0", "0.5", "nan", "inf", "1e300", "on", "4g", "0x4"}) {
        BOOST_CHECK_EXCEPTION(cli::memoryLimit(bad), InputError, [&](const InputError& error) {
            return std::string(error.what()).rfind("--memory: '" + std::string(bad) + "' is not allowed", 0) == 0;
        });
    }
}

BOOST_AUTO_TEST_CASE(auto_is_a_share_of_what_is_at_hand)
{
    BOOST_TEST(cli::memoryLimit("auto") <
               cli::memoryAtHand() / 10 * 9); // other programs change what is at hand a little
    BOOST_TEST(cli::memoryLimit("auto") > cli::memoryAtHand() / 10 * 6);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_is_no_limit)
{
    const Root root;
    BOOST_TEST(root.atHand() == unlimited);
    root.write("proc/meminfo", "nothing of use");
    root.write("proc/self/cgroup", "nothing\n::\n0::/\n");
    BOOST_TEST(root.atHand() == unlimited);
}

BOOST_AUTO_TEST_CASE(the_machine_has_what_is_available)
{
    const Root root;
    root.write("proc/meminfo", "MemTotal:       24000000 kB\nMemFree:   1000 kB\nMemAvailable:   16000000 kB\n");
    BOOST_TEST(root.atHand() == std::size_t{16000000} * 1024);
}

BOOST_AUTO_TEST_CASE(the_least_of_the_control_groups_around_it_counts)
{
    const Root root;
    root.write("proc/meminfo", "MemAvailable:   16000000 kB\n");
    root.write("proc/self/cgroup", "0::/farm.slice/job/step\n");
    root.write("sys/fs/cgroup/memory.max", "max\n");
    root.write("sys/fs/cgroup/farm.slice/job/memory.max", "3000000000\n");
    BOOST_TEST(root.atHand() == 3000000000U);
    root.write("sys/fs/cgroup/farm.slice/job/step/memory.max", "2000000000\n");
    BOOST_TEST(root.atHand() == 2000000000U);
    root.write("sys/fs/cgroup/farm.slice/memory.max", "1000000000\n");
    BOOST_TEST(root.atHand() == 1000000000U);
    root.write("sys/fs/cgroup/other/memory.max", "1\n");
    BOOST_TEST(root.atHand() == 1000000000U);
}

BOOST_AUTO_TEST_CASE(in_a_container_the_path_is_one_of_outside)
{
    const Root root;
    root.write("proc/self/cgroup", "0::/../../docker/0123\n");
    root.write("sys/fs/cgroup/memory.max", "700000000\n");
    BOOST_TEST(root.atHand() == 700000000U);
}

BOOST_AUTO_TEST_CASE(control_groups_of_version_1_count_too)
{
    const Root root;
    root.write("proc/self/cgroup", "12:cpu,cpuacct:/a\n9:memory:/slurm/uid_0/job_7\n1:name=systemd:/a\n0::/\n");
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    root.write("sys/fs/cgroup/memory/slurm/uid_0/job_7/memory.limit_in_bytes", "500000000\n");
    root.write("sys/fs/cgroup/cpu/a/memory.limit_in_bytes", "1\n");
    BOOST_TEST(root.atHand() == 500000000U);
}

BOOST_AUTO_TEST_SUITE_END()
