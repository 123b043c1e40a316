// Based on: the file format of OpenVDB (Museth, VDB: High-Resolution Sparse Volumes with Dynamic Topology, ACM
// Transactions on Graphics 32(3), 2013), versions 222 to 225, as the headers of OpenVDB 10.0.1 and 13.0.0 describe it;
// c-blosc 1.21; zlib.
#include <vdbcage/volume/detail/vdb/vdb_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <sstream>
#include <utility>

#include <blosc.h>
#include <openvdb/io/Compression.h>
#include <zlib.h>

namespace vdbcage::detail {

namespace {

using openvdb::Coord;
using openvdb::GridBase;
using openvdb::Index;

constexpr std::uint32_t firstVersion = 222, lastVersion = 225;
constexpr char suffixSeparator = '\x1E'; // makes names of one file unique
constexpr std::string_view halfSuffix = "_HalfFloat", halfTree = "Tree_half_5_4_3";

/// The storage of a tree's values.
enum class Stored {
    asTheyAre,
    halfArrays, ///< arrays of nodes as half floats, single values unchanged
    halves,     ///< all as half floats: the half grids of OpenVDB 13, read as grids of floats
};

/// The data of a grid that the file has before the grid itself.
struct Descriptor {
    std::string uniqueName, type, parent; // parent: the unique name of the grid whose tree it shares, else empty
    Stored stored = Stored::asTheyAre;
    std::size_t begin = 0, end = 0; // of the grid, if the file has offsets

    std::string name() const { return uniqueName.substr(0, uniqueName.find(suffixSeparator)); }
};

Descriptor readDescriptor(ByteCursor& in)
{
    Descriptor result;
    result.uniqueName = in.string();
    result.type = in.string();
    result.parent = in.string();
    const std::size_t size = result.type.size();
    if (result.type == halfTree) {
        result.type = openvdb::FloatGrid::gridType();
        result.stored = Stored::halves;
    } else if (size > halfSuffix.size() && result.type.substr(size - halfSuffix.size()) == halfSuffix) {
        result.type.resize(size - halfSuffix.size());
        result.stored = Stored::halfArrays;
    }
    return result;
}

/// Reads the positions in the file after a descriptor, 0 where there are none.
void readOffsets(ByteCursor& in, Descriptor& descriptor, bool hasOffsets)
{
    const auto begin = in.value<std::int64_t>();
    in.value<std::int64_t>(); // the beginning of the leaf nodes' values
    const auto end = in.value<std::int64_t>();
    if (!hasOffsets) return;
    if (begin < static_cast<std::int64_t>(in.position()) || end < begin) {
        in.damaged("grid '" + shortened(descriptor.name()) + "' lies from byte " + std::to_string(begin) + " to " +
                   std::to_string(end));
    }
    in.take(static_cast<std::size_t>(end) - in.position());
    descriptor.begin = static_cast<std::size_t>(begin);
    descriptor.end = static_cast<std::size_t>(end);
}

// ---- Metadata

template <class Value>
bool insertIfOf(openvdb::MetaMap& map, const std::string& name, std::string_view type, std::string_view bytes)
{
    using Metadata = openvdb::TypedMetadata<Value>;
    if (type != Metadata::staticTypeName()) return false;
    if constexpr (std::is_same_v<Value, std::string>) {
        map.insertMeta(name, Metadata(std::string(bytes)));
    } else if constexpr (std::is_same_v<Value, bool>) {
        if (bytes.size() != 1) return false;
        map.insertMeta(name, Metadata(bytes[0] != 0));
    } else {
        if (bytes.size() != sizeof(Value)) return false;
        Value value;
        std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof(Value));
        map.insertMeta(name, Metadata(value));
    }
    return true;
}

template <class... Values>
bool insertIfOneOf(openvdb::MetaMap& map, const std::string& name, std::string_view type, std::string_view bytes)
{
    return (insertIfOf<Values>(map, name, type, bytes) || ...);
}

/// Reads metadata, without those of types that OpenVDB does not have and its tables for delayed loading.
openvdb::MetaMap readMetadata(ByteCursor& in)
{
    openvdb::MetaMap map;
    for (auto count = in.value<std::uint32_t>(); count-- > 0;) {
        const std::string name(in.string());
        const std::string_view type = in.string(), bytes = in.string();
        if (name.empty() || map[name]) in.damaged("metadata have no name or the same");
        insertIfOneOf<bool, float, double, std::int32_t, std::int64_t, std::string, openvdb::Vec2d, openvdb::Vec2i,
                      openvdb::Vec2s, openvdb::Vec3d, openvdb::Vec3i, openvdb::Vec3s, openvdb::Vec4d, openvdb::Vec4i,
                      openvdb::Vec4s, openvdb::Mat4s, openvdb::Mat4d>(map, name, type, bytes);
    }
    return map;
}

// ---- Transform

/// The numbers of a linear map: a matrix, or a translation followed by numbers that all depend on the scale.
struct MapLayout {
    const char* type;
    std::size_t translations, scales; // of three numbers each
    bool isMatrix;
};
constexpr std::array<MapLayout, 7> mapLayouts{{{"AffineMap", 0, 0, true},
                                               {"UnitaryMap", 0, 0, true},
                                               {"ScaleMap", 0, 5, false},
                                               {"UniformScaleMap", 0, 5, false},
                                               {"TranslationMap", 3, 0, false},
                                               {"ScaleTranslateMap", 3, 5, false},
                                               {"UniformScaleTranslateMap", 3, 5, false}}};

bool isNear(double a, double b)
{
    return std::abs(a - b) <= 1e-6 * std::abs(b);
}

/// Checks the numbers of a linear map of this type. OpenVDB reads the numbers that depend on the scale (voxel size,
/// inverse, its square and its half) instead of computing them, so they are checked.
void checkLinearMap(ByteCursor& in, std::string_view type)
{
    const auto* const layout = std::find_if(mapLayouts.begin(), mapLayouts.end(),
                                            [&](const MapLayout& candidate) { return type == candidate.type; });
    if (layout == mapLayouts.end()) in.damaged("its transform is a '" + shortened(type) + "', which is unknown");
    std::vector<double> numbers(layout->isMatrix ? 16 : layout->translations + 3 * layout->scales);
    bool isRight = true;
    for (double& number : numbers) {
        number = in.value<double>();
        isRight = isRight && std::isfinite(number);
    }
    if (layout->isMatrix) {
        for (std::size_t row = 0; row < 4; ++row) isRight = isRight && numbers[4 * row + 3] == (row == 3 ? 1.0 : 0.0);
    } else if (layout->scales > 0) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double* const n = &numbers[layout->translations + axis];
            isRight = isRight && isNear(n[3], std::abs(n[0])) && isNear(n[6], 1 / n[0]) &&
                      isNear(n[9], 1 / (n[0] * n[0])) && isNear(n[12], 0.5 / n[0]);
        }
    }
    if (!isRight) in.damaged("the numbers of its transform do not fit each other");
}

