#pragma once

#include <cstdint>
#include <functional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/bounding/detail/guard/admissible.h>

namespace vdbcage::detail {

/// The change of some quantity when a star's centre moves by d: about d curvature d / 2 + slope d.
struct Quadratic {
    openvdb::Mat3d curvature = openvdb::Mat3d::zero();
    Vec3d slope{0.0};
};

/// A cost of the places of vertices other than the distance, such as the shape of quads.
class ShapeTerm {
public:
    virtual ~ShapeTerm() = default;
    /// Returns the sum of the cost's terms that depend on the star's centre, with the centre at `centre`. Adds its
    /// change to `change` (Gauss-Newton).
    virtual double add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
                       Quadratic& change) const = 0;
    /// Returns whether faces that are fit stay so when the star's centre moves to `centre`.
    virtual bool keepsFit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre) const = 0;
};

/// The limits of a centre's step.
struct StepLimit {
    double radius;       ///< of the star; no step is longer than half of it
    double share = 1;    ///< of the way to the best allowed place; less than 1 leaves room for the neighbours
    double least = 1e-3; ///< no step is shorter than this part of `radius`
};

/// Looks for a place of the star's centre where `change` is negative. Returns whether there was one.
///
/// It slides along the planes of the contacts that it meets. The first place that the guard allows and for which
/// accepts(place) is true becomes `p`.
/// \pre the centre is allowed at `p`
bool descend(const GuardedMesh& surface, const StarChange& star, Vec3d& p, const Quadratic& change,
             const StepLimit& limit, const std::function<bool(const Vec3d&)>& accepts);

/// The integral of the distance to the model over triangles, by sampling. Where the surface's wishes have a density,
/// distance counts for more or less.
///
/// A triangle is cut into k x k equal ones, each sampled at its centroid. k grows with the triangle's size.
class DistanceMeasure {
public:
    /// `areaPerSample` is in the guard's units, squared. If `shape` is given, fit() and improve() add it.
    /// The guard and the wishes of `surface`, and `shape`, must outlive this.
    DistanceMeasure(const GuardedMesh& surface, double areaPerSample, const ShapeTerm* shape = nullptr)
        : guard_(surface.guard()), wishes_(surface.wishes()), areaPerSample_(areaPerSample), shape_(shape)
    {
    }

    /// Returns the integral over a triangle. `seed` is an item of the model near it, or TriangleBvh::none, and becomes
    /// a nearer one.
    double integral(const Corners& t, std::uint32_t& seed) const;

    /// The integral over a star, and its change when the centre moves. Distances are to the point that is nearest to
    /// each sample now.
    struct Fit {
        double integral = 0;
        Quadratic change;
        double radius = 0; ///< of the star: the length of the longest edge at the centre
    };
    Fit fit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre, std::uint32_t& seed) const;

    /// The limits of a step and its least gain. `share` and `least` are as in StepLimit.
    struct Pace {
        double share = 1;
        double least = 1e-3;
        double gain = 1e-3; ///< of the integral, at least
    };
    /// Moves the centre of a star to where the integral is less. Returns whether there was such a place; `p` and `fit`
    /// are then those of the new one.
    /// \pre the centre is allowed at `p`, and `fit` is of that place
    bool improve(const GuardedMesh& surface, const StarChange& star, Vec3d& p, Fit& fit, std::uint32_t& seed,
                 const Pace& pace) const;

private:
    template <typename Visit>
    void forEachSample(const Corners& t, std::uint32_t& seed, const Visit& visit) const;

    const GuardModel& guard_;
    const Wishes& wishes_;
    double areaPerSample_;
    const ShapeTerm* shape_;
};

} // namespace vdbcage::detail
