#include <tools/view/action_runner.h>

#include <utility>

#include <tools/view/files/file_contents.h>
#include <tools/view/files/folder.h>
#include <tools/view/files/scene.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

struct ActionRunner::VerbEffect {
    ActionRunner& runner;
    AppParts& parts;

    template <class T>
    std::enable_if_t<amountsToCommand<T>> operator()(const T& verb) const
    {
        const Session& session = parts.session;
        const CageResultPtr& cage = parts.making.cage();
        const bool isSymmetric = cage && cage->report.symmetry;
        runner.beginAndRecord(
            verb.command({session.state(), session.cage(), isSymmetric ? &cage->report.symmetry->plane : nullptr}));
    }

    template <class T>
    std::enable_if_t<std::is_base_of_v<SaveFile, T>> operator()(const T& verb) const
    {
        parts.saver.save(verb.path, T::isSequence, [&](const fs::path& file) {
            return T::writer(
                {parts.session.state(), parts.session.cage(), parts.making.planner(), parts.making.posing()}, file);
        });
    }

    void operator()(const Undo& /*verb*/) const { parts.session.undo(); }
    void operator()(const Redo& /*verb*/) const { parts.session.redo(); }
    void operator()(const UndoView& /*verb*/) const { parts.session.undoView(); }
    void operator()(const RedoView& /*verb*/) const { parts.session.redoView(); }
    void operator()(const MakeAgain& /*verb*/) const { parts.making.again(); }
    void operator()(const Cancel& /*verb*/) const
    {
        if (runner.dismiss()) return;
        if (parts.saver.isBusy()) return parts.saver.stop();
        parts.making.cancel();
    }

    void operator()(const FrameView& verb) const
    {
        runner.attempt(
            SetCamera{parts.screen.viewports().first().fitted(parts.session.state().view, verb.onlySelected)});
    }
    void operator()(const StartBox& /*verb*/) const { parts.control.startBox(); }
    void operator()(const Grab& verb) const { parts.control.grab(verb.tool); }

    void operator()(const SaveStages& verb) const
    {
        const Planner& planner = parts.making.planner();
        if (currentCage(planner, "save-stages")->order.cage) {
            throw InputError("save-stages", "the cage was opened, not made, so it has no stages");
        }
        parts.making.keepIntermediates(true);
        runner.waitUntilSettled();
        parts.making.keepIntermediates(false);
        const CageResultPtr result = currentCage(planner, "save-stages");
        if (!result->intermediates) throw InputError("save-stages", planner.error());
        saveStages(*result, verb.path);
        saySaved(verb.path);
    }
    void operator()(const SaveScene& verb) const
    {
        const Planner& planner = parts.making.planner();
        const bool isCurrent = planner.standing() == Planner::Standing::current;
        saveScene(parts.session.state(), isCurrent ? planner.made().get() : nullptr, verb.path);
        parts.saved = parts.session.state().document;
        parts.asksToQuit = false;
        saySaved(verb.path);
    }
    void operator()(const SavePicture& verb) const
    {
        parts.refresh();
        savePicture(parts.screen.viewports().first().picture(), verb.path);
        saySaved(verb.path);
    }
    void saySaved(const fs::path& path) const { parts.say("saved " + path.filename().string()); }

    void operator()(const OpenScene& verb) const
    {
        parts.session.restart(openScene(verb.path));
        parts.saved = parts.session.state().document;
        parts.watch = {};
    }
    void operator()(const Drop& verb) const { runner.drop(verb.path); }
    void operator()(const Reload& /*verb*/) const
    {
        const OpenedMeshPtr model = parts.session.state().document.model;
        if (!model) throw InputError("reload", "there is no model yet");
        parts.watch.ignore(); // a file that cannot be read is not offered again
        parts.session.execute(OpenModel{model->path.string()});
    }
    void operator()(const Browse& verb) const { parts.panels.browse(verb.line); }
    void operator()(const ChooseKeys& verb) const
    {
        parts.chooseKeys(verb.map);
        writePreferences(parts.setup.preferences, {verb.map});
    }
    void operator()(const ShowHelp& /*verb*/) const { parts.panels.showHelp(); }
    void operator()(const Dismiss& /*verb*/) const { runner.dismiss(); }
    void operator()(const Tick& verb) const { runner.pass(verb.seconds); }

