#pragma once

#include <openvdb/openvdb.h>

/// OpenVDB's grids in full, for files that use their content. The two kinds that vdbcage makes are compiled once, in
/// grids.cpp. Otherwise every file that makes a grid would compile their virtual functions, about a hundred, again.
namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {

extern template class tree::Tree<FloatTree::RootNodeType>;
extern template class tree::Tree<MaskTree::RootNodeType>;
extern template class Grid<FloatTree>;
extern template class Grid<MaskTree>;

} // namespace OPENVDB_VERSION_NAME
} // namespace openvdb
