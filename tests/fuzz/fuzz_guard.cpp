// Changes of all kinds to a surface around a small model, as operators propose them, wherever they like. What the guard
// allowed leaves a surface that bounds the model, which is checked by other code than the guard's.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <fuzz/bytes.h>
#include <pipeline/runs.h>
#include <support/surface_models.h>
#include <support/symmetric.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

using namespace vdbcage;
using detail::GuardedMesh;
using detail::StarChange;
using fuzz::Choices;
using fuzz::require;
using openvdb::Vec3d;

namespace {

/// Within a ball of radius 0.42: a soup with needles and points near to others.
Mesh modelOf(Choices& choices)
{
    Mesh model;
    const int points = 3 + choices.below(12), faces = 1 + choices.below(10);
    for (int i = 0; i < points; ++i) {
        const bool isNear = i > 0 && choices.oneIn(3);
        const Vec3d from = isNear ? choices.of(model.points) : Vec3d(0);
        const double reach = isNear ? choices.small() : 0.42;
        Vec3d p = from + reach * choices.direction();
        if (p.length() > 0.42) p *= 0.42 / p.length();
        model.points.push_back(p);
    }
    for (int i = 0; i < faces; ++i) {
        const auto corner = [&] { return static_cast<openvdb::Index32>(choices.below(points)); };
        if (choices.oneIn(4)) {
            model.quads.push_back({corner(), corner(), corner(), corner()});
        } else {
            model.triangles.push_back({corner(), corner(), corner()});
        }
    }
    return model;
}

GuardOptions optionsOf(Choices& choices)
{
    GuardOptions options;
    options.clearance = std::pow(10.0, choices.between(-7.0, -1.5));
    options.minAngleDegrees = choices.oneIn(2) ? 0 : 30 * choices.share();
    options.spacing = std::pow(10.0, choices.between(-4.0, -2.0));
    if (choices.oneIn(3)) options.symmetry = SymmetryPlane{choices.below(3), 0};
    return options;
}

/// Proposes changes, and makes those that are allowed.
class Changes {
public:
    Changes(GuardedMesh& surface, Choices& choices) : surface_(surface), choices_(choices) {}

