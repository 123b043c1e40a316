#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The number of self-intersections at which counting ends. n faces have up to n^2 / 2, which would take hours.
constexpr std::size_t mostSelfIntersections = 1'000'000;

/// The verdict on a cage. Yes/no answers and counts are exact on the coordinates given; measures are rounded.
///
/// A quad stands for all four triangles of its two diagonals: a defect under one of them counts. All sets are closed: a
/// touch is a contact. Points are the same only if their index is, so two at one place touch. Faces are numbered
/// triangles first, then quads.
struct CageCheck {
    /// \name The cage alone
    /// \{

    std::size_t points = 0;              ///< all of its points, also those that no face uses
    std::size_t triangles = 0;           ///< its triangles, degenerate ones too
    std::size_t quads = 0;               ///< its quads, degenerate ones too
    std::size_t components = 0;          ///< connected over edges
    long genus = 0;                      ///< sum over the components; only meaningful if closed and manifold
    std::size_t boundaryEdges = 0;       ///< edges with one face
    std::size_t nonManifoldEdges = 0;    ///< edges with more than two faces
    std::size_t nonManifoldVertices = 0; ///< vertices whose faces form more than one umbrella
    std::size_t misorientedEdges = 0;    ///< edges whose two faces run along them in the same direction
    /// Components whose volume is not positive for some choice of diagonals. Those with a boundary or a misoriented
    /// edge have no volume and are not counted.
    std::size_t inwardComponents = 0;
    std::size_t degenerateFaces = 0; ///< faces with a repeated corner or a triangle of zero area
    /// Pairs of faces that meet in more than the corners and edges they share, and quads folded over a diagonal.
    /// Degenerate triangles are not tested. At most `mostSelfIntersections`, which then stands for as many or more.
    /// `badFaces` has the faces of all of them.
    std::size_t selfIntersections = 0;
    /// \}

    /// \name The cage against the model
    /// \{

    std::size_t contactFaces = 0; ///< cage faces that touch or cross the model
    /// Model vertices (used by faces) not strictly inside: they lie on the cage, or their winding number is not 1 for
    /// every choice of diagonals. All of them if the cage has no inside (see MeshTopology::isCycle).
    std::size_t modelVerticesOutside = 0;
    std::size_t loosePoints = 0;         ///< model points that no face uses: bounding() does not depend on them
    std::size_t loosePointsOutside = 0;  ///< those of them that are not strictly inside
    std::vector<std::uint32_t> badFaces; ///< sorted: cage faces in a self-intersection or contact, degenerate, folded,
                                         ///< or with a model vertex between the two diagonals of the quad
    /// \}

    /// \name Measures
    /// Lengths are fractions of the longest side of the model's bounding box.
    /// \{

    double longestSide = 0;     ///< of the model's bounding box, world units: the unit of the others
    double diagonal = 0;        ///< of the model's bounding box: 1 to the root of 3; 0 if the model is one point
    double meanDistance = 0;    ///< from the cage to the model under every split of its faces, over an even sample
    double maxDistance = 0;     ///< the largest distance of these samples and of the cage's corners
    double minDistance = 0;     ///< the smallest distance of them (sampled, not exact)
    double cageVolume = 0;      ///< in world units cubed, the mean over the diagonals; 0 if the cage has no inside
    double volumeRatio = 0;     ///< cage volume / model volume; 0 if the model or the cage has no inside
    double minAngleDegrees = 0; ///< the smallest triangle angle (quads: under both diagonals)
    double angle1stPercentileDegrees = 0; ///< 1 % of these angles are smaller
    double medianAngleDegrees = 0;        ///< half of these angles are smaller
    /// \}

    /// Returns whether there are faces, and no edge has only one.
    bool closed() const { return triangles + quads > 0 && boundaryEdges == 0; }
    /// Returns whether no edge has more than two faces, and the faces of each vertex form one umbrella.
    bool manifold() const { return nonManifoldEdges == 0 && nonManifoldVertices == 0; }
    /// Returns whether neighbouring faces agree on their orientation, and all components face outward.
    bool oriented() const { return misorientedEdges == 0 && inwardComponents == 0; }
    /// Returns whether it is a cage at all: closed, 2-manifold, facing outward, without degenerate faces and
    /// self-intersections.
    bool valid() const
    {
        return closed() && manifold() && oriented() && degenerateFaces == 0 && selfIntersections == 0;
    }
    /// Returns whether it is a valid cage that strictly bounds the model: no contact, every vertex of the model inside.
    bool bounding() const { return valid() && contactFaces == 0 && modelVerticesOutside == 0; }
};

/// The options of a check.
struct CheckOptions {
    bool asFloats = false; ///< examine both meshes with their points rounded to float (only the cage's measures)
    bool measure = true;   ///< fill in the measures too (distances cost the most)
    /// Points on the cage for the distances, beside its corners. With 0 there is no mean, and the others are of
    /// corners.
    std::size_t samples = 20000;
};

/// A checker of cages against one model, which is examined once. Copies share all that was found out. Any number of
/// threads may check at the same time.
class VDBCAGE_API CageChecker {
public:
    /// Examines a model. Its degenerate faces count as the segments or points that they are.
    /// \param model any polygon soup with a face; it need not outlive the checker
    /// \param interrupter asked whether to stop; may be null
    /// \throw InputError when there are no faces, an index is out of range, or a point of a face is not finite
    /// \throw Cancelled when the interrupter asks to stop
    /// Cost: O(m log m) for m faces of the model, in parallel.
    explicit CageChecker(const Mesh& model, Interrupter* interrupter = nullptr);

    /// Examines a cage; never throws for a bad one. Exact predicates (CGAL's filtered kernel) decide every yes/no. The
    /// verdict is the same for any number of threads.
    /// \param cage any polygon soup, also without faces
    /// \param options for floats, measures and samples
    /// \param interrupter asked whether to stop; may be null
    /// \throw InputError when an index is out of range, or a point of a face is not finite; with `asFloats` also when
    /// one is not finite as a float, or the model is beyond the range of float
    /// \throw Cancelled when the interrupter asks to stop
    /// Cost: O(n log m) for ordinary meshes of n faces, m of the model, in parallel.
    CageCheck check(const Mesh& cage, const CheckOptions& options = {}, Interrupter* interrupter = nullptr) const;

    /// Returns the number of hollows that the model has by its own surface: components that face inward, inside of
    /// others. A cage has no inner surface, so they are solid to it. Only components that are cycles (see MeshTopology)
    /// count.
    std::size_t hollows() const;

private:
    class Model;
    std::shared_ptr<const Model> model_;
};

/// Checks a single cage, in one step: `CageChecker(model).check(cage, options)`.
/// \param cage as for CageChecker::check()
/// \param model as for CageChecker
/// \param options as for CageChecker::check()
/// \param interrupter asked whether to stop; may be null
/// \throw InputError as CageChecker
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API CageCheck checkCage(const Mesh& cage, const Mesh& model, const CheckOptions& options = {},
                                Interrupter* interrupter = nullptr);

} // namespace vdbcage
