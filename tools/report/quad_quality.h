#pragma once

#include <cstddef>
#include <map>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::report {

/// Shape and flow of the quads of a mesh. Angles are in degrees; shares are 0 to 1.
struct QuadQuality {
    double share = 0;                            ///< of quads among the faces
    double irregular = 0;                        ///< of vertices without four edges, among those that faces use
    std::map<std::size_t, std::size_t> valences; ///< the number of vertices for each number of edges
    double cornerMean = 0;                       ///< the mean difference of quads' corners from 90
    double corner95th = 0;                       ///< 95 % are at most this
    double foldMean = 0;   ///< mean angle between the two triangles of a quad, for the diagonal where it is larger
    double fold95th = 0;   ///< 95 % are at most this
    double inLoops = 0;    ///< of quads in a closed polychord that passes no quad twice and is no longer than 4 times
                           ///< the root of the number of faces
    std::size_t loops = 0; ///< the number of such polychords
    double aspect = 0;     ///< longer over shorter line between the middles of opposite sides: the median
};

/// Returns the quality. A mesh without quads has 0 in all except the vertices.
/// Cost: O(n log n).
QuadQuality quadQuality(const Mesh& mesh);

} // namespace vdbcage::report