    void propose()
    {
        const std::uint32_t v = vertex();
        switch (choices_.below(10)) {
        case 0:
            collapse(v, neighbour(v));
            break;
        case 1:
            flip(v);
            break;
        case 2:
            split(v, neighbour(v));
            break;
        case 3:
            merge(v);
            break;
        case 4:
            quad(v);
            break;
        case 5:
            batch();
            break;
        default:
            make(starOf(surface_, v), surface_.point(v));
        }
    }

private:
    std::uint32_t vertex()
    {
        std::uint32_t v = choices_.any<std::uint16_t>() % surface_.vertices();
        while (!surface_.isVertex(v)) v = (v + 1) % surface_.vertices();
        return v;
    }
    std::uint32_t neighbour(std::uint32_t v)
    {
        const auto near = surface_.neighbours(v);
        return near[static_cast<std::size_t>(choices_.below(static_cast<int>(near.size())))];
    }
    bool hasQuadAt(std::uint32_t v) const
    {
        if (!surface_.alternatesOf(v).empty()) return true;
        for (const std::uint32_t f : surface_.facesOf(v)) {
            if (surface_.isInQuad(f)) return true;
        }
        return false;
    }
    /// Near to a place, on the way to the middle of the model, or through it.
    Vec3d placeNear(const Vec3d& p)
    {
        const double size = choices_.small();
        const Vec3d aside = p + size * choices_.direction();
        if (choices_.oneIn(2)) return aside;
        const Vec3d middle = surface_.guard().scaled(0.3 * choices_.direction());
        return aside + choices_.between(0.0, 1.5) * (middle - aside);
    }
    void make(const StarChange& star, const Vec3d& from)
    {
        const Vec3d p = rounded(surface_, star, placeNear(from));
        if (!allows(surface_, star, p)) return;
        surface_.apply(star, p);
    }
    void collapse(std::uint32_t keep, std::uint32_t remove)
    {
        if (hasQuadAt(keep) || hasQuadAt(remove)) return;
        StarChange star;
        if (!starOfCollapse(surface_, keep, remove, star)) return;
        const Vec3d from = surface_.point(choices_.oneIn(2) ? keep : remove);
        if (choices_.oneIn(2)) return make(star, from);
        // As it was, to the bit, when it is taken back.
        const Vec3d p = rounded(surface_, star, from);
        if (!allows(surface_, star, p)) return;
        const Mesh before = surface_.mesh();
        const auto saved = surface_.saved(star);
        surface_.apply(star, p);
        if (choices_.oneIn(2)) return;
        surface_.restore(saved);
        require(test::sameMesh(surface_.mesh(), before));
    }
    void flip(std::uint32_t v)
    {
        if (surface_.quads() > 0) return;
        const StarChange around = starOf(surface_, v);
        const auto& edge = around.link[static_cast<std::size_t>(choices_.below(static_cast<int>(around.link.size())))];
        StarChange star;
        if (starOfFlip(surface_, v, edge[0], edge[1], star)) make(star, surface_.point(v));
    }
    void split(std::uint32_t u, std::uint32_t v)
    {
        if (surface_.quads() > 0) return;
        make(starOfSplit(surface_, u, v), 0.5 * (surface_.point(u) + surface_.point(v)));
    }
    /// A new vertex for some faces in a row.
    void merge(std::uint32_t v)
    {
        if (hasQuadAt(v)) return;
        StarChange::Faces faces;
        for (const std::uint32_t f : surface_.facesOf(v)) {
            if (faces.empty() || choices_.oneIn(2)) faces.push_back(f);
        }
        StarChange star;
        if (starOfFaces(surface_, faces, choices_.oneIn(4) && surface_.guard().symmetry(), star)) {
            make(star, surface_.point(v));
        }
    }
    void quad(std::uint32_t v)
    {
        const auto& faces = surface_.facesOf(v);
        const std::uint32_t f = faces[static_cast<std::size_t>(choices_.below(static_cast<int>(faces.size())))];
        if (surface_.isInQuad(f)) return choices_.oneIn(2) ? surface_.splitQuad(f) : surface_.flipQuad(f);
        for (const std::uint32_t g : faces) {
            const bool isApart = g != f && !surface_.isInQuad(g);
            if (isApart && sharesEdge(f, g) && makeQuad(surface_, f, g)) return;
        }
    }
    bool sharesEdge(std::uint32_t f, std::uint32_t g) const
    {
        int shared = 0;
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) shared += surface_.face(f)[i] == surface_.face(g)[k];
        }
        return shared == 2;
    }
    /// Moves side by side, each allowed on the surface as it is now.
    void batch()
    {
        std::vector<std::pair<StarChange, Vec3d>> moves;
        for (int i = choices_.below(6); i >= 0; --i) {
            const std::uint32_t v = vertex();
            const StarChange star = starOf(surface_, v);
            const Vec3d p = rounded(surface_, star, placeNear(surface_.point(v)));
            if (allows(surface_, star, p)) moves.emplace_back(star, p);
        }
        detail::Batch batch(surface_);
        for (const auto& [star, p] : moves) batch.apply(star, p);
    }

    GuardedMesh& surface_;
    Choices& choices_;
};

bool isBounding(const CageChecker& checker, const Mesh& surface)
{
    CheckOptions options;
    options.measure = false;
    return checker.check(surface, options).bounding();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices(data, size);
    const GuardOptions options = optionsOf(choices);
    const int resolution = choices.between(6, 12);
    const Mesh model = modelOf(choices);
    std::optional<BoundingGuard> guard;
    try {
        guard.emplace(model, options);
    } catch (const InputError& error) { // no face with an area
        fuzz::requireOneLine(error.what());
        return 0;
    }
    Mesh start = test::ball(resolution);
    if (options.symmetry) start = guard->symmetrized(start, 0.25 / resolution);
    const CageChecker checker(model);
    if (!guard->facesTooNear(start).empty() || !isBounding(checker, start)) return 0;
    GuardedMesh surface(start, detail::modelOf(*guard));
    require(isBounding(checker, surface.mesh()));

    Changes changes(surface, choices);
    while (!choices.isAtEnd()) changes.propose();

    const Mesh end = surface.mesh();
    require(isBounding(checker, end));
    require(guard->facesTooNear(end).empty());
    require(end.triangles.size() + 2 * end.quads.size() == surface.copies() * surface.liveFaces());
    require(analyzeTopology(end).genus() == analyzeTopology(start).genus());
    if (options.symmetry) require(test::isSymmetric(end, *guard->symmetry()));
    return 0;
}
