#include <vdbcage/pipeline/detail/stages/certifier.h>

#include <utility>

namespace vdbcage::detail {

Certifier::Certifier(const Mesh& model) : model_(model), box_(boundingBox(model))
{
}

CageCheck Certifier::check(const Mesh& cage, Interrupter* interrupter)
{
    const Stage stage(interrupter, StageName::certify);
    return checker(interrupter).check(cage, {}, interrupter);
}

bool Certifier::boundsAsFloats(const Mesh& cage, Precision precision, Interrupter* interrupter)
{
    if (!areFloats(precision)) return true;
    const Stage stage(interrupter, StageName::certify);
    CheckOptions options;
    options.asFloats = true;
    options.measure = false;
    return checker(interrupter).check(cage, options, interrupter).bounding();
}

Mesh Certifier::rounded(Mesh mesh, Precision precision) const
{
    return areFloats(precision) ? asFloats(std::move(mesh)) : mesh;
}

const CageChecker& Certifier::checker(Interrupter* interrupter)
{
    if (!checker_) checker_ = std::make_unique<const CageChecker>(model_, interrupter);
    return *checker_;
}

} // namespace vdbcage::detail
