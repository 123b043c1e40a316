#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tools/view/state/pose.h>

namespace vdbcage::view {

/// The number of the last frame; the first one is 0.
constexpr int lastFrame = 99999;

/// A pose at a frame.
struct PoseKey {
    int frame = 0;    ///< 0 to lastFrame
    PosePtr pose;     ///< null: at rest
    std::string name; ///< empty: none
};

/// Poses along frames. A value; copies share the keys. Before the first key the pose is that of the first, after the
/// last that of the last, and at rest if there are no keys. Between two keys points move straight and evenly.
class TimeLine {
public:
    /// Returns the keys in order, at most one for a frame.
    const std::vector<PoseKey>& keys() const;
    /// Returns the key at the frame; null: there is none.
    const PoseKey* keyAt(int frame) const;
    bool isEmpty() const { return keys().empty(); }
    /// Returns the frame of the first or last key; 0 if there are none.
    int firstFrame() const { return isEmpty() ? 0 : keys().front().frame; }
    int finalFrame() const { return isEmpty() ? 0 : keys().back().frame; }

    /// Returns a copy with this key, in place of one at its frame.
    TimeLine with(PoseKey key) const;
    /// Returns a copy without the key at the frame, if there is one.
    TimeLine without(int frame) const;

    /// The pose at a frame: a share of the way from one pose to another.
    struct Between {
        PosePtr from, to; ///< null: at rest
        double share = 0; ///< 0 to 1; 0 where the pose is `from`
    };
    Between at(int frame) const;

    friend bool operator==(const TimeLine& a, const TimeLine& b);
    friend bool operator!=(const TimeLine& a, const TimeLine& b) { return !(a == b); }

private:
    std::shared_ptr<const std::vector<PoseKey>> keys_; // null: none
};

/// Returns whether pointsAt() has nothing to carry over, at any frame. Cost: O(keys).
bool areCarried(const TimeLine& timeLine, const PosableCage& cage);

/// Returns the cage's points at a frame.
/// Cost: O(points), and once for each pose that was made for another cage as PosableCage::points.
std::vector<openvdb::Vec3d> pointsAt(const TimeLine& timeLine, int frame, PosableCage& cage);

} // namespace vdbcage::view
