#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <openvdb/math/Vec4.h>
#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/guard/move_limit.h>
#include <vdbcage/bounding/detail/guard/wishes.h>
#include <vdbcage/geometry/dynamic_bvh.h>

namespace vdbcage::detail {

using openvdb::Vec4I;

struct StarChange;

/// A closed surface that bounds a model, changed only in ways that keep it so. A value; copies share the guard.
///
/// Its triangles are called faces. Two that share an edge can be a quad, which bounds under both diagonals. The two
/// triangles of its alternate diagonal are its alternates. They pass the same tests as live faces, against all faces
/// except the quad's own two. Alternates have numbers among the faces, but are in no list unless its comment says so.
///
/// Where the guard has a plane of symmetry, this is the half of the surface beyond it, and all counts are of the half.
/// The other half is its mirror image and not stored. Vertices on the plane stay on it, and all others beyond it. Only
/// edges where the half ends have both ends on the plane. The halves thus meet only in vertices and edges on the plane,
/// and a change allowed in one is allowed in the other.
class GuardedMesh {
public:
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    enum class Quads {
        split,
        keep ///< where both diagonals are allowed; else they are split
    };
    /// Rounds the points as the guard asks.
    /// \throw InputError not a closed 2-manifold, or not symmetric where the guard has a plane
    GuardedMesh(const Mesh& surface, const GuardModel& guard, Quads quads = Quads::split,
                const FaceWishes& wishes = {});

    /// Returns 2 where the guard has a plane of symmetry, since the surface is twice this; else 1.
    std::size_t copies() const { return guard().symmetry() ? 2 : 1; }
    std::size_t liveFaces() const { return liveFaces_; }
    std::uint32_t faces() const { return static_cast<std::uint32_t>(faces_.size()); } ///< ever; numbers are less
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(points_.size()); }
    bool isVertex(std::uint32_t v) const { return !facesOf_[v].empty(); }
    const Vec3d& point(std::uint32_t v) const { return points_[v]; }
    bool isOnPlane(std::uint32_t v) const
    {
        const auto& plane = guard().symmetry();
        return plane && points_[v][plane->axis] == plane->offset;
    }
    /// Returns the nearest point on the plane of symmetry.
    /// \pre there is one
    Vec3d ontoPlane(Vec3d p) const;
    using FaceList = boost::container::small_vector<std::uint32_t, 8>;
    const FaceList& facesOf(std::uint32_t v) const { return facesOf_[v]; }
    const Vec3I& face(std::uint32_t f) const { return faces_[f]; }
    Corners corners(std::uint32_t f) const
    {
        const Vec3I& t = faces_[f];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }
    using Vertices = boost::container::small_vector<std::uint32_t, 16>;
    /// Returns the vertices joined to v by an edge or by an alternate diagonal, ascending.
    Vertices neighbours(std::uint32_t v) const;

    /// Makes a change.
    /// \pre allows() returned true for it
    void apply(const StarChange& star, const Vec3d& p);
    /// Makes one of several changes: tree() does not have it before refit().
    void change(const StarChange& star, const Vec3d& p);
    void refit() { tree_.refit(); }
    /// The faces and points that a change replaces, and the counts before it.
    struct Saved {
        std::uint32_t faceCount, vertexCount;
        std::vector<std::pair<std::uint32_t, Vec3I>> faces;
        std::vector<std::pair<std::uint32_t, Vec3d>> points;
        std::vector<std::pair<std::uint32_t, FaceList>> facesOf;
    };
    /// Returns the faces and points that `star` would replace.
    /// \pre it touches no quad
    Saved saved(const StarChange& star) const;
    /// Undoes a change, to the bit, except that the numbers of new vertices and faces stay used up.
    /// \pre `saved` is of the last change that is not undone
    void restore(const Saved& saved);
    /// Returns the boxes of all faces and alternates, by number.
    const DynamicBvh& tree() const { return tree_; }

