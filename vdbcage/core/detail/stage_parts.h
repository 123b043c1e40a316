#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <mutex>
#include <numeric>
#include <vector>

#include <vdbcage/core/interrupter.h>

/// Progress of work that is a part of a stage. Null stands for nobody who watches, as everywhere.
namespace vdbcage::detail {

/// One of several steps, one after another: 0 to 100 % of it are `from` to `to` of the whole.
class StagePart : public Interrupter {
public:
    StagePart(Interrupter* whole, int from, int to) : whole_(whole), from_(from), to_(to) {}

    /// To be passed on to the work.
    Interrupter* passedOn() { return whole_ ? this : nullptr; }

    bool wasInterrupted(int percent) override
    {
        return whole_->wasInterrupted(percent < 0 ? -1 : from_ + (to_ - from_) * std::min(percent, 100) / 100);
    }

private:
    Interrupter* whole_;
    int from_, to_;
};

/// Several pieces of work side by side, each of which says how far it is: together they are as far as the mean by
/// weight, and never go back.
class StagesSideBySide {
public:
    /// \param weights of the pieces, positive
    StagesSideBySide(Interrupter* whole, const std::vector<double>& weights)
        : whole_(whole), weight_(std::accumulate(weights.begin(), weights.end(), 0.0))
    {
        for (const double weight : weights) pieces_.emplace_back(*this, weight);
    }
    StagesSideBySide(const StagesSideBySide&) = delete;
    StagesSideBySide& operator=(const StagesSideBySide&) = delete;

    /// To be passed on to the i-th piece of work. Any thread may ask it.
    Interrupter* passedOn(std::size_t i) { return whole_ ? &pieces_[i] : nullptr; }

private:
    class Piece : public Interrupter {
    public:
        Piece(StagesSideBySide& all, double weight) : all_(all), weight_(weight) {}

        bool wasInterrupted(int percent) override
        {
            if (percent < 0) return all_.whole_->wasInterrupted(-1);
            const std::lock_guard lock(all_.mutex_);
            const int now = std::max(percent_, std::min(percent, 100));
            all_.sum_ += weight_ * (now - percent_);
            percent_ = now;
            return all_.whole_->wasInterrupted(static_cast<int>(all_.sum_ / all_.weight_));
        }

    private:
        StagesSideBySide& all_;
        const double weight_;
        int percent_ = 0; // guarded by mutex_
    };

    Interrupter* whole_;
    std::mutex mutex_;    // held while the whole is told, so that nothing older is told later
    const double weight_; // of all
    double sum_ = 0;
    std::deque<Piece> pieces_; // they cannot be moved
};

} // namespace vdbcage::detail
