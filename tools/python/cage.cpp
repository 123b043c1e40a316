#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <tools/report/fit_words.h>
#include <tools/report/report.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/parts.h>
#include <vdbcage/pipeline/memory.h>
#include <vdbcage/pipeline/pipeline.h>

#include "job.h"
#include "module.h"

namespace py = pybind11;

namespace vdbcage::python {

namespace {

using OptionTexts = std::vector<std::pair<std::string, std::string>>;

CageOptions toOptions(const OptionTexts& texts)
{
    CageOptions options;
    for (const auto& [name, value] : texts) setOption(options, name, value);
    requireValid(options);
    return options;
}

/// The fields of the package's CageCheck by their names.
py::dict toDict(const CageCheck& check)
{
    py::dict fields;
    fields["valid"] = check.valid();
    fields["bounding"] = check.bounding();
    fields["closed"] = check.closed();
    fields["manifold"] = check.manifold();
    fields["oriented"] = check.oriented();
    fields["points"] = check.points;
    fields["triangles"] = check.triangles;
    fields["quads"] = check.quads;
    fields["components"] = check.components;
    fields["genus"] = check.genus;
    fields["boundary_edges"] = check.boundaryEdges;
    fields["non_manifold_edges"] = check.nonManifoldEdges;
    fields["non_manifold_vertices"] = check.nonManifoldVertices;
    fields["misoriented_edges"] = check.misorientedEdges;
    fields["inward_components"] = check.inwardComponents;
    fields["degenerate_faces"] = check.degenerateFaces;
    fields["self_intersections"] = check.selfIntersections;
    fields["contact_faces"] = check.contactFaces;
    fields["model_vertices_outside"] = check.modelVerticesOutside;
    fields["loose_points"] = check.loosePoints;
    fields["loose_points_outside"] = check.loosePointsOutside;
    fields["bad_faces"] = py::tuple(py::cast(check.badFaces));
    fields["longest_side"] = check.longestSide;
    fields["diagonal"] = check.diagonal;
    fields["mean_distance"] = check.meanDistance;
    fields["max_distance"] = check.maxDistance;
    fields["min_distance"] = check.minDistance;
    fields["cage_volume"] = check.cageVolume;
    fields["volume_ratio"] = check.volumeRatio;
    fields["min_angle_degrees"] = check.minAngleDegrees;
    fields["angle_1st_percentile_degrees"] = check.angle1stPercentileDegrees;
    fields["median_angle_degrees"] = check.medianAngleDegrees;
    return fields;
}

/// What a run leaves beside its cage.
struct Made {
    MeshPtr cage;
    CageReport report;
    double seconds = 0; // wall clock
    std::vector<StageTime> stages;
};

Made make(Pipeline& pipeline, const CageOptions& options, Interrupter* interrupter)
{
    const auto began = std::chrono::steady_clock::now();
    StageClock clock(interrupter);
    const Mesh& cage = pipeline.run(options, &clock);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return {std::make_shared<Mesh>(cage), pipeline.report(), seconds, clock.stages()};
}

py::object toPython(const report::Json& json)
{
    return py::module_::import("json").attr("loads")(report::toText(json));
}

/// (cage, the fields of its CageCheck, its report)
py::tuple toTuple(const Made& made, const CageOptions& options)
{
    py::dict stages;
    for (const StageTime& stage : made.stages) stages[py::str(stage.name)] = stage.seconds;
    py::dict report;
    report["options"] = toPython(report::toJson(options));
    report["seconds"] = made.seconds;
    report["stages"] = stages;
    report.attr("update")(toPython(report::toJson(made.report)));
    return py::make_tuple(made.cage, toDict(made.report.check), report);
}

/// A pipeline that one thread at a time can use.
class SharedPipeline {
public:
    explicit SharedPipeline(const Mesh& model) : pipeline_(model) {}

