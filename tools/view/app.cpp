#include <tools/view/app.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <system_error>

#include <tools/view/files/folder.h>
#include <tools/view/files/preferences.h>
#include <tools/view/files/saver.h>
#include <tools/view/files/saving.h>
#include <tools/view/files/scene.h>
#include <tools/view/input/verbs.h>
#include <tools/view/jobs/posing.h>
#include <tools/view/picture/picture_control.h>
#include <tools/view/picture/pictures.h>
#include <tools/view/state/animation.h>
#include <tools/view/state/move.h>
#include <tools/view/values.h>
#include <tools/view/widgets/widget_renderer.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

using openvdb::Vec3d;

Counts countsOf(const Mesh& mesh, std::size_t edges)
{
    return {mesh.points.size(), edges, faceCount(mesh)};
}

bool isScene(const fs::path& path)
{
    return path.extension() == ".json";
}

} // namespace

class App::Impl {
public:
    Impl(const gl::Api& api, AppSetup setup)
        : api_(api), setup_(std::move(setup)), widgets_(setup_.scale, setup_.clipboard),
          pictures_(api, setup_.isSoftware), widgetRenderer_(api, widgets_.glyphs()),
          runner_(setup_.maker ? std::move(setup_.maker) : makePipelineMaker(), setup_.wake),
          posing_(setup_.binding ? std::move(setup_.binding) : bindingWork(), setup_.wake), saver_(setup_.wake),
          control_({session_, pictures_.first(), [this](const Command& command) { attempt(command); },
                    [this] { endDrag(); }, [this] { return pictureInUse(); }, double{setup_.scale}})
    {
        recent_ = recentFiles(setup_.recentFiles);
        chooseKeys(readPreferences(setup_.preferences).keys);
        resize(setup_.width, setup_.height);
    }

    /// Waits for what is written.
    void perform(const Action& action)
    {
        begin(action);
        finishSaving();
    }

    void begin(const Action& action)
    {
        std::visit([this](const auto& line) { run(line); }, action);
        needsFrame_ = true;
        refresh();
    }

    /// As a user does it: what is wrong becomes a message.
    void attempt(const Action& action)
    {
        try {
            doAndRecord(action);
        } catch (const std::exception& error) {
            complain(error.what());
        }
    }

    void handle(const InputEvent& event)
    {
        const bool hadMessage = !messages_.empty(); // one that the event brings is not dismissed by it
        PanelAnswer answer;
        layOut(); // it is meant for what is to be seen
        const bool isTaken = layOutOnce(&event, answer);
        take(answer);
        // Where the pointer is must be known when a key begins something.
        if (!isTaken || control_.isHeld() || std::holds_alternative<PointerMoved>(event.what)) control_.handle(event);
        if (const auto* const down = std::get_if<KeyDown>(&event.what)) press(*down, event.modifiers, hadMessage);
        refresh();
    }

    void drop(const fs::path& path)
    {
        attempt(isScene(path) ? Action(OpenScene{path.string()}) : OpenModel{path.string()});
    }

    void resize(int width, int height)
    {
        width = std::max(width, 1);
        height = std::max(height, 1);
        if (canvas_ && width == width_ && height == height_) return;
        canvas_.reset();
        canvas_.emplace(api_, width, height, 1);
        width_ = width;
        height_ = height;
        needsFrame_ = true;
        refresh();
    }

    void update()
    {
        runner_.update();
        posing_.update();
        try {
            takeSaved();
        } catch (const Error& error) {
            complain(error.what());
        }
        refresh();
    }

    void checkFiles()
    {
        const OpenedMeshPtr& model = session_.state().document.model;
        if (!model) return;
        const FileStamp stamp = stampOf(model->path);
        // A file that is gone may come back in a moment, as when a program saves.
        if (stamp == FileStamp{} || stamp == model->stamp || stamp == ignoredStamp_ || hasModelChanged_) return;
        hasModelChanged_ = true;
        changedStamp_ = stamp;
        refresh();
    }