/// Reads a transform with OpenVDB, from bytes that are known to be right.
openvdb::math::Transform::Ptr readTransform(ByteCursor& in)
{
    const std::size_t begin = in.position();
    const std::string_view type = in.string();
    if (type == "NonlinearFrustumMap") {
        bool isRight = true;
        std::array<double, 8> numbers{}; // a box, the taper and the depth
        for (double& number : numbers) {
            number = in.value<double>();
            isRight = isRight && std::isfinite(number);
        }
        if (!isRight || numbers[6] == 0 || numbers[7] == 0) in.damaged("its transform is no frustum");
        checkLinearMap(in, in.string());
    } else {
        checkLinearMap(in, type);
    }
    std::istringstream stream{std::string(in.since(begin))};
    openvdb::io::setCurrentVersion(stream);
    const auto transform = openvdb::math::Transform::createLinearTransform();
    bool isRight = true;
    try {
        transform->read(stream);
        const openvdb::math::MapBase& map = *transform->baseMap();
        isRight = std::isfinite(map.determinant()) && map.determinant() != 0;
        for (int corner = 0; map.isLinear() && corner < 8; ++corner) { // of all of index space
            const openvdb::Vec3d index(corner & 1 ? 0x1p31 : -0x1p31, corner & 2 ? 0x1p31 : -0x1p31,
                                       corner & 4 ? 0x1p31 : -0x1p31);
            const openvdb::Vec3d world = map.applyMap(index);
            isRight = isRight && world.isFinite() && map.applyInverseMap(world).isFinite();
        }
    } catch (const openvdb::Exception&) {
        isRight = false;
    }
    if (!isRight) in.damaged("its transform cannot be inverted");
    return transform;
}

