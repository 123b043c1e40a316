#include <chrono>
#include <optional>
#include <utility>

#include <tools/view/state/runner.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began)
{
    return std::chrono::duration<double>(Clock::now() - began).count();
}

/// A pipeline with the order that it has carried out last.
class OrderedPipeline {
public:
    CageResultPtr make(const Job& job, Interrupter& interrupter)
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
        // Intermediates may be asked for when the cage is made already.
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
        if (job.intermediates && !done_->intermediates) {
            CageResult result = *done_;
            result.intermediates = std::make_shared<const Intermediates>(
                Intermediates{pipeline_->solid(), pipeline_->closed(), pipeline_->surface(), pipeline_->smoothed(),
                              pipeline_->decimated()});
            done_ = std::make_shared<const CageResult>(std::move(result));
        }
        return done_;
    }

private:
    OpenedMeshPtr model_;
    std::optional<Pipeline> pipeline_;
    CageResultPtr done_; ///< what the pipeline holds; null: nothing that is known
};

class PipelineMaker : public CageMaker {
public:
    CageResultPtr make(const Job& job, Interrupter& interrupter) override
    {
        if (job.order.cage) return check(job.order, interrupter);
        OrderedPipeline& pipeline = job.order == previewOf(job.order) ? preview_ : full_;
        try {
            return pipeline.make(job, interrupter);
        } catch (const InputError& error) { // of the pipeline, which does not know the file
            const std::string text = error.what(), prefix = "model: ";
            if (text.compare(0, prefix.size(), prefix) != 0) throw;
            throw InputError(job.order.model->path.string() + ": " + text.substr(prefix.size()));
        }
    }

private:
    CageResultPtr check(const Order& order, Interrupter& interrupter)
    {
        const auto began = Clock::now();
        StageClock clock(&interrupter);
        CageResult result;
        result.order = order;
        result.cage = order.cage->mesh;
        if (!checker_ || checked_ != order.model) {
            checker_.reset();
            const Stage stage(&clock, "guard");
            checker_.emplace(order.model->mesh, &clock);
            checked_ = order.model;
        }
        {
            const Stage stage(&clock, "certify");
            result.report.check = checker_->check(result.cage, {}, &clock);
        }
        result.stages = clock.stages();
        result.seconds = secondsSince(began);
        return std::make_shared<const CageResult>(std::move(result));
    }

    OrderedPipeline preview_, full_;
    OpenedMeshPtr checked_;
    std::optional<CageChecker> checker_;
};

} // namespace

std::unique_ptr<CageMaker> makePipelineMaker()
{
    return std::make_unique<PipelineMaker>();
}

} // namespace vdbcage::view