    void pass(double seconds)
    {
        if (!isAnimated()) return;
        // It is no step that could be undone.
        session_.replaceView(animation_.passed(session_.state(), seconds));
        refresh();
    }

    /// What is dragged is of the frame and the camera at which that began.
    bool isAnimated() const { return Animation::isAnimated(session_.state()) && !session_.isDragging(); }
    /// While a value is dragged the processor is for the cages that follow it, not for fine pictures or many.
    bool awaitsCage() const { return isValueDragged_ && !runner_.planner().isSettled(); }
    double secondsBetweenFrames() const { return setup_.isSoftware && awaitsCage() ? 0.05 : 0; }
    bool isMoving() const { return control_.isCameraDragged() || control_.isMoving() || isAnimated() || awaitsCage(); }
    bool leavesItRough() const { return isMoving() && pictures_.isDrawn(); }

    /// Brings the panels in line with the state.
    void layOut()
    {
        // What a layout answers may change the state, and with it the layout.
        for (int i = 0; i < 3 && !isLaidOut_; ++i) {
            isLaidOut_ = true;
            PanelAnswer answer;
            layOutOnce(nullptr, answer);
            take(answer);
        }
        isLaidOut_ = true;
    }

    bool needsFrame()
    {
        layOut();
        return needsFrame_ || widgets_.version() != drawnWidgets_ || (!pictures_.isRefined() && !leavesItRough());
    }

    void drawFrame()
    {
        layOut();
        if (!leavesItRough()) pictures_.draw(isMoving());
        draw::Target target = canvas_->target();
        pictures_.copyTo(target.framebuffer, height_);
        widgetRenderer_.draw(target, widgets_.drawing());
        gl::throwIfFailed(api_, "drawing the window");
        needsFrame_ = false;
        drawnWidgets_ = widgets_.version();
        ++frames_;
    }

    draw::Picture picture()
    {
        layOut();
        while (!pictures_.isRefined() && !isMoving()) pictures_.draw(false);
        drawFrame();
        return draw::fromPixels(canvas_->pixels(), width_, height_, false);
    }

    void waitUntilSettled()
    {
        refresh();
        while (!runner_.planner().isSettled() || !posing_.isSettled()) {
            if (!runner_.planner().isSettled()) {
                runner_.waitForNews(1);
            } else {
                posing_.waitForNews(1);
            }
            update();
        }
        while (saver_.isBusy()) {
            saver_.waitForNews(1);
            update();
        }
    }

    /// \throw InputError why something could not be written
    void finishSaving()
    {
        while (saver_.isBusy()) {
            saver_.waitForNews(1);
            takeSaved();
        }
    }

    std::map<std::string, std::function<std::string()>> values() const
    {
        return valuesOf({session_, runner_.planner(), posing_, messages_, notes_, frames_, isEnded_, keys_});
    }

    const gl::Api& api_;
    AppSetup setup_;
    Session session_;
    Widgets widgets_;
    Panels panels_;
    Pictures pictures_;
    WidgetRenderer widgetRenderer_;
    Runner runner_;
    Posing posing_;
    Saver saver_;
    PictureControl control_;
    std::optional<draw::Canvas> canvas_;
    int width_ = 0, height_ = 0;
    std::vector<std::string> messages_, notes_;
    std::vector<fs::path> recent_;
    KeyMap keys_{};
    bool needsFrame_ = true;         ///< something else than the panels changed since the last frame
    std::uint64_t drawnWidgets_ = 0; ///< their version in the last frame
    std::uint64_t frames_ = 0;

    std::optional<Rectangle> handlePlace(const std::string& name) const
    {
        const auto at = placeOf(control_.overlay().gizmo, name, double{setup_.scale});
        if (!at) return std::nullopt;
        const Rectangle& picture = pictures_.places().front();
        const auto round = [](double x) { return static_cast<int>(std::lround(x)); };
        return Rectangle{picture.left + round((*at)[0]), picture.top + round((*at)[1]), 0, 0};
    }

