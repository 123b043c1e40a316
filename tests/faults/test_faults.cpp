// Calls of the library whose k-th allocation fails, or that are cancelled at their k-th question: they throw what they
// say, all that they took is given back, and what stood stands. VDBCAGE_FAULTS=N multiplies the numbers of runs by N.

#include <boost/test/unit_test.hpp>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <vdbcage/vdbcage.h>

using namespace vdbcage;

namespace {

std::atomic<long> living{0};  // blocks
std::atomic<long> asked{0};   // so far
std::atomic<long> failing{0}; // the number of the one that fails; 0: none

void* allocate(std::size_t size, std::size_t alignment)
{
    if (++asked == failing) throw std::bad_alloc();
    void* block = nullptr;
    if (::posix_memalign(&block, std::max(alignment, sizeof(void*)), std::max<std::size_t>(size, 1)) != 0) {
        throw std::bad_alloc();
    }
    ++living;
    return block;
}

void release(void* block) noexcept
{
    if (block) --living;
    std::free(block);
}

} // namespace

// Those that are not here call these.
void* operator new(std::size_t size)
{
    return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept
{
    release(block);
}
void operator delete(void* block, std::size_t /*size*/) noexcept
{
    release(block);
}
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept
{
    release(block);
}
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
    release(block);
}

namespace {

int times(int runs)
{
    const char* more = std::getenv("VDBCAGE_FAULTS");
    return runs * (more ? std::atoi(more) : 1);
}

struct Call {
    std::string name;
    std::function<void(Interrupter*)> run;
};

const Mesh& model()
{
    static const Mesh mesh = test::joined(test::sphere({0, 0, 0}, 1, 12), test::torus(2, 0.2, 32, 8));
    return mesh;
}
const Mesh& cage()
{
    static const Mesh mesh = test::sphere({0, 0, 0}, 3.5, 6);
    return mesh;
}

CageOptions optionsOf(const std::vector<std::pair<std::string, std::string>>& texts)
{
    CageOptions options;
    options.effort = Effort::fast;
    options.faces = 60;
    for (const auto& [name, value] : texts) setOption(options, name, value);
    return options;
}

std::vector<Call> calls()
{
    std::vector<Call> all;
    const auto make = [&](const std::string& name, const std::vector<std::pair<std::string, std::string>>& texts) {
        all.push_back({"make " + name, [options = optionsOf(texts)](Interrupter* interrupter) {
                           makeCage(model(), options, interrupter);
                       }});
    };
    make("triangles", {{"faces", "200"}});
    make("few", {{"faces", "20"}, {"effort", "fair"}});
    make("quads", {{"mesh", "quads"}});
    make("loops", {{"mesh", "loops"}});
    make("symmetric", {{"symmetry", "x"}});
    make("dense", {{"density", "sphere:0,0,0,1,2"}, {"scale-field", "sphere:0,0,0,1,2"}});
    make("plain", {{"bounding", "off"}});
    for (const FamilyInfo& family : coordinateFamilies()) {
        all.push_back({std::string("bind ") + family.name, [&family](Interrupter* interrupter) {
                           const CoordinateOptions options(family.family, 16);
                           Binding(cage(), model().points, options, interrupter).pose(cage().points);
                       }});
    }
    all.push_back({"check", [](Interrupter* interrupter) { checkCage(cage(), model(), {}, interrupter); }});
    if (hasRepair()) {
        all.push_back({"repair", [](Interrupter* interrupter) {
                           Mesh open = cage();
                           open.quads.resize(open.quads.size() - 5);
                           repair(open, interrupter);
                       }});
    }
    all.push_back({"memory", [](Interrupter* interrupter) { predictedMemory(model(), {}, interrupter); }});
    return all;
}

/// `runs` numbers from 1 to `count`, in equal steps from the middle of the first one on.
std::vector<long> swept(long count, int runs)
{
    std::vector<long> all;
    for (int run = 0; run < runs; ++run) {
        all.push_back(std::max(1L, static_cast<long>((run + 0.5) / runs * static_cast<double>(count))));
    }
    return all;
}

/// Fails the k-th allocation from now on, until the scope is left.
struct Failing {
    explicit Failing(long k) { failing = asked + k; }
    ~Failing() { failing = 0; }
};

} // namespace

BOOST_AUTO_TEST_SUITE(faults)

BOOST_AUTO_TEST_CASE(an_allocation_that_fails_is_bad_alloc_and_nothing_leaks)
{
    int runs = 0, failed = 0;
    for (const Call& call : calls()) {
        call.run(nullptr); // what is made once
        const long before = asked;
        call.run(nullptr);
        const long count = asked - before;
        for (const long k : swept(count, times(6))) {
            const long lived = living;
            bool hasFailed = false;
            try {
                const Failing failing(k);
                call.run(nullptr);
            } catch (const std::bad_alloc&) {
                hasFailed = true;
            }
            BOOST_TEST(living == lived, call.name << ", allocation " << k << " of " << count << ": " << living - lived
                                                  << " blocks more");
            failed += hasFailed;
            ++runs;
        }
    }
    BOOST_TEST_MESSAGE(failed << " of " << runs << " calls lacked memory");
    BOOST_TEST(failed > runs / 2);
}

BOOST_AUTO_TEST_CASE(a_call_that_is_cancelled_at_any_question_says_so_and_nothing_leaks)
{
    int runs = 0;
    for (const Call& call : calls()) {
        constexpr int many = 1 << 30;
        test::StopAt patient(many);
        call.run(&patient);
        const int count = test::questions(patient, many);
        BOOST_TEST(count > 0, call.name);
        for (const long k : swept(count, times(4))) {
            const long lived = living;
            test::StopAt stopping(static_cast<int>(k) - 1);
            BOOST_CHECK_THROW(call.run(&stopping), Cancelled);
            BOOST_TEST(living == lived,
                       call.name << ", question " << k << " of " << count << ": " << living - lived << " blocks more");
            ++runs;
        }
    }
    BOOST_TEST_MESSAGE(runs << " calls were cancelled");
}

BOOST_AUTO_TEST_CASE(a_run_that_fails_leaves_the_cage_of_the_last_one_and_what_the_next_one_needs)
{
    const CageOptions first = optionsOf({{"faces", "100"}}), second = optionsOf({{"faces", "60"}, {"smooth", "1"}});
    const Mesh wanted = makeCage(model(), second);
    Pipeline counting(model());
    counting.run(first);
    const long before = asked;
    counting.run(second);
    const long count = asked - before;
    int failed = 0;
    for (const long k : swept(count, times(8))) {
        Pipeline pipeline(model());
        const Mesh stood = pipeline.run(first);
        try {
            const Failing failing(k);
            pipeline.run(second);
            continue; // it could do without
        } catch (const std::bad_alloc&) {
            ++failed;
        }
        BOOST_TEST((pipeline.cage().points == stood.points && pipeline.cage().triangles == stood.triangles));
        const Mesh& made = pipeline.run(second);
        BOOST_TEST((made.points == wanted.points && made.triangles == wanted.triangles), "after allocation " << k);
    }
    BOOST_TEST(failed > 0);
}

BOOST_AUTO_TEST_SUITE_END()
