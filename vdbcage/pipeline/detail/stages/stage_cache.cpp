#include <vdbcage/pipeline/detail/stages/stage_cache.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/pipeline/detail/stages/mesh_tools.h>
#include <vdbcage/pipeline/detail/stages/starting_surface.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage::detail {

bool WishesKey::operator==(const WishesKey& other) const
{
    return guard == other.guard && density == other.density && joints == other.joints &&
           jointDensity == other.jointDensity;
}

StageCache::StageCache(const Mesh& model, Volumes& volumes, const std::optional<Symmetry>& acrossX)
    : model_(model), volumes_(volumes)
{
    if (acrossX) symmetry_.of(CageSymmetry::x, [&] { return *acrossX; });
}

bool StageCache::isSheet(const CageOptions& options, Interrupter* interrupter)
{
    const SolidKey key{policy::sheetResolution, options.voxelizer, options.interior, std::nullopt};
    return sheet_.of(key, [&] {
        const auto solid = volumes_.solid(key, interrupter);
        const std::size_t inner = countOf(*erode(*solid->mask, 1, StructuringElement::cube, interrupter));
        return detail::isSheet(solid->voxels, inner, key.resolution);
    });
}

const Symmetry& StageCache::symmetry(CageSymmetry choice, Interrupter* interrupter)
{
    return symmetry_.of(choice, [&] {
        const Stage stage(interrupter, StageName::symmetry);
        if (choice == CageSymmetry::automatic) {
            // A model too large for doubles has none.
            constexpr double any = std::numeric_limits<double>::infinity();
            return findSymmetry(model_, any, interrupter).value_or(Symmetry{{}, any});
        }
        const int axis = choice == CageSymmetry::x ? 0 : choice == CageSymmetry::y ? 1 : 2;
        return bestSymmetry(model_, axis, interrupter);
    });
}

Rules StageCache::rules(const CageOptions& options, const FieldVersion& density, bool ofSheet,
                        const std::optional<SymmetryPlane>& plane, Interrupter* interrupter)
{
    WishesKey key{guardOptions(options, ofSheet), density, options.joints.list, jointDensity(options)};
    key.guard.symmetry = plane;
    const auto guard = guard_.of(key.guard, [&] {
        const Stage stage(interrupter, StageName::guard);
        starts_.clear();
        wishes_.forget();
        return std::make_shared<const BoundingGuard>(model_, key.guard, interrupter);
    });
    const FaceWishes wishes = wishes_.of(key, [&] {
        return FaceWishes(*guard, {options.density, key.joints, key.jointDensity}, interrupter);
    });
    return {std::move(key), guard, wishes};
}

const AlignedAxes& StageCache::axes(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter)
{
    const Axis axis = plane ? Axis(plane->axis) : std::nullopt;
    return axes_.of(axis, [&] { return alignedAxes(model_, axis, interrupter); });
}

StageCache::Turned& StageCache::turnedModel(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter)
{
    const openvdb::Mat3d& rows = axes(plane, interrupter).rows;
    return *turned_.of(plane ? Axis(plane->axis) : std::nullopt,
                       [&] { return std::make_unique<Turned>(turned(model_, rows)); });
}

double StageCache::turnedSide(const std::optional<SymmetryPlane>& plane, Interrupter* interrupter)
{
    return longestSide(boundingBox(turnedModel(plane, interrupter).model)) / longestSide(boundingBox(model_));
}

std::size_t StageCache::quadsOf(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                                Interrupter* interrupter)
{
    const ClosingKey key = closingKey(options, scale, voxels);
    const auto known =
        std::find_if(quads_.begin(), quads_.end(), [&](const auto& counted) { return counted.first == key; });
    if (known != quads_.end()) return known->second;
    const auto closing = volumes_.closing(options, scale, voxels, interrupter);
    const std::size_t quads = faceCount(*closingSurface_.of(key, [&] {
        const Stage stage(interrupter, StageName::surface);
        return std::make_shared<const Mesh>(extractSurface(*closing->mask, interrupter));
    }));
    constexpr std::size_t most = 64;
    if (quads_.size() >= most) quads_.clear();
    quads_.emplace_back(key, quads);
    return quads;
}

std::shared_ptr<KeptStart> StageCache::keptStart(const CageOptions& options, const FieldVersion& scale,
                                                 const Voxels& voxels, CageStart kind, const Rules& rules,
                                                 Interrupter* interrupter)
{
    const ClosingKey key = closingKey(options, scale, voxels);
    const auto isIt = [&](const auto& kept) {
        return kept->surface.kind == kind && kept->turned == voxels.turned && kept->surface.closing->key == key;
    };
    auto known = std::find_if(starts_.begin(), starts_.end(), isIt);
    if (known == starts_.end()) {
        StartingSurface surface = makeStart(options, scale, voxels, kind, rules, interrupter);
        KeptStart kept{voxels.turned, rules.guard, std::move(surface), {}};
        known = starts_.insert(starts_.end(), std::make_shared<KeptStart>(std::move(kept)));
    }
    (*known)->isUsed = true;
    return *known;
}

StartingSurface StageCache::makeStart(const CageOptions& options, const FieldVersion& scale, const Voxels& voxels,
                                      CageStart kind, const Rules& rules, Interrupter* interrupter)
{
    const BoundingGuard& guard = *rules.guard;
    const auto closingOf = [&](Volumes& volumes) { return volumes.closing(options, scale, voxels, interrupter); };
    auto closing = closingOf(volumes_);
    if (isSimpleSolid(kind)) {
        return simpleSolid(std::move(closing), kind, model_, axes(guard.symmetry(), interrupter).rows,
                           thinnestBox(rules.key.guard), guard, interrupter);
    }
    if (voxels.turned) {
        Turned& turned = turnedModel(guard.symmetry(), interrupter);
        StartingSurface start = startingSurface(closingOf(turned.volumes), kind,
                                                axes(guard.symmetry(), interrupter).rows, nullptr, guard, interrupter);
        start.closing = std::move(closing); // in the model's own place
        return start;
    }
    const auto* const knownSurface = closingSurface_.find(closing->key);
    std::shared_ptr<const Mesh> extracted = knownSurface ? *knownSurface : nullptr;
    closingSurface_.forget();
    return startingSurface(std::move(closing), kind, std::nullopt, std::move(extracted), guard, interrupter);
}

void StageCache::beginRun()
{
    for (const auto& kept : starts_) kept->isUsed = false;
}

void StageCache::endRun()
{
    const auto isUnused = [](const auto& kept) { return !kept->isUsed; };
    starts_.erase(std::remove_if(starts_.begin(), starts_.end(), isUnused), starts_.end());
}

} // namespace vdbcage::detail
