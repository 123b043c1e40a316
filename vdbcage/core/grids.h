#pragma once

#include <openvdb/Types.h>

/// \file
/// The names of OpenVDB's grids. Code that looks into one includes <openvdb/openvdb.h>, which takes seconds to compile.

/// \cond
namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {

namespace tree {
template <typename Value, Index log2Size>
class LeafNode;
template <typename Child, Index log2Size>
class InternalNode;
template <typename Child>
class RootNode;
template <typename Root>
class Tree;
} // namespace tree
template <typename Tree>
class Grid;

using BoolTree = tree::Tree<tree::RootNode<tree::InternalNode<tree::InternalNode<tree::LeafNode<bool, 3>, 4>, 5>>>;
using FloatTree = tree::Tree<tree::RootNode<tree::InternalNode<tree::InternalNode<tree::LeafNode<float, 3>, 4>, 5>>>;
using MaskTree = tree::Tree<tree::RootNode<tree::InternalNode<tree::InternalNode<tree::LeafNode<ValueMask, 3>, 4>, 5>>>;
using BoolGrid = Grid<BoolTree>;
using FloatGrid = Grid<FloatTree>;
using MaskGrid = Grid<MaskTree>;

} // namespace OPENVDB_VERSION_NAME
} // namespace openvdb
/// \endcond
