#include <vdbcage/bounding/detail/quads/quad_table.h>

#include <algorithm>

#include <vdbcage/core/error.h>

namespace vdbcage::detail {

QuadTable::QuadTable(const GuardedMesh& surface) : quadsOf_(surface.vertices())
{
    if (surface.faces() % 2 != 0) throw InputError("surface", "it has a triangle; all faces must be quads");
    for (std::uint32_t f = 0; f < surface.faces(); f += 2) {
        const Vec3I &s = surface.face(f), &t = surface.face(f + 1); // as triangulate() splits a quad
        if (s[0] != t[0] || s[2] != t[1]) throw InputError("surface", "it has a triangle; all faces must be quads");
        for (const std::uint32_t v : {s[0], s[1], s[2], t[2]}) quadsOf_[v].push_back(quads());
        corners_.emplace_back(s[0], s[1], s[2], t[2]);
    }
    count_ = corners_.size();
}

QuadTable QuadTable::ofPairs(const GuardedMesh& surface)
{
    QuadTable table;
    table.quadsOf_.resize(surface.vertices());
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (surface.isFace(f) && surface.isInQuad(f) && f < surface.partnerOf(f)) table.add(surface.quadOf(f));
    }
    return table;
}

int QuadTable::sideOf(std::uint32_t q, std::uint32_t a, std::uint32_t b) const
{
    const Vec4I& ids = corners_[q];
    int i = 0;
    while (i < 4 && !(ids[i] == a && ids[(i + 1) % 4] == b)) ++i;
    return i;
}

std::uint32_t QuadTable::quadAt(std::uint32_t a, std::uint32_t b) const
{
    const Quads& around = quadsOf_[a];
    const auto found = std::find_if(around.begin(), around.end(), [&](std::uint32_t q) { return sideOf(q, a, b) < 4; });
    return found == around.end() ? none : *found;
}

void QuadTable::remove(std::uint32_t q)
{
    for (int i = 0; i < 4; ++i) {
        Quads& around = quadsOf_[corners_[q][i]];
        const auto found = std::find(around.begin(), around.end(), q);
        if (found != around.end()) around.erase(found);
    }
    corners_[q] = Vec4I(none);
    --count_;
}

void QuadTable::merge(std::uint32_t kept, std::uint32_t removed)
{
    const Quads moving = quadsOf_[removed];
    for (const std::uint32_t q : moving) {
        Vec4I& ids = corners_[q];
        for (int i = 0; i < 4; ++i) {
            if (ids[i] == removed) ids[i] = kept;
        }
        quadsOf_[kept].push_back(q);
    }
    quadsOf_[removed].clear();
}

void QuadTable::add(const Vec4I& corners)
{
    corners_.emplace_back(none);
    ++count_;
    replace(quads() - 1, corners);
}

void QuadTable::replace(std::uint32_t q, const Vec4I& corners)
{
    if (isQuad(q)) {
        remove(q);
        ++count_;
    }
    corners_[q] = corners;
    for (int i = 0; i < 4; ++i) {
        if (corners[i] >= quadsOf_.size()) quadsOf_.resize(corners[i] + 1);
        quadsOf_[corners[i]].push_back(q);
    }
}

QuadTable::Saved QuadTable::saved(const std::vector<std::uint32_t>& vertices) const
{
    Saved saved{{}, {}, count_, quads(), quadsOf_.size()};
    for (const std::uint32_t v : vertices) {
        saved.quadsOf.emplace_back(v, quadsOf_[v]);
        for (const std::uint32_t q : quadsOf_[v]) saved.corners.emplace_back(q, corners_[q]);
    }
    return saved;
}

void QuadTable::restore(const Saved& saved)
{
    corners_.resize(saved.quads, Vec4I(none));
    quadsOf_.resize(saved.vertices);
    for (const auto& [v, list] : saved.quadsOf) quadsOf_[v] = list;
    for (const auto& [q, ids] : saved.corners) corners_[q] = ids;
    count_ = saved.count;
}

std::vector<std::uint32_t> cornersOf(const QuadTable& table, const std::vector<std::uint32_t>& quads)
{
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t q : quads) {
        for (int i = 0; i < 4; ++i) corners.push_back(table.corners(q)[i]);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

std::size_t valence(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v)
{
    return (surface.isOnPlane(v) ? 2 : 1) * table.quadsOf(v).size();
}

} // namespace vdbcage::detail
