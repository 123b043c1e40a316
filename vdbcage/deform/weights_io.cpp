// Based on: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays", version 1.0.

#include <vdbcage/deform/weights_io.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/hash.h>
#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/given_weights.h>
#include <vdbcage/deform/detail/weight_blocks.h>

namespace vdbcage {

namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "reverse the bytes here");

const std::string numpy = "\x93NUMPY", magic("\x93NUMPY\x01\x00", 8);
constexpr std::size_t nameSizes[] = {8, 16}; // a family's name is written in the first that is long enough
const std::string afterCounts = "))], 'fortran_order': False, 'shape': (), }";

/// The data before the weights.
struct Hashes {
    std::uint64_t cage = 0, points = 0;
};
static_assert(sizeof(Hashes) == 16, "written as it is in memory");

template <typename Item>
void add(detail::Hash& hash, const std::vector<Item>& items)
{
    const std::uint64_t count = items.size();
    hash.add({reinterpret_cast<const char*>(&count), sizeof count});
    hash.add({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)});
}

Hashes hashesOf(const Mesh& cage, const std::vector<openvdb::Vec3d>& points)
{
    detail::Hash ofCage, ofPoints;
    add(ofCage, cage.points);
    add(ofCage, cage.triangles);
    add(ofCage, cage.quads);
    add(ofPoints, points);
    return {ofCage.value(), ofPoints.value()};
}

/// Returns the header's text up to the counts.
std::string beforeCounts(std::size_t nameSize)
{
    return "{'descr': [('family', '|S" + std::to_string(nameSize) +
           "'), ('cage_hash', '<u8'), ('points_hash', '<u8'), ('weights', '<f4', (";
}

/// Returns magic, length and text, padded as NumPy does so that the data are aligned.
std::string headerOf(std::size_t nameSize, std::size_t points, std::size_t handles)
{
    std::string text = beforeCounts(nameSize) + std::to_string(points) + ", " + std::to_string(handles) + afterCounts;
    text.append(63 - (magic.size() + 2 + text.size()) % 64, ' ');
    text += '\n';
    return magic + char(text.size() & 0xFFU) + char(text.size() >> 8U) + text;
}

bool isDmat(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension == ".dmat";
}

/// Returns the family of a name in a file; accepts `given`, too, unlike coordinatesNamed.
Coordinates familyOf(std::string name)
{
    name.resize(::strnlen(name.data(), name.size()));
    return name == coordinatesName(Coordinates::given) ? Coordinates::given : coordinatesNamed(name);
}

} // namespace

void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                  const std::vector<float>& weights, const std::filesystem::path& path)
{
    writeFileAtomically(path, [&](std::ostream& out) { writeWeights(cage, points, family, weights, out, path); });
}

void writeWeights(const Mesh& cage, const std::vector<openvdb::Vec3d>& points, Coordinates family,
                  const std::vector<float>& weights, std::ostream& out, const std::filesystem::path& path)
{
    const std::size_t handles = handleCount(cage, family);
    detail::requireWeights(weights.size(), points.size(), handles);
    std::string name = coordinatesName(family);
    const std::size_t nameSize = *std::lower_bound(std::begin(nameSizes), std::end(nameSizes), name.size());
    if (nameSize + sizeof(Hashes) + weights.size() * sizeof(float) >= std::size_t(1) << 31U) {
        throw InputError(path.string(), std::to_string(points.size()) + " points times " + std::to_string(handles) +
                                            " handles do not fit in a weights file, which must be smaller than 2 GiB");
    }
    const Hashes hashes = hashesOf(cage, points);
    name.resize(nameSize);
    out << headerOf(nameSize, points.size(), handles) << name;
    out.write(reinterpret_cast<const char*>(&hashes), sizeof hashes);
    out.write(reinterpret_cast<const char*>(weights.data()),
              static_cast<std::streamsize>(weights.size() * sizeof(float)));
}

