#pragma once

#include <optional>

#include <tools/view/state/cage_changes.h>
#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>
#include <tools/view/state/pose_files.h>
#include <vdbcage/core/error.h>

/// Commands for the poses on the time line. Frames are 0 to lastFrame.
namespace vdbcage::view {

/// Returns the key at the frame. \throw InputError naming the command: there is none
inline PoseKey requiredKey(const TimeLine& poses, int frame, const std::string& command)
{
    const PoseKey* const key = poses.keyAt(frame);
    if (!key) throw InputError(command, "there is no key at frame " + std::to_string(frame));
    return *key;
}

/// A command that sets the pose of the view's frame.
struct OpenPose {
    std::string path;

    static LineInfo info() { return {"open-pose", "FILE", 1, 1, "poses the cage as another file has it"}; }
    static OpenPose read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
    void apply(Document& document, const Situation& now) const
    {
        document = withOpenedPose(now.state, now.cage, path, now.remark);
    }
};

/// A command that replaces all poses by a sequence of posed cages, or by a file of parameters.
struct OpenPoses {
    std::string path;
    int frames = 25; ///< of a file of parameters, 1 to lastFrame + 1

    static LineInfo info()
    {
        return {"open-poses", "FILE [FRAMES]", 1, 2,
                "opens a sequence such as walk.%04d.obj, or one of its files; or FRAMES frames of a .param file"};
    }
    static OpenPoses read(const Arguments& arguments)
    {
        return {arguments[0], arguments.count() == 1 ? OpenPoses().frames : arguments.whole(1, 1, lastFrame + 1)};
    }
    std::string text() const { return written(path) + (frames == OpenPoses().frames ? "" : written(frames)); }
    void apply(Document& document, const Situation& now) const
    {
        document = withOpenedPoses(now.state, now.cage, path, frames, now.remark);
    }
};

/// A command that makes the pose at the frame a key if there is none, and names it.
struct SetKey {
    int frame = 0;
    std::optional<std::string> name = {}; ///< none: the present name

    static LineInfo info()
    {
        return {"set-key", "FRAME [NAME]", 1, 2, "keeps the pose at a frame on the time line, and names it"};
    }
    static SetKey read(const Arguments& arguments)
    {
        SetKey line{arguments.whole(0, 0, lastFrame)};
        if (arguments.count() == 2) line.name = arguments[1];
        return line;
    }
    std::string text() const { return written(frame) + (name ? written(*name) : ""); }
    void apply(Document& document, const Situation& now) const { document = withKey(now.state, now.cage, frame, name); }
};

struct DeleteKey {
    int frame = 0;

    static LineInfo info() { return {"delete-key", "FRAME", 1, 1, "takes a pose off the time line"}; }
    static DeleteKey read(const Arguments& arguments) { return {arguments.whole(0, 0, lastFrame)}; }
    std::string text() const { return written(frame); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        requiredKey(document.poses, frame, "delete-key");
        document.poses = document.poses.without(frame);
    }
};

/// A command that moves a key to a frame that has none.
struct MoveKey {
    int from = 0, to = 0;

    static LineInfo info() { return {"move-key", "FROM TO", 2, 2, "moves a pose to another frame"}; }
    static MoveKey read(const Arguments& arguments)
    {
        return {arguments.whole(0, 0, lastFrame), arguments.whole(1, 0, lastFrame)};
    }
    std::string text() const { return written(from, to); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        PoseKey key = requiredKey(document.poses, from, "move-key");
        if (from == to) return;
        if (document.poses.keyAt(to)) {
            throw InputError("move-key", "there is a key at frame " + std::to_string(to) + " already");
        }
        key.frame = to;
        document.poses = document.poses.without(from).with(std::move(key));
    }
};

/// A command that replaces all poses by a motion from rest.
struct MakeInBetweens {
    int frames = 25; ///< 2 to lastFrame + 1

    static LineInfo info()
    {
        return {"in-betweens", "FRAMES", 1, 1, "makes so many frames from rest to the pose that is seen"};
    }
    static MakeInBetweens read(const Arguments& arguments) { return {arguments.whole(0, 2, lastFrame + 1)}; }
    std::string text() const { return written(frames); }
    void apply(Document& document, const Situation& now) const
    {
        document = withInBetweens(now.state, now.cage, frames);
    }
};

struct ClearPoses {
    static LineInfo info() { return {"clear-poses", "", 0, 0, "takes all poses off the time line"}; }
    void apply(Document& document, const Situation& /*now*/) const { document.poses = {}; }
};

} // namespace vdbcage::view
