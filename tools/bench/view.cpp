// vdbcage-bench view: the speed of the window's answers, as ratios to the least possible times, measured in one run.

#include <atomic>
#include <chrono>
#include <iostream>
#include <random>
#include <thread>

#include <tools/view/app.h>
#include <tools/view/script.h>
#include <vdbcage/core/error.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "bench.h"

namespace vdbcage::bench {

namespace {

using namespace view;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began)
{
    return std::chrono::duration<double>(Clock::now() - began).count();
}

/// Returns the wall seconds of `work`.
template <class Work>
double secondsOf(const Work& work)
{
    const auto began = Clock::now();
    work();
    return secondsSince(began);
}

struct Reading {
    double base = 0;  ///< for reading the model and making a context
    double first = 0; ///< until the first frame is there, including `base`
};

/// Measures the first frame beside the least time that it needs. `making`: the time for the context. The app keeps the
/// model.
Reading measureFirstFrame(const std::string& model, const gl::OffscreenContext& context, double making,
                          std::optional<App>& app)
{
    Reading reading;
    reading.base = making + secondsOf([&] { readMesh(model); });
    reading.first = making + secondsOf([&] {
                        AppSetup setup;
                        setup.isSoftware = context.isSoftware();
                        app.emplace(context.api(), std::move(setup));
                        app->perform(OpenModel{model});
                        app->drawFrame();
                    });
    return reading;
}

/// Measures frames in CPU seconds: while the view moves, one pass of a still one, all passes, and the widgets alone.
Json measureFrames(App& app)
{
    constexpr int passes = 16, runs = 5;
    double still = 1e9, moving = 1e9, refined = 1e9, widgets = 1e9;
    for (int run = 0; run < runs; ++run) {
        runLine(app, "opacity model " + std::to_string(run % 2 == 0 ? 1 : 0.999)); // forces the picture to be drawn
                                                                                   // again
        refined = std::min(refined, costOf([&] { app.picture(); }).cpuSeconds);
        still = refined / passes;
        runLine(app, "mouse move picture");
        runLine(app, "mouse down");
        runLine(app, "mouse move picture 0.6 0.5");
        runLine(app, "mouse move picture 0.65 0.5");
        moving = std::min(moving, costOf([&] { app.drawFrame(); }).cpuSeconds);
        runLine(app, "mouse up");
        app.picture();
        widgets = std::min(widgets, costOf([&] {
                                        app.update();
                                        app.drawFrame();
                                    }).cpuSeconds);
    }
    return {{"moving_cpu_seconds", moving},
            {"still_pass_cpu_seconds", still},
            {"refined_cpu_seconds", refined},
            {"widgets_cpu_seconds", widgets},
            {"moving_over_still_pass", moving / still},
            {"moving_over_refined", moving / refined},
            {"widgets_over_still_pass", widgets / still}};
}

/// Returns the median time of a run for another face count in a pipeline that has made the default one before, and then
/// each of `faces`.
double rerunSeconds(const Mesh& model, Effort effort, const std::vector<int>& faces)
{
    Pipeline pipeline(model);
    CageOptions options;
    options.effort = effort;
    pipeline.run(options);
    std::vector<double> times;
    for (const int count : faces) {
        options.faces = count;
        times.push_back(secondsOf([&] { pipeline.run(options); }));
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

/// Drags the slider of the faces from 98 to 546 at the pace of Window::run, and releases it.
Json measureDrag(App& app, const Mesh& model, double seconds)
{
    const double fast = rerunSeconds(model, Effort::fast, {98, 151, 244, 351, 484}); // as the drag meets them
    runLine(app, "mouse move faces.slider 0.30");
    runLine(app, "mouse down");
    CageResultPtr made = app.planner().made();
    int cages = 0, frames = 0;
    double drawn = 0;
    const auto began = Clock::now();
    for (double now = 0; now < seconds; now = secondsSince(began)) {
        if (now >= drawn + app.secondsBetweenFrames()) {
            // It moves one way only, so that no cage was made before.
            runLine(app, "mouse move faces.slider " + std::to_string(0.22 + 0.16 * now / seconds));
            if (app.needsFrame()) {
                app.drawFrame();
                drawn = secondsSince(began);
                ++frames;
            }
        }
        app.update();
        if (app.planner().made() != made) {
            made = app.planner().made();
            ++cages;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5)); // a window sleeps until an event comes
    }
    const double dragged = secondsSince(began);
    const double settled = secondsOf([&] {
        runLine(app, "mouse up");
        app.waitUntilSettled();
    });
    const int faces = app.session().state().document.options.faces;
    const double full = rerunSeconds(model, Effort::fair, {faces});
    return {{"seconds", dragged},
            {"cages_shown", cages},
            {"frames", frames},
            {"fast_run_seconds", fast},
            {"cages_shown_per_fast_run", cages * fast / dragged},
            {"let_go_seconds", settled},
            {"full_run_seconds", full},
            {"let_go_over_full_run", settled / full}};
}

/// Measures binding the model to its cage, coarsely and completely, in CPU seconds, and following a pose in one frame
/// by each family, beside drawing the model once, in `pass`.
Json measurePosing(App& app, double pass)
{
    constexpr int runs = 5;
    runLine(app, "set faces 400");
    runLine(app, "mode pose");
    runLine(app, "select-kind points");
    runLine(app, "select-all");
    app.waitUntilSettled();
    Json list = Json::object();
    for (const FamilyInfo& info : coordinateFamilies()) {
        const Coordinates family = info.family;
        const State& state = app.session().state();
        const BindOrder order{state.document.model, app.session().cage()->rest(), family};
        BoundModelPtr coarse;
        const double first = costOf([&] { coarse = boundCoarsely(order, nullptr); }).cpuSeconds;
        const double whole = costOf([&] { boundWhole(*coarse, nullptr); }).cpuSeconds;
        runLine(app, std::string("coordinates ") + coordinatesName(family));
        app.waitUntilSettled();
        double follow = 1e9, frame = 1e9;
        for (int run = 0; run < runs; ++run) {
            // Each point moves: no weight can be skipped.
            follow = std::min(follow, costOf([&] { runLine(app, "rotate 0 1 0 0.1 0 0 0"); }).cpuSeconds);
            app.drawFrame();
        }
        runLine(app, "mouse move picture");
        runLine(app, "grab rotate");
        for (int run = 0; run < runs; ++run) {
            frame = std::min(frame, secondsOf([&] {
                                 runLine(app, "mouse by 3 2");
                                 app.drawFrame();
                             }));
        }
        runLine(app, "key escape");
        list[coordinatesName(family)] = {
            {"first_bound_cpu_seconds", first},        {"bound_cpu_seconds", whole},
            {"first_bound_over_bound", first / whole}, {"follow_cpu_seconds", follow},
            {"follow_over_still_pass", follow / pass}, {"frames_per_second_while_dragged", 1 / frame}};
    }
    runLine(app, "mode shape");
    return list;
}

/// An interrupter that asks to stop from some moment on.
struct Stopper : Interrupter {
    std::atomic<bool> stop{false};
    bool wasInterrupted(int) override { return stop; }
};

/// Measures the longest time from a cancel to its answer, as a share of the run.
Json measureCancels(const OpenedMeshPtr& model, int count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> real(0, 1);
    Json list = Json::object();
    double worst = 0;
    for (const auto& [name, effort] :
         {std::pair("fast", Effort::fast), {"fair", Effort::fair}, {"best", Effort::best}}) {
        Job job;
        job.order.model = model;
        job.order.options.effort = effort;
        Interrupter none;
        const double run = secondsOf([&] { makePipelineMaker()->make(job, none); });
        double most = 0;
        for (int i = 0; i < count; ++i) {
            const std::unique_ptr<CageMaker> maker = makePipelineMaker();
            Stopper stopper;
            Clock::time_point asked;
            std::thread hand([&] {
                std::this_thread::sleep_for(std::chrono::duration<double>(run * real(random)));
                asked = Clock::now();
                stopper.stop = true;
            });
            Clock::time_point answered = Clock::time_point::min(); // min: the run ended before
            try {
                maker->make(job, stopper);
            } catch (const Cancelled&) {
                answered = Clock::now();
            }
            hand.join();
            if (answered > asked) most = std::max(most, std::chrono::duration<double>(answered - asked).count());
        }
        list[name] = {{"run_seconds", run}, {"worst_answer_seconds", most}, {"share", most / run}};
        worst = std::max(worst, most / run);
    }
    list["worst_share"] = worst;
    return list;
}

/// Returns the number of frames that are drawn while nothing changes.
int idleFrames(App& app)
{
    app.picture();
    int frames = 0;
    for (int i = 0; i < 100; ++i) {
        app.update();
        app.checkFiles();
        if (app.needsFrame()) {
            app.drawFrame();
            ++frames;
        }
    }
    return frames;
}

} // namespace

int runView(int argc, char** argv)
{
    std::string model;
    double seconds = 3;
    int cancels = 8;
    CLI::App cli("vdbcage-bench view: how fast the window answers, as one JSON line. It is drawn without a display");
    cli.add_option("model", model, "what is opened")->required()->type_name("MODEL");
    cli.add_option("--seconds", seconds, "that the slider of the faces is dragged [3]")->type_name("S");
    cli.add_option("--cancels", cancels, "of each effort, at random moments [8]")->type_name("N");
    CLI11_PARSE(cli, argc - 1, argv + 1);
    requirePositive("--cancels", cancels);
    if (!(seconds > 0 && seconds <= 600)) throw InputError("--seconds", "it must be above 0 and at most 600");

    const auto began = Clock::now();
    const gl::OffscreenContext context;
    const auto current = context.makeCurrent();
    const double making = secondsSince(began);
    std::optional<App> app;
    const Reading reading = measureFirstFrame(model, context, making, app);
    app->waitUntilSettled();
    const OpenedMeshPtr opened = app->session().state().document.model;
    const Json frames = measureFrames(*app);
    const Json line{{"model", model},
                    {"device", context.description()},
                    {"reading_and_context_seconds", reading.base},
                    {"first_frame_seconds", reading.first},
                    {"first_frame_over_reading_and_context", reading.first / reading.base},
                    {"frames", frames},
                    {"drag", measureDrag(*app, opened->mesh, seconds)},
                    {"posing", measurePosing(*app, frames["still_pass_cpu_seconds"])},
                    {"idle_frames", idleFrames(*app)},
                    {"cancels", measureCancels(opened, cancels)}};
    std::cout << line.dump() << std::endl;
    return 0;
}

} // namespace vdbcage::bench
