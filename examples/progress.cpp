// Shows how far the making of a cage is; Ctrl-C cancels it, or SECONDS:  example_progress model.obj [SECONDS]

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <future>
#include <iostream>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

namespace {

std::atomic<bool> isCancelled{false};

/// The library tells it where it is, and asks whether to go on: from any thread, thousands of times a second. So it
/// only notes and answers; the main thread looks at it when it likes.
class Progress : public vdbcage::Interrupter {
public:
    void start(const char* name) override // names live as long as the program
    {
        stage = name;
        percentOfStage = 0;
    }
    bool wasInterrupted(int percent) override
    {
        if (percent >= 0) percentOfStage = percent;
        return isCancelled;
    }

    std::atomic<const char*> stage{""};
    std::atomic<int> percentOfStage{0};
};

} // namespace

int main(int count, char** words)
try {
    if (count < 2 || count > 3) throw vdbcage::InputError("usage: example_progress MODEL [SECONDS]");
    std::signal(SIGINT, [](int) { isCancelled = true; });
    const vdbcage::Mesh model = vdbcage::readMesh(words[1]);
    const std::chrono::duration<double> allowed(count > 2 ? std::atof(words[2]) : 1e9);
    const auto began = std::chrono::steady_clock::now();
    Progress progress;
    auto cage = std::async(std::launch::async, [&] { return vdbcage::makeCage(model, {}, &progress); });
    while (cage.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
        std::cout << '\r' << progress.stage << ' ' << progress.percentOfStage << " %    " << std::flush;
        if (std::chrono::steady_clock::now() - began > allowed) isCancelled = true;
    }
    std::cout << '\n' << cage.get().triangles.size() << " triangles\n"; // or throws what makeCage() threw
    return 0; // the cage is whole, even if a cancel came in its last moment
} catch (const vdbcage::Cancelled&) {
    std::cout << "cancelled\n"; // nothing is left of it
    return 130;                 // as of a program that Ctrl-C ends
} catch (const vdbcage::Error& error) {
    std::cerr << "example_progress: " << error.what() << '\n';
    return 1;
}
