#include <tools/view/making.h>

#include <utility>

#include <tools/view/state/animation.h>

namespace vdbcage::view {

namespace {

bool showsIntermediates(const ViewState& view)
{
    bool shows = view.cageColours == CageColours::distance;
    for (std::size_t i = 0; i < layerCount; ++i) {
        const auto id = static_cast<LayerId>(i);
        shows |= view.layers[i].shown && id != LayerId::model && id != LayerId::cage;
    }
    return shows;
}

} // namespace

Making::Making(std::unique_ptr<CageMaker> maker, Binder::Work binding, const std::function<void()>& wake)
    : runner_(maker ? std::move(maker) : makePipelineMaker(), wake),
      posing_(binding ? std::move(binding) : bindingWork(), wake)
{
}

void Making::follow(Session& session, const Hand& hand)
{
    const Document& document = session.state().document;
    std::optional<Order> order;
    if (document.model) order = orderOf(document);
    runner_.want(order, hand.hasValue || hand.hasCage, keepsIntermediates_ || showsIntermediates(session.state().view));
    cage_ = posing_.cageOf(session.state(), planner());
    if (session.cage() != posing_.posable()) session.setCage(posing_.posable());
    posing_.follow(session.state(), planner(),
                   !hand.hasCage && !session.isDragging() && !Animation::isPlaying(session.state()));
}

void Making::update()
{
    runner_.update();
    posing_.update();
}

void Making::waitForNews(double seconds)
{
    if (!planner().isSettled()) return runner_.waitForNews(seconds);
    posing_.waitForNews(seconds);
}

void Making::again()
{
    runner_.again();
    posing_.again();
}

void Making::cancel()
{
    runner_.cancel();
    posing_.cancel();
}

} // namespace vdbcage::view
