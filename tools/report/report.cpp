#include <tools/report/report.h>
#include <tools/report/run_facts.h>

#include <cstdio>
#include <iomanip>
#include <optional>
#include <sstream>
#include <type_traits>

#include <sys/resource.h>

#include <vdbcage/core/detail/length_text.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/printable.h>

namespace vdbcage::report {

Json toJson(const CageCheck& check)
{
    return {{"valid", check.valid()},
            {"bounding", check.bounding()},
            {"closed", check.closed()},
            {"manifold", check.manifold()},
            {"oriented", check.oriented()},
            {"points", check.points},
            {"triangles", check.triangles},
            {"quads", check.quads},
            {"components", check.components},
            {"genus", check.closed() && check.manifold() ? Json(check.genus) : Json()},
            {"boundary_edges", check.boundaryEdges},
            {"non_manifold_edges", check.nonManifoldEdges},
            {"non_manifold_vertices", check.nonManifoldVertices},
            {"misoriented_edges", check.misorientedEdges},
            {"inward_components", check.inwardComponents},
            {"degenerate_faces", check.degenerateFaces},
            {"self_intersections", check.selfIntersections},
            {"contact_faces", check.contactFaces},
            {"model_vertices_outside", check.modelVerticesOutside},
            {"loose_points", check.loosePoints},
            {"loose_points_outside", check.loosePointsOutside},
            {"model_longest_side", check.longestSide},
            {"model_diagonal", check.diagonal},
            {"mean_distance", check.meanDistance},
            {"max_distance", check.maxDistance},
            {"min_distance", check.minDistance},
            {"cage_volume", check.cageVolume != 0 ? Json(check.cageVolume) : Json()},
            {"volume_ratio", check.volumeRatio > 0 ? Json(check.volumeRatio) : Json()},
            {"min_angle_degrees", check.minAngleDegrees},
            {"angle_1st_percentile_degrees", check.angle1stPercentileDegrees},
            {"median_angle_degrees", check.medianAngleDegrees}};
}

/// Returns an option's value as text.
std::string textOf(const CageOptions& options, const char* name)
{
    for (const auto& option : optionValues(options)) {
        if (option.first == name) return option.second;
    }
    return {};
}

/// Returns a remark on the chosen inside of an open model, if rays agree on it neither clearly nor clearly not; else
/// empty.
std::string remarkOnInterior(const VoxelizeReport& report)
{
    constexpr double surelySheet = 0.15, surelySolid = 0.95;
    if (!report.agreement || *report.agreement < surelySheet || *report.agreement > surelySolid) return "";
    std::ostringstream out;
    out << "the model is open: " << std::fixed << std::setprecision(0) << 100 * *report.agreement
        << " % of rays agree on its inside, so it was taken for a "
        << (report.interior == Interior::shell ? "shell; --interior solid fills it"
                                               : "solid; --interior shell keeps to its walls");
    return out.str();
}

Json toJson(const CageReport& report)
{
    const char* start = report.start == CageStart::closing       ? "closing"
                        : report.start == CageStart::hull        ? "hull"
                        : report.start == CageStart::orientedBox ? "oriented_box"
                        : report.start == CageStart::tetrahedron ? "tetrahedron"
                                                                 : "box";
    Json symmetry = nullptr;
    if (report.symmetry) {
        symmetry = {{"axis", std::string(1, "xyz"[report.symmetry->plane.axis])},
                    {"offset", report.symmetry->plane.offset},
                    {"deviation", report.symmetry->deviation}};
    } else if (report.tiltedSymmetry) {
        const openvdb::Vec3d& normal = report.tiltedSymmetry->normal;
        symmetry = {{"axis", nullptr},
                    {"normal", {normal[0], normal[1], normal[2]}},
                    {"offset", report.tiltedSymmetry->offset},
                    {"deviation", report.tiltedSymmetry->deviation}};
    }
    CageOptions voxels;
    voxels.voxelizer = report.voxels.voxelizer;
    voxels.interior = report.voxels.interior;
    const Json agreement = report.voxels.agreement ? Json(*report.voxels.agreement) : Json(nullptr);
    return {{"float_safe", report.floatSafe},
            {"symmetry", symmetry},
            {"no_symmetry", report.noSymmetry},
            {"offset_voxels", report.offsetVoxels},
            {"resolution", report.resolution},
            {"voxelizer", textOf(voxels, "voxelizer")},
            {"voxelizer_fallback", report.voxels.fallback},
            {"interior", textOf(voxels, "interior")},
            {"ray_agreement", agreement},
            {"close_radius", report.closeRadius},
            {"erode_radius", report.erodeRadius},
            {"min_angle_degrees", report.minAngle ? Json(*report.minAngle) : Json()},
            {"merge_angle_degrees", report.mergeAngle ? Json(*report.mergeAngle) : Json()},
            {"smooth", report.smooth},
            {"start", start},
            {"repaired", report.repaired},
            {"parts_left_out", report.partsLeftOut},
            {"faces_left_out", report.facesLeftOut},
            {"side_share", report.sideShare},
            {"start_faces", report.startFaces},
            {"cavities_filled", report.cavitiesFilled},
            {"solid_parts", report.solidParts},
            {"solid_handles", report.solidHandles},
            {"model_hollows", report.modelHollows},
            {"start_parts", report.parts},
            {"start_handles", report.handles},
            {"solid_voxels", report.solidVoxels},
            {"closed_voxels", report.closedVoxels}};
}

Json toJson(const Mesh& mesh, const ReadSummary& summary, const std::filesystem::path& path)
{
    return {{"file", path.string()},
            {"points", mesh.points.size()},
            {"triangles", mesh.triangles.size()},
            {"quads", mesh.quads.size()},
            {"polygons_split", summary.polygons},
            {"splits_certified_up_to_corners", summary.alternateCorners},
            {"degenerate_faces", summary.degenerateFaces},
            {"ignored_elements", summary.ignoredElements},
            {"warnings", summary.warnings},
            {"sha256", nullptr}, // set by the caller, if it has them
            {"check", nullptr}};
}

Json toJson(const std::vector<StageTime>& stages)
{
    Json list = Json::array();
    for (const StageTime& stage : stages) {
        list.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"cpu_seconds", stage.cpuSeconds}});
    }
    return list;
}