// ---- Trees

/// Reads the values of a node, which take `size` bytes. Compressed ones follow their length in the file; a length that
/// is not positive means that compression did not make the values smaller and they are stored unchanged.
void readChunk(ByteCursor& in, std::uint32_t compression, char* out, std::size_t size)
{
    const auto copy = [&] {
        const std::string_view bytes = in.take(size);
        std::copy(bytes.begin(), bytes.end(), out);
    };
    if ((compression & (openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ZIP)) == 0) return copy();
    const auto length = in.value<std::int64_t>();
    if (length == -static_cast<std::int64_t>(size)) return copy();
    if (length <= 0 || static_cast<std::uint64_t>(length) > size + BLOSC_MAX_OVERHEAD) {
        in.damaged("the length of a chunk of " + std::to_string(size) + " bytes is " + std::to_string(length));
    }
    const std::string_view bytes = in.take(static_cast<std::size_t>(length));
    std::size_t got = 0;
    if (compression & openvdb::io::COMPRESS_BLOSC) {
        if (blosc_cbuffer_validate(bytes.data(), bytes.size(), &got) != 0 || got != size ||
            blosc_decompress_ctx(bytes.data(), out, size, 1) != static_cast<int>(size)) {
            in.damaged("a chunk of " + std::to_string(size) + " bytes cannot be decompressed by Blosc");
        }
    } else {
        uLongf count = size;
        if (uncompress(reinterpret_cast<Bytef*>(out), &count, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()) != Z_OK ||
            count != size) {
            in.damaged("a chunk of " + std::to_string(size) + " bytes cannot be decompressed by zlib");
        }
    }
}

template <class Mask>
Mask readMask(ByteCursor& in)
{
    Mask mask;
    const std::string_view bytes = in.take(Mask::SIZE / 8);
    for (Index i = 0; i < Mask::SIZE / 64; ++i) {
        std::memcpy(&mask.template getWord<std::uint64_t>(i), bytes.data() + 8 * i, 8);
    }
    return mask;
}

template <class Tree>
class TreeReader {
public:
    TreeReader(ByteCursor& in, std::uint32_t compression, Stored stored)
        : in_(in), compression_(compression), stored_(stored), values_(new Value[Upper::NUM_VALUES])
    {
    }

    /// Reads a tree: the nodes first, each before those below it; then the values of all leaf nodes.
    typename Tree::Ptr read()
    {
        if (const auto count = in_.value<std::int32_t>(); count != 1) {
            in_.damaged("leaf nodes have " + std::to_string(count) + " buffers instead of one");
        }
        background_ = readValue();
        const auto tree = std::make_shared<Tree>(background_);
        const auto tiles = in_.value<std::uint32_t>(), children = in_.value<std::uint32_t>();
        for (std::uint32_t i = 0; i < tiles; ++i) {
            const Coord origin = readOrigin();
            const Value value = readValue();
            tree->root().addTile(origin, value, in_.flag("the state of a tile"));
        }
        for (std::uint32_t i = 0; i < children; ++i) {
            const Coord origin = readOrigin();
            tree->root().addChild(readNode<Upper>(origin).release());
        }
        for (auto leaf = tree->beginLeaf(); leaf; ++leaf) readBuffer(*leaf);
        return tree;
    }

private:
    using Value = typename Tree::ValueType;
    using Upper = typename Tree::RootNodeType::ChildNodeType;
    using Leaf = typename Tree::LeafNodeType;
    using Half = typename openvdb::io::RealToHalf<Value>::HalfT;

    Coord readCoord()
    {
        const auto x = in_.value<std::int32_t>(), y = in_.value<std::int32_t>(), z = in_.value<std::int32_t>();
        return {x, y, z};
    }

    /// Reads the origin of an entry of the root node.
    Coord readOrigin()
    {
        const Coord origin = readCoord();
        if ((origin & (static_cast<int>(Upper::DIM) - 1)) != Coord(0)) {
            in_.damaged("the origin of a node is not a multiple of " + std::to_string(Upper::DIM));
        }
        if (!origins_.insert(origin).second) in_.damaged("two nodes have the same origin");
        return origin;
    }

