#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <tools/view/jobs/runner.h>
#include <tools/view/posing/posing.h>
#include <tools/view/state/session.h>

namespace vdbcage::view {

/// The results of a session from other threads: its cage (see Runner), and the model as the cage poses it (see Posing).
class Making {
public:
    /// `maker` null: pipelines; `binding` empty: by the library. `wake`: see Runner.
    Making(std::unique_ptr<CageMaker> maker, Binder::Work binding, const std::function<void()>& wake);

    /// The things that the user is dragging.
    struct Hand {
        bool hasValue = false; ///< an option, by its slider or the like
        bool hasCage = false;  ///< the selected parts of the cage
    };
    /// Orders the session's wanted cage, sets the cage that it shows, and follows its pose.
    void follow(Session& session, const Hand& hand);
    /// Sets whether made cages have their intermediates even if no layer shows them.
    void keepIntermediates(bool keeps) { keepsIntermediates_ = keeps; }

    /// Returns the shown cage, of the last follow(); null: none.
    const CageResultPtr& cage() const { return cage_; }
    const Planner& planner() const { return runner_.planner(); }
    const Posing& posing() const { return posing_; }
    /// Returns the progress of the cage that is being made.
    std::optional<Progress> progress() const { return runner_.progress(); }

    /// Takes the results of other threads, and begins the next jobs.
    void update();
    /// Returns whether all work for the last follow() is done.
    bool isSettled() const { return planner().isSettled() && posing_.isSettled(); }
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// Begins cancelled or failed jobs again.
    void again();
    void cancel();

private:
    Runner runner_;
    Posing posing_;
    CageResultPtr cage_;
    bool keepsIntermediates_ = false;
};

} // namespace vdbcage::view