    py::tuple run(const OptionTexts& texts, const py::object& progress)
    {
        const Use use(*this);
        const CageOptions options = toOptions(texts);
        const Made made =
            resultOfJob(progress, [&](Interrupter* interrupter) { return make(pipeline_, options, interrupter); });
        hasRun_ = true;
        return toTuple(made, options);
    }
    /// A copy of what `stage` gives; null before the first run.
    MeshPtr mesh(const Mesh& (Pipeline::*stage)() const)
    {
        const Use use(*this);
        return hasRun_ ? std::make_shared<Mesh>((pipeline_.*stage)()) : nullptr;
    }
    std::optional<VolumeMask> mask(openvdb::MaskGrid::ConstPtr (Pipeline::*stage)() const)
    {
        const Use use(*this);
        return hasRun_ ? std::optional(VolumeMask{(pipeline_.*stage)()}) : std::nullopt;
    }

private:
    /// Holds the pipeline for one call. Waiting for it could go on forever: a call in `progress` would wait for itself.
    class Use {
    public:
        explicit Use(SharedPipeline& pipeline) : pipeline_(pipeline)
        {
            if (pipeline_.isInUse_.exchange(true)) throw Error("pipeline: another call is running it");
        }
        ~Use() { pipeline_.isInUse_ = false; }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

    private:
        SharedPipeline& pipeline_;
    };

    Pipeline pipeline_;
    std::atomic<bool> isInUse_{false};
    bool hasRun_ = false;
};

MeshPtr stageOf(SharedPipeline& pipeline, const std::string& name)
{
    return pipeline.mesh(name == "surface"    ? &Pipeline::surface
                         : name == "smoothed" ? &Pipeline::smoothed
                                              : &Pipeline::decimated);
}

std::optional<VolumeMask> maskOf(SharedPipeline& pipeline, const std::string& name)
{
    return pipeline.mask(name == "solid" ? &Pipeline::solid : &Pipeline::closed);
}

} // namespace

void defineCage(py::module_& module)
{
    module.def("options", [] {
        py::list list; // (name, what stands for a value)
        for (const OptionText& option : describeOptions()) list.append(py::make_tuple(option.name, option.value));
        return list;
    });
    py::class_<SharedPipeline>(module, "Pipeline", py::module_local())
        .def(py::init([](const MeshPtr& model) {
            return resultOfJob(py::none(), [&](Interrupter*) { return std::make_unique<SharedPipeline>(*model); });
        }))
        .def("run", &SharedPipeline::run)
        .def("mesh", stageOf)
        .def("mask", maskOf);
    module.def("predicted_memory", [](const MeshPtr& model, const OptionTexts& texts, const py::object& progress) {
        const CageOptions options = toOptions(texts);
        return resultOfJob(progress,
                           [&](Interrupter* interrupter) { return predictedMemory(*model, options, interrupter); });
    });
    module.def("fit_cage",
               [](const MeshPtr& cage, const MeshPtr& model, double tight, const std::vector<std::size_t>& keep,
                  double most, const std::string& place, const py::object& progress) {
                   struct Fitted {
                       Fit fit;
                       CageCheck check;
                   };
                   const Fitted fitted = resultOfJob(progress, [&](Interrupter* interrupter) {
                       const BoundingGuard guard(*model, fitGuardOptions(Precision::float64), interrupter);
                       FitOptions options;
                       options.tightness = tight;
                       options.mostWay = most;
                       options.keptPoints = keep;
                       options.tightening = tightenOptions(Effort::fair);
                       const PlaceTurns turns = place == "turn" ? PlaceTurns::quarters : PlaceTurns::none;
                       const Mesh drawn = place.empty() ? *cage : placeCage(*cage, guard, turns, interrupter);
                       Fitted result{fitCage(drawn, guard, options, interrupter), {}};
                       result.check = checkCage(result.fit.cage, *model, {}, interrupter);
                       if (result.fit.obstacle != Fit::Obstacle::none || !result.check.bounding())
                           throw InputError("cage", "no place was found where " + report::unfoundPlace(result.fit));
                       return result;
                   });
                   return py::make_tuple(std::make_shared<Mesh>(fitted.fit.cage), toDict(fitted.check));
               });
    module.def("check_cage", [](const MeshPtr& cage, const MeshPtr& model, double leastPart, bool asFloats,
                                bool measure, std::size_t samples, const py::object& progress) {
        return toDict(resultOfJob(progress, [&](Interrupter* interrupter) {
            const CheckOptions options{asFloats, measure, samples};
            return leastPart > 0 ? checkCage(*cage, largeParts(*model, leastPart).mesh, options, interrupter)
                                 : checkCage(*cage, *model, options, interrupter);
        }));
    });
}

} // namespace vdbcage::python
