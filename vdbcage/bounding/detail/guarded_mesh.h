#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <openvdb/math/Vec4.h>
#include <vdbcage/bounding/detail/contact_planes.h>
#include <vdbcage/bounding/detail/guard_model.h>
#include <vdbcage/geometry/dynamic_bvh.h>

namespace vdbcage::detail {

using openvdb::Vec4I;

/// A change to a surface: the triangles around one vertex, with one next to them or without, around both ends of an
/// edge, or on both sides of an edge give way to a star around a centre. Moving a vertex, flipping an edge, collapsing
/// one and splitting one are the same thing to the guard.
struct StarChange {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    using Faces = boost::container::small_vector<std::uint32_t, 16>;

    std::uint32_t centre = none;  ///< the vertex that moves, survives the collapse, or is new: then it is vertices()
    bool onPlane = false;         ///< the centre is, or comes to be, on the plane of symmetry: this is half of a star
    std::uint32_t removed = none; ///< the vertex that goes in a collapse
    Faces oldFaces;               ///< those that give way
    Faces keptFaces;              ///< for each link edge the old face that becomes its triangle; none: a new face
    /// Edges across from the centre, in the faces' direction.
    boost::container::small_vector<std::array<std::uint32_t, 2>, 16> link;
    std::size_t alternates = 0; ///< so many faces and link edges at the ends of the lists are of quads' other diagonals
};

/// A closed surface that bounds a model and is only changed in ways that keep it so. A value; copies share the guard.
///
/// It is made of triangles; two that share an edge can be the pair of a quad. A quad bounds under both diagonals: for
/// that the two triangles of its other diagonal, its alternates, go through the same tests as live faces, against all but
/// its pair. Faces below are triangles; alternates have numbers among them, but are in no list unless it says so.
///
/// Where the guard has a plane of symmetry, this is the half of the surface beyond it, and all counts are of the half.
/// The other half is its mirror image and not stored: vertices on the plane, where the half ends, stay on it, all
/// alternates stay beyond it, and no edge but those where the half ends has both its ends on the plane; so the pair can
/// meet in nothing but vertices and edges on the plane, and what is allowed here is allowed there.
class GuardedMesh {
public:
    enum class Quads {
        split,
        keep ///< where both diagonals are allowed; else they are split
    };
    /// Points are rounded as the guard asks. \throw InputError the surface is not a closed 2-manifold, or not
    /// symmetric where the guard has a plane
    GuardedMesh(const Mesh& surface, const GuardModel& guard, Quads quads = Quads::split);

    /// How many times this the surface is: 2 where the guard has a plane of symmetry, else 1.
    std::size_t copies() const { return guard().symmetry() ? 2 : 1; }
    std::size_t liveFaces() const { return liveFaces_; }
    std::uint32_t faces() const { return static_cast<std::uint32_t>(faces_.size()); } ///< ever, numbers below
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(points_.size()); }
    bool isVertex(std::uint32_t v) const { return !facesOf_[v].empty(); }
    const Vec3d& point(std::uint32_t v) const { return points_[v]; }
    /// Whether a vertex is on the plane of symmetry.
    bool isOnPlane(std::uint32_t v) const;
    /// The nearest point on the plane of symmetry. \pre there is one
    Vec3d ontoPlane(Vec3d p) const;
    using FaceList = boost::container::small_vector<std::uint32_t, 8>;
    const FaceList& facesOf(std::uint32_t v) const { return facesOf_[v]; }
    const Vec3I& face(std::uint32_t f) const { return faces_[f]; }
    Corners corners(std::uint32_t f) const;
    using Vertices = boost::container::small_vector<std::uint32_t, 16>;
    /// The vertices joined to v by an edge, or by the other diagonal of a quad, or opposite to it in one; ascending.
    Vertices neighbours(std::uint32_t v) const;

    StarChange starOf(std::uint32_t v) const;
    /// The star that takes the place of the stars of both ends; false where the link condition forbids the collapse.
    /// \pre there are no quads
    bool starOf(std::uint32_t keep, std::uint32_t remove, StarChange& star) const;
    /// The star that splits the edge between two neighbours at a new vertex. \pre there are no quads
    StarChange starOfSplit(std::uint32_t u, std::uint32_t v) const;
    /// The star around c that takes in the face across its link edge from a to b, which gives way to an edge from c to
    /// that face's third corner. False where there is no such face, or these two are joined already (as the other
    /// neighbours of a vertex with three are) or both on the plane of symmetry. \pre there are no quads
    bool starOfFlip(std::uint32_t c, std::uint32_t a, std::uint32_t b, StarChange& star) const;
    /// The star around a new vertex that takes the place of some faces; on the plane of symmetry, where they have a side
    /// there, if `onPlane`. False unless they are one disk without a vertex inside. \pre they are in no quad
    bool starOfFaces(const StarChange::Faces& faces, bool onPlane, StarChange& star) const;
    /// The mean normal of what the star replaces, of unit length (or zero).
    Vec3d outward(const StarChange& star) const;
    /// `p` as a place of the star's centre: on the plane of symmetry where it has to be, rounded as the guard asks.
    Vec3d rounded(const StarChange& star, const Vec3d& p) const;