    void operator()(const Quit& /*verb*/) const
    {
        parts.asksToQuit = !parts.isSaved();
        if (!parts.asksToQuit) runner.finishSaving();
        parts.isEnded = !parts.asksToQuit;
    }
    void operator()(const QuitUnsaved& /*verb*/) const
    {
        runner.finishSaving();
        parts.isEnded = true;
    }
};

void ActionRunner::perform(const Action& action)
{
    begin(action);
    finishSaving();
}

void ActionRunner::attempt(const Action& action)
{
    try {
        beginAndRecord(action);
    } catch (const std::exception& error) {
        parts_.complain(error.what());
    }
}

void ActionRunner::drop(const fs::path& path)
{
    attempt(path.extension() == ".json" ? Action(OpenScene{path.string()}) : OpenModel{path.string()});
}

void ActionRunner::begin(const Action& action)
{
    if (const auto* const command = std::get_if<Command>(&action)) {
        run(*command);
    } else {
        std::visit(VerbEffect{*this, parts_}, std::get<Verb>(action));
    }
    parts_.screen.invalidate();
    parts_.refresh();
}

void ActionRunner::beginAndRecord(const Action& action)
{
    begin(action);
    // A drag is recorded when it ends.
    const auto& record = parts_.setup.record;
    if (record && !parts_.session.isDragging() && isRecorded(action)) record(textOf(action));
}

void ActionRunner::run(const Command& command)
{
    Session& session = parts_.session;
    const bool hadModel = session.state().document.model != nullptr;
    const bool wasSaved = parts_.isSaved();
    std::string remark;
    session.execute(command, &remark);
    if (!remark.empty()) parts_.say(remark);
    if (!std::holds_alternative<OpenModel>(command)) return;
    addRecentFile(parts_.setup.recentFiles, session.state().document.model->path);
    parts_.recentFiles = recentFiles(parts_.setup.recentFiles);
    parts_.watch = {};
    parts_.refresh();
    // These are not recorded as lines: they follow from the command.
    session.execute(SetCamera{parts_.screen.viewports().first().fitted(session.state().view, false)});
    session.execute(SetFrame{0});
    // A newly opened model is no work that could be lost.
    if (!hadModel || wasSaved) parts_.saved = session.state().document;
}

void ActionRunner::endDrag()
{
    Session& session = parts_.session;
    session.endDrag();
    parts_.isValueDragged = false;
    parts_.screen.invalidate();
    const auto& record = parts_.setup.record;
    if (!record) return;
    const State& before = session.beforeDrag();
    if (session.hasDraggedDocument() && session.state().document != before.document) {
        record(session.documents().undone());
    }
    if (session.hasDraggedView() && session.state().view != before.view) record(session.views().undone());
}

bool ActionRunner::dismiss()
{
    if (!parts_.messages.empty()) {
        parts_.messages.erase(parts_.messages.begin());
        return true;
    }
    if (parts_.panels.dismiss()) return true;
    if (parts_.asksToQuit) {
        parts_.asksToQuit = false;
        return true;
    }
    if (!parts_.watch.hasChanged()) return false;
    parts_.watch.ignore();
    return true;
}

void ActionRunner::pass(double seconds)
{
    if (!parts_.isAnimated()) return;
    // This is no step that could be undone.
    parts_.session.replaceView(parts_.animation.passed(parts_.session.state(), seconds));
    parts_.refresh();
}

void ActionRunner::update()
{
    parts_.making.update();
    try {
        takeSaved();
    } catch (const Error& error) {
        parts_.complain(error.what());
    }
    parts_.refresh();
}

void ActionRunner::waitUntilSettled()
{
    for (parts_.refresh(); !parts_.making.isSettled(); update()) parts_.making.waitForNews(1);
    for (; parts_.saver.isBusy(); update()) parts_.saver.waitForNews(1);
}

void ActionRunner::finishSaving()
{
    while (parts_.saver.isBusy()) {
        parts_.saver.waitForNews(1);
        takeSaved();
    }
}

void ActionRunner::takeSaved()
{
    const bool wasBusy = parts_.saver.isBusy();
    const auto name = parts_.saver.take();
    if (name) parts_.say("saved " + *name);
    if (!name && wasBusy && !parts_.saver.isBusy()) parts_.say("nothing was written");
}

} // namespace vdbcage::view
