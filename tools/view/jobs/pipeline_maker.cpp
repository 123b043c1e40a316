#include <chrono>
#include <optional>
#include <utility>

#include <tools/files/naming_files.h>
#include <tools/view/jobs/opened_cages.h>
#include <tools/view/jobs/runner.h>

namespace vdbcage::view {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began)
{
    return std::chrono::duration<double>(Clock::now() - began).count();
}

/// The tree of the model's triangles, for distances.
class ModelTree {
public:
    const detail::TriangleBvh& of(const OpenedMeshPtr& model, Interrupter& interrupter)
    {
        if (model != model_) {
            tree_ = detail::TriangleBvh(model->mesh.points, triangulate(model->mesh), &interrupter);
            model_ = model;
        }
        return tree_;
    }

private:
    OpenedMeshPtr model_;
    detail::TriangleBvh tree_;
};

/// A pipeline with the order of its last run.
class OrderedPipeline {
public:
    CageResultPtr make(const Job& job, ModelTree& trees, Interrupter& interrupter)
    {
        const auto began = Clock::now();
        const Order& order = job.order;
        StageClock clock(&interrupter);
        if (!model_ || model_ != order.model) {
            done_.reset();
            pipeline_.reset();
            pipeline_.emplace(order.model->mesh);
            model_ = order.model;
        }
        if (!done_ || done_->order != order) {
            pipeline_->run(order.options, &clock);
            CageResult result;
            result.order = order;
            result.cage = pipeline_->cage();
            result.report = pipeline_->report();
            result.stages = clock.stages();
            result.seconds = secondsSince(began);
            done_ = std::make_shared<const CageResult>(std::move(result));
        }
        // The intermediates may be requested after the cage is made.
        if (job.intermediates && !done_->intermediates) {
            const Stage stage(&interrupter, StageName::layers);
            CageResult result = *done_;
            result.intermediates = std::make_shared<const Intermediates>(
                intermediatesOf(*pipeline_, trees.of(order.model, interrupter), &interrupter));
            done_ = std::make_shared<const CageResult>(std::move(result));
        }
        return done_;
    }

private:
    OpenedMeshPtr model_;
    std::optional<Pipeline> pipeline_;
    CageResultPtr done_; ///< the pipeline's result; null: unknown
};

class PipelineMaker : public CageMaker {
public:
    CageResultPtr make(const Job& job, Interrupter& interrupter) override
    {
        if (job.order.cage) return makeOpened(job, interrupter);
        OrderedPipeline& pipeline = job.order == previewOf(job.order) ? preview_ : full_;
        return files::namingFiles({{"model", job.order.model->path.string()}},
                                  [&] { return pipeline.make(job, tree_, interrupter); });
    }

private:
    CageResultPtr makeOpened(const Job& job, Interrupter& interrupter)
    {
        const Order& order = job.order;
        const auto began = Clock::now();
        StageClock clock(&interrupter);
        CageResult result = opened_.made(order, clock);
        if (job.intermediates) {
            Intermediates made;
            made.distance = measureDistances(result.cage, tree_.of(order.model, interrupter));
            result.intermediates = std::make_shared<const Intermediates>(std::move(made));
        }
        result.stages = clock.stages();
        result.seconds = secondsSince(began);
        return std::make_shared<const CageResult>(std::move(result));
    }

    OrderedPipeline preview_, full_;
    OpenedCages opened_;
    ModelTree tree_;
};

} // namespace

std::unique_ptr<CageMaker> makePipelineMaker()
{
    return std::make_unique<PipelineMaker>();
}

} // namespace vdbcage::view
