// A chess bishop after Staunton's pattern: a lathed body and, cut into the head, the slot of the mitre.

#include <algorithm>
#include <map>
#include <utility>

#include "model.h"

namespace data {

namespace {

constexpr int segments = 72; // around the axis; an even number
constexpr int halfTurn = segments / 2;
constexpr double spacing = 0.075; // of the lines on the slot's wall

struct ProfilePoint {
    double r, y;
};

/// The outline from the middle of the foot to the top of the knob.
class Profile {
public:
    explicit Profile(const ProfilePoint& start) : points_{start} {}

    void lineTo(const ProfilePoint& end, int steps)
    {
        const ProfilePoint start = points_.back();
        for (int i = 1; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            points_.push_back({lerp(start.r, end.r, t), lerp(start.y, end.y, t)});
        }
    }

    /// A cubic Bezier curve with two control points between the last point and `end`.
    void curveTo(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& end, int steps)
    {
        const ProfilePoint start = points_.back();
        for (int i = 1; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const double w[4] = {(1 - t) * (1 - t) * (1 - t), 3 * t * (1 - t) * (1 - t), 3 * t * t * (1 - t),
                                 t * t * t};
            points_.push_back({w[0] * start.r + w[1] * a.r + w[2] * b.r + w[3] * end.r,
                               w[0] * start.y + w[1] * a.y + w[2] * b.y + w[3] * end.y});
        }
    }

    int size() const { return static_cast<int>(points_.size()); }

    /// The point at parameter `s`, a whole number at each point of the profile.
    ProfilePoint operator()(double s) const
    {
        const int i = std::min(static_cast<int>(s), size() - 2);
        const ProfilePoint& a = points_[static_cast<std::size_t>(i)];
        const ProfilePoint& b = points_[static_cast<std::size_t>(i) + 1];
        return {lerp(a.r, b.r, s - i), lerp(a.y, b.y, s - i)};
    }

private:
    std::vector<ProfilePoint> points_;
};

/// A bead: a half round that sticks out from the radius `r`, from the height of the last point to `top`.
void addBead(Profile& profile, double from, double r, double bulge, double top, int steps)
{
    profile.curveTo({r + bulge * 4 / 3, from}, {r + bulge * 4 / 3, top}, {r, top}, steps);
}

Profile makeProfile()
{
    Profile p({0, 0.14});
    p.lineTo({1.30, 0.14}, 5); // the hollow under the foot
    p.curveTo({1.38, 0.14}, {1.40, 0.0}, {1.48, 0.0}, 3);
    p.lineTo({1.66, 0.0}, 2);
    p.curveTo({1.78, 0.0}, {1.84, 0.05}, {1.84, 0.16}, 4); // foot
    p.lineTo({1.84, 0.30}, 2);
    p.curveTo({1.84, 0.52}, {1.66, 0.62}, {1.50, 0.66}, 6);
    p.lineTo({1.44, 0.68}, 1);
    addBead(p, 0.68, 1.44, 0.10, 0.92, 6);
    p.lineTo({1.36, 0.94}, 1);
    p.curveTo({1.22, 1.42}, {0.66, 1.62}, {0.56, 2.80}, 14); // the sweep up to the stem
    p.curveTo({0.50, 3.50}, {0.44, 3.90}, {0.48, 4.36}, 8);
    p.curveTo({0.50, 4.60}, {0.62, 4.74}, {0.82, 4.80}, 4); // collars
    addBead(p, 4.80, 0.94, 0.07, 4.98, 6);
    p.curveTo({0.72, 5.02}, {0.66, 5.04}, {0.64, 5.10}, 3);
    addBead(p, 5.12, 0.66, 0.06, 5.28, 6);
    p.curveTo({0.50, 5.30}, {0.46, 5.36}, {0.46, 5.44}, 3);
    p.curveTo({0.50, 5.60}, {0.86, 5.76}, {0.86, 6.14}, 10); // head
    p.curveTo({0.86, 6.60}, {0.42, 7.06}, {0.20, 7.34}, 15);
    p.curveTo({0.15, 7.40}, {0.15, 7.41}, {0.17, 7.43}, 2); // knob
    p.curveTo({0.30, 7.52}, {0.30, 7.74}, {0.14, 7.81}, 6);
    p.curveTo({0.09, 7.833}, {0.05, 7.84}, {0, 7.84}, 3);
    return p;
}

/// The slot: what lies within `halfWidth` of a half plane that opens to the upper side and is level along Z.
struct Slot {
    double halfWidth = 0.092;
    Vec3 end = {-0.02, 6.26, 0};              // a point of the half plane's edge
    Vec3 opening = {0.7880108, 0.6156615, 0}; // from there to the outside; a unit vector

