#pragma once

#include <atomic>
#include <map>
#include <string>

#include <support/shapes.h>
#include <vdbcage/pipeline/pipeline.h>

/// What tests of the pipeline run, and who watches.
namespace vdbcage::test {

/// Counts the stages that ran; asks to stop at the n-th check.
class Watcher : public Interrupter {
public:
    explicit Watcher(long stopAt = -1) : stopAt_(stopAt) {}
    void start(const char* name) override
    {
        ++runs[name];
        ++open_;
    }
    void end() override { --open_; }
    bool wasInterrupted(int) override { return stopAt_ >= 0 && checks++ >= stopAt_; }
    long open() const { return open_; }

    std::map<std::string, int> runs;
    std::atomic<long> checks{0};

private:
    long stopAt_, open_ = 0;
};

inline CageOptions coarse()
{
    CageOptions options;
    options.resolution = 32;
    options.faces = 200;
    return options;
}

/// A ball with a ring around it: two parts, one with a handle.
inline Mesh saturn()
{
    return test::joined(test::sphere({0, 0, 0}, 1, 16), test::torus(2, 0.2, 48, 12));
}

} // namespace vdbcage::test