Binding readWeights(const std::filesystem::path& path, const Mesh& cage, std::vector<openvdb::Vec3d> points)
{
    const auto fail = [&](const std::string& what) { throw IoError(path.string() + ": " + what); };
    const auto bindGiven = [&](const std::vector<float>& weights) {
        const std::string problem = detail::weightsProblem(weights, cage.points.size());
        if (!problem.empty()) fail(problem);
        return Binding(cage, std::move(points), Coordinates::given, weights);
    };
    if (isDmat(path)) {
        const std::vector<float> weights = detail::withMemoryToRead(path, [&] {
            return detail::parseDmat(detail::readFile(path), path.string(), points.size(), cage.points.size());
        });
        return bindGiven(weights);
    }
    detail::requireRegularFile(path);
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("cannot be read: " + std::generic_category().message(errno != 0 ? errno : EIO));
    std::error_code problem;
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    if (problem) fail("cannot be read: " + problem.message());
    std::string start(magic.size() + 2, '\0');
    in.read(start.data(), static_cast<std::streamsize>(start.size()));
    if (!in || start.compare(0, numpy.size(), numpy) != 0) {
        fail("it is not a weights file: neither NumPy's (.npy) nor named .dmat");
    }
    const auto byteAt = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(start[i])); };
    std::string text(byteAt(magic.size()) + 256 * byteAt(magic.size() + 1), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    std::size_t nameSize = 0;
    for (const std::size_t candidate : nameSizes) {
        if (text.rfind(beforeCounts(candidate), 0) == 0) nameSize = candidate;
    }
    if (start.compare(0, magic.size(), magic) != 0 || nameSize == 0) {
        const std::vector<float> weights = detail::withMemoryToRead(path, [&] {
            return detail::parseNpy(detail::readFile(path), path.string(), points.size(), cage.points.size());
        });
        return bindGiven(weights);
    }
    std::size_t rows = 0, columns = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data() + beforeCounts(nameSize).size(), end, rows);
    if (end - first.ptr > 2) std::from_chars(first.ptr + 2, end, columns);
    std::string name(nameSize, '\0');
    in.read(name.data(), static_cast<std::streamsize>(nameSize));
    Hashes hashes;
    in.read(reinterpret_cast<char*>(&hashes), sizeof hashes);
    if (!in || start + text != headerOf(nameSize, rows, columns))
        fail("it is not a weights file of vdbcage, or truncated");

    const Hashes expected = hashesOf(cage, points);
    if (hashes.cage != expected.cage) fail("it was made for another cage");
    if (hashes.points != expected.points || rows != points.size()) fail("it was made for another model");
    Coordinates family{};
    try {
        family = familyOf(name);
    } catch (const InputError& error) {
        fail(error.what());
    }
    if (columns != handleCount(cage, family)) {
        fail("it has " + std::to_string(columns) + " handles; " + coordinatesName(family) +
             " coordinates of this cage have " + std::to_string(handleCount(cage, family)));
    }
    // The file's size bounds the numbers of the header before memory is taken for them. Neither sum can overflow: rows
    // and columns are those of a model and a cage in memory.
    const std::uintmax_t expectedSize =
        start.size() + text.size() + nameSize + sizeof hashes + rows * columns * sizeof(float);
    if (size < expectedSize) fail("it is truncated");
    if (size > expectedSize) {
        fail("it has " + std::to_string(size - expectedSize) + " bytes behind the weights; it should end there");
    }
    std::vector<float> weights = detail::withMemoryToRead(path, [&] { return std::vector<float>(rows * columns); });
    in.read(reinterpret_cast<char*>(weights.data()), static_cast<std::streamsize>(weights.size() * sizeof(float)));
    if (!in) fail("it is truncated");
    if (family == Coordinates::given) return bindGiven(weights);
    return Binding(cage, std::move(points), family, weights);
}

} // namespace vdbcage