    /// Distance of `p` to the slot, negative within.
    double operator()(const Vec3& p) const
    {
        const Vec3 d = p - end;
        const double along = std::max(0.0, d.x * opening.x + d.y * opening.y);
        const double dx = d.x - along * opening.x;
        const double dy = d.y - along * opening.y;
        return std::sqrt(dx * dx + dy * dy) - halfWidth;
    }
};

/// The half of the bishop with z >= 0; the other half is its mirror image.
class Half {
public:
    Half() : profile_(makeProfile()) {}

    Model make()
    {
        findCorners();
        snap();
        for (int i = 0; i + 1 < profile_.size(); ++i)
            for (int j = 0; j < halfTurn; ++j) addCell(i, j);
        addSlotWall();
        return model_;
    }

private:
    struct Corner {
        double s, t;     // along the profile and around, whole numbers on the unchanged grid
        double distance; // to the slot
        int point;
    };

    Vec3 place(double s, double t) const
    {
        const ProfilePoint q = profile_(s);
        double sn = 0;
        double cs = 0;
        sineCosine(2 * pi * t / segments, sn, cs);
        return {q.r * cs, q.y, t == 0 || t == halfTurn ? 0 : q.r * sn};
    }

    Vec3 at(int point) const { return model_.points[static_cast<std::size_t>(point)]; }

    Corner& corner(int i, int j) { return corners_[static_cast<std::size_t>(i * (halfTurn + 1) + j)]; }

    void findCorners()
    {
        for (int i = 0; i < profile_.size(); ++i)
            for (int j = 0; j <= halfTurn; ++j) corners_.push_back({1.0 * i, 1.0 * j, slot_(place(i, j)), -1});
    }

    /// Where the slot's edge crosses the line between two corners, as a part of that line.
    double crossing(const Corner& a, const Corner& b) const
    {
        double low = 0;
        double high = 1;
        for (int step = 0; step < 50; ++step) {
            const double middle = 0.5 * (low + high);
            const bool inside = slot_(place(lerp(a.s, b.s, middle), lerp(a.t, b.t, middle))) < 0;
            (inside == (a.distance < 0) ? low : high) = middle;
        }
        return low;
    }

    /// Moves corners onto the slot's edge where it passes near by, so that no sliver is cut off.
    void snap()
    {
        std::vector<Corner> moved = corners_;
        for (int i = 1; i + 1 < profile_.size(); ++i) {
            for (int j = 0; j <= halfTurn; ++j) {
                const Corner& a = corner(i, j);
                double nearest = 0.36;
                for (const auto& step : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
                    if (j + step.second < 0 || j + step.second > halfTurn) continue;
                    const bool onSeam = j == 0 || j == halfTurn;
                    if (onSeam && step.second != 0) continue; // must stay in the middle plane
                    const Corner& b = corner(i + step.first, j + step.second);
                    if ((a.distance < 0) == (b.distance < 0)) continue;
                    const double part = crossing(a, b);
                    if (part >= nearest) continue;
                    nearest = part;
                    moved[static_cast<std::size_t>(&a - corners_.data())] = {lerp(a.s, b.s, part), lerp(a.t, b.t, part),
                                                                             0, -1};
                }
            }
        }
        corners_ = moved;
    }

    int pointOf(Corner& c)
    {
        if (c.point < 0) {
            c.point = model_.addPoint(place(c.s, c.t));
            if (c.distance == 0) onEdge_.push_back(c.point);
        }
        return c.point;
    }

    /// The point where the slot's edge crosses the line between two corners.
    int cut(Corner& a, Corner& b)
    {
        Corner* first = &a < &b ? &a : &b;
        Corner* second = &a < &b ? &b : &a;
        const auto known = cuts_.find({first, second});
        if (known != cuts_.end()) return known->second;
        const double part = crossing(*first, *second);
        const int point = model_.addPoint(place(lerp(first->s, second->s, part), lerp(first->t, second->t, part)));
        onEdge_.push_back(point);
        cuts_[{first, second}] = point;
        return point;
    }

    void addFace(const std::vector<Corner*>& corners)
    {
        std::vector<int> points;
        for (Corner* c : corners) points.push_back(pointOf(*c)); // numbers new points in this order
        addFace(points);
    }

    void addFace(const std::vector<int>& points)
    {
        if (points.size() == 3) model_.addTriangle(points[0], points[1], points[2]);
        if (points.size() == 4) model_.addQuad(points[0], points[1], points[2], points[3]);
    }

