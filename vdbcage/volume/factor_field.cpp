// Based on: adjunctions of varying structuring elements, Serra, Image Analysis and Mathematical Morphology II, 1988.
#include <vdbcage/volume/factor_field.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/close_options.h>
#include <vdbcage/volume/detail/factor_at.h>
#include <vdbcage/volume/detail/sphere/radius_field.h>
#include <vdbcage/volume/detail/sphere/sphere_pass.h>
#include <vdbcage/volume/vdb_io.h>

namespace vdbcage {

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::MaskGrid;
using openvdb::Vec3d;

void require(bool isRight, const char* name, double value, const char* allowed)
{
    if (isRight) return;
    std::ostringstream text;
    text << name << " is " << value << "; it must be " << allowed;
    throw InputError(text.str());
}

[[noreturn]] void refuse(const std::string& part, const std::string& name)
{
    throw InputError("'" + part + "' is not a " + name +
                     " field; it must be a .vdb file, sphere:X,Y,Z,RADIUS,SCALE or box:X,Y,Z,X,Y,Z,SCALE");
}

// Returns the numbers after the colon, separated by commas.
std::vector<double> numbers(const std::string& part, const std::string& name, std::size_t count)
{
    std::vector<double> list;
    const char *begin = part.data() + part.find(':') + 1, *const end = part.data() + part.size();
    for (;;) {
        double value = 0;
        const auto parsed = std::from_chars(begin, end, value);
        if (parsed.ec != std::errc() || !std::isfinite(value)) refuse(part, name);
        list.push_back(value);
        if (parsed.ptr == end) break;
        if (*parsed.ptr != ',') refuse(part, name);
        begin = parsed.ptr + 1;
    }
    if (list.size() != count) refuse(part, name);
    return list;
}

/// Returns the box of the active voxels.
openvdb::CoordBBox boxOf(const MaskGrid& mask)
{
    return detail::isolated([&] { return mask.evalActiveVoxelBoundingBox(); });
}

} // namespace

FloatGrid::Ptr factorsFromPoints(const std::vector<Vec3d>& points, const std::vector<float>& values, double voxelSize,
                                 double radius, Interrupter* interrupter)
{
    if (points.size() != values.size()) {
        std::ostringstream text;
        text << "there are " << values.size() << " values for " << points.size() << " points; it must be one for each";
        throw InputError(text.str());
    }
    for (const float value : values) {
        require(std::isfinite(value), "a value at a point", static_cast<double>(value), "finite");
    }
    require(voxelSize > 0 && std::isfinite(voxelSize), "the voxel size", voxelSize, "above 0");
    require(radius > 0 && radius <= 64 * voxelSize, "the radius", radius, "above 0 and at most 64 voxels");
    auto scale = FloatGrid::create(1.0F);
    scale->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
    FloatGrid nearest(static_cast<float>(openvdb::math::Pow2(radius / voxelSize))); // squared distances in voxels
    auto scales = scale->getAccessor();
    auto distances = nearest.getAccessor();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d place = scale->worldToIndex(points[i]);
        const Vec3d span(radius / voxelSize);
        const Coord lower = Coord::ceil(place - span), upper = Coord::floor(place + span);
        for (int x = lower.x(); x <= upper.x(); ++x) {
            throwIfInterrupted(interrupter, static_cast<int>(100 * i / points.size()));
            const openvdb::CoordBBox slice(Coord(x, lower.y(), lower.z()), Coord(x, upper.y(), upper.z()));
            for (auto c = slice.begin(); c; ++c) {
                const auto distance = static_cast<float>(((*c).asVec3d() - place).lengthSqr());
                const bool isFirst = !distances.isValueOn(*c);
                if (isFirst ? distance > distances.getValue(*c) : distance >= distances.getValue(*c)) continue;
                distances.setValue(*c, distance);
                scales.setValue(*c, values[i]);
            }
        }
    }
    return scale;
}

FactorField readFactorField(const std::string& text, const std::string& name)
{
    FactorField field;
    if (text == "none") return field;
    field.source = text;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        begin = end + 1;
        if (part.rfind("sphere:", 0) == 0) {
            const auto n = numbers(part, name, 5);
            field.regions.push_back({FactorRegion::Shape::sphere, Vec3d(n[0], n[1], n[2]), Vec3d(0), n[3], n[4]});
        } else if (part.rfind("box:", 0) == 0) {
            const auto n = numbers(part, name, 7);
            field.regions.push_back({FactorRegion::Shape::box,
                                     Vec3d(std::min(n[0], n[3]), std::min(n[1], n[4]), std::min(n[2], n[5])),
                                     Vec3d(std::max(n[0], n[3]), std::max(n[1], n[4]), std::max(n[2], n[5])), 0, n[6]});
        } else if (std::filesystem::path(part).extension() == ".vdb") {
            if (field.grid) throw InputError("'" + part + "' is a second .vdb file; a " + name + " field can have one");
            field.grid = readFloatGrid(part, name);
            field.file = part;
        } else {
            refuse(part, name);
        }
        if (!field.regions.empty()) detail::requireValid(field.regions.back());
    }
    return field;
}

MaskGrid::Ptr dilate(const MaskGrid& mask, double radiusVoxels, const FactorField& scale, Interrupter* interrupter)
{
    detail::requireValid({radiusVoxels, 0, StructuringElement::sphere});
    const detail::Progress progress{interrupter};
    const detail::RadiusField field(scale, mask.transform(), radiusVoxels, boxOf(mask), progress.part(0, 10));
    if (field.isUniform()) return dilate(mask, field.largest(), StructuringElement::sphere, interrupter);
    detail::requireSupportedCoordinates(mask.tree());
    return detail::maskGridLike(mask, detail::dilateByField(mask.tree(), field, {interrupter, 10, 100}));
}

MaskGrid::Ptr closeMask(const MaskGrid& solid, const CloseOptions& options, const FactorField& scale,
                        Interrupter* interrupter)
{
    detail::requireValid(options);
    const detail::Progress progress{interrupter};
    const detail::RadiusField field(scale, solid.transform(), options.closeRadiusVoxels, boxOf(solid),
                                    progress.part(0, 10));
    const double factor = options.closeRadiusVoxels > 0 ? options.erodeRadiusVoxels / options.closeRadiusVoxels : 0.0;
    if (field.isUniform()) {
        return closeMask(solid, {field.largest(), std::min(field.largest(), field.largest() * factor), options.element},
                         interrupter);
    }
    if (options.element != StructuringElement::sphere) {
        throw InputError("the cube has one radius everywhere; a scale field needs the sphere");
    }
    detail::requireSupportedCoordinates(solid.tree());
    const detail::Progress rest{interrupter, 10, 100};
    const auto dilated = detail::dilateByField(solid.tree(), field, rest.part(0, 2));
    const auto closed = detail::erodeByField(*dilated, &solid.tree(), field, std::min(factor, 1.0), rest.part(1, 2));
    detail::release(*dilated, rest.end());
    return detail::maskGridLike(solid, closed);
}

} // namespace vdbcage
