#pragma once

#include <openvdb/Types.h>

/// Poses for cages of our own models: where a point of a cage goes.
namespace data {

/// The creature walks in place: `time` is the share of a stride that has passed. A point is turned around the joints of
/// the leg it belongs to, the further below a joint the more; the angles put the hoofs where the stride needs them.
openvdb::Vec3d walking(const openvdb::Vec3d& p, double time);

/// The bishop bows to the front, without stretching its axis.
openvdb::Vec3d bowing(const openvdb::Vec3d& p);

} // namespace data
