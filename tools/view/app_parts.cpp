#include <tools/view/app_parts.h>

#include <utility>

namespace vdbcage::view {

AppParts::AppParts(const gl::Api& api, AppSetup given, std::function<void(const Command&)> attempt,
                   std::function<void()> endDrag)
    : setup(std::move(given)), making(std::move(setup.maker), std::move(setup.binding), setup.wake), saver(setup.wake),
      widgets(setup.scale, setup.clipboard), screen(api, setup.isSoftware, widgets),
      control({session, screen.viewports().first(), std::move(attempt), std::move(endDrag),
               [this] { return pictureInUse(); }, double{setup.scale}})
{
}

void AppParts::chooseKeys(KeyMap map)
{
    keys = map;
    control.setMouse(mouseMap(map));
}

Rectangle AppParts::picturePlace() const
{
    return Panels::picturePlace(screen.width(), screen.height(), setup.scale, session.state().view.mode == Mode::pose);
}

Rectangle AppParts::pictureInUse() const
{
    const std::vector<Rectangle>& places = screen.viewports().places();
    return control.home()[0] < places.back().left ? places.front() : places.back();
}

void AppParts::refresh()
{
    making.follow(session, {isValueDragged, control.hasGrip()});
    const Planner& planner = making.planner();
    PictureContent content;
    content.model = session.state().document.model;
    content.cage = making.cage();
    content.isStale = content.cage == planner.made() && planner.standing() == Planner::Standing::stale;
    content.cagePoints = making.posing().cagePoints();
    const bool changed = screen.viewports().show(picturePlace(), content, making.posing().follower(),
                                                 making.posing().compared(), session.state().view);
    if (changed) screen.invalidate();
    arePanelsCurrent = false;
}

void AppParts::say(const std::string& text)
{
    note = text;
    screen.invalidate();
}

void AppParts::complain(const std::string& text)
{
    messages.push_back(text);
    screen.invalidate();
    refresh();
}

} // namespace vdbcage::view
