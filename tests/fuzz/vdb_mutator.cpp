// What fuzz_read_vdb is called with: files that OpenVDB wrote, changed where the reader finds values in them, so that
// mutants get deep. Without a corpus the first ones are made here.

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <vdbcage/core/error.h>
#include <volume/vdb_samples.h>

using namespace vdbcage;
using detail::ByteField;
using openvdb::Coord;
using openvdb::GridBase;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

/// Where the reader finds values, as far as it gets.
std::vector<ByteField> fieldsOf(const std::string& bytes)
{
    std::vector<ByteField> fields;
    try {
        detail::parseVdb(bytes, "mutant", "density", detail::VdbValues::scalars, &fields);
    } catch (const IoError&) {
    }
    return fields;
}

template <class Grid>
GridBase::Ptr randomGrid(std::mt19937& random)
{
    using Value = typename Grid::ValueType;
    const auto value = [&] { return static_cast<Value>(static_cast<int>(random() % 7) - 3); };
    auto grid = Grid::create(random() % 2 ? Value(0) : value());
    auto& tree = grid->tree();
    for (unsigned i = random() % 4; i > 0; --i) {
        auto* const leaf = tree.touchLeaf(Coord(static_cast<int>(random() % 256), 0, 0));
        const unsigned kinds = 1 + random() % 4; // of inactive values
        for (openvdb::Index n = 0; n < leaf->SIZE; ++n) {
            if (random() % 16 == 0) {
                leaf->setValueOn(n, value());
            } else {
                leaf->setValueOff(n, static_cast<Value>(static_cast<int>(random() % kinds) - 1));
            }
        }
    }
    for (unsigned i = random() % 3; i > 0; --i) {
        tree.addTile(1 + random() % 3, Coord(static_cast<int>(random() % 20000) - 10000, 0, 128), value(),
                     random() % 2);
    }
    if (random() % 4 == 0) grid->setSaveFloatAsHalf(true);
    if (random() % 2 == 0) grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    if (random() % 4 == 0) grid->insertMeta("vector", openvdb::Vec3DMetadata(openvdb::Vec3d(1)));
    return grid;
}

std::string randomFile(std::mt19937& random)
{
    const auto randomOfAny = [&] {
        const unsigned type = random() % 5;
        return type == 0   ? randomGrid<openvdb::DoubleGrid>(random)
               : type == 1 ? randomGrid<openvdb::BoolGrid>(random)
               : type == 2 ? randomGrid<openvdb::MaskGrid>(random)
                           : randomGrid<openvdb::FloatGrid>(random);
    };
    openvdb::GridCPtrVec grids;
    const GridBase::Ptr first = randomOfAny();
    first->setName(random() % 2 ? "density" : "other");
    grids.push_back(first);
    if (random() % 4 == 0) {
        const GridBase::Ptr second = random() % 2 ? first->copyGrid() : randomOfAny(); // the same tree, or not
        second->setName("density");
        grids.push_back(second);
    }
    constexpr std::uint32_t compressions[] = {2, 2, 2, 2, 3, 6, 6, 7, 0};
    return test::vdbBytes(grids, compressions[random() % 9], random() % 2);
}

template <class Value>
void change(std::string& bytes, std::size_t position, std::mt19937& random)
{
    Value value;
    std::memcpy(&value, bytes.data() + position, sizeof(value));
    constexpr std::int64_t special[] = {0, 1, 2, -1, 6, 0x7FFFFFFF, -0x80000000LL, 0x7FFFFFFFFFFFFFFF, 4096, 100000};
    switch (random() % 6) {
    case 0:
    case 1:
        value = static_cast<Value>(special[random() % 10]);
        break;
    case 2:
        value = static_cast<Value>(value + 1);
        break;
    case 3:
        value = static_cast<Value>(value - 1);
        break;
    case 4:
        value = static_cast<Value>(value ^ static_cast<Value>(Value(1) << random() % (8 * sizeof(Value))));
        break;
    default:
        value = static_cast<Value>(0U - static_cast<std::uint64_t>(value));
        break;
    }
    std::memcpy(bytes.data() + position, &value, sizeof(value));
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed)
{
    std::mt19937 random(seed);
    std::string bytes(reinterpret_cast<const char*>(data), size);
    openvdb::initialize();
    const std::vector<ByteField> fields = fieldsOf(bytes);
    if (fields.size() < 20 || random() % 128 == 0) {
        bytes = randomFile(random);
    } else if (random() % 8 == 0) {
        return LLVMFuzzerMutate(data, size, maxSize);
    } else {
        const auto anyField = [&] { return fields[random() % fields.size()]; };
        for (unsigned i = 1 + random() % 3; i > 0; --i) {
            const ByteField field = anyField();
            if (field.position + field.size > bytes.size()) continue;
            if (random() % 16 == 0) { // some fields twice, or not at all
                const std::size_t other = anyField().position;
                if (other > field.position && other <= bytes.size()) {
                    const std::string between = bytes.substr(field.position, other - field.position);
                    if (random() % 2) {
                        bytes.insert(other, between);
                    } else {
                        bytes.erase(field.position, between.size());
                    }
                }
            } else if (field.size == 8) {
                change<std::uint64_t>(bytes, field.position, random);
            } else if (field.size == 4) {
                change<std::uint32_t>(bytes, field.position, random);
            } else {
                const std::size_t from = random() % 2 ? 0 : random() % field.size;
                change<std::uint8_t>(bytes, field.position + from, random);
            }
        }
    }
    if (bytes.size() > maxSize) bytes.resize(maxSize);
    std::memcpy(data, bytes.data(), bytes.size());
    return bytes.size();
}
