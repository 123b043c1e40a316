#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <thread>
#include <tuple>
#include <vector>

#include <support/gl_sources.h>
#include <support/stop_at.h>
#include <tbb/parallel_for.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/voxelize/detail/gl.h>
#include <vdbcage/voxelize/voxelize.h>
#include <voxelize/models.h>
#include <voxelize/reference.h>

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Coord;
using openvdb::Vec3d;
using Path = GlVoxelizer::Path;
using Source = gl::OffscreenContext::Source;
using test::HardModel;

namespace {

/// A way to voxelize: all of them must work here, and without a display.
struct Way {
    Source source;
    Path path;
};

std::ostream& operator<<(std::ostream& out, const Way& way)
{
    return out << (way.source == Source::egl ? "EGL" : "OSMesa")
               << (way.path == Path::compute ? ", compute" : ", raster");
}

const std::vector<Way> ways = [] {
    std::vector<Way> all;
    for (const Source source : test::everySource()) {
        for (const Path path : {Path::compute, Path::raster}) all.push_back({source, path});
    }
    return all;
}();

/// A context with debug messages on, and its voxelizer.
class Device {
public:
    explicit Device(const Way& way, std::size_t gridBytes = GlVoxelizer::usualGridBytes)
        : context_(gl::OffscreenContext::Debug::on, way.source), current_(context_.makeCurrent()),
          voxelizer_(context_.api(), way.path, gridBytes)
    {
    }
    const gl::Api& api() const { return context_.api(); }
    BitGrid run(const Mesh& model, int resolution, Interrupter* interrupter = nullptr) const
    {
        BitGrid bits = voxelizer_.run(model, makeFrame(model, resolution), interrupter);
        gl::throwIfFailed(api(), "testing");
        return bits;
    }

private:
    gl::OffscreenContext context_;
    gl::OffscreenContext::Current current_;
    GlVoxelizer voxelizer_;
};

std::size_t countBits(const BitGrid& bits)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < bits.wordCount(); ++i) {
        count += static_cast<std::size_t>(__builtin_popcountll(bits.words()[i]));
    }
    return count;
}

/// How many bits differ.
std::size_t difference(const BitGrid& a, const BitGrid& b)
{
    if (a.box() != b.box()) return ~std::size_t(0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.wordCount(); ++i) {
        count += static_cast<std::size_t>(__builtin_popcountll(a.words()[i] ^ b.words()[i]));
    }
    return count;
}

BitGrid onCpu(const Mesh& model, int resolution)
{
    return voxelizeCpu(model, makeFrame(model, resolution), nullptr);
}

Mesh dataModel(const std::string& name)
{
    return readMesh(VDBCAGE_MODELS_DIR "/" + name + ".obj");
}

/// Vertical walls around a star, without floor and roof: every face is parallel to z.
Mesh walls(int corners)
{
    Mesh mesh;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners, radius = i % 2 == 0 ? 1 : 0.37;
        mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -0.8);
        mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.9);
    }
    const auto point = [&](int i) { return static_cast<openvdb::Index32>(i % (2 * corners)); };
    for (int i = 0; i < corners; ++i) {
        mesh.triangles.emplace_back(point(2 * i), point(2 * i + 2), point(2 * i + 3));
        mesh.triangles.emplace_back(point(2 * i), point(2 * i + 3), point(2 * i + 1));
    }
    return mesh;
}