    /// What allows() learns of the model.
    struct Obstacle {
        std::uint32_t item = TriangleBvh::none; ///< of the model: the last that was in the way, the first to try
        std::size_t clear = 0; ///< at the last place so many of the star's triangles, from the first, keep clear
    };
    /// Whether the star may have its centre at `p` (rounded as the guard asks).
    bool allows(const StarChange& star, const Vec3d& p, Obstacle* obstacle = nullptr) const;
    /// The half-spaces that keep the star's centre, allowed at `from`, off what forbids it at `to`; `obstacle` is what
    /// allows() gave there.
    void contacts(const StarChange& star, const Vec3d& from, const Vec3d& to, Obstacle obstacle,
                  std::vector<HalfSpace>& halfSpaces) const;
    /// Makes the change; it must have been allowed.
    void apply(const StarChange& star, const Vec3d& p);

    std::size_t quads() const { return quads_.size() - freeQuads_.size(); }
    /// The other half of the quad that a face belongs to, or StarChange::none; for a quad's other, the second of these.
    std::uint32_t partnerOf(std::uint32_t f) const;
    /// The corners of a quad of two faces that share an edge, which runs from corner 0 to corner 2.
    Vec4I quadOf(std::uint32_t f, std::uint32_t g) const;
    /// No quad is made, and no vertex moved, so that the triangles of a quad meet at a larger angle, under either
    /// diagonal; up to 90 degrees, and that unless it was set.
    void limitQuadFold(double degrees);
    /// Makes two faces that share an edge, and are in no quad, the pair of one, if it is convex, its other diagonal
    /// joins no two vertices that are joined already, and the guard allows its alternates. Returns whether.
    bool makeQuad(std::uint32_t f, std::uint32_t g);
    /// The pair of a quad are triangles again.
    void splitQuad(std::uint32_t half);
    /// The pair of a quad become its alternates, and its alternates its pair: the same quad, about to be split otherwise.
    void flipQuad(std::uint32_t half);
    /// Whether a face is one, not a quad's other and not gone.
    bool isFace(std::uint32_t f) const { return life_[f] == live; }
    /// The alternates of the quad that a half belongs to.
    const std::array<std::uint32_t, 2>& alternatesIn(std::uint32_t half) const { return quads_[quadAt_[half]].alternates; }
    /// The weight of a face, or a quad's other, in a sum over the surface: a half if it shows under one diagonal only.
    double weight(std::uint32_t f) const { return f != StarChange::none && quadAt_[f] != StarChange::none ? 0.5 : 1; }
    /// The alternates at a vertex.
    const FaceList& alternatesOf(std::uint32_t v) const { return alternatesOf_[v]; }

    /// Changes that were each allowed on the surface as it was when the batch began, made one after the other. The
    /// surface may not be asked what it allows before the batch ends.
    class Batch;

    /// The live triangles and quads, points that no face uses left out, order kept; then the mirror image of them all.
    Mesh mesh() const;
    const GuardModel& guard() const { return guard_; }

private:
    /// Keeps the faces beyond the plane; returns the number of the first half of a quad among them.
    std::uint32_t takeHalf(std::uint32_t firstOfQuads);
    bool isManifoldAt(std::uint32_t v) const;
    /// Whether the star with its centre at `p` would not keep off its mirror image.
    bool isTooNearPlane(const StarChange& star, const Vec3d& p) const;
    /// The distance that a star, its longest spoke being its longest edge, keeps from what is larger.
    double spacingAround(const StarChange& star, const Vec3d& p) const;
    Corners starCorners(const StarChange& star, std::size_t i, const Vec3d& p) const;
    bool wellShaped(const StarChange& star, const Vec3d& p) const;
    bool clearOfSurface(const StarChange& star, const Vec3d& p) const;
    struct PlacedStar;
    bool isTooNear(const PlacedStar& placed, std::uint32_t face, const Box& box) const;
    bool isOld(const StarChange& star, std::uint32_t face) const;
    bool sweepsOverNothing(const StarChange& star, const Vec3d& p) const;
    bool areConvexQuads(const StarChange& star, const Vec3d& p) const;
    /// apply(), not seen by tree_ until it is refitted.
    void change(const StarChange& star, const Vec3d& p);
    void reconnect(const StarChange& star);
    bool areAlternatives(std::uint32_t f, std::uint32_t g) const;

    enum Life : char { dead, live, alternate };
    struct Quad {
        std::array<std::uint32_t, 2> pair, alternates;
    };

    std::reference_wrapper<const GuardModel> guard_;
    std::vector<Vec3d> points_;
    std::vector<Vec3I> faces_;
    std::vector<char> life_;
    std::vector<FaceList> facesOf_, alternatesOf_; // by vertex
    std::size_t liveFaces_ = 0;
    double leastQuadCosine_ = 0;
    std::vector<Quad> quads_;
    std::vector<std::uint32_t> freeQuads_; // of quads_, not in use
    std::vector<std::uint32_t> quadAt_;    // by face: of quads_, or StarChange::none
    DynamicBvh tree_;
};

class GuardedMesh::Batch {
public:
    explicit Batch(GuardedMesh& surface) : surface_(surface) {}
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
    ~Batch();

    /// Makes the change, unless one made before it in the batch moved a vertex of its star or came into its way.
    bool apply(const StarChange& star, const Vec3d& p);

private:
    struct Made {
        Box box; // of the star
        std::uint32_t centre;
    };

    GuardedMesh& surface_;
    std::vector<std::uint32_t> moved_; // vertices, ascending
    std::vector<Made> made_;
};

} // namespace vdbcage::detail
