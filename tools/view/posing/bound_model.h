#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <tools/draw/stand_in.h>
#include <tools/view/state/state.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/deform/binding.h>

namespace vdbcage::view {

/// Everything that weights depend on; the material is not among it. Cages are compared by their content: one that was
/// made again with the same result is equal.
struct BindOrder {
    OpenedMeshPtr model;
    MeshPtr cage; ///< at rest; not null
    Coordinates family = Coordinates::meanValue;
    WeightsPtr weights = {}; ///< of the family `given`; null: another family
};
bool operator==(const BindOrder& a, const BindOrder& b);
inline bool operator!=(const BindOrder& a, const BindOrder& b)
{
    return !(a == b);
}
/// Returns the order for the document's model and family. \pre there is a model
BindOrder bindOrder(const Document& document, const MeshPtr& cage);

/// A model bound to a cage: coarsely at first, then completely. It never changes.
struct BoundModel {
    BindOrder order;
    std::shared_ptr<const draw::StandIn> standIn; ///< of the model
    std::shared_ptr<const Binding> coarse;        ///< of the model's points that belong to the stand-in's; null for
                                                  ///< weights
    std::shared_ptr<const Binding> whole;         ///< of the model's points; null: not yet
};
using BoundModelPtr = std::shared_ptr<const BoundModel>;

/// The most triangles of any stand-in: few enough to be posed and drawn at each frame of a motion.
constexpr std::size_t mostStandInTriangles = 12000;

/// Returns the most triangles that a bound stand-in of the model has: a tenth of the model's, within bounds.
std::size_t coarseTriangles(const Mesh& model);

/// Returns the order's family, and the model's points that no face uses.
CoordinateOptions coordinateOptions(const BindOrder& order);

/// Binds all of the model's points, or reads their weights. \throw InputError as Binding, naming the file; IoError as
/// readWeights; Cancelled
std::shared_ptr<const Binding> makeBinding(const BindOrder& order, Interrupter* interrupter);

/// Binds the stand-in. Its points are some of the model's, at most about a tenth, so it costs about as much of the
/// whole.
/// \throw InputError as Binding, naming the file; Cancelled
BoundModelPtr boundCoarsely(const BindOrder& order, Interrupter* interrupter);
/// Binds all points of the model. \throw as boundCoarsely
BoundModelPtr boundWhole(const BoundModel& coarse, Interrupter* interrupter);

/// Returns the same with another material if Somigliana coordinates were bound; else the same object.
/// \throw InputError as Binding::with
std::shared_ptr<const Binding> withMaterial(const std::shared_ptr<const Binding>& binding,
                                            const Elasticity& elasticity);
BoundModelPtr withMaterial(const BoundModelPtr& bound, const Elasticity& elasticity);

/// Returns the stand-in's points if the model's points that belong to them are at `posed` (one each): they keep their
/// offsets from these.
std::vector<openvdb::Vec3d> posedStandIn(const draw::StandIn& standIn, const Mesh& model,
                                         const std::vector<openvdb::Vec3d>& posed);

} // namespace vdbcage::view