    Rectangle viewport() const
    {
        return Panels::viewport(width_, height_, setup_.scale, session_.state().view.mode == Mode::pose);
    }
    /// The picture that what is done with the pointer belongs to.
    Rectangle pictureInUse() const
    {
        const std::vector<Rectangle>& places = pictures_.places();
        return control_.home()[0] < places.back().left ? places.front() : places.back();
    }
    bool isValueDragged_ = false;
    bool isEnded_ = false;

private:
    // ---- lines

    void doAndRecord(const Action& action)
    {
        begin(action);
        // A drag is recorded when it ends.
        if (setup_.record && !session_.isDragging() && isRecorded(action)) setup_.record(textOf(action));
    }

    void run(const Command& command)
    {
        const bool hadModel = session_.state().document.model != nullptr;
        const bool wasSaved = isSaved();
        std::string remark;
        session_.execute(command, &remark);
        if (!remark.empty()) note(remark);
        if (std::holds_alternative<OpenModel>(command)) {
            const fs::path& path = session_.state().document.model->path;
            addRecentFile(setup_.recentFiles, path);
            recent_ = recentFiles(setup_.recentFiles);
            hasModelChanged_ = false;
            ignoredStamp_ = {};
            show();
            // Not a line of its own: it follows from this one.
            session_.execute(SetCamera{pictures_.first().fitted(session_.state().view, false)});
            session_.execute(SetFrame{0});
            // To have opened a model is no work that could be lost.
            if (!hadModel || wasSaved) saved_ = session_.state().document;
        }
    }

    void run(const Verb& verb)
    {
        std::visit([this](const auto& each) { runVerb(each); }, verb);
    }

    template <class T>
    std::enable_if_t<amountsToCommand<T>> runVerb(const T& verb)
    {
        const auto& symmetry = visible_ ? visible_->report.symmetry : std::nullopt;
        doAndRecord(verb.command({session_.state(), session_.cage(), symmetry ? &symmetry->plane : nullptr}));
    }

    template <class T>
    std::enable_if_t<std::is_base_of_v<SaveFile, T>> runVerb(const T& verb)
    {
        saver_.save(verb.path, T::isSequence, [&](const fs::path& file) {
            return T::writer({session_.state(), session_.cage(), runner_.planner(), posing_}, file);
        });
    }

    void runVerb(const Undo& /*verb*/) { session_.undo(); }
    void runVerb(const Redo& /*verb*/) { session_.redo(); }
    void runVerb(const UndoView& /*verb*/) { session_.undoView(); }
    void runVerb(const RedoView& /*verb*/) { session_.redoView(); }

    void runVerb(const MakeAgain& /*verb*/)
    {
        runner_.again();
        posing_.again();
    }

    void runVerb(const Cancel& /*verb*/)
    {
        if (dismiss()) return;
        if (saver_.isBusy()) return saver_.stop();
        runner_.cancel();
        posing_.cancel();
    }

    void runVerb(const FrameView& verb)
    {
        attempt(SetCamera{pictures_.first().fitted(session_.state().view, verb.onlySelected)});
    }

    void runVerb(const StartBox& /*verb*/) { control_.startBox(); }
    void runVerb(const Grab& verb) { control_.grab(verb.tool); }

    void runVerb(const SaveScene& verb)
    {
        const Planner& planner = runner_.planner();
        const bool isCurrent = planner.standing() == Planner::Standing::current;
        saveScene(session_.state(), isCurrent ? planner.shown().get() : nullptr, verb.path);
        saved_ = session_.state().document;
        asksToQuit_ = false;
        noteSaved(verb.path);
    }

    void runVerb(const SavePicture& verb)
    {
        show();
        savePicture(pictures_.first().picture(), verb.path);
        noteSaved(verb.path);
    }

