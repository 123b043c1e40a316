#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <tools/draw/stand_in.h>
#include <tools/view/state/opened_mesh.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage::view {

using MeshPtr = std::shared_ptr<const Mesh>;

/// Weights from a file (see readWeights). They are read when something is bound.
struct OpenedWeights {
    std::filesystem::path path; ///< absolute
};
using WeightsPtr = std::shared_ptr<const OpenedWeights>;
/// \throw IoError there is no such file
WeightsPtr openWeights(const std::filesystem::path& path);

/// Everything that weights depend on; the material is not of it. Cages are compared by what they are: one that was made
/// anew and came out the same is the same.
struct BindOrder {
    OpenedMeshPtr model;
    MeshPtr cage; ///< at rest; not null
    Coordinates family = Coordinates::meanValue;
    WeightsPtr weights = {}; ///< of the family given; null: of any other
};
bool operator==(const BindOrder& a, const BindOrder& b);
inline bool operator!=(const BindOrder& a, const BindOrder& b)
{
    return !(a == b);
}

/// A model bound to a cage: coarsely at first, then whole. It never changes.
struct BoundModel {
    BindOrder order;
    std::shared_ptr<const draw::StandIn> standIn; ///< of the model
    std::shared_ptr<const Binding> coarse;        ///< of the points that the stand-in's go with; null for weights
    std::shared_ptr<const Binding> whole;         ///< of the model's points; null: not yet
};
using BoundModelPtr = std::shared_ptr<const BoundModel>;

/// At most so many triangles a stand-in of a model has: a tenth of the model's, and so many as are drawn at once.
std::size_t coarseTriangles(const Mesh& model);

/// The family of an order, and the model's points that no face uses.
CoordinateOptions coordinateOptions(const BindOrder& order);

/// Binds all of the model's points, or reads their weights. \throw InputError as Binding, naming the file; IoError as
/// readWeights; Cancelled
std::shared_ptr<const Binding> bindingOf(const BindOrder& order, Interrupter* interrupter);

/// Binds the stand-in. Its points are some of the model's, at most about a tenth, so it costs about as much of the
/// whole.
/// \throw InputError as Binding, naming the file; Cancelled
BoundModelPtr boundCoarsely(const BindOrder& order, Interrupter* interrupter);
/// Binds the rest. \throw as boundCoarsely
BoundModelPtr boundWhole(const BoundModel& coarse, Interrupter* interrupter);

/// The same with another material, where Somigliana coordinates were bound; else the same object.
/// \throw InputError as Binding::with
std::shared_ptr<const Binding> withMaterial(const std::shared_ptr<const Binding>& binding,
                                            const Elasticity& elasticity);
BoundModelPtr withMaterial(const BoundModelPtr& bound, const Elasticity& elasticity);

/// Where the stand-in's points are when the model's points that they go with are at `posed` (one each): they keep their
/// distance from these.
std::vector<openvdb::Vec3d> posedStandIn(const draw::StandIn& standIn, const Mesh& model,
                                         const std::vector<openvdb::Vec3d>& posed);

} // namespace vdbcage::view
