// Repair by CGAL's Polygon_mesh_processing, which is GPL: this file is compiled only with VDBCAGE_WITH_CGAL_GPL.

#include <vdbcage/surface/repair.h>

#include <algorithm>
#include <array>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

namespace vdbcage {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Polygon = std::vector<std::size_t>;

std::size_t countSelfIntersections(const Surface& surface)
{
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
    pmp::self_intersections(surface, std::back_inserter(pairs));
    return pairs.size();
}

/// The directed edges of triangles by position, sorted: how a soup is oriented, whatever its points are called.
std::vector<std::array<Kernel::Point_3, 2>> directedEdges(const std::vector<Kernel::Point_3>& points,
                                                          const std::vector<Polygon>& polygons)
{
    std::vector<std::array<Kernel::Point_3, 2>> edges;
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            edges.push_back({points[polygon[i]], points[polygon[(i + 1) % polygon.size()]]});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Fills every hole that can be; `filled` and `unfilled` count them.
void fillHoles(Surface& surface, std::size_t& filled, std::size_t& unfilled)
{
    std::vector<Surface::Halfedge_index> borders;
    pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
    for (const Surface::Halfedge_index border : borders) {
        std::vector<Surface::Face_index> patch;
        pmp::triangulate_hole(surface, border, std::back_inserter(patch));
        ++(patch.empty() ? unfilled : filled);
    }
}

} // namespace

bool hasRepair()
{
    return true;
}

RepairedCage repair(const Mesh& cage, Interrupter* interrupter)
{
    requireUsable(cage, "cage");
    RepairReport done;
    std::vector<Kernel::Point_3> points;
    for (const openvdb::Vec3d& p : cage.points) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<Polygon> polygons;
    for (const openvdb::Vec3I& t : triangulate(cage)) polygons.push_back({t[0], t[1], t[2]});

    // As a soup: one point a place, no degenerate face, no face twice.
    done.mergedPoints = pmp::merge_duplicate_points_in_polygon_soup(points, polygons);
    const std::size_t before = polygons.size();
    polygons.erase(
        std::remove_if(polygons.begin(), polygons.end(),
                       [&](const Polygon& t) { return CGAL::collinear(points[t[0]], points[t[1]], points[t[2]]); }),
        polygons.end());
    pmp::merge_duplicate_polygons_in_polygon_soup(
        points, polygons, pmp::parameters::erase_all_duplicates(false).require_same_orientation(false));
    done.removedFaces = before - polygons.size();
    throwIfInterrupted(interrupter, 10);

    const auto edgesBefore = directedEdges(points, polygons);
    const std::size_t pointsBefore = points.size();
    pmp::orient_polygon_soup(points, polygons);
    done.splitVertices = points.size() - pointsBefore;
    Surface surface;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
    throwIfInterrupted(interrupter, 25);

    done.stitchedEdges = pmp::stitch_borders(surface);
    fillHoles(surface, done.filledHoles, done.unfilledHoles);
    throwIfInterrupted(interrupter, 40);

    pmp::remove_degenerate_faces(surface);
    done.selfIntersectionsBefore = countSelfIntersections(surface);
    if (done.selfIntersectionsBefore > 0) {
        pmp::experimental::remove_self_intersections(surface);
        // What was cut out and could not be patched is a hole again.
        fillHoles(surface, done.filledHoles, done.unfilledHoles);
    }
    throwIfInterrupted(interrupter, 80);
    pmp::duplicate_non_manifold_vertices(surface);
    if (CGAL::is_closed(surface)) pmp::orient(surface);
    done.selfIntersectionsAfter = countSelfIntersections(surface);
    surface.collect_garbage();

    Mesh mended;
    for (const Surface::Vertex_index v : surface.vertices()) {
        const Kernel::Point_3& p = surface.point(v);
        mended.points.emplace_back(p.x(), p.y(), p.z());
    }
    std::vector<Polygon> after;
    points.clear();
    for (const Surface::Vertex_index v : surface.vertices()) points.push_back(surface.point(v));
    for (const Surface::Face_index f : surface.faces()) {
        Polygon corners;
        for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) {
            corners.push_back(static_cast<std::size_t>(v));
        }
        mended.triangles.emplace_back(static_cast<openvdb::Index32>(corners[0]),
                                      static_cast<openvdb::Index32>(corners[1]),
                                      static_cast<openvdb::Index32>(corners[2]));
        after.push_back(corners);
    }
    // Faces that were there before and now run the other way round.
    const auto edgesAfter = directedEdges(points, after);
    done.reoriented = std::any_of(edgesBefore.begin(), edgesBefore.end(), [&](const auto& edge) {
        return !std::binary_search(edgesAfter.begin(), edgesAfter.end(), edge) &&
               std::binary_search(edgesAfter.begin(), edgesAfter.end(),
                                  std::array<Kernel::Point_3, 2>{edge[1], edge[0]});
    });
    return {std::move(mended), done};
}

} // namespace vdbcage
