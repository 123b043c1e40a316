#pragma once

#include <tools/view/state/opened_mesh.h>

namespace vdbcage::view {

/// Looks whether the model's file has changed on disk since it was opened.
class ModelWatch {
public:
    /// Returns whether it has changed since the last look.
    bool look(const OpenedMesh& model)
    {
        const FileStamp stamp = stampOf(model.path);
        // A file that is gone may come back in a moment, as when a program saves.
        if (stamp == FileStamp{} || stamp == model.stamp || stamp == ignored_ || hasChanged_) return false;
        hasChanged_ = true;
        changed_ = stamp;
        return true;
    }

    /// It has changed, and the user has not said yet what to do.
    bool hasChanged() const { return hasChanged_; }
    /// The user knows: what is there now is not spoken of again.
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