    std::size_t quads() const { return quads_.size() - freeQuads_.size(); }
    /// Returns the other triangle of a face's quad, or `none`; for an alternate, the other alternate.
    std::uint32_t partnerOf(std::uint32_t f) const;
    /// Returns the corners of a quad of two faces that share an edge. The edge goes from corner 0 to corner 2.
    Vec4I quadOf(std::uint32_t f, std::uint32_t g) const;
    /// Returns the corners of the quad that a face or an alternate belongs to; corners 0 and 2 are on its diagonal.
    Vec4I quadOf(std::uint32_t f) const;
    /// Sets the largest angle at which the triangles of a quad may meet, under either diagonal: 90 degrees unless set,
    /// and at most.
    void limitQuadFold(double degrees);
    double leastQuadCosine() const { return leastQuadCosine_; }
    /// Makes a quad of two faces that share an edge. `alternates` are the corners of its alternates.
    /// \pre it is allowed (see makeQuad)
    void pair(std::uint32_t f, std::uint32_t g, const std::array<Vec3I, 2>& alternates);
    /// Makes the two faces of a quad triangles again.
    void splitQuad(std::uint32_t face);
    /// Makes the alternates of a quad its faces, and its faces its alternates.
    void flipQuad(std::uint32_t face);
    /// Returns whether a number is that of a live face: not of an alternate or of a removed face.
    bool isFace(std::uint32_t f) const { return life_[f] == live; }
    bool isInQuad(std::uint32_t f) const { return f != none && quadAt_[f] != none; }
    /// Returns whether one is a face and the other an alternate of the same quad.
    bool areAlternatives(std::uint32_t f, std::uint32_t g) const
    {
        return isInQuad(f) && quadAt_[f] == quadAt_[g] && life_[f] != life_[g];
    }
    /// Returns the alternates of the quad that a face belongs to.
    const std::array<std::uint32_t, 2>& alternatesIn(std::uint32_t face) const
    {
        return quads_[quadAt_[face]].alternates;
    }
    /// Returns the weight of a face or an alternate in a sum over the surface: 0.5 if it belongs to a quad.
    double weight(std::uint32_t f) const { return isInQuad(f) ? 0.5 : 1; }
    const FaceList& alternatesOf(std::uint32_t v) const
    {
        return alternatesOf_.empty() ? noAlternates_ : alternatesOf_[v];
    }

    /// Lets a face cut the model, or no longer. A surface with such faces does not bound yet: all changes are allowed
    /// that the model alone would forbid there.
    void letCut(std::uint32_t face, bool may);
    bool mayCut(std::uint32_t face) const { return face < mayCut_.size() && mayCut_[face] != 0; }

    /// Keeps a vertex within a limit: no change is allowed that takes it elsewhere or removes it.
    /// \pre the vertex is within
    void limit(std::uint32_t v, const MoveLimit& limit);
    /// Returns the limit of a vertex; null if it has none.
    const MoveLimit* limitOf(std::uint32_t v) const
    {
        return v < limits_.size() && limits_[v] ? &*limits_[v] : nullptr;
    }

    /// Returns the live triangles and quads, in order, without unused points, then the mirror image of them all.
    Mesh mesh() const;
    const GuardModel& guard() const { return guard_; }
    /// Returns where the faces should go.
    const Wishes& wishes() const { return wishesOf(wishes_); }

private:
    /// Keeps the faces beyond the plane; returns the number of the first half of a quad among them.
    std::uint32_t takeHalf(std::uint32_t firstOfQuads);
    bool isManifoldAt(std::uint32_t v) const;
    void reconnect(const StarChange& star);

    enum Life : char { dead, live, alternate };
    struct Quad {
        std::array<std::uint32_t, 2> faces, alternates;
    };

    std::reference_wrapper<const GuardModel> guard_;
    FaceWishes wishes_;
    std::vector<Vec3d> points_;
    std::vector<Vec3I> faces_;
    std::vector<char> life_;
    std::vector<FaceList> facesOf_;      // by vertex
    std::vector<FaceList> alternatesOf_; // by vertex; empty until there is a quad
    FaceList noAlternates_;              // stays empty
    std::size_t liveFaces_ = 0;
    double leastQuadCosine_ = 0;
    std::vector<Quad> quads_;
    std::vector<std::uint32_t> freeQuads_;         // of quads_, not in use
    std::vector<std::uint32_t> quadAt_;            // by face: of quads_, or none
    std::vector<char> mayCut_;                     // by face; faces beyond its end may not
    std::vector<std::optional<MoveLimit>> limits_; // by vertex; vertices beyond its end have none
    DynamicBvh tree_;
};

} // namespace vdbcage::detail
