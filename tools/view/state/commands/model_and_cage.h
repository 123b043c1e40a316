#pragma once

#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>
#include <vdbcage/core/error.h>

/// Commands that open the model and the cage.
namespace vdbcage::view {

/// A command that opens another model, for which a cage is made.
struct OpenModel {
    std::string path;

    static LineInfo info() { return {"open", "FILE", 1, 1, "opens a model and makes its cage"}; }
    static OpenModel read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        document.model = openMesh(path);
        document.setCage(nullptr);
        document.poses = {};
        if (document.weights) document.coordinates = Coordinates::meanValue;
        document.weights.reset();
    }
};

/// A command that opens a cage in place of a made one.
struct OpenCage {
    std::string path;

    static LineInfo info() { return {"open-cage", "FILE", 1, 1, "shows a cage from a file instead of making one"}; }
    static OpenCage read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        if (!document.model) throw InputError("open-cage", "there is no model yet that the cage could bound");
        document.setCage(openMesh(path));
    }
};

struct CloseCage {
    static LineInfo info() { return {"close-cage", "", 0, 0, "goes back to the cage that the options make"}; }
    void apply(Document& document, const Situation& /*now*/) const { document.setCage(nullptr); }
};

} // namespace vdbcage::view