    Value readValue()
    {
        if constexpr (std::is_same_v<Value, bool>) {
            return in_.flag("a value");
        } else if (stored_ == Stored::halves) {
            return static_cast<Value>(static_cast<float>(in_.value<Half>()));
        } else {
            return in_.value<Value>();
        }
    }

    template <class Node>
    std::unique_ptr<Node> readNode(const Coord& origin)
    {
        if constexpr (Node::LEVEL == 0) {
            auto leaf = std::make_unique<Node>(openvdb::PartialCreate(), origin, background_);
            leaf->setValueMask(readMask<typename Node::NodeMaskType>(in_));
            return leaf;
        } else {
            using Mask = typename Node::NodeMaskType;
            const auto children = readMask<Mask>(in_), active = readMask<Mask>(in_);
            if (!(children & active).isOff()) in_.damaged("a tile is where a node is");
            readValues(values_.get(), active);
            auto node = std::make_unique<Node>(openvdb::PartialCreate(), origin, background_);
            for (Index i = 0; i < Node::NUM_VALUES; ++i) {
                if (children.isOff(i)) node->addTile(i, values_[i], active.isOn(i));
            }
            for (auto child = children.beginOn(); child; ++child) {
                node->addChild(
                    readNode<typename Node::ChildNodeType>(node->offsetToGlobalCoord(child.pos())).release());
            }
            return node;
        }
    }

    void readBuffer(Leaf& leaf)
    {
        using Mask = typename Leaf::NodeMaskType;
        using Build = typename Tree::BuildType;
        if (readMask<Mask>(in_) != leaf.getValueMask()) in_.damaged("the two masks of a leaf node differ");
        if constexpr (std::is_same_v<Value, bool>) {
            if (readCoord() != leaf.origin()) in_.damaged("the two origins of a leaf node differ");
            if constexpr (std::is_same_v<Build, bool>) {
                const auto values = readMask<Mask>(in_);
                for (Index i = 0; i < Mask::SIZE / 64; ++i) {
                    leaf.buffer().data()[i] = values.template getWord<std::uint64_t>(i);
                }
            }
        } else {
            leaf.allocate();
            readValues(leaf.buffer().data(), leaf.getValueMask());
        }
    }

    /// Reads all values of a node. Active values and one or two values of all inactive ones can stand for them.
    template <class Mask>
    void readValues(Value* out, const Mask& active)
    {
        using namespace openvdb::io;
        const auto code = in_.value<std::uint8_t>();
        if (code > NO_MASK_AND_ALL_VALS) in_.damaged("the code of a node's values is " + std::to_string(code));
        std::array<Value, 2> inactive{background_, background_};
        if (code != NO_MASK_OR_INACTIVE_VALS) inactive[0] = openvdb::math::negative(background_);
        const bool hasTwo = code == MASK_AND_TWO_INACTIVE_VALS, hasOne = code == MASK_AND_ONE_INACTIVE_VAL || hasTwo;
        if (hasOne || code == NO_MASK_AND_ONE_INACTIVE_VAL) inactive[0] = readValue();
        if (hasTwo) inactive[1] = readValue();
        Mask second;
        if (hasOne || code == MASK_AND_NO_INACTIVE_VALS) second = readMask<Mask>(in_);
        const bool activeOnly = (compression_ & COMPRESS_ACTIVE_MASK) && code != NO_MASK_AND_ALL_VALS;
        Index count = activeOnly ? active.countOn() : Mask::SIZE;
        readStored(out, count);
        if (!activeOnly) return;
        for (Index i = Mask::SIZE; i-- > 0;) out[i] = active.isOn(i) ? out[--count] : inactive[second.isOn(i)];
    }

    void readStored(Value* out, Index count)
    {
        const auto read = [&](auto* values) {
            readChunk(in_, compression_, reinterpret_cast<char*>(values), count * sizeof(*values));
        };
        if constexpr (std::is_same_v<Value, bool>) {
            read(out);
            const auto* const bytes = reinterpret_cast<const unsigned char*>(out);
            if (std::any_of(bytes, bytes + count, [](unsigned char byte) { return byte > 1; })) {
                in_.damaged("a value is neither 0 nor 1");
            }
        } else if (stored_ != Stored::asTheyAre) {
            if (count == 0 && stored_ == Stored::halfArrays) return; // not even the length of a chunk is there
            halves_.resize(count);
            read(halves_.data());
            std::transform(halves_.begin(), halves_.end(), out,
                           [](Half stored) { return static_cast<Value>(static_cast<float>(stored)); });
        } else {
            read(out);
        }
    }

