#include <tools/view/panel_driver.h>

#include <algorithm>

#include <tools/view/state/cage_changes.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

Counts countsOf(const Mesh& mesh, std::size_t edges)
{
    return {mesh.points.size(), edges, faceCount(mesh)};
}

/// Returns x, y and z as seen: to the right, up, to the viewer.
std::array<Vec3d, 3> axesSeenBy(const draw::Camera& camera)
{
    const draw::Eye eye = draw::eyeOf(camera, 1, {});
    std::array<Vec3d, 3> axes;
    for (int k = 0; k < 3; ++k) {
        Vec3d axis(0);
        axis[k] = 1;
        axes[static_cast<std::size_t>(k)] = {axis.dot(eye.right), axis.dot(eye.up), axis.dot(eye.back)};
    }
    return axes;
}

} // namespace

void PanelDriver::update()
{
    // The answer of a layout may change the state, and with it the layout.
    for (int i = 0; i < 3 && !parts_.arePanelsCurrent; ++i) {
        parts_.arePanelsCurrent = true;
        PanelAnswer answer;
        layOut(nullptr, answer);
        take(answer);
    }
    parts_.arePanelsCurrent = true;
}

bool PanelDriver::handle(const InputEvent& event)
{
    PanelAnswer answer;
    const bool isTaken = layOut(&event, answer);
    take(answer);
    return isTaken;
}

bool PanelDriver::layOut(const InputEvent* event, PanelAnswer& answer)
{
    const PanelContent shown = content();
    return parts_.widgets.layOut(event, parts_.screen.width(), parts_.screen.height(),
                                 [&] { parts_.panels.build(shown, answer); });
}

void PanelDriver::take(const PanelAnswer& answer)
{
    if (answer.beginsDrag) {
        parts_.session.beginDrag();
        parts_.isValueDragged = true;
    }
    for (const Action& action : answer.actions) actions_.attempt(action);
    for (const std::string& problem : answer.problems) parts_.complain(problem);
    if (answer.endsDrag) actions_.endDrag();
    if (answer.beginsDrag || answer.endsDrag) parts_.refresh();
}

PanelContent PanelDriver::content() const
{
    const Session& session = parts_.session;
    const State& state = session.state();
    const Posing& posing = parts_.making.posing();
    const Viewport& picture = parts_.screen.viewports().first();
    PanelContent content{session,     parts_.making.planner(), parts_.making.progress(), parts_.messages,
                         parts_.note, shortcuts(parts_.keys),  parts_.recentFiles};
    content.axes = axesSeenBy(state.view.camera);
    content.gridStep = picture.shapes().ground().step();
    if (const OpenedMeshPtr& model = state.document.model) {
        const openvdb::BBoxd& box = picture.shapes().box();
        const Vec3d extents = box.extents();
        const double longest = std::max({extents.x(), extents.y(), extents.z()});
        content.largestDistance = longest > 0 ? picture.shapes().largestDistance() / longest : 0;
        content.box = box;
        content.model = countsOf(model->mesh, picture.shapes().edgeCount(LayerId::model));
    }
    if (const CageResultPtr& cage = parts_.making.cage()) {
        content.cage = countsOf(cage->cage, picture.shapes().edgeCount(LayerId::cage));
    }
    content.overlay = parts_.control.overlay();
    content.pictures = parts_.screen.viewports().places();
    content.binding = posing.follower().binder().progress();
    content.isPosedCoarsely = posing.follower().model().bound() && !posing.follower().model().isWhole();
    content.keys = parts_.keys;
    content.selected = selectionFrame(state, session.cage(), {});
    if (parts_.saver.isBusy()) content.saving = parts_.saver.progress();
    content.bindingError = posing.error();
    content.isPoseChecked = posing.follower().isChecking();
    content.poseCheck = posing.follower().check();
    content.isPosed = posing.isPosed(state);
    content.hasMaterial = posing.hasMaterial(state);
    content.hasModelChanged = parts_.watch.hasChanged();
    content.asksToQuit = parts_.asksToQuit;
    return content;
}

} // namespace vdbcage::view
