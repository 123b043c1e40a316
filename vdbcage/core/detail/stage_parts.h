#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <mutex>
#include <numeric>
#include <vector>

#include <vdbcage/core/interrupter.h>

/// Progress of parts of a stage. A null Interrupter means that nobody watches, as everywhere.
namespace vdbcage::detail {

/// One of several steps in sequence: 0 to 100 % of it are `from` to `to` of the whole.
class StagePart : public Interrupter {
public:
    StagePart(Interrupter* whole, int from, int to) : whole_(whole), from_(from), to_(to) {}

    /// Returns the interrupter for the work of this part.
    Interrupter* passedOn() { return whole_ ? this : nullptr; }

    bool wasInterrupted(int percent) override
    {
        return whole_->wasInterrupted(percent < 0 ? -1 : from_ + (to_ - from_) * std::min(percent, 100) / 100);
    }

private:
    Interrupter* whole_;
    int from_, to_;
};

/// Several pieces of work side by side, each with its own progress. The progress of the whole is their weighted mean
/// and never decreases.
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

    /// Returns the interrupter for the i-th piece of work. Any thread may ask it.
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
    std::mutex mutex_;    // held while progress is reported, so that no older value follows a newer one
    const double weight_; // of all
    double sum_ = 0;
    std::deque<Piece> pieces_; // they cannot be moved
};

} // namespace vdbcage::detail
