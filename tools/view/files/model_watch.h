#pragma once

#include <tools/view/state/opened_mesh.h>

namespace vdbcage::view {

/// A watch for changes of the model's file on disk since it was opened.
class ModelWatch {
public:
    /// Returns whether it has changed since the last call.
    bool look(const OpenedMesh& model)
    {
        const FileStamp stamp = stampOf(model.path);
        // A missing file may come back in a moment, as when a program saves.
        if (stamp == FileStamp{} || stamp == model.stamp || stamp == ignored_ || hasChanged_) return false;
        hasChanged_ = true;
        changed_ = stamp;
        return true;
    }

    /// Returns whether it has changed and the user has not answered yet.
    bool hasChanged() const { return hasChanged_; }
    /// Notes that the user knows: the present change is not reported again.
    void ignore()
    {
        hasChanged_ = false;
        ignored_ = changed_;
    }

private:
    FileStamp changed_, ignored_;
    bool hasChanged_ = false;
};

} // namespace vdbcage::view
