// A cloak, hung over shoulders that are not there: a sheet of quads without thickness, open in front, with a standing
// collar, folds that deepen towards the hem, and two slits for the arms. Three boundary loops.

#include <algorithm>

#include "implicit.h"

namespace data {

namespace {

constexpr int columns = 72; // from the one front edge around the back to the other
constexpr int rows = 40;    // from the collar to the hem

/// Half the width and height of an arm slit in cells, and where its middle is.
constexpr double slitWidth = 2;
constexpr double slitHeight = 4;
constexpr double slitRow = 18;
constexpr double slitColumns[] = {20, columns - 20.0};

/// A point of the sheet; `column` and `row` need not be whole.
Vec3 place(double column, double row)
{
    // The outline of the right side, from collar to hem: distance from the axis, height.
    static const std::vector<Knot> outline = spline({{{13.5, 152, 0}, 0},
                                                     {{10.0, 143, 0}, 0},
                                                     {{17.5, 137, 0}, 0},
                                                     {{23.0, 127, 0}, 0},
                                                     {{25.0, 112, 0}, 0},
                                                     {{27.0, 94, 0}, 0},
                                                     {{30.5, 75, 0}, 0},
                                                     {{35.0, 56, 0}, 0},
                                                     {{40.5, 37, 0}, 0},
                                                     {{46.0, 18, 0}, 0}},
                                                    8);
    const double v = clamp(row / rows, 0, 1);
    const double s = v * static_cast<double>(outline.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(s), outline.size() - 2);
    const Vec3 at = lerp(outline[i].center, outline[i + 1].center, s - static_cast<double>(i));

    const double gap = 0.30 + 0.35 * v * v; // half the opening in front, radians
    const double turn = lerp(gap, 2 * pi - gap, column / columns);
    const double depth = smoothStep(0.12, 1.1, v);
    const double fold = cosine(9 * turn + 0.9 * sine(2 * turn)) + 0.35 * cosine(4 * turn + 1.3);
    const double radius = at.x + 4.2 * depth * fold;
    const double shoulders = smoothStep(0.05, 0.3, v) * (1 - 0.6 * smoothStep(0.3, 1, v));
    return {radius * (1 + 0.22 * shoulders) * sine(turn), at.y - 2.5 * depth * cosine(2 * turn) + 1.2 * depth * fold,
            radius * (1 - 0.18 * shoulders) * cosine(turn) - 5 * depth};
}

/// How far a grid point is from the nearest slit's middle: 1 on the edge of the block of cells that the slit replaces.
double slitDistance(double column, double row, double& across, double& along)
{
    const double middle = column < columns / 2 ? slitColumns[0] : slitColumns[1];
    across = (column - middle) / slitWidth;
    along = (row - slitRow) / slitHeight;
    return std::max(std::fabs(across), std::fabs(along));
}

} // namespace

Model makeOpenShell()
{
    Model model;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            // Around a slit, rectangles of grid points are drawn into ellipses, less and less with the distance.
            double across = 0;
            double along = 0;
            const double distance = slitDistance(i, j, across, along);
            double shrink = 1;
            if (distance > 0)
                shrink = lerp(distance / std::sqrt(across * across + along * along), 1, smoothStep(1, 2.6, distance));
            model.addPoint(place(i + slitWidth * across * (shrink - 1), j + slitHeight * along * (shrink - 1)));
        }
    }
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            double across = 0;
            double along = 0;
            if (slitDistance(i + 0.5, j + 0.5, across, along) < 1) continue;
            const int a = j * (columns + 1) + i;
            const int below = a + columns + 1;
            model.addQuad(a, below, below + 1, a + 1);
        }
    }
    removeUnusedPoints(model);
    return model;
}

} // namespace data