Json toJson(const QuadQuality& quality)
{
    Json valences = Json::object();
    for (const auto& [edges, vertices] : quality.valences) valences[std::to_string(edges)] = vertices;
    return {{"share", quality.share},
            {"irregular_share", quality.irregular},
            {"valences", valences},
            {"corner_mean_degrees", quality.cornerMean},
            {"corner_95th_degrees", quality.corner95th},
            {"fold_mean_degrees", quality.foldMean},
            {"fold_95th_degrees", quality.fold95th},
            {"loop_share", quality.inLoops},
            {"loops", quality.loops},
            {"aspect_median", quality.aspect}};
}

/// Returns a number, a truth, or the text of an option: words, and names of files; null if there is none.
template <typename Value>
Json typed(const Value& value, const std::string& text)
{
    if constexpr (std::is_arithmetic_v<Value>) {
        return value;
    } else if constexpr (std::is_same_v<Value, std::optional<int>> || std::is_same_v<Value, std::optional<double>>) {
        return value ? Json(*value) : Json(text);
    } else {
        return text == "none" ? Json() : Json(text);
    }
}

Json toJson(const CageOptions& options)
{
    Json object = Json::object();
    const auto texts = optionValues(options);
    auto text = texts.begin();
    visitOptions(options,
                 [&](const OptionInfo& info, const auto& value) { object[info.name] = typed(value, text++->second); });
    return object;
}

