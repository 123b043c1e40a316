#include <vdbcage/pipeline/detail/certifier.h>

#include <vdbcage/core/detail/nearest_float.h>

namespace vdbcage::detail {

Certifier::Certifier(const Mesh& model) : model_(model), fitsFloat_(detail::fitsFloat(boundingBox(model)))
{
}

CageCheck Certifier::check(const Mesh& cage, Interrupter* interrupter)
{
    const Stage stage(interrupter, "certify");
    return checker(interrupter).check(cage, {}, interrupter);
}

bool Certifier::boundsAsFloats(const Mesh& cage, Interrupter* interrupter)
{
    if (!fitsFloat_) return true;
    const Stage stage(interrupter, "certify");
    CheckOptions options;
    options.asFloats = true;
    options.measure = false;
    return checker(interrupter).check(cage, options, interrupter).bounding();
}

Mesh Certifier::rounded(Mesh mesh) const
{
    if (fitsFloat_) {
        for (openvdb::Vec3d& point : mesh.points) point = nearestFloat(point);
    }
    return mesh;
}

const CageChecker& Certifier::checker(Interrupter* interrupter)
{
    if (!checker_) checker_ = std::make_unique<const CageChecker>(model_, interrupter);
    return *checker_;
}

} // namespace vdbcage::detail