    void runVerb(const SaveStages& verb)
    {
        if (currentCage(runner_.planner(), "save-stages").order.cage) {
            throw InputError("save-stages: the cage was opened, not made, so it has no stages");
        }
        keepsIntermediates_ = true;
        want();
        waitUntilSettled();
        keepsIntermediates_ = false;
        const CageResult& result = currentCage(runner_.planner(), "save-stages");
        if (!result.intermediates) throw InputError("save-stages: " + runner_.planner().error());
        saveStages(result, verb.path);
        noteSaved(verb.path);
    }

    void runVerb(const OpenScene& verb)
    {
        session_.restart(openScene(verb.path));
        saved_ = session_.state().document;
        hasModelChanged_ = false;
    }

    void runVerb(const Drop& verb) { drop(verb.path); }
    void runVerb(const Reload& /*verb*/) { reload(); }
    void runVerb(const Browse& verb) { panels_.browse(verb.line); }

    void runVerb(const ChooseKeys& verb)
    {
        chooseKeys(verb.map);
        writePreferences(setup_.preferences, {keys_});
    }

    void runVerb(const ShowHelp& /*verb*/) { panels_.showHelp(); }
    void runVerb(const Dismiss& /*verb*/) { dismiss(); }
    void runVerb(const Tick& verb) { pass(verb.seconds); }

    void runVerb(const Quit& /*verb*/)
    {
        asksToQuit_ = !isSaved();
        if (!asksToQuit_) finishSaving();
        isEnded_ = !asksToQuit_;
    }

    void runVerb(const QuitUnsaved& /*verb*/)
    {
        finishSaving();
        isEnded_ = true;
    }

    void chooseKeys(KeyMap keys)
    {
        keys_ = keys;
        control_.setMouse(mouseMap(keys));
    }

    bool isSaved() const { return session_.state().document == saved_; }

    bool dismiss()
    {
        if (!messages_.empty()) {
            messages_.erase(messages_.begin());
            return true;
        }
        if (panels_.dismiss()) return true;
        if (asksToQuit_) {
            asksToQuit_ = false;
            return true;
        }
        if (hasModelChanged_) {
            hasModelChanged_ = false;
            ignoredStamp_ = changedStamp_;
            return true;
        }
        return false;
    }

    void reload()
    {
        const OpenedMeshPtr model = session_.state().document.model;
        if (!model) throw InputError("reload: there is no model yet");
        hasModelChanged_ = false;
        ignoredStamp_ = changedStamp_; // what cannot be read is not offered again
        session_.execute(OpenModel{model->path.string()});
    }

    // ---- files

    void noteSaved(const fs::path& path) { note("saved " + path.filename().string()); }

    /// \throw InputError why it could not be written
    void takeSaved()
    {
        const bool wasBusy = saver_.isBusy();
        const auto name = saver_.take();
        if (name) note("saved " + *name);
        if (!name && wasBusy && !saver_.isBusy()) note("nothing was written");
    }

    void note(const std::string& text)
    {
        notes_.assign(1, text);
        needsFrame_ = true;
    }

    void complain(const std::string& text)
    {
        messages_.push_back(text);
        needsFrame_ = true;
        refresh();
    }

    // ---- widgets

