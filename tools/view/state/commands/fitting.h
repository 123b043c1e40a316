#pragma once

#include <tools/view/state/cage_changes.h>
#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>

/// Commands that fit the cage to the model, and that lock its points.
namespace vdbcage::view {

/// A fit of the shown cage, or another tightness of the last one. The cage is fitted by the maker of cages (see Order).
struct FitCage {
    double tightness = FitOptions().tightness; ///< in FitOptions::tightnesses

    static LineInfo info()
    {
        return {"fit", "[TIGHT]", 0, 1,
                "moves the cage's points until it bounds the model; 0: least moves, 1: tightest [0.5]"};
    }
    static FitCage read(const Arguments& arguments)
    {
        return arguments.count() == 0 ? FitCage{} : FitCage{arguments.number(0, FitOptions::tightnesses)};
    }
    std::string text() const { return tightness == FitCage().tightness ? "" : written(tightness); }
    void apply(Document& document, const Situation& now) const { document = withFit(now.state, now.cage, tightness); }
};

struct LockPoints {
    static LineInfo info() { return {"lock", "", 0, 0, "locks selected points: they stay in fits and motions"}; }
    void apply(Document& document, const Situation& now) const { document = withLocks(now.state, now.cage, true); }
};

struct UnlockPoints {
    static LineInfo info() { return {"unlock", "", 0, 0, "unlocks selected points"}; }
    void apply(Document& document, const Situation& now) const { document = withLocks(now.state, now.cage, false); }
};

} // namespace vdbcage::view
