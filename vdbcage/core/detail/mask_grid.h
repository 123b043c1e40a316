#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include <vdbcage/core/detail/grids.h>

namespace vdbcage::detail {

// Where memory is lacking, OpenVDB's own trees end the program, since their destructor allocates; and a copy that
// fails leaks the part it has copied. These functions make the trees of vdbcage.

/// Returns an empty tree, whose deleter allocates no memory.
template <typename Tree>
std::shared_ptr<Tree> emptyTree(const typename Tree::ValueType& background)
{
    const auto giveBack = [](Tree* tree) {
        tree->root().clear();
        delete tree;
    };
    return {new Tree(background), giveBack};
}

/// Returns a tree whose active voxels are those of `source`, with the value `on`; all others have `off`.
template <typename Tree, typename Source>
std::shared_ptr<Tree> treeLike(const Source& source, const typename Tree::ValueType& off,
                               const typename Tree::ValueType& on)
{
    const auto tree = emptyTree<Tree>(off);
    // Otherwise the root would leak a new child if there were no memory for its entry.
    for (auto child = source.root().cbeginChildOn(); child; ++child) tree->root().addTile(child.getCoord(), off, false);
    auto tile = source.cbeginValueOn();
    tile.setMaxDepth(Source::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) tree->addTile(tile.getLevel(), tile.getCoord(), on, true);
    openvdb::tree::ValueAccessor<Tree> accessor(*tree);
    for (auto leaf = source.cbeginLeaf(); leaf; ++leaf) {
        auto* const copy = accessor.touchLeaf(leaf->origin());
        copy->setValueMask(leaf->getValueMask());
        if constexpr (!std::is_same_v<typename Tree::ValueType, bool>) {
            for (auto voxel = copy->beginValueOn(); voxel; ++voxel) voxel.setValue(on);
        }
    }
    accessor.clear();
    tree->root().eraseBackgroundTiles();
    return tree;
}

/// Returns a mask tree with the active voxels of `source`.
template <typename Source>
openvdb::MaskTree::Ptr maskTreeLike(const Source& source)
{
    return treeLike<openvdb::MaskTree>(source, false, true);
}

/// Sets the transform of `grid` to a copy of that of `source`. Where voxels are smaller than about 1e-5 the grids share
/// it, since OpenVDB can read and write such a transform, but refuses to copy it.
inline void copyTransform(const openvdb::GridBase& source, openvdb::GridBase& grid)
{
    try {
        grid.setTransform(source.transform().copy());
    } catch (const openvdb::ArithmeticError&) {
        grid.setTransform(std::const_pointer_cast<openvdb::math::Transform>(source.constTransformPtr()));
    }
}

/// Returns a grid of `tree` with a copy of the transform of `source`, and no metadata.
inline openvdb::MaskGrid::Ptr maskGridLike(const openvdb::GridBase& source, openvdb::MaskTree::Ptr tree)
{
    auto grid = openvdb::MaskGrid::create(std::move(tree));
    copyTransform(source, *grid);
    return grid;
}

} // namespace vdbcage::detail
