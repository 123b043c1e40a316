#include <tools/view/state/time_line.h>

#include <algorithm>
#include <utility>

namespace vdbcage::view {

namespace {

bool isBefore(const PoseKey& key, int frame)
{
    return key.frame < frame;
}

} // namespace

const std::vector<PoseKey>& TimeLine::keys() const
{
    static const std::vector<PoseKey> none;
    return keys_ ? *keys_ : none;
}

const PoseKey* TimeLine::keyAt(int frame) const
{
    const auto found = std::lower_bound(keys().begin(), keys().end(), frame, isBefore);
    return found != keys().end() && found->frame == frame ? &*found : nullptr;
}

TimeLine TimeLine::with(PoseKey key) const
{
    std::vector<PoseKey> changed = without(key.frame).keys();
    changed.insert(std::lower_bound(changed.begin(), changed.end(), key.frame, isBefore), std::move(key));
    TimeLine timeLine;
    timeLine.keys_ = std::make_shared<const std::vector<PoseKey>>(std::move(changed));
    return timeLine;
}

TimeLine TimeLine::without(int frame) const
{
    if (!keyAt(frame)) return *this;
    std::vector<PoseKey> changed = keys();
    changed.erase(std::lower_bound(changed.begin(), changed.end(), frame, isBefore));
    TimeLine timeLine;
    if (!changed.empty()) timeLine.keys_ = std::make_shared<const std::vector<PoseKey>>(std::move(changed));
    return timeLine;
}

TimeLine::Between TimeLine::at(int frame) const
{
    if (isEmpty()) return {};
    const auto next = std::lower_bound(keys().begin(), keys().end(), frame, isBefore);
    if (next == keys().end()) return {keys().back().pose, nullptr, 0};
    if (next->frame == frame || next == keys().begin()) return {next->pose, nullptr, 0};
    const PoseKey& before = *(next - 1);
    return {before.pose, next->pose, 1.0 * (frame - before.frame) / (next->frame - before.frame)};
}

bool operator==(const TimeLine& a, const TimeLine& b)
{
    return a.keys_ == b.keys_ ||
           std::equal(a.keys().begin(), a.keys().end(), b.keys().begin(), b.keys().end(),
                      [](const PoseKey& x, const PoseKey& y) {
                          return x.frame == y.frame && x.name == y.name && areEqual(x.pose, y.pose);
                      });
}

bool areCarried(const TimeLine& timeLine, const PosableCage& cage)
{
    return std::all_of(timeLine.keys().begin(), timeLine.keys().end(),
                       [&](const PoseKey& key) { return cage.has(key.pose); });
}

std::vector<openvdb::Vec3d> pointsAt(const TimeLine& timeLine, int frame, PosableCage& cage)
{
    const TimeLine::Between between = timeLine.at(frame);
    std::vector<openvdb::Vec3d> points = cage.points(between.from);
    if (!(between.share > 0)) return points;
    const std::vector<openvdb::Vec3d>& to = cage.points(between.to);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = (1 - between.share) * points[i] + between.share * to[i];
    }
    return points;
}

} // namespace vdbcage::view
