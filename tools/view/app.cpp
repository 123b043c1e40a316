#include <tools/view/app.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tools/view/files/folder.h>
#include <tools/view/values.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

App::App(const gl::Api& api, AppSetup setup)
    : parts_(
          api, std::move(setup), [this](const Command& command) { actions_.attempt(command); },
          [this] { actions_.endDrag(); })
{
    parts_.recentFiles = recentFiles(parts_.setup.recentFiles);
    parts_.chooseKeys(readPreferences(parts_.setup.preferences).keys);
    resize(parts_.setup.width, parts_.setup.height);
}

void App::handle(const InputEvent& event)
{
    const bool hadMessage = !parts_.messages.empty(); // the event must not dismiss a message that it causes
    panels_.update();                                 // the event is meant for the visible panels
    const bool isTaken = panels_.handle(event);
    // The pointer's position must be known when a key begins a motion.
    if (!isTaken || parts_.control.isHeld() || std::holds_alternative<PointerMoved>(event.what)) {
        parts_.control.handle(event);
    }
    if (const auto* const down = std::get_if<KeyDown>(&event.what)) press(*down, event.modifiers, hadMessage);
    parts_.refresh();
}

void App::press(const KeyDown& down, const Modifiers& modifiers, bool isMessage)
{
    if (isMessage && (down.key == Key::escape || down.key == Key::enter || down.key == Key::space)) {
        actions_.dismiss();
        return;
    }
    if (parts_.control.press(down, modifiers)) return;
    if (down.key == Key::escape) return attempt(Cancel{});
    if (isMessage || parts_.widgets.wantsText() || parts_.widgets.wantsKeyboard()) return;
    const std::string chord = nameOf(KeyChord{down.key, modifiers});
    for (const Shortcut& shortcut : shortcuts(parts_.keys)) {
        if (shortcut.chord == chord) return attempt(shortcut.action);
    }
}

void App::resize(int width, int height)
{
    if (parts_.screen.resize(std::max(width, 1), std::max(height, 1))) parts_.refresh();
}

void App::checkFiles()
{
    const OpenedMeshPtr& model = parts_.session.state().document.model;
    if (model && parts_.watch.look(*model)) parts_.refresh();
}

bool App::needsFrame()
{
    panels_.update();
    return parts_.screen.needsFrame(parts_.isMoving());
}

double App::secondsBetweenFrames() const
{
    return parts_.setup.isSoftware && parts_.awaitsCage() ? 0.05 : 0;
}

void App::drawFrame()
{
    panels_.update();
    parts_.screen.drawFrame(parts_.isMoving());
}

draw::Picture App::picture()
{
    panels_.update();
    return parts_.screen.picture(parts_.isMoving());
}

std::string App::value(const std::string& name)
{
    panels_.update();
    const auto values = valuesOf(parts_);
    const auto found = values.find(name);
    if (found != values.end()) return found->second();
    const std::string known = detail::joined(values, ", ", [](const auto& value) { return value.first; });
    throw InputError("'" + name + "' is not known; there are " + known);
}

std::vector<std::string> App::valueNames() const
{
    std::vector<std::string> names;
    for (const auto& value : valuesOf(parts_)) names.push_back(value.first);
    return names;
}

std::optional<Rectangle> App::widget(const std::string& name)
{
    panels_.update();
    if (name.rfind("handle.", 0) == 0) return handlePlace(name.substr(7));
    const auto& places = parts_.panels.places();
    const auto found = places.find(name);
    if (found == places.end()) return std::nullopt;
    return found->second;
}

std::optional<Rectangle> App::handlePlace(const std::string& name) const
{
    const auto at = placeOf(parts_.control.overlay().gizmo, name, double{parts_.setup.scale});
    if (!at) return std::nullopt;
    const Rectangle& picture = parts_.screen.viewports().places().front();
    const auto round = [](double x) { return static_cast<int>(std::lround(x)); };
    return Rectangle{picture.left + round((*at)[0]), picture.top + round((*at)[1]), 0, 0};
}

void App::reveal(const std::string& name)
{
    parts_.panels.reveal(name);
    update();
}

std::string App::title() const
{
    const OpenedMeshPtr& model = parts_.session.state().document.model;
    return (model ? model->path.filename().string() + " - " : std::string()) + "vdbcage";
}

} // namespace vdbcage::view
