#include <vdbcage/deform/coordinates.h>

#include <algorithm>

#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/coordinate_family.h>
#include <vdbcage/deform/detail/point_checks.h>
#include <vdbcage/deform/detail/row_maker.h>

namespace vdbcage {

using openvdb::Vec3d;

namespace {

template <typename Number>
std::vector<Number> computeRows(const Mesh& cage, const std::vector<Vec3d>& points, const CoordinateOptions& options,
                                Interrupter* interrupter)
{
    const Stage stage(interrupter, StageName::bind);
    detail::RowMaker maker(cage, points, options, interrupter);
    std::vector<Number> rows;
    const std::size_t count = points.size() * maker.columns();
    rows.reserve(count);
    while (rows.size() < count) { // allocating gigabytes takes seconds
        throwIfInterrupted(interrupter);
        rows.resize(std::min(count, rows.size() + (1U << 22)));
    }
    maker.make(nullptr, points.size(), rows.data());
    maker.requireDefined();
    return rows;
}

} // namespace

std::string detail::familyNames()
{
    return joined(coordinateFamilies(), ", ", [](const FamilyInfo& family) { return family.name; });
}

const std::vector<FamilyInfo>& coordinateFamilies()
{
    static const std::vector<FamilyInfo> computable = [] {
        std::vector<FamilyInfo> list;
        for (std::size_t i = 0; i < static_cast<std::size_t>(Coordinates::given); ++i) {
            list.push_back(familyInfo(static_cast<Coordinates>(i)));
        }
        return list;
    }();
    return computable;
}

const FamilyInfo& familyInfo(Coordinates family)
{
    return detail::coordinateFamily(family).info;
}

const char* coordinatesName(Coordinates family)
{
    return familyInfo(family).name;
}

void requireElasticity(const Elasticity& elasticity)
{
    if (!(elasticity.nu > -1 && elasticity.nu < 0.5)) {
        throw InputError("nu",
                         detail::numberText(elasticity.nu) + " is not allowed; it must be above -1 and below 0.5");
    }
    requireWithin(Elasticity::bulgings, elasticity.localBulging, "local bulging");
    requireWithin(Elasticity::bulgings, elasticity.globalBulging, "global bulging");
}

const char* rotationsName(Elasticity::Rotations rotations)
{
    return rotations == Elasticity::Rotations::global ? "global" : "local";
}

Elasticity::Rotations rotationsNamed(const std::string& name)
{
    for (const auto rotations : {Elasticity::Rotations::global, Elasticity::Rotations::local}) {
        if (name == rotationsName(rotations)) return rotations;
    }
    throw InputError("rotations", "'" + name + "' is not allowed; it must be global or local");
}

LoosePoints::Motion looseMotionNamed(const std::string& name)
{
    if (name == "ride") return LoosePoints::Motion::ride;
    if (name == "stay") return LoosePoints::Motion::stay;
    throw InputError("loose points", "'" + name + "' is not allowed; it must be ride or stay");
}

bool Elasticity::operator==(const Elasticity& other) const
{
    return nu == other.nu && rotations == other.rotations && localBulging == other.localBulging &&
           globalBulging == other.globalBulging;
}

Coordinates coordinatesNamed(const std::string& name)
{
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (name == family.name || name == family.nameOnQuads) return family.family;
    }
    throw InputError("coordinates", "'" + name + "' is not a family; there are " + detail::familyNames());
}

std::size_t handleCount(const Mesh& cage, Coordinates family)
{
    const detail::VectorHandles& vectors = detail::coordinateFamily(family).vectors;
    return cage.points.size() + vectors.perTriangle * cage.triangles.size() + vectors.perQuad * cage.quads.size();
}

std::vector<Vec3d> cageHandles(const Mesh& cage, const std::vector<Vec3d>& posed, const CoordinateOptions& options)
{
    detail::requireCount("posed cage", posed.size(), cage.points.size(), "the cage");
    detail::requireFinite(posed, "posed cage");
    std::vector<Vec3d> handles = posed;
    handles.reserve(handleCount(cage, options.family));
    const detail::VectorHandles& vectors = detail::coordinateFamily(options.family).vectors;
    if (vectors.add != nullptr) vectors.add(cage, posed, options, handles);
    return handles;
}

std::vector<double> computeCoordinates(const Mesh& cage, const std::vector<Vec3d>& points,
                                       const CoordinateOptions& options, Interrupter* interrupter)
{
    return computeRows<double>(cage, points, options, interrupter);
}

std::vector<float> computeWeights(const Mesh& cage, const std::vector<Vec3d>& points, const CoordinateOptions& options,
                                  Interrupter* interrupter)
{
    return computeRows<float>(cage, points, options, interrupter);
}

} // namespace vdbcage
