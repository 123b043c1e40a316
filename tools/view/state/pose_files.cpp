#include <tools/view/state/pose_files.h>

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <tools/files/frames.h>
#include <tools/files/posed_cage.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

namespace fs = std::filesystem;
using openvdb::Vec3d;

PosedPoints openPosedCage(const Mesh& cage, const fs::path& path)
{
    const OpenedMeshPtr posed = openMesh(path);
    return files::posedPointsOf(posed->path, posed->mesh, cage);
}

TimeLine openSequence(const MeshPtr& cage, const fs::path& path, std::string* remark)
{
    const fs::path pattern = patternOf(path);
    if (!files::isPattern(pattern)) {
        throw InputError(path.string(), "its name has no number; a sequence is named as walk.0001.obj");
    }
    TimeLine poses;
    const std::vector<files::Frame> frames = files::findFrames(pattern);
    std::size_t reordered = 0;
    for (const files::Frame& frame : frames) {
        if (frame.number > lastFrame) {
            throw InputError(frame.path.string(), "the number of a frame must be at most " + std::to_string(lastFrame));
        }
        PosedPoints pose = openPosedCage(*cage, frame.path);
        reordered += pose.reordered;
        poses = poses.with(
            {static_cast<int>(frame.number), poseOf(cage, std::move(pose.points)), frame.path.stem().string()});
    }
    if (remark) *remark = files::describeOrder(pattern.filename(), reordered, frames.size());
    return poses;
}

/// A reader of the numbers of a file of parameters.
class Parameters {
public:
    explicit Parameters(const fs::path& path) : path_(path.string()), words_(detail::readFile(path)) {}

    double number(const std::string& what)
    {
        std::string word;
        if (!(words_ >> word)) throw InputError(path_, "it ends where " + what + " should be");
        try {
            return numberOf(word, what);
        } catch (const InputError& error) {
            throw InputError(path_, error.what());
        }
    }
    std::size_t whole(const std::string& what, std::size_t most)
    {
        const double value = number(what);
        if (!(value >= 0 && value <= static_cast<double>(most) && value == std::floor(value))) {
            std::ostringstream text;
            text << what << " is " << value << "; it must be a whole number from 0 to " << most;
            throw InputError(path_, text.str());
        }
        return static_cast<std::size_t>(value);
    }
    void requireEnd()
    {
        std::string word;
        if (words_ >> word) throw InputError(path_, "'" + word + "' comes after the last move");
    }

private:
    std::string path_;
    std::istringstream words_;
};

TimeLine openParameters(const MeshPtr& cage, const fs::path& path, int frames)
{
    Parameters parameters(path);
    const double least = parameters.number("the least factor"), most = parameters.number("the largest factor");
    const std::size_t count = parameters.whole("the number of moves", cage->points.size());
    std::vector<Vec3d> moves(cage->points.size(), Vec3d(0));
    for (std::size_t i = 0; i < count; ++i) {
        Vec3d& move = moves[parameters.whole("the number of a point", cage->points.size() - 1)];
        for (int k = 0; k < 3; ++k) move[k] = parameters.number("a move");
    }
    parameters.requireEnd();
    const auto posed = [&](double factor) {
        std::vector<Vec3d> points = cage->points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] += factor * moves[i];
            if (!points[i].isFinite()) throw InputError(path.string(), "it moves a point out of all numbers");
        }
        return poseOf(cage, std::move(points));
    };
    const std::string name = path.stem().string();
    const TimeLine poses = TimeLine().with({frames - 1, posed(most), name});
    return frames > 1 ? poses.with({0, posed(least), name}) : poses;
}

} // namespace

Document withOpenedPose(const State& state, const PosableCagePtr& cage, const fs::path& path, std::string* remark)
{
    PosedPoints pose = openPosedCage(*restOf(cage), path);
    if (remark) *remark = files::describeOrder(path.filename(), pose.reordered, 1);
    return withPose(state, cage, std::move(pose.points));
}

Document withOpenedPoses(const State& state, const PosableCagePtr& cage, const fs::path& path, int frames,
                         std::string* remark)
{
    const MeshPtr& rest = restOf(cage);
    Document document = state.document;
    document.poses =
        path.extension() == ".param" ? openParameters(rest, path, frames) : openSequence(rest, path, remark);
    return document;
}

fs::path patternOf(const fs::path& path)
{
    if (files::isPattern(path)) return path;
    const std::string name = path.filename().string(), stem = path.stem().string();
    const std::size_t last = stem.find_last_of("0123456789");
    if (last == std::string::npos) return path;
    const std::size_t before = stem.find_last_not_of("0123456789", last);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    const std::size_t digits = last - first + 1;
    const auto with = [&](const std::string& place) {
        return path.parent_path() / (name.substr(0, first) + place + name.substr(last + 1));
    };
    const fs::path plain = with("%d"), padded = with("%0" + std::to_string(digits) + 'd');
    if (digits == 1) return plain;
    return name[first] == '0' || files::countFrames(plain) <= files::countFrames(padded) ? padded : plain;
}

} // namespace vdbcage::view