/// One triangle whose box is the whole grid.
Mesh coveringTriangle()
{
    Mesh mesh;
    mesh.points = {{0, 0.1, 0}, {1, 0, 0.3}, {0.4, 1, 1}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

/// One whose columns are as long as the grid, in the plane x = y or, to the right, at x = 0.
Mesh standingTriangle(bool diagonal)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {diagonal ? 1.0 : 0.0, 1, 0.2}, {0, 0, 1}, {diagonal ? 1.0 : 0.0, 1, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 1, 2}};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(gl_backend)

BOOST_DATA_TEST_CASE(voxels_are_those_of_the_definition, boost::unit_test::data::make(ways), way)
{
    const Device device(way);
    for (const HardModel& model : test::hardModels()) {
        const test::Reference& reference = test::referenceOf(model);
        const BitGrid bits = device.run(model.mesh, model.resolution);
        std::size_t missing = 0, extra = 0;
        for (const Coord& ijk : reference.box) {
            const bool expected = reference.solid[reference.index(ijk)], got = test::isOn(bits, ijk);
            missing += expected && !got;
            extra += !expected && got;
        }
        BOOST_TEST(missing == 0U, model.name);
        BOOST_TEST(extra == 0U, model.name);
    }
}

BOOST_DATA_TEST_CASE(touched_voxels_are_those_of_the_cpu, boost::unit_test::data::make(ways), way)
{
    // A face that is there twice is crossed an even number of times: what remains is what is touched.
    const Device device(way);
    for (const HardModel& model : test::hardModels()) {
        const Mesh twice = test::joined(model.mesh, model.mesh);
        for (const int resolution : {model.resolution, 2 * model.resolution + 1}) {
            BOOST_TEST(difference(device.run(twice, resolution), onCpu(twice, resolution)) == 0U, model.name);
        }
    }
    for (std::uint32_t seed = 100; seed < 130; ++seed) {
        const Mesh once = test::soup(seed, 50, 10, 1 + seed % 7, seed % 3 == 0), twice = test::joined(once, once);
        const int resolution = static_cast<int>(8 + 5 * (seed % 11));
        BOOST_TEST(difference(device.run(twice, resolution), onCpu(twice, resolution)) == 0U, seed);
        BOOST_TEST(difference(device.run(once, resolution), onCpu(once, resolution)) == 0U, seed);
    }
}

BOOST_DATA_TEST_CASE(models_get_the_voxels_of_the_cpu, boost::unit_test::data::make(ways), way)
{
    // Without hardware both contexts have one rasterizer: large grids for one of them.
    const bool all = way.source == test::softwareSource();
    const Device device(way);
    for (const char* name : {"bench", "bishop", "botijo", "creature", "open_shell", "soup"}) {
        const Mesh model = dataModel(name);
        for (const int resolution : all ? std::vector<int>{32, 64, 100, 128, 256, 512} : std::vector<int>{100}) {
            BOOST_TEST(difference(device.run(model, resolution), onCpu(model, resolution)) == 0U,
                       name << " at " << resolution);
        }
    }
}

BOOST_DATA_TEST_CASE(extreme_triangles_get_the_voxels_of_the_cpu, boost::unit_test::data::make(ways), way)
{
    const Device device(way);
    const auto same = [&](const char* name, const Mesh& model, int resolution) {
        const BitGrid bits = device.run(model, resolution);
        BOOST_TEST(countBits(bits) > 0U, name);
        BOOST_TEST(difference(bits, onCpu(model, resolution)) == 0U, name);
    };
    same("covering the grid", coveringTriangle(), 300);
    same("in a few voxels", coveringTriangle(), 2);
    same("standing, diagonal", standingTriangle(true), 333);
    same("standing along y", standingTriangle(false), 700);
    same("standing, all steps that an item may take", standingTriangle(false), 4096);
    same("walls", walls(60), 200);
    same("box on voxel corners", test::box(Vec3d(0.5), Vec3d(96.5, 63.5, 32.5)), 96);
    const bool many = way.source == test::softwareSource() && way.path == Path::compute;
    same("needles", test::needles(many ? 100000 : 3000, 1e4), 128);
}

BOOST_AUTO_TEST_CASE(a_million_triangles_get_the_voxels_of_the_cpu)
{
    const Mesh model = test::sphere(Vec3d(0.1, 0.2, 0.3), 1, 708);
    BOOST_TEST(faceCount(model) * 2 > 1000000U); // quads
    const Device device({test::softwareSource(), Path::compute});
    BOOST_TEST(difference(device.run(model, 200), onCpu(model, 200)) == 0U);
}

BOOST_DATA_TEST_CASE(slabs_do_not_show, boost::unit_test::data::make(ways), way)
{
    const Mesh models[] = {test::torus(1, 0.4, 40, 20), test::soup(7, 60, 10, 1, false), test::bowl(1, 20)};
    const int resolution = 70;
    for (const std::size_t planes : {1U, 2U, 9U, 69U}) {
        // 4 grids of rows of 2 words of 8 bytes; these models are cubes at most
        const Device device(way, planes * 4 * 71 * 2 * 8);
        for (const Mesh& model : models) {
            BOOST_TEST(difference(device.run(model, resolution), onCpu(model, resolution)) == 0U, planes);
        }
    }
    const Device small(way, 4 * 71 * 2 * 8 - 1);
    BOOST_CHECK_THROW((void)small.run(models[1], resolution), DeviceError);
}

BOOST_AUTO_TEST_CASE(grids_may_be_larger_than_a_buffer)
{
    Mesh rod = test::sphere(Vec3d(0), 1, 30);
    for (Vec3d& point : rod.points) point = Vec3d(point.x(), 0.2 * point.y(), 0.2 * point.z());
    const Device device({test::softwareSource(), Path::compute});
    for (const int resolution : {2048, 4096}) {
        const BitGrid bits = onCpu(rod, resolution);
        BOOST_TEST(4 * 8 * bits.wordCount() > GlVoxelizer::usualGridBytes);
        BOOST_TEST(difference(device.run(rod, resolution), bits) == 0U);
    }
}

BOOST_AUTO_TEST_CASE(threads_voxelize_at_once_each_with_its_context)
{
    const Mesh models[] = {test::torus(1, 0.4, 40, 20), test::soup(7, 60, 10, 1, false)};
    std::array<std::size_t, 4> differences{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < differences.size(); ++t) {
        threads.emplace_back([&, t] {
            const Mesh& model = models[t % 2];
            const Device device(ways[t]);
            for (int round = 0; round < 3; ++round) {
                differences[t] += difference(device.run(model, 60 + round), onCpu(model, 60 + round));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::size_t differing : differences) BOOST_TEST(differing == 0U);
}

BOOST_AUTO_TEST_CASE(tasks_of_tbb_may_voxelize)
{
    const Mesh model = test::torus(1, 0.4, 40, 20);
    const openvdb::MaskGrid::Ptr expected = voxelize(model, {50, Voxelizer::cpu}).mask;
    std::array<openvdb::MaskGrid::Ptr, 8> masks;
    tbb::parallel_for(std::size_t(0), masks.size(), [&](std::size_t i) {
        masks[i] = voxelize(model, {50, Voxelizer::gl}).mask;
    });
    for (const auto& mask : masks) BOOST_TEST(mask->tree().hasSameTopology(expected->tree()));
}

BOOST_AUTO_TEST_CASE(automatic_is_the_cpu_where_the_device_fails_or_does_not_pay)
{
    const Mesh model = test::box(Vec3d(0), Vec3d(1, 0.03, 0.02));
    Backend& failing = *+[](const Mesh&, const Frame&, Interrupter*) -> BitGrid { throw DeviceError("broken device"); };
    Backend& cancelled = *+[](const Mesh&, const Frame&, Interrupter*) -> BitGrid { throw Cancelled(); };
    const auto frame = [&](int resolution) { return makeFrame(model, resolution); };
    constexpr int large = leastResolutionForDevice;

    auto [bits, report] = voxelizeAutomatically(model, frame(large), failing, nullptr);
    BOOST_TEST((report.voxelizer == Voxelizer::cpu));
    BOOST_TEST(report.fallback == "broken device");
    BOOST_TEST(difference(bits, onCpu(model, large)) == 0U);

    std::tie(bits, report) = voxelizeAutomatically(model, frame(large), voxelizeGl, nullptr);
    BOOST_TEST((report.voxelizer == Voxelizer::gl));
    BOOST_TEST(report.fallback == "");
    BOOST_TEST(difference(bits, onCpu(model, large)) == 0U);

    std::tie(bits, report) = voxelizeAutomatically(model, frame(large - 1), failing, nullptr);
    BOOST_TEST((report.voxelizer == Voxelizer::cpu));
    BOOST_TEST(report.fallback == "");
    BOOST_CHECK_THROW((void)voxelizeAutomatically(model, frame(large), cancelled, nullptr), Cancelled);

    report = voxelize(model, {large}).report;
    BOOST_TEST(((report.voxelizer == Voxelizer::gl) == report.fallback.empty()));
}

BOOST_AUTO_TEST_CASE(every_question_can_cancel)
{
    const Mesh model = test::torus(1, 0.4, 40, 20);
    const Device device({test::softwareSource(), Path::compute}, 10 * 4 * 61 * 8);
    constexpr int many = 1 << 20;
    test::StopAt counter(many);
    const BitGrid bits = device.run(model, 60, &counter);
    const int asked = test::questions(counter, many);
    BOOST_TEST(asked > 10);
    for (int k = 0; k < asked; k += 3) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW((void)device.run(model, 60, &stop), Cancelled);
    }
    BOOST_TEST(difference(device.run(model, 60), bits) == 0U);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(gl_faults)

namespace {

const gl::Api* driver = nullptr; // what the faults below are put in front of

void breakSource(GLuint shader, GLsizei /*count*/, const GLchar* const* /*text*/, const GLint* /*lengths*/)
{
    const GLchar* broken = "#version 450 core\nvoid main() { brokenOnPurpose(); }\n";
    driver->ShaderSource(shader, 1, &broken, nullptr);
}

/// Refuses buffers as large as grids.
void haveNoMemory(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags)
{
    driver->NamedBufferStorage(buffer, size < (1 << 16) ? size : GLsizeiptr(1) << 50, data, flags);
}

void drawNothing(GLenum /*mode*/, GLint first, GLsizei count)
{
    driver->DrawArrays(GL_INVALID_ENUM, first, count);
}

} // namespace

BOOST_DATA_TEST_CASE(faults_of_the_device_are_errors, boost::unit_test::data::make(ways), way)
{
    const gl::OffscreenContext context(gl::OffscreenContext::Debug::on, way.source);
    const auto current = context.makeCurrent();
    driver = &context.api();
    const Mesh model = test::torus(1, 0.4, 20, 10);
    const auto says = [](const char* words) {
        return [words](const DeviceError& error) {
            BOOST_TEST_MESSAGE(error.what());
            return std::string(error.what()).find(words) != std::string::npos;
        };
    };
    gl::Api broken = context.api();
    broken.ShaderSource = &breakSource;
    BOOST_CHECK_EXCEPTION(GlVoxelizer(broken, way.path), DeviceError, says("brokenOnPurpose"));

    broken = context.api();
    broken.NamedBufferStorage = &haveNoMemory;
    BOOST_CHECK_EXCEPTION((void)GlVoxelizer(broken, way.path).run(model, makeFrame(model, 80), nullptr), DeviceError,
                          says("GL_OUT_OF_MEMORY"));

    if (way.path == Path::raster) {
        broken = context.api();
        broken.DrawArrays = &drawNothing;
        BOOST_CHECK_EXCEPTION((void)GlVoxelizer(broken, way.path).run(model, makeFrame(model, 80), nullptr),
                              DeviceError, says("voxelizing"));
    }

    const BitGrid bits = GlVoxelizer(context.api(), way.path).run(model, makeFrame(model, 80), nullptr);
    BOOST_TEST(difference(bits, onCpu(model, 80)) == 0U); // the context is as good as before
}

BOOST_AUTO_TEST_SUITE_END()