    PanelContent content() const
    {
        const ViewState& view = session_.state().view;
        PanelContent content{session_, runner_.planner(), runner_.progress(), messages_, notes_, shortcuts(keys_),
                             recent_};
        const draw::Eye eye = draw::eyeOf(view.camera, 1, {});
        for (int k = 0; k < 3; ++k) {
            Vec3d axis(0);
            axis[k] = 1;
            content.axes[static_cast<std::size_t>(k)] = {axis.dot(eye.right), axis.dot(eye.up), axis.dot(eye.back)};
        }
        content.gridStep = pictures_.first().gridStep();
        if (const OpenedMeshPtr& model = session_.state().document.model) {
            const openvdb::BBoxd& box = pictures_.first().box();
            const Vec3d extents = box.extents();
            const double longest = std::max({extents.x(), extents.y(), extents.z()});
            content.largestDistance = longest > 0 ? pictures_.first().largestDistance() / longest : 0;
            content.box = box;
            content.model = countsOf(model->mesh, pictures_.first().edgeCount(LayerId::model));
        }
        if (const CageResultPtr& cage = runner_.planner().shown()) {
            content.cage = countsOf(cage->cage, pictures_.first().edgeCount(LayerId::cage));
        }
        content.overlay = control_.overlay();
        content.pictures = pictures_.places();
        content.binding = posing_.follower().binder().progress();
        content.isPosedCoarsely = posing_.follower().model().bound() && !posing_.follower().model().isWhole();
        content.keys = keys_;
        content.selected = selectionFrame(session_.state(), session_.cage(), {});
        if (saver_.isBusy()) content.saving = saver_.progress();
        content.bindingError = posing_.error();
        content.isPoseChecked = posing_.follower().isChecking();
        content.poseCheck = posing_.follower().check();
        content.isPosed = posing_.isPosed(session_.state());
        content.hasMaterial = posing_.hasMaterial(session_.state());
        content.hasModelChanged = hasModelChanged_;
        content.asksToQuit = asksToQuit_;
        return content;
    }

    /// Builds the panels, with an event or without. Returns whether they took it.
    bool layOutOnce(const InputEvent* event, PanelAnswer& answer)
    {
        const PanelContent shown = content();
        return widgets_.layOut(event, width_, height_, [&] { panels_.build(shown, answer); });
    }

    void take(const PanelAnswer& answer)
    {
        if (answer.beginsDrag) {
            session_.beginDrag();
            isValueDragged_ = true;
        }
        for (const Action& action : answer.actions) attempt(action);
        for (const std::string& problem : answer.problems) complain(problem);
        if (answer.endsDrag) endDrag();
        if (answer.beginsDrag || answer.endsDrag) refresh();
    }

    /// The drag becomes the line that its end amounts to.
    void endDrag()
    {
        session_.endDrag();
        isValueDragged_ = false;
        needsFrame_ = true;
        if (!setup_.record) return;
        const State& before = session_.dragged();
        if (session_.hasDraggedDocument() && session_.state().document != before.document) {
            setup_.record(session_.documents().undone());
        }
        if (session_.hasDraggedView() && session_.state().view != before.view) {
            setup_.record(session_.views().undone());
        }
    }

    /// Brings what is made and what is seen in line with the state; the panels follow when they are needed.
    void refresh()
    {
        want();
        show();
        isLaidOut_ = false;
    }

    void want()
    {
        const Document& document = session_.state().document;
        std::optional<Order> order;
        if (document.model) order = Order{document.model, document.options, document.cage};
        const ViewState& view = session_.state().view;
        bool intermediates = keepsIntermediates_ || view.cageColours == CageColours::distance;
        for (std::size_t i = 0; i < layerCount; ++i) {
            const auto id = static_cast<LayerId>(i);
            intermediates |= view.layers[i].shown && id != LayerId::model && id != LayerId::cage;
        }
        runner_.want(order, isValueDragged_ || control_.isMoving(), intermediates);
    }

    void show()
    {
        const Planner& planner = runner_.planner();
        const CageResultPtr cage = posing_.cageOf(session_.state(), planner);
        visible_ = cage;
        if (session_.cage() != posing_.posable()) session_.setCage(posing_.posable());
        posing_.follow(session_.state(), planner,
                       !control_.isMoving() && !session_.isDragging() && !Animation::isPlaying(session_.state()));
        Shown shown;
        shown.model = session_.state().document.model;
        shown.cage = cage;
        shown.isStale = cage == planner.shown() && planner.standing() == Planner::Standing::stale;
        shown.cagePoints = posing_.cagePoints();
        const bool changed =
            pictures_.show(viewport(), shown, posing_.follower(), posing_.compared(), session_.state().view);
        if (changed) needsFrame_ = true;
    }

