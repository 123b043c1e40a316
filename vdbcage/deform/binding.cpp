// Differs from the papers: a pose adds the moves of the handles to the rest pose, instead of summing up their
// positions. Single precision is thus enough, the rest pose is exact, and the weights of handles that do not move are
// not read.

#include <vdbcage/deform/binding.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/given_weights.h>
#include <vdbcage/deform/detail/point_checks.h>
#include <vdbcage/deform/detail/row_maker.h>
#include <vdbcage/deform/detail/weight_blocks.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

/// Returns how far each handle may move, in longest sides of the cage: 1 for a point; vectors by family.
std::vector<float> reachOf(const Mesh& cage, Coordinates family)
{
    std::vector<float> reach(cage.points.size(), 1.0F);
    const detail::VectorHandles& vectors = detail::coordinateFamily(family).vectors;
    if (vectors.addReach != nullptr) vectors.addReach(cage, reach);
    return reach;
}

} // namespace

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, const CoordinateOptions& options,
                 Interrupter* interrupter)
    : cage_(cage), points_(std::move(points)), options_(options)
{
    const Stage stage(interrupter, StageName::bind);
    detail::RowMaker maker(cage_, points_, options_, interrupter);
    restHandles_ = cageHandles(cage_, cage_.points, options_);
    weights_ = std::make_shared<detail::WeightBlocks>(
        points_, reachOf(cage_, family()),
        [&](const std::vector<std::uint32_t>& block, std::vector<float>& rows) {
            maker.make(block.data(), block.size(), rows.data());
        },
        interrupter);
    maker.requireDefined();
}

Binding::Binding(const Mesh& cage, std::vector<Vec3d> points, const CoordinateOptions& options,
                 const std::vector<float>& weights)
    : cage_(cage), points_(std::move(points)), options_(options)
{
    requireUsable(cage, "cage");
    detail::requireFinite(points_, "points");
    restHandles_ = cageHandles(cage, cage.points, options_);
    detail::requireWeights(weights.size(), points_.size(), handles());
    if (family() == Coordinates::given) {
        const std::string problem = detail::weightsProblem(weights, handles());
        if (!problem.empty()) throw InputError("weights", problem);
    }
    weights_ = std::make_shared<detail::WeightBlocks>(
        points_, reachOf(cage_, family()), [&](const std::vector<std::uint32_t>& block, std::vector<float>& rows) {
            for (std::size_t i = 0; i < block.size(); ++i) {
                std::copy_n(weights.begin() + static_cast<std::ptrdiff_t>(block[i] * handles()), handles(),
                            rows.begin() + static_cast<std::ptrdiff_t>(i * handles()));
            }
        });
}

Binding Binding::with(const Elasticity& elasticity) const
{
    requireElasticity(elasticity);
    if (!familyInfo(family()).hasElasticity) return *this;
    Binding changed = *this;
    changed.options_.elasticity = elasticity;
    changed.restHandles_ = cageHandles(cage_, cage_.points, changed.options_);
    return changed;
}

std::size_t Binding::weightBytes() const
{
    return weights_->bytes();
}

std::vector<Vec3d> Binding::pose(const std::vector<Vec3d>& cagePoints) const
{
    std::vector<Vec3d> posed = points_;
    add(restHandles_, cageHandles(cage_, cagePoints, options_), posed);
    return posed;
}

void Binding::update(std::vector<Vec3d>& posed, const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) const
{
    detail::requireCount("posed points", posed.size(), points_.size(), "the binding");
    add(cageHandles(cage_, from, options_), cageHandles(cage_, to, options_), posed);
}

void Binding::add(const std::vector<Vec3d>& fromHandles, const std::vector<Vec3d>& toHandles,
                  std::vector<Vec3d>& posed) const
{
    // In units of the cage: floats hold the motion of models of any size.
    const double size = detail::longestSide(boundingBox(cage_));
    std::vector<detail::HandleMove> moves;
    for (std::size_t k = 0; k < toHandles.size(); ++k) {
        if (fromHandles[k] == toHandles[k]) continue;
        moves.push_back({k, openvdb::Vec3f((toHandles[k] - fromHandles[k]) / size)});
    }
    if (!moves.empty()) weights_->move(moves, size, posed);
}

} // namespace vdbcage
