#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tools/view/state/pose.h>

namespace vdbcage::view {

/// Frames are numbered from 0 to this.
constexpr int lastFrame = 99999;

/// A pose at a frame.
struct PoseKey {
    int frame = 0;    ///< 0 to lastFrame
    PosePtr pose;     ///< null: at rest
    std::string name; ///< empty: none
};

/// Poses along frames. A value; a copy shares the keys. Without keys all is at rest. Before the first key the pose is
/// that of the first, after the last that of the last. Between two keys points go straight and evenly from one to the
/// other.
class TimeLine {
public:
    /// By frame, each frame once.
    const std::vector<PoseKey>& keys() const;
    /// Null: there is none.
    const PoseKey* keyAt(int frame) const;
    bool isEmpty() const { return keys().empty(); }
    /// Frames of the first and the last key. 0 if there are none.
    int firstFrame() const { return isEmpty() ? 0 : keys().front().frame; }
    int finalFrame() const { return isEmpty() ? 0 : keys().back().frame; }

    /// With this key, in place of one that is at its frame.
    TimeLine with(PoseKey key) const;
    /// Without the key at the frame, if there is one.
    TimeLine without(int frame) const;

    /// What the pose at a frame is made of: a share of the way from one pose to another.
    struct Between {
        PosePtr from, to; ///< null: at rest
        double share = 0; ///< 0 to 1; 0 where `from` is all of it
    };
    Between at(int frame) const;

    friend bool operator==(const TimeLine& a, const TimeLine& b);
    friend bool operator!=(const TimeLine& a, const TimeLine& b) { return !(a == b); }

private:
    std::shared_ptr<const std::vector<PoseKey>> keys_; // null: none
};

/// Whether pointsAt() has nothing to carry over, at any frame. Cost: O(keys).
bool areCarried(const TimeLine& timeLine, const PosableCage& cage);

/// The cage's points at a frame.
/// Cost: O(points), and once for each pose that was made for another cage as PosableCage::points.
std::vector<openvdb::Vec3d> pointsAt(const TimeLine& timeLine, int frame, PosableCage& cage);

} // namespace vdbcage::view