Json reportOf(const CageOrder& order, const CageMade& made)
{
    Json report = reportOf(order, "", 0);
    report["cage_sha256"] = made.sha256.empty() ? Json() : Json(made.sha256);
    report["seconds"] = made.seconds;
    report["stages"] = toJson(made.stages);
    report["result"] = toJson(made.report);
    if (!made.cage.quads.empty()) report["quads"] = toJson(quadQuality(made.cage));
    report["check"] = toJson(made.report.check);
    return report;
}

Json reportOf(const CageOrder& order, const std::string& error, int status)
{
    Json report = runFacts("make", order.arguments);
    report["models"] = order.models;
    report["inputs"] = order.inputs.empty() ? Json() : Json(order.inputs);
    report["cage"] = order.cage.empty() ? Json() : Json(order.cage.string());
    report["options"] = toJson(order.options);
    report["exit_status"] = status;
    report["error"] = error.empty() ? Json() : Json(error);
    report["memory_peak_mib"] = peakMemory();
    // A failure has none of these.
    for (const char* name : {"cage_sha256", "seconds", "stages", "result", "quads", "check"}) report[name] = nullptr;
    return report;
}

double peakMemory()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string toText(const Json& report)
{
    // A path is any bytes, JSON is UTF-8: other bytes become the replacement character.
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<std::string> remarks(const CageReport& report, const CageOptions& options)
{
    std::vector<std::string> lines;
    if (report.partsLeftOut > 0) {
        lines.push_back("left out, so not bound: parts below " + detail::numberText(options.leastPart) +
                        " of the largest: " + std::to_string(report.partsLeftOut) + ", with " +
                        std::to_string(report.facesLeftOut) + " faces");
    }
    if (report.sideShare < 1) {
        std::ostringstream out;
        out << "all parts are small beside the longest side, " << report.check.longestSide
            << ": voxels and radii were chosen as for " << report.sideShare << " of it; the mean distance is "
            << std::setprecision(3) << report.check.meanDistance * report.check.longestSide
            << "; --least-part leaves out parts that are small and far away";
        lines.push_back(out.str());
    }
    if (options.bounding && !options.resolution && report.start == CageStart::closing &&
        2 * report.startFaces < static_cast<std::size_t>(options.faces)) {
        lines.push_back("too few voxels for so many faces: their surface has " + std::to_string(2 * report.startFaces) +
                        " triangles; --least-part leaves small parts far away out, --resolution takes finer voxels");
    }
    if (report.start == CageStart::hull) {
        lines.emplace_back("shrunk from the convex hull: the closing has too many parts or handles for so few faces");
    } else if (report.start == CageStart::box) {
        lines.emplace_back("this is a box around the model: nothing tighter with so few faces was certified");
    }
    constexpr double aPlace = 1e-4; // of the longest side: the precision of places of planes
    if (report.symmetry) {
        const SymmetryPlane& plane = report.symmetry->plane;
        const bool isFound = options.symmetry == CageSymmetry::automatic;
        std::ostringstream out;
        out << "symmetric in the plane "
            << "xyz"[plane.axis] << " = " << detail::lengthText(plane.offset, aPlace * report.check.longestSide)
            << (isFound ? ", found" : ", asked for") << "; the model is, within " << std::fixed << std::setprecision(2)
            << 100 * report.symmetry->deviation << " % of its longest side";
        lines.push_back(out.str());
    } else if (report.tiltedSymmetry) {
        const TiltedSymmetry& plane = *report.tiltedSymmetry;
        std::ostringstream out;
        out << "symmetric in the plane across (" << std::setprecision(4) << plane.normal[0] << ", " << plane.normal[1]
            << ", " << plane.normal[2] << ") at " << detail::lengthText(plane.offset, aPlace * report.check.longestSide)
            << ", found; the model is, within " << std::fixed << std::setprecision(2) << 100 * plane.deviation
            << " % of its longest side";
        lines.push_back(out.str());
    } else if (!report.noSymmetry.empty()) {
        lines.push_back("not symmetric: " + report.noSymmetry);
    }
    const std::string interior = remarkOnInterior(report.voxels);
    if (!interior.empty()) lines.push_back(interior);
    if (!report.voxels.fallback.empty()) {
        lines.push_back("voxels by the CPU: " + detail::printable(report.voxels.fallback));
    }
    const auto hollows = [](std::size_t count) {
        return std::to_string(count) + (count == 1 ? " hollow" : " hollows");
    };
    if (report.modelHollows > 0) lines.push_back(hollows(report.modelHollows) + " inside the model became solid");
    if (report.cavitiesFilled > 0) {
        lines.push_back(hollows(report.cavitiesFilled) + " inside the closing " +
                        (report.cavitiesFilled == 1 ? "was" : "were") + " filled");
    }
    if (options.bounding && !report.floatSafe && options.precision != Precision::float64) {
        lines.emplace_back("coordinates are float64: programs that hold float32, as Blender, round them, and the cage "
                           "may then cut the model; --precision float32 makes one for them, or says by how much to "
                           "move the model first");
    }
    const CageCheck& check = report.check;
    if (check.loosePoints > 0) {
        lines.push_back("points of the model that no face uses: " + std::to_string(check.loosePoints) +
                        ", outside of the cage: " + std::to_string(check.loosePointsOutside));
    }
    const bool isSameThroughout = report.solidParts == report.parts && report.parts == check.components &&
                                  report.solidHandles == report.handles && report.handles == check.genus;
    if (report.start == CageStart::closing && !isSameThroughout) {
        std::ostringstream out;
        out << "parts and handles: " << report.solidParts << " and " << report.solidHandles << " of the solid, "
            << report.parts << " and " << report.handles << " of the closing, " << check.components << " and "
            << check.genus << " of the cage";
        lines.push_back(out.str());
    }
    return lines;
}

std::string warningLines(const std::filesystem::path& path, const ReadSummary& summary)
{
    std::string lines;
    for (const std::string& warning : summary.warnings) {
        lines += "  warning: " + detail::printable(path.string()) + ": " + warning + '\n';
    }
    return lines;
}

std::string describe(const CageCheck& check)
{
    std::string text;
    const auto fact = [&](const char* name, const std::string& value) {
        text += std::string("  ") + name + std::string(26 - std::char_traits<char>::length(name), ' ') + value + '\n';
    };
    const auto count = [&](const char* name, std::size_t value) { fact(name, std::to_string(value)); };
    const auto percent = [&](const char* name, double fraction) {
        char buffer[96];
        const double ofDiagonal = check.diagonal > 0 ? fraction / check.diagonal : 0;
        std::snprintf(buffer, sizeof buffer, "%.3f %% of the model's longest side (%.3f %% of its diagonal)",
                      100 * fraction, 100 * ofDiagonal);
        fact(name, buffer);
    };
    fact("faces", std::to_string(check.triangles) + " triangles, " + std::to_string(check.quads) + " quads");
    fact("components, genus", std::to_string(check.components) + ", " + std::to_string(check.genus));
    count("boundary edges", check.boundaryEdges);
    count("non-manifold edges", check.nonManifoldEdges);
    count("non-manifold vertices", check.nonManifoldVertices);
    count("misoriented edges", check.misorientedEdges);
    count("inward components", check.inwardComponents);
    count("degenerate faces", check.degenerateFaces);
    count("self-intersections", check.selfIntersections);
    count("faces touching the model", check.contactFaces);
    count("model vertices outside", check.modelVerticesOutside);
    if (check.loosePoints > 0) {
        fact("points of no face",
             std::to_string(check.loosePoints) + ", outside of the cage " + std::to_string(check.loosePointsOutside));
    }
    percent("mean distance", check.meanDistance);
    percent("largest distance", check.maxDistance);
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.3f", check.volumeRatio);
    fact("cage volume / model's", check.volumeRatio > 0 ? buffer : "- (the model or the cage is not closed)");
    std::snprintf(buffer, sizeof buffer, "%.1f degrees", check.minAngleDegrees);
    fact("smallest angle", buffer);
    return text;
}

} // namespace vdbcage::report