    void press(const KeyDown& down, const Modifiers& modifiers, bool isMessage)
    {
        if (isMessage && (down.key == Key::escape || down.key == Key::enter || down.key == Key::space)) {
            dismiss();
            return;
        }
        if (control_.press(down, modifiers)) return;
        if (down.key == Key::escape) return attempt(Cancel{});
        if (isMessage || widgets_.wantsText() || widgets_.wantsKeyboard()) return;
        const std::string chord = nameOf(KeyChord{down.key, modifiers});
        for (const Shortcut& shortcut : shortcuts(keys_)) {
            if (shortcut.chord == chord) return attempt(shortcut.action);
        }
    }

    Document saved_; ///< as it was last saved, or opened
    CageResultPtr visible_;
    Animation animation_;
    bool isLaidOut_ = false;
    bool keepsIntermediates_ = false;
    bool asksToQuit_ = false, hasModelChanged_ = false;
    FileStamp changedStamp_, ignoredStamp_;
};

App::App(const gl::Api& api, AppSetup setup) : impl_(std::make_unique<Impl>(api, std::move(setup)))
{
}
App::~App() = default;

void App::perform(const Action& action)
{
    impl_->perform(action);
}

void App::attempt(const Action& action)
{
    impl_->attempt(action);
}

void App::handle(const InputEvent& event)
{
    impl_->handle(event);
}

void App::drop(const std::filesystem::path& path)
{
    impl_->drop(path);
}

void App::resize(int width, int height)
{
    impl_->resize(width, height);
}

void App::update()
{
    impl_->update();
}

void App::checkFiles()
{
    impl_->checkFiles();
}

void App::pass(double seconds)
{
    impl_->pass(seconds);
}

bool App::isAnimated() const
{
    return impl_->isAnimated();
}

bool App::needsFrame()
{
    return impl_->needsFrame();
}

double App::secondsBetweenFrames() const
{
    return impl_->secondsBetweenFrames();
}

void App::drawFrame()
{
    impl_->drawFrame();
}

const draw::Canvas& App::canvas() const
{
    return *impl_->canvas_;
}

draw::Picture App::picture()
{
    return impl_->picture();
}

void App::waitUntilSettled()
{
    impl_->waitUntilSettled();
}

void App::waitUntilSaved()
{
    impl_->finishSaving();
}

std::string App::value(const std::string& name) const
{
    impl_->layOut();
    const auto values = impl_->values();
    const auto found = values.find(name);
    if (found != values.end()) return found->second();
    std::string known;
    for (const auto& value : values) known += (known.empty() ? "" : ", ") + value.first;
    throw InputError("'" + name + "' is not known; there are " + known);
}

std::vector<std::string> App::valueNames() const
{
    std::vector<std::string> names;
    for (const auto& value : impl_->values()) names.push_back(value.first);
    return names;
}

std::optional<Rectangle> App::widget(const std::string& name) const
{
    impl_->layOut();
    if (name.rfind("handle.", 0) == 0) return impl_->handlePlace(name.substr(7));
    const auto& places = impl_->panels_.places();
    const auto found = places.find(name);
    if (found == places.end()) return std::nullopt;
    return found->second;
}

void App::reveal(const std::string& name)
{
    impl_->panels_.reveal(name);
    impl_->update();
}

Rectangle App::viewport() const
{
    return impl_->viewport();
}

std::array<double, 2> App::pointer() const
{
    return impl_->control_.pointer();
}

const Session& App::session() const
{
    return impl_->session_;
}

const Planner& App::planner() const
{
    return impl_->runner_.planner();
}

const std::vector<std::string>& App::messages() const
{
    return impl_->messages_;
}

bool App::isEnded() const
{
    return impl_->isEnded_;
}

std::string App::title() const
{
    const OpenedMeshPtr& model = impl_->session_.state().document.model;
    return (model ? model->path.filename().string() + " - " : std::string()) + "vdbcage";
}

PointerShape App::pointerShape() const
{
    return impl_->widgets_.pointerShape();
}

} // namespace vdbcage::view
