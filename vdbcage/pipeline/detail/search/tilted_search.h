#pragma once

#include <optional>

#include <vdbcage/mesh/symmetry.h>
#include <vdbcage/pipeline/detail/search/bounding_search.h>

namespace vdbcage::detail {

/// The search for a cage that is symmetric in a plane of any direction. It turns the model so that the plane lies
/// across x, and turns the cage back.
///
/// Turning rounds, so the cage is symmetric except for the rounding of its coordinates.
class TiltedSearch {
public:
    /// `certifier` is of `model`, which is not turned, and must outlive this.
    TiltedSearch(const Mesh& model, const TiltedSymmetry& plane, Certifier& certifier);

    /// Returns a symmetric cage, certified after it was turned back; nothing if there is none with so few faces.
    /// \pre the options have no field that varies in space
    /// \throw InputError as Pipeline::run
    /// \throw MemoryError
    /// \throw DeviceError
    /// \throw Cancelled
    std::optional<Candidate> run(const CageOptions& options, std::size_t memoryLimit, Interrupter* interrupter);

    const TiltedSymmetry& plane() const { return plane_; }

private:
    Mesh turnedBack(Mesh mesh) const;
    std::shared_ptr<const openvdb::MaskGrid> turnedBack(const openvdb::MaskGrid& mask) const;

    const TiltedSymmetry plane_;
    Certifier& certifier_;
    openvdb::Mat3d rotation_;
    Mesh turned_;
    Volumes volumes_{turned_};
    Certifier turnedCertifier_{turned_};
    BoundingSearch search_;
};

} // namespace vdbcage::detail