    ByteCursor& in_;
    std::uint32_t compression_;
    Stored stored_;
    Value background_{};
    std::set<Coord> origins_;
    std::unique_ptr<Value[]> values_; // of an internal node
    std::vector<Half> halves_;
};

// ---- Grids

/// Calls make(static_cast<Grid*>(nullptr)) for the type of grid with this name. \return whether there is one
template <class Make>
bool forType(const std::string& type, const Make& make)
{
    const auto makeIf = [&](auto* none) {
        const bool isType = type == std::decay_t<decltype(*none)>::gridType();
        if (isType) make(none);
        return isType;
    };
    return makeIf(static_cast<openvdb::FloatGrid*>(nullptr)) || makeIf(static_cast<openvdb::DoubleGrid*>(nullptr)) ||
           makeIf(static_cast<openvdb::BoolGrid*>(nullptr)) || makeIf(static_cast<openvdb::MaskGrid*>(nullptr));
}

bool isReadable(const std::string& type)
{
    return forType(type, [](auto*) {});
}

/// Reads a grid. \return without a tree if the descriptor names another grid whose tree it shares
GridBase::Ptr readGrid(ByteCursor& in, const Descriptor& descriptor)
{
    constexpr std::uint32_t known =
        openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC;
    const auto compression = in.value<std::uint32_t>();
    if (compression & ~known) in.damaged("its compression is " + std::to_string(compression));
    const openvdb::MetaMap metadata = readMetadata(in);
    const auto saved = metadata[GridBase::META_SAVE_HALF_FLOAT];
    if ((saved && saved->asBool()) != (descriptor.stored == Stored::halfArrays)) {
        in.damaged("it is said to be both of half floats and not");
    }
    const auto transform = readTransform(in);
    GridBase::Ptr result;
    forType(descriptor.type, [&](auto* none) {
        using Grid = std::decay_t<decltype(*none)>;
        result = descriptor.parent.empty()
                     ? Grid::create(TreeReader<typename Grid::TreeType>(in, compression, descriptor.stored).read())
                     : Grid::create();
    });
    result->insertMeta(metadata);
    result->setTransform(transform);
    return result;
}

class FileReader {
public:
    FileReader(ByteCursor in, const std::string& wanted, VdbValues values) : in_(in), wanted_(wanted), values_(values)
    {
        if (in_.value<std::int64_t>() != openvdb::OPENVDB_MAGIC) in_.refuse("is not a .vdb file, or is truncated");
    }

    GridBase::Ptr read()
    {
        const auto version = in_.value<std::uint32_t>();
        if (version < firstVersion || version > lastVersion) {
            in_.refuse("is of version " + std::to_string(version) + " of the .vdb format; " +
                       std::to_string(firstVersion) + " to " + std::to_string(lastVersion) + " can be read");
        }
        in_.take(2 * sizeof(std::uint32_t)); // the version of the library
        const bool hasOffsets = in_.flag("what tells whether there are offsets");
        in_.take(36); // a UUID
        readMetadata(in_);
        const auto count = in_.value<std::int32_t>();
        if (count < 0) in_.damaged("there are " + std::to_string(count) + " grids");
        return hasOffsets ? readByOffsets(count) : readInOrder(count);
    }

private:
    GridBase::Ptr readByOffsets(std::int32_t count)
    {
        std::vector<Descriptor> descriptors;
        for (std::int32_t i = 0; i < count; ++i) {
            descriptors.push_back(readDescriptor(in_));
            readOffsets(in_, descriptors.back(), true);
        }
        const Descriptor& chosen = choose(descriptors);
        const GridBase::Ptr grid = readPart(chosen);
        if (chosen.parent.empty()) return grid;
        const auto parent = std::find_if(descriptors.begin(), descriptors.end(),
                                         [&](const Descriptor& other) { return isParent(other, chosen); });
        if (parent == descriptors.end()) refuseForParent(chosen);
        grid->setTree(readPart(*parent)->baseTreePtr());
        return grid;
    }

