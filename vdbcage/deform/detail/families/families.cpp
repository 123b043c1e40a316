// The list of all families. Each is defined in its own file of this folder.

#include <cstddef>
#include <iterator>

#include <vdbcage/deform/detail/coordinate_family.h>

namespace vdbcage::detail {

extern const CoordinateFamily meanValue, green, maximumLikelihood, harmonic, biharmonic, somigliana;

namespace {

constexpr FamilyInfo givenInfo{Coordinates::given,      "given", "given", "Weights", "weights from a file", "",
                               /*isEverywhere*/ true,
                               /*splitsQuads*/ false,
                               /*hasResolution*/ false,
                               /*hasElasticity*/ false};

/// Weights made elsewhere: they have handles, but no rows.
constexpr CoordinateFamily given{givenInfo, nullptr};

/// The families in the order of Coordinates.
constexpr const CoordinateFamily* families[]{&meanValue,  &green, &maximumLikelihood, &harmonic, &biharmonic,
                                             &somigliana, &given};
static_assert(std::size(families) == static_cast<std::size_t>(Coordinates::given) + 1);

} // namespace

const CoordinateFamily& coordinateFamily(Coordinates family)
{
    return *families[static_cast<std::size_t>(family)];
}

} // namespace vdbcage::detail
