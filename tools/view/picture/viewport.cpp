#include <tools/view/picture/viewport.h>

#include <tools/view/state/cage_changes.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

constexpr draw::Colour background{0.945F, 0.95F, 0.955F};
constexpr double lineWidth = 1.2; // pixels

} // namespace

Viewport::Viewport(const gl::Api& api, bool isSoftware) : renderer_(api), canvas_(api), shapes_(api, isSoftware)
{
    restart();
}

void Viewport::resize(int width, int height)
{
    if (canvas_.resize(width, height)) restart();
}

bool Viewport::show(const PictureContent& content, const ViewState& view)
{
    const LayerShapes::Change change = shapes_.show(content, view);
    if (change.model) picker_.forgetModel();
    if (change.any) restart();
    return change.any;
}

void Viewport::restart()
{
    canvas_.restart();
    picker_.forgetVisible();
    const ViewState& view = shapes_.view();
    eye_ = draw::eyeOf(view.camera, aspect(), shapes_.points(view, true));
}

void Viewport::draw(bool isMoving)
{
    canvas_.draw(isMoving, [&](draw::Target target, const draw::Crop& crop) {
        draw::Look look{eye_};
        look.crop = crop;
        look.background = background;
        look.section = shapes_.section();
        target.lineWidth = lineWidth;
        renderer_.draw(target, look, shapes_.layers(isMoving));
    });
}

draw::Picture Viewport::picture()
{
    while (!canvas_.isRefined()) draw(false);
    return canvas_.picture();
}

std::vector<Vec3d> Viewport::selectedPoints(const ViewState& view) const
{
    std::vector<Vec3d> points;
    if (!shapes_.cage()) return points;
    for (const openvdb::Index32 i : view::selectedPoints(shapes_.cage()->cage, view.selection)) {
        points.push_back(shapes_.frame().toDrawing(shapes_.cagePoints()[i]));
    }
    return points;
}

draw::Camera Viewport::fitted(const ViewState& view, bool selection) const
{
    const draw::Camera& camera = view.camera;
    std::vector<draw::Vec3f> selected;
    if (selection) {
        for (const Vec3d& p : selectedPoints(view)) {
            selected.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
        }
    }
    if (!selected.empty()) return draw::fit(camera.view, camera.projection, {&selected}, aspect(), 0.05);
    return draw::fit(camera.view, camera.projection, shapes_.points(view, false), aspect());
}

std::optional<Vec3d> Viewport::pointAt(double x, double y) const
{
    const auto hit = shapes_.nearestHit(draw::rayThrough(eye_, x, y));
    if (!hit) return std::nullopt;
    return hit->point;
}

std::optional<Vec3d> Viewport::selectionCentre(const ViewState& view) const
{
    const std::vector<Vec3d> selected = selectedPoints(view);
    if (selected.empty()) return std::nullopt;
    Vec3d sum(0);
    for (const Vec3d& p : selected) sum += p;
    return sum / static_cast<double>(selected.size());
}

std::optional<openvdb::Index32> Viewport::elementAt(const ViewState& view, const Pixel& at, double pixels)
{
    return picker_.at(pickedPicture(), view, at, pixels);
}

std::vector<openvdb::Index32> Viewport::elementsWithin(const ViewState& view, const std::vector<Pixel>& border)
{
    return picker_.within(pickedPicture(), view, border);
}

void Viewport::addElements(const ViewState& view, const std::vector<openvdb::Index32>& locked, bool isMoved,
                           PictureOverlay& overlay)
{
    picker_.addElements(pickedPicture(), view, locked, isMoved, overlay);
}

} // namespace vdbcage::view