    /// Reads all grids up to the wanted one.
    GridBase::Ptr readInOrder(std::int32_t count)
    {
        std::vector<Descriptor> descriptors;
        std::vector<GridBase::Ptr> grids;
        for (std::int32_t i = 0; i < count; ++i) {
            descriptors.push_back(readDescriptor(in_));
            const Descriptor& descriptor = descriptors.back();
            readOffsets(in_, descriptors.back(), false);
            const bool isWanted = count == 1 || descriptor.name() == wanted_;
            if (isWanted) requireType(descriptor);
            if (!isReadable(descriptor.type)) {
                in_.refuse("grid '" + shortened(descriptor.name()) + "' of type " + shortened(descriptor.type) +
                           " cannot be passed by: the file was streamed and has no offsets");
            }
            grids.push_back(readGrid(in_, descriptor));
            if (!isWanted) continue;
            if (descriptor.parent.empty()) return grids.back();
            for (std::size_t j = 0; j + 1 < grids.size(); ++j) {
                if (!isParent(descriptors[j], descriptor)) continue;
                grids.back()->setTree(grids[j]->baseTreePtr());
                return grids.back();
            }
            refuseForParent(descriptor);
        }
        choose(descriptors);
        return nullptr; // never: the chosen one was returned
    }

    GridBase::Ptr readPart(const Descriptor& descriptor) const
    {
        ByteCursor in = in_.part(descriptor.begin, descriptor.end);
        GridBase::Ptr result = readGrid(in, descriptor);
        if (in.left() > 0) in.damaged("a grid ends " + std::to_string(in.left()) + " bytes before its end");
        return result;
    }

    /// Returns whether `child` shares the tree of `parent`: a shared tree was written with the first of its grids.
    static bool isParent(const Descriptor& parent, const Descriptor& child)
    {
        return parent.uniqueName == child.parent && parent.parent.empty() && parent.type == child.type;
    }

    [[noreturn]] void refuseForParent(const Descriptor& descriptor) const
    {
        in_.damaged("grid '" + shortened(descriptor.name()) + "' shares the tree of '" + shortened(descriptor.parent) +
                    "', which has none like it");
    }

    const Descriptor& choose(const std::vector<Descriptor>& descriptors) const
    {
        constexpr std::size_t listed = 16;
        std::string names;
        for (const Descriptor& descriptor : descriptors) {
            if (descriptors.size() == 1 || descriptor.name() == wanted_) {
                requireType(descriptor);
                return descriptor;
            }
            const auto number = static_cast<std::size_t>(&descriptor - descriptors.data());
            if (number < listed) names += (number == 0 ? "" : ", ") + shortened(descriptor.name());
            if (number == listed) names += ", ...";
        }
        if (descriptors.empty()) in_.refuse("holds no grid");
        in_.refuse("holds several grids but none named " + shortened(wanted_) + ": " + names);
    }

    void requireType(const Descriptor& descriptor) const
    {
        const bool isFloat = descriptor.type == openvdb::FloatGrid::gridType();
        if (values_ == VdbValues::floats ? isFloat : isReadable(descriptor.type)) return;
        // such as Tree_vec3s_5_4_3
        const std::string_view prefix = "Tree_", levels = "_5_4_3";
        std::string_view held = descriptor.type;
        if (held.size() <= prefix.size() + levels.size() || held.substr(0, prefix.size()) != prefix ||
            held.substr(held.size() - levels.size()) != levels) {
            in_.refuse("grid '" + shortened(descriptor.name()) + "' is of type '" + shortened(held) +
                       "'; a tree of levels 5, 4 and 3 is needed");
        }
        held = held.substr(prefix.size(), held.size() - prefix.size() - levels.size());
        in_.refuse("grid '" + shortened(descriptor.name()) + "' holds " + shortened(held) + " values; " +
                   (values_ == VdbValues::floats ? "float" : "float, double, bool or mask") + " is needed");
    }

    ByteCursor in_;
    const std::string& wanted_;
    VdbValues values_;
};

} // namespace

openvdb::GridBase::Ptr parseVdb(std::string_view bytes, const std::string& name, const std::string& wanted,
                                VdbValues values, std::vector<ByteField>* fields)
{
    return FileReader(ByteCursor(bytes, name, fields), wanted, values).read();
}

std::string shortened(std::string_view name)
{
    constexpr std::size_t most = 80;
    return std::string(name.substr(0, most)) + (name.size() > most ? "..." : "");
}

} // namespace vdbcage::detail
