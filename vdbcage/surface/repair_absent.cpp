// Replaces repair.cpp in builds without CGAL's GPL packages.

#include <vdbcage/core/error.h>
#include <vdbcage/surface/repair.h>

namespace vdbcage {

bool hasRepair()
{
    return false;
}

RepairedCage repair(const Mesh& /*cage*/, Interrupter* /*interrupter*/)
{
    throw InputError("repair", "this build was made without VDBCAGE_WITH_CGAL_GPL and has none");
}

} // namespace vdbcage
