// vdbcage-bench closing: costs of dilating, eroding and closing a model's voxels, beside other ways to do it.

#include <fstream>
#include <iostream>

#include <malloc.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/voxelize/voxelize.h>

#include "bench.h"
#include "rivals.h"

namespace vdbcage::bench {

namespace {

using openvdb::MaskGrid;
using openvdb::MaskTree;

/// Returns the memory in MiB that `work` takes at its peak, beyond the memory before; unused pages of the process are
/// freed first.
template <class Work>
double memoryPeak(const Work& work)
{
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5; // resets VmHWM
    const double before = processMemory("VmRSS");
    work();
    return processMemory("VmHWM") - before;
}

double threadSeconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The longest time that the asking thread has worked between two questions.
class GapClock : public Interrupter {
public:
    bool wasInterrupted(int percent) override
    {
        const double now = threadSeconds();
        if (now - last_ > seconds) {
            seconds = now - last_;
            percentAfter = percent;
        }
        last_ = now;
        ++questions;
        return false;
    }
    double seconds = 0;
    int percentAfter = 0; ///< the progress at the gap's end
    int questions = 0;

private:
    double last_ = threadSeconds();
};

/// Returns the largest gap between two questions on one thread; of several runs the least, as other processes can only
/// lengthen gaps.
template <class Work>
Json largestGap(int runs, const Work& work)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    GapClock least;
    for (int i = 0; i < runs; ++i) {
        GapClock clock;
        const MaskGrid::Ptr result = work(clock);
        clock.wasInterrupted(100); // the end counts as one
        if (i == 0 || clock.seconds < least.seconds) least = clock;
    }
    return {{"largest_gap_cpu_ms", 1000 * least.seconds},
            {"gap_ends_at_percent", least.percentAfter},
            {"questions", least.questions}};
}

double mebibytes(const MaskTree& tree)
{
    return static_cast<double>(tree.memUsage()) / (1 << 20);
}

Json measure(const std::string& model, int resolution, int radius, const CageOptions& shape, int runs, bool compare)
{
    VoxelizeOptions voxels;
    voxels.resolution = resolution;
    const auto solid = voxelize(readMesh(model), voxels).mask;
    const StructuringElement element = shape.element;
    const double r = radius;
    MaskGrid::Ptr dilated, closed;
    const double memory = memoryPeak([&] { closed = closeMask(*solid, {r, r, element}); });
    dilated = dilate(*solid, r, element);
    Json line{{"model", model},
              {"resolution", resolution},
              {"radius_voxels", radius},
              {"element", element == StructuringElement::sphere ? "sphere" : "cube"},
              {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)},
              {"solid_voxels", solid->activeVoxelCount()},
              {"closed_voxels", closed->activeVoxelCount()},
              {"dilation", toJson(leastCost(runs, [&] { return dilate(*solid, r, element); }))},
              {"erosion", toJson(leastCost(runs, [&] { return erode(*dilated, r, element); }))}};
    const Cost ours = leastCost(runs, [&] { return closeMask(*solid, {r, r, element}); });
    line["closing"] = toJson(ours);
    line["closing"]["memory_peak_mib"] = memory;
    // The cube's closing makes no tree of the dilation.
    const double trees =
        mebibytes(closed->tree()) + (element == StructuringElement::sphere ? mebibytes(dilated->tree()) : 0);
    line["closing"]["memory_peak_beyond_trees_mib"] = memory - trees;
    line["interrupter"] = largestGap(runs, [&](GapClock& clock) { return closeMask(*solid, {r, r, element}, &clock); });
    if (element == StructuringElement::sphere && !shape.scale.isNone()) {
        const auto close = [&](Interrupter* watcher) {
            return closeMask(*solid, {r, r, element}, shape.scale, watcher);
        };
        line["scaled"] = toJson(leastCost(runs, [&] { return close(nullptr); }));
        line["scaled"]["interrupter"] = largestGap(runs, [&](GapClock& clock) { return close(&clock); });
    }
    if (!compare) return line;
    dilated.reset();
    MaskTree::Ptr other;
    Cost theirs;
    const double theirMemory = memoryPeak([&] {
        theirs = leastCost(1, [&] {
            other = element == StructuringElement::sphere ? closeByDenseDistances(solid->tree(), radius)
                                                          : closeByRepetition(solid->tree(), radius);
        });
    });
    MaskTree difference(*other);
    difference.topologyDifference(closed->tree());
    line["alternative"] = toJson(theirs);
    line["alternative"].update({{"memory_peak_mib", theirMemory},
                                {"same_voxels", other->activeVoxelCount() == closed->activeVoxelCount() &&
                                                    difference.activeVoxelCount() == 0}});
    line["times_faster"] = theirs.cpuSeconds / ours.cpuSeconds;
    return line;
}

} // namespace

int runClosing(int argc, char** argv)
{
    std::string model, elementName = "sphere", scale = "none";
    int resolution = 256, radius = 0, threads = tbb::info::default_concurrency(), runs = 3;
    bool alone = false;
    CLI::App app("vdbcage-bench closing: time and memory of dilating, eroding and closing a model's voxels, least of\n"
                 "several runs, and the longest work between two questions to the interrupter, beside an alternative:\n"
                 "for the sphere two exact distance transforms of the dense box, for the cube OpenVDB's\n"
                 "dilateActiveValues and erodeActiveValues. A JSON line");
    app.add_option("--model", model, "the model to voxelize")->required()->type_name("MODEL");
    app.add_option("--resolution", resolution, "voxels along the longest side [256]")->type_name("N");
    app.add_option("--radius", radius, "in whole voxels [resolution / 16]")->type_name("K");
    app.add_option("--element", elementName, "[sphere]")->type_name("sphere|cube");
    app.add_option("--scale-field", scale, "also close with it [none]")->type_name("FILE.vdb|REGION");
    app.add_option("--threads", threads, "[all]")->type_name("N");
    app.add_option("--runs", runs, "how many to take the least of [3]")->type_name("N");
    app.add_flag("--alone", alone, "without the alternative");
    CLI11_PARSE(app, argc - 1, argv + 1);
    if (app.count("--radius") == 0) radius = resolution / 16;
    requirePositive("--resolution", resolution);
    requirePositive("--threads", threads);
    requirePositive("--runs", runs);
    CageOptions options;
    setOption(options, "element", elementName);
    setOption(options, "scale-field", scale);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    std::cout << measure(model, resolution, radius, options, runs, !alone).dump() << std::endl;
    return 0;
}

} // namespace vdbcage::bench
