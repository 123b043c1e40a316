#include <tools/view/picture/cage_picker.h>

#include <algorithm>

namespace vdbcage::view {

using openvdb::Vec3d;

std::optional<openvdb::Index32> CagePicker::at(const Picture& picture, const ViewState& view, const Pixel& place,
                                               double pixels)
{
    const auto made = picking(picture, view);
    return made ? made->at(view.selection.kind, place[0], place[1], pixels) : std::nullopt;
}

std::vector<openvdb::Index32> CagePicker::within(const Picture& picture, const ViewState& view,
                                                 const std::vector<Pixel>& border)
{
    const auto made = picking(picture, view);
    if (!made) return {};
    std::vector<openvdb::Vec2d> polygon;
    for (const Pixel& corner : border) polygon.emplace_back(corner[0], corner[1]);
    return made->within(view.selection.kind, polygon);
}

std::optional<edit::Picking> CagePicker::picking(const Picture& picture, const ViewState& view)
{
    const LayerShapes& shapes = picture.shapes;
    if (!shapes.cage() || !view.layer(LayerId::cage).shown) return std::nullopt;
    edit::PickView seen{picture.eye, 1.0 * picture.width, 1.0 * picture.height, shapes.section(), view.seeThrough};
    const std::optional<draw::Shape>& model = shapes.model().drawn(false);
    const LayerLook& look = view.layer(LayerId::model);
    const bool hides = model && look.shown && look.opacity >= 1;
    if (hides && !occluder_) occluder_.emplace(model->geometry());
    std::vector<Vec3d> points;
    points.reserve(shapes.cagePoints().size());
    for (const Vec3d& p : shapes.cagePoints()) points.push_back(shapes.frame().toDrawing(p));
    return std::make_optional<edit::Picking>(elements(shapes.cage()), std::move(points), seen,
                                             hides ? &*occluder_ : nullptr);
}

const edit::Elements& CagePicker::elements(const CageResultPtr& cage)
{
    return elements_.of(cage, [&] { return edit::Elements(cage->cage); });
}

void CagePicker::addElements(const Picture& picture, const ViewState& view, const std::vector<openvdb::Index32>& locked,
                             bool isMoved, PictureOverlay& overlay)
{
    const LayerShapes& shapes = picture.shapes;
    if (!shapes.cage() || !view.layer(LayerId::cage).shown) return;
    const double width = picture.width, height = picture.height;
    const edit::Selection& selection = view.selection;
    const auto pixelAt = [&](openvdb::Index32 point) {
        const Vec3d seen = draw::project(picture.eye, shapes.frame().toDrawing(shapes.cagePoints()[point]));
        return Pixel{(seen.x() + 1) / 2 * width, (1 - seen.y()) / 2 * height};
    };
    const auto isIn = [](const std::vector<openvdb::Index32>& ascending, openvdb::Index32 point) {
        return std::binary_search(ascending.begin(), ascending.end(), point);
    };
    const bool arePointsSelected = selection.kind == edit::Element::point;
    if (arePointsSelected || !locked.empty()) {
        if (!isMoved || !lastPoints_) {
            if (!visiblePoints_) {
                visiblePoints_ = picking(picture, view)
                                     ->within(edit::Element::point, {{0, 0}, {width, 0}, {width, height}, {0, height}});
            }
            lastPoints_ = visiblePoints_;
        }
        for (const openvdb::Index32 i : *lastPoints_) {
            if (i >= shapes.cagePoints().size()) break;
            const bool isLocked = isIn(locked, i);
            if (!arePointsSelected && !isLocked) continue;
            overlay.points.push_back({pixelAt(i), arePointsSelected && isIn(selection.ids, i), isLocked});
        }
    }
    if (selection.kind == edit::Element::edge && !selection.ids.empty()) {
        const auto& edges = elements(shapes.cage()).edges();
        for (const openvdb::Index32 edge : selection.ids) {
            if (edge >= edges.size()) break;
            overlay.edges.push_back({pixelAt(edges[edge].first), pixelAt(edges[edge].second)});
        }
    }
}

} // namespace vdbcage::view
