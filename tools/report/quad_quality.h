#pragma once

#include <cstddef>
#include <map>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::report {

/// Shape and flow of the quads of a mesh. Angles are in degrees; shares are 0 to 1.
struct QuadQuality {
    double share = 0;                            ///< of the faces, those that are quads
    double irregular = 0;                        ///< of the vertices that faces use, those without four edges
    std::map<std::size_t, std::size_t> valences; ///< how many vertices have how many edges
    double cornerMean = 0;                       ///< how far corners of quads are from 90
    double corner95th = 0;                       ///< 95 % are not further
    double foldMean = 0;   ///< between the two triangles of a quad, for the diagonal where it is more
    double fold95th = 0;   ///< 95 % are not more
    double inLoops = 0;    ///< of the quads, those in a closed polychord that passes no quad twice and is no
                           ///< longer than 4 times the root of the number of faces
    std::size_t loops = 0; ///< how many such polychords there are
    double aspect = 0;     ///< longer over shorter line between the middles of opposite sides: the median
};

/// Of a mesh without quads all is 0, but for the vertices.
/// Cost: O(n log n).
QuadQuality quadQuality(const Mesh& mesh);

} // namespace vdbcage::report
