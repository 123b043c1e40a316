#include <vdbcage/core/detail/grids.h>

namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {

template class tree::Tree<FloatTree::RootNodeType>;
template class tree::Tree<MaskTree::RootNodeType>;
template class Grid<FloatTree>;
template class Grid<MaskTree>;

} // namespace OPENVDB_VERSION_NAME
} // namespace openvdb