    void addCell(int i, int j)
    {
        Corner* c[4] = {&corner(i, j), &corner(i + 1, j), &corner(i + 1, j + 1), &corner(i, j + 1)};
        if (i == 0) { // the pole below, then the pole on top
            addFace({&corner(0, 0), c[1], c[2]});
        } else if (i + 2 == profile_.size()) {
            addFace({c[0], &corner(i + 1, 0), c[3]});
        } else if (std::all_of(c, c + 4, [](const Corner* q) { return q->distance > 0; })) {
            addFace({c[0], c[1], c[2], c[3]});
        } else if (!std::all_of(c, c + 4, [](const Corner* q) { return q->distance <= 0; })) {
            // By the diagonal that the slot's edge does not cross, if there is one.
            const bool turn = c[0]->distance * c[2]->distance < 0;
            addClipped({c[turn], c[1 + turn], c[2 + turn]});
            addClipped({c[turn], c[2 + turn], c[(3 + turn) % 4]});
        }
    }

    /// The part of a triangle that the slot leaves.
    void addClipped(const std::array<Corner*, 3>& triangle)
    {
        std::vector<int> kept;
        bool outside = false;
        for (std::size_t i = 0; i < 3; ++i) {
            Corner& a = *triangle[i];
            Corner& b = *triangle[(i + 1) % 3];
            outside = outside || a.distance > 0;
            if (a.distance >= 0) kept.push_back(pointOf(a));
            if (a.distance * b.distance < 0) kept.push_back(cut(a, b));
        }
        if (!outside) return;
        addFace(kept);
    }

    /// Lines along Z from the slot's edge to the middle plane, and triangles between one line and the next.
    void addSlotWall()
    {
        // From the lip above along the edge to the lip below: by the place across the slot, then along it.
        const auto order = [this](int point) {
            const Vec3 d = at(point) - slot_.end;
            const double along = d.x * slot_.opening.x + d.y * slot_.opening.y;
            const double across = d.y * slot_.opening.x - d.x * slot_.opening.y;
            return along > 0 ? (across > 0 ? -1 - along : 1 + along) : -across / slot_.halfWidth;
        };
        std::sort(onEdge_.begin(), onEdge_.end(), [&](int a, int b) { return order(a) < order(b); });
        // A line starts where its foot is well away from the last line's; edge points between the two become the
        // end of the shorter line.
        std::vector<int> above{onEdge_.front()};
        std::vector<int> between;
        for (std::size_t i = 1; i < onEdge_.size(); ++i) {
            const Vec3 start = at(onEdge_[i]);
            const Vec3 foot{start.x, start.y, 0};
            const Vec3 lower{at(onEdge_.back()).x, at(onEdge_.back()).y, 0};
            const bool last = i + 1 == onEdge_.size();
            if (!last && (length(foot - at(above.front())) < spacing || length(foot - lower) < 0.6 * spacing)) {
                between.push_back(onEdge_[i]);
                continue;
            }
            const int steps = last ? 0 : 1 + static_cast<int>(start.z / spacing);
            std::vector<int> line;
            for (int k = 0; k < steps; ++k) line.push_back(model_.addPoint({start.x, start.y, start.z * k / steps}));
            line.push_back(onEdge_[i]);
            std::vector<int> longer = line;
            if (at(above.back()).z < start.z) {
                above.insert(above.end(), between.begin(), between.end());
            } else {
                longer.insert(longer.end(), between.rbegin(), between.rend());
            }
            addStrip(above, longer);
            between.clear();
            above = line;
        }
    }

    /// Triangles between two lines, each time across the shorter way.
    void addStrip(const std::vector<int>& a, const std::vector<int>& b)
    {
        std::size_t i = 0;
        std::size_t j = 0;
        while (i + 1 < a.size() || j + 1 < b.size()) {
            const bool advanceA =
                j + 1 == b.size() ||
                (i + 1 < a.size() && length(at(a[i + 1]) - at(b[j])) < 0.999999 * length(at(a[i]) - at(b[j + 1])));
            if (advanceA) {
                model_.addTriangle(a[i], a[i + 1], b[j]);
                ++i;
            } else {
                model_.addTriangle(a[i], b[j + 1], b[j]);
                ++j;
            }
        }
    }

    Profile profile_;
    Slot slot_;
    Model model_;
    std::vector<Corner> corners_;
    std::vector<int> onEdge_;
    std::map<std::pair<Corner*, Corner*>, int> cuts_;
};

} // namespace

Model makeBishop()
{
    Model model = Half().make();
    std::vector<int> mirrored(model.points.size());
    for (std::size_t i = 0; i < mirrored.size(); ++i) {
        const Vec3 p = model.points[i];
        mirrored[i] = p.z == 0 ? static_cast<int>(i) : model.addPoint({p.x, p.y, -p.z});
    }
    const std::vector<Face> half = model.faces;
    for (Face face : half) {
        for (int& corner : face)
            if (corner >= 0) corner = mirrored[static_cast<std::size_t>(corner)];
        // Turned round, the first corner kept: so a quad keeps its diagonal.
        std::swap(face[1], face[face[3] < 0 ? 2 : 3]);
        model.faces.push_back(face);
    }
    removeUnusedPoints(model);
    return model;
}

} // namespace data
