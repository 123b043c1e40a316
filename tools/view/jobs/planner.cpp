#include <tools/view/jobs/planner.h>

#include <algorithm>

namespace vdbcage::view {

namespace {

/// Returns whether cages by both orders can share the model's voxels and their closing, or are fits of one cage.
bool shareStages(const Order& a, const Order& b)
{
    if (a.model != b.model || a.cage != b.cage) return false;
    if (a.cage) return a.fit && b.fit;
    CageOptions early = b.options;
    early.faces = a.options.faces;
    early.smooth = a.options.smooth;
    early.mesh = a.options.mesh;
    early.quadShape = a.options.quadShape;
    early.mergeAngle = a.options.mergeAngle;
    return areEqual(early, a.options);
}

std::size_t bytesOf(const Mesh& mesh)
{
    return mesh.points.size() * sizeof(openvdb::Vec3d) + mesh.triangles.size() * sizeof(openvdb::Vec3I) +
           mesh.quads.size() * sizeof(openvdb::Vec4I);
}

std::size_t bytesOf(const CageResult& result)
{
    std::size_t bytes = bytesOf(result.cage) + 10000; // the rest of the result, about
    if (const Intermediates* const inner = result.intermediates.get()) {
        for (const Mesh* mesh : {&inner->solidFaces, &inner->closedFaces, &inner->solidNodes, &inner->closedNodes,
                                 &inner->surface, &inner->smoothed, &inner->decimated, &inner->distance.mesh}) {
            bytes += bytesOf(*mesh);
        }
    }
    return bytes;
}

} // namespace

bool operator==(const Order& a, const Order& b)
{
    return a.model == b.model && a.cage == b.cage && a.fit == b.fit && areEqual(a.options, b.options);
}

Order orderOf(const Document& document)
{
    Order order{document.model, document.options, document.cage};
    if (document.isFitted) order.fit = FitOrder{document.tightness, document.locked};
    return order;
}

Order previewOf(Order order)
{
    if (!order.cage) order.options.effort = Effort::fast;
    return order;
}

int steppedFaces(int faces, int direction, CageFaces mesh)
{
    Range range;
    CageOptions options;
    visitOptions(options, [&](const OptionInfo& info, const auto& field) {
        if (static_cast<const void*>(&field) == &options.faces) range = info.range;
    });
    const double step = std::max(1, faces / 20);
    return static_cast<int>(std::clamp(faces + (direction > 0 ? step : -step), double(leastFaces(mesh)), range.most));
}

void Planner::want(const std::optional<Order>& order, bool isDragging, bool intermediates)
{
    const bool isOther = order.has_value() != wanted_.has_value() || (order && *order != *wanted_);
    const bool hasEnded = isDragging_ && !isDragging;
    if (isOther) {
        isHalted_ = false;
        madeAhead_ = 0;
        error_.clear();
        wanted_ = order;
    }
    if (hasEnded) {
        skipsPreview_ = true;
    } else if (isOther) {
        skipsPreview_ = false;
    }
    isDragging_ = isDragging;
    intermediates_ = intermediates;
    reconsider();
}

void Planner::cancel()
{
    isHalted_ = !isSettled() || isHalted_;
    reconsider();
}

void Planner::again()
{
    isHalted_ = false;
    error_.clear();
    reconsider();
}

std::optional<Job> Planner::start()
{
    if (running_) return std::nullopt;
    running_ = nextJob();
    if (running_ && running_->kind == Job::Kind::ahead) ++madeAhead_;
    stop_ = false;
    return running_;
}

void Planner::finished(CageResultPtr result)
{
    const Job::Kind kind = running_->kind;
    running_.reset();
    keep(result);
    choose();
    // Neither the wanted cage nor its preview is there yet: the newest one of this model is nearest to it.
    const bool isThere = made_ && wanted_ && (*wanted_ == made_->order || previewOf(*wanted_) == made_->order);
    if (!isThere && kind != Job::Kind::ahead && wanted_ && wanted_->model == result->order.model) {
        made_ = std::move(result);
    }
}

void Planner::failed(const std::string& error)
{
    const Job job = *std::move(running_);
    running_.reset();
    // If a preview fails, so does its cage; a job made ahead was not requested.
    const bool isWanted = wanted_ && (job.order == *wanted_ || job.order == previewOf(*wanted_));
    if (!isWanted || job.kind == Job::Kind::ahead) return;
    isHalted_ = true;
    error_ = error;
}

void Planner::stopped()
{
    running_.reset();
}

bool Planner::isSettled() const
{
    if (running_ && running_->kind != Job::Kind::ahead) return false;
    const std::optional<Job> next = nextJob();
    return !next || next->kind == Job::Kind::ahead;
}

Planner::Standing Planner::standing() const
{
    if (!made_) return Standing::none;
    if (wanted_ && made_->order == *wanted_) return Standing::current;
    if (wanted_ && made_->order == previewOf(*wanted_)) return Standing::preview;
    return Standing::stale;
}

std::optional<Job> Planner::nextJob() const
{
    if (!wanted_ || !wanted_->model || isHalted_) return std::nullopt;
    const Order preview = previewOf(*wanted_);
    const CageResultPtr full = kept(*wanted_);
    const bool hasFull = full && (full->intermediates || !intermediates_);
    if (!full && (isDragging_ || !skipsPreview_) && preview != *wanted_ && !kept(preview)) {
        return Job{Job::Kind::preview, preview, false};
    }
    if (isDragging_ && (full || preview != *wanted_)) return std::nullopt;
    if (!hasFull) return Job{Job::Kind::full, *wanted_, intermediates_};
    // Each neighbour is tried once for each wanted cage, whether it succeeds or not.
    for (int side = madeAhead_; side < 2 && !wanted_->cage; ++side) {
        Order next = preview;
        next.options.faces = steppedFaces(next.options.faces, side == 0 ? -1 : 1, next.options.mesh);
        if (next != preview && !kept(next)) return Job{Job::Kind::ahead, next, false};
    }
    return std::nullopt;
}

CageResultPtr Planner::kept(const Order& order) const
{
    for (const CageResultPtr& result : kept_) {
        if (result->order == order) return result;
    }
    return nullptr;
}

void Planner::keep(const CageResultPtr& result)
{
    kept_.remove_if([&](const CageResultPtr& other) { return other->order == result->order; });
    kept_.push_front(result);
    std::size_t bytes = 0, count = 0;
    for (auto i = kept_.begin(); i != kept_.end();) {
        bytes += bytesOf(**i);
        const bool isNeeded = wanted_ && ((*i)->order == *wanted_ || (*i)->order == previewOf(*wanted_));
        i = ++count > 2 && bytes > mostBytes_ && !isNeeded ? kept_.erase(i) : std::next(i);
    }
}

void Planner::reconsider()
{
    if (running_) stop_ = stop_ || !isUseful(*running_);
    choose();
}

bool Planner::isUseful(const Job& job) const
{
    if (!wanted_ || isHalted_ || wanted_->model != job.order.model) return false;
    const Order preview = previewOf(*wanted_);
    if (job.kind == Job::Kind::ahead) {
        const std::optional<Job> next = nextJob();
        return !next || next->kind == Job::Kind::ahead || next->order == job.order;
    }
    if (job.order == *wanted_) return true;
    if (job.order != previewOf(job.order) || skipsPreview_ || kept(*wanted_)) return false;
    if (job.order.cage && !isDragging_) return false;
    return job.order == preview || (!kept(preview) && shareStages(job.order, preview));
}

/// Takes the best of the kept results.
void Planner::choose()
{
    if (!wanted_ || !wanted_->model) {
        made_.reset();
        return;
    }
    if (const CageResultPtr full = kept(*wanted_)) {
        made_ = full;
    } else if (const CageResultPtr preview = kept(previewOf(*wanted_))) {
        made_ = preview;
    } else if (made_ && made_->order.model != wanted_->model) {
        made_.reset();
    }
}

} // namespace vdbcage::view
