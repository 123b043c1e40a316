#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <tools/view/jobs/posing.h>
#include <tools/view/jobs/runner.h>
#include <tools/view/state/session.h>

namespace vdbcage::view {

/// What is made of a session on other threads: its cage (see Runner), and the model as the cage poses it (see Posing).
class Making {
public:
    /// `maker` null: pipelines; `binding` empty: by the library. `wake`: see Runner.
    Making(std::unique_ptr<CageMaker> maker, Binder::Work binding, const std::function<void()>& wake);

    /// What the user has in hand.
    struct Hand {
        bool hasValue = false; ///< the slider of an option, or the like
        bool hasCage = false;  ///< what is selected of the cage
    };
    /// Orders the cage that the session wants, gives it the one that is there, and follows its pose.
    void follow(Session& session, const Hand& hand);
    /// Cages that are made have what is between model and cage, whether it is shown or not.
    void keepIntermediates(bool keeps) { keepsIntermediates_ = keeps; }

    /// The cage that is seen, as of the last follow(); null: none.
    const CageResultPtr& cage() const { return cage_; }
    const Planner& planner() const { return runner_.planner(); }
    const Posing& posing() const { return posing_; }
    /// Of the cage that is being made.
    std::optional<Progress> progress() const { return runner_.progress(); }

    /// Takes what was done on other threads, and begins what is next.
    void update();
    /// Nothing that was wanted by the last follow() is left to do.
    bool isSettled() const { return planner().isSettled() && posing_.isSettled(); }
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// What was cancelled or failed is begun again; what is under way is cancelled.
    void again();
    void cancel();

private:
    Runner runner_;
    Posing posing_;
    CageResultPtr cage_;
    bool keepsIntermediates_ = false;
};

} // namespace vdbcage::view
