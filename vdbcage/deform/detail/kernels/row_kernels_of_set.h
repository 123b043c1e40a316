// Based on: the papers of the families mean_value, green, likelihood and somigliana, of which these are the formulas in
// vectors. Differs: the angle or potential of an edge is computed once for both of its triangles. Determinants and feet
// of perpendiculars come from the faces' planes. The damping of Newton's method is that of self-concordant functions
// (Nesterov and Nemirovskii, "Interior-Point Polynomial Algorithms in Convex Programming", 1994): it needs no trials.
// Where rounding or a singularity is near, the scalar formulas take over.

// Included once for each instruction set; see lanes.h. VDBCAGE_KERNELS is the name of the table, VDBCAGE_INSTRUCTIONS
// that of its instruction set.

#include <vdbcage/deform/detail/kernels/lanes.h>
#include <vdbcage/deform/detail/kernels/row_kernels.h>

namespace vdbcage::detail {

extern const RowKernels VDBCAGE_KERNELS;

namespace {

constexpr double fourPi = 4 * pi;

struct Corner {
    Vector place; // seen from the points
    Lanes distance;
};

Vector placesOf(const double (*x)[packetSize], int first)
{
    return {load(x[0] + first), load(x[1] + first), load(x[2] + first)};
}

void seeCorners(const KernelCage& cage, Vector x, Corner* corners)
{
    for (std::size_t i = 0; i < cage.pointCount; ++i) {
        const Vector place = towards(cage.points[i], x);
        corners[i] = {place, squareRoot(dot(place, place))};
    }
}

/// Divides the points' weights by `sum`, and makes them reproduce affine maps. `normals` is the part of the place at
/// rest that other columns add.
void restorePrecision(const KernelCage& cage, Vector x, double (*rows)[packetSize], int first, Lanes sum,
                      Vector normals)
{
    Vector missing = x + all(-1) * normals;
    for (std::size_t i = 0; i < cage.pointCount; ++i) {
        double* const at = &rows[i][first];
        const Lanes weight = load(at) / sum;
        store(weight, at);
        missing = missing + -weight * Vector{all(cage.points[i][0]), all(cage.points[i][1]), all(cage.points[i][2])};
    }
    for (std::size_t i = 0; i < cage.pointCount; ++i) add(dot(cage.restoring[i], missing), &rows[i][first]);
}

// --- Bilinear patches

/// A part of a patch: its corners, and its place in the patch.
struct Piece {
    double c[4][3];
    PatchExtent extent;
    double u, v, du, dv;
    Mask lanes; // that need it
};

double lengthOf(const double (&from)[3], const double (&to)[3])
{
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    return __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

double larger(double a, double b)
{
    return a > b ? a : b;
}

PatchExtent extentOf(const double (&c)[4][3])
{
    PatchExtent extent;
    for (int a = 0; a < 3; ++a) extent.middle[a] = 0.25 * (c[0][a] + c[1][a] + c[2][a] + c[3][a]);
    extent.radius = 0;
    for (const auto& corner : c) extent.radius = larger(extent.radius, lengthOf(extent.middle, corner));
    extent.halfU = 0.5 * larger(lengthOf(c[0], c[1]), lengthOf(c[3], c[2]));
    extent.halfV = 0.5 * larger(lengthOf(c[0], c[3]), lengthOf(c[1], c[2]));
    return extent;
}

/// Halves `piece` across its longer side.
void halve(const Piece& piece, Piece& a, Piece& b)
{
    const bool inU = piece.extent.halfU > piece.extent.halfV;
    a = b = piece;
    const auto& c = piece.c;
    for (int k = 0; k < 3; ++k) {
        if (inU) {
            a.c[1][k] = b.c[0][k] = 0.5 * (c[0][k] + c[1][k]);
            a.c[2][k] = b.c[3][k] = 0.5 * (c[3][k] + c[2][k]);
        } else {
            a.c[3][k] = b.c[0][k] = 0.5 * (c[0][k] + c[3][k]);
            a.c[2][k] = b.c[1][k] = 0.5 * (c[1][k] + c[2][k]);
        }
    }
    if (inU) {
        a.du = b.du = 0.5 * piece.du;
        b.u += a.du;
    } else {
        a.dv = b.dv = 0.5 * piece.dv;
        b.v += a.dv;
    }
    a.extent = extentOf(a.c);
    b.extent = extentOf(b.c);
}

/// The polynomials shared by all samples of a patch along u: the normal, dp/du x dp/dv, is linear there, and so is its
/// dot product with the place; the square of the distance is quadratic.
struct PatchRow {
    Lanes product[2], square[3]; // by power of s, which is 0 to 1
};

PatchRow patchRow(const Piece& piece, double t, Vector x)
{
    double from[3], along[3], across[3], turn[3]; // dp/dv is across + s turn
    for (int a = 0; a < 3; ++a) {
        across[a] = piece.c[3][a] - piece.c[0][a];
        const double right = piece.c[2][a] - piece.c[1][a];
        from[a] = piece.c[0][a] + t * across[a];
        along[a] = piece.c[1][a] + t * right - from[a];
        turn[a] = right - across[a];
    }
    const auto alongCross = [&](const double(&q)[3], double(&to)[3]) {
        to[0] = along[1] * q[2] - along[2] * q[1];
        to[1] = along[2] * q[0] - along[0] * q[2];
        to[2] = along[0] * q[1] - along[1] * q[0];
    };
    double normal[3], normalTurn[3];
    alongCross(across, normal);
    alongCross(turn, normalTurn);
    const Vector place = towards(from, x);
    const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    return {{dot(normal, place), dot(normalTurn, place)}, {dot(place, place), 2 * dot(along, place), all(square)}};
}

/// Integrates over a piece by Gauss rules of `pointsU` and `pointsV` points, see integratePatch().
template <int functions, typename Value>
void integratePiece(const Piece& piece, const KernelRules& rules, int pointsU, int pointsV, Vector x,
                    Lanes (&sums)[functions][4], const Value& value)
{
    for (auto& sum : sums) {
        for (Lanes& part : sum) part = all(0);
    }
    for (int j = 0; j < pointsV; ++j) {
        const double t = rules.at[pointsV][j], v = piece.v + t * piece.dv;
        const PatchRow line = patchRow(piece, t, x);
        Lanes row[functions] = {}, rowS[functions] = {};
        for (int i = 0; i < pointsU; ++i) {
            const double s = rules.at[pointsU][i];
            Lanes values[functions];
            value(line.product[0] + s * line.product[1], line.square[0] + s * (line.square[1] + s * line.square[2]),
                  values);
            for (int f = 0; f < functions; ++f) {
                const Lanes weighted = rules.weight[pointsU][i] * values[f];
                row[f] += weighted;
                rowS[f] += s * weighted;
            }
        }
        const double weight = rules.weight[pointsV][j];
        for (int f = 0; f < functions; ++f) {
            const Lanes right = piece.u * row[f] + piece.du * rowS[f], left = row[f] - right;
            const double below = weight * (1 - v), above = weight * v;
            sums[f][0] += below * left;
            sums[f][1] += below * right;
            sums[f][2] += above * right;
            sums[f][3] += above * left;
        }
    }
}

/// Integrates functions of a bilinear patch over u and v, each times the basis functions of the corners. It subdivides
/// as samplePatch() does, by lane.
///
/// value(product, square, values) gets the place's dot product with dp/du x dp/dv and its square. values[1] is for
/// functions without the product; it is scaled by the area of the piece in u and v. Returns the lanes that are too
/// near.
template <int functions, typename Value>
Mask integratePatch(const KernelCage& cage, const KernelQuad& quad, Vector x, Lanes (&sums)[functions][4],
                    const Value& value)
{
    constexpr double caution = 0.8, smallest = 1e-5; // the scalar formulas compute smaller pieces
    constexpr int room = 128;
    const KernelRules& rules = *cage.rules;
    for (auto& sum : sums) {
        for (Lanes& part : sum) part = all(0);
    }
    Mask near = Mask{};
    Piece stack[room];
    int top = 0;
    Piece& whole = stack[top++];
    for (int k = 0; k < 4; ++k) {
        for (int a = 0; a < 3; ++a) whole.c[k][a] = cage.points[quad.corner[k]][a];
    }
    whole.extent = quad.extent;
    whole.u = whole.v = 0;
    whole.du = whole.dv = 1;
    whole.lanes = ~Mask{};
    while (top > 0) {
        const Piece piece = stack[--top];
        const PatchExtent& extent = piece.extent;
        if (extent.radius < smallest) {
            near |= piece.lanes;
            continue;
        }
        const Vector ahead = towards(extent.middle, x);
        const Lanes away = squareRoot(dot(ahead, ahead));
        Lanes front = away * away;
        for (const auto& corner : piece.c) front = least(front, dot(towards(corner, x), ahead));
        const Lanes distance = caution * most(most(away - extent.radius, front / most(away, all(1e-300))), all(0));
        Lanes inU = all(rules.fewest), inV = inU;
        const double longer = larger(extent.halfU, extent.halfV);
        for (int n = rules.fewest; n <= rules.most && any(distance < rules.leastDistance[n] * longer); ++n) {
            inU = select(distance < rules.leastDistance[n] * extent.halfU, all(n + 1), inU);
            inV = select(distance < rules.leastDistance[n] * extent.halfV, all(n + 1), inV);
        }
        const Mask split = piece.lanes & (most(inU, inV) > rules.most);
        if (any(split)) {
            if (top + 2 > room) {
                near |= split;
            } else {
                halve(piece, stack[top], stack[top + 1]);
                stack[top].lanes = stack[top + 1].lanes = split;
                top += 2;
            }
        }
        Mask left = piece.lanes & ~split;
        while (any(left)) { // the lanes of one rule after the other
            const int lane = __builtin_ctz(bits(left));
            const Mask now = left & (inU == inU[lane]) & (inV == inV[lane]);
            left &= ~now;
            Lanes parts[functions][4];
            integratePiece(piece, rules, static_cast<int>(inU[lane]), static_cast<int>(inV[lane]), x, parts, value);
            for (int f = 0; f < functions; ++f) {
                const double scale = f == 0 ? 1 : piece.du * piece.dv;
                for (int k = 0; k < 4; ++k) sums[f][k] += select(now, scale * parts[f][k], all(0));
            }
        }
    }
    return near;
}

// --- Mean value coordinates

struct SeenEdge {
    Vector normal;       // of the triangle with the point, twice its area long
    Lanes angle, factor; // half the angle over the normal's length
};

/// Calls take(face, corners, count, weights) for each face; the weights are those of meanValueWeights(). Returns the
/// lanes that are too near the cage.
template <typename Take>
Mask forEachMeanValue(const KernelCage& cage, Vector x, void* scratch, const Take& take)
{
    auto* const corners = static_cast<Corner*>(scratch);
    auto* const edges = reinterpret_cast<SeenEdge*>(corners + cage.pointCount);
    Mask near = Mask{};
    seeCorners(cage, x, corners);
    for (std::size_t i = 0; i < cage.edgeCount; ++i) {
        const Corner &a = corners[cage.edges[i].from], &b = corners[cage.edges[i].to];
        const Vector normal = cross(a.place, b.place);
        const Lanes length = squareRoot(dot(normal, normal));
        const Lanes angle = angleOf(length, dot(a.place, b.place));
        edges[i] = {normal, angle, 0.5 * angle / most(length, all(1e-300))};
        near |= (angle > pi - 1e-4) | (least(a.distance, b.distance) < tooNear);
    }
    for (std::size_t face = 0; face < cage.triangleCount; ++face) {
        const KernelTriangle& t = cage.triangles[face];
        Vector normals[3], mean{};
        Lanes widest = all(0), product = all(1);
        for (int i = 0; i < 3; ++i) {
            const SeenEdge& edge = edges[t.edge[i]];
            normals[i] = all(t.sign[i]) * edge.normal;
            mean = mean + edge.factor * normals[i];
            widest = most(widest, edge.angle);
            product *= corners[t.corner[i]].distance;
        }
        const Lanes determinant = dot(corners[t.corner[0]].place, normals[0]), size = abs(determinant);
        const Lanes square = dot(mean, mean);
        near |= (size <= 1e-11 * t.area) & (square > 1); // on the face, not only in its plane
        const Mask good = (size > 1e-3 * widest * widest * product) | ((square > 0.05 * 0.05) & (determinant != 0));
        Lanes weights[3];
        for (int i = 0; i < 3; ++i) weights[i] = dot(mean, normals[i]) / determinant;
        unsigned bad = t.sliver ? bits(~Mask{}) : bits(~good & ~near);
        for (; bad != 0; bad &= bad - 1) {
            const int lane = __builtin_ctz(bad);
            const double place[3] = {x.x[lane], x.y[lane], x.z[lane]};
            double exact[4] = {};
            if (!exactMeanValue(*cage.cage, face, place, exact)) near[lane] = -1;
            for (int i = 0; i < 3; ++i) weights[i][lane] = exact[i];
        }
        take(face, t.corner, 3, weights);
    }
    for (std::size_t q = 0; q < cage.quadCount; ++q) {
        const KernelQuad& quad = cage.quads[q];
        Lanes weights[1][4];
        near |= integratePatch(cage, quad, x, weights,
                               [](Lanes product, Lanes square, Lanes* value) { *value = product / (square * square); });
        take(cage.triangleCount + q, quad.corner, 4, weights[0]);
    }
    return near;
}

unsigned meanValueRows(const KernelCage& cage, const double (*x)[packetSize], void* scratch, double (*rows)[packetSize])
{
    unsigned leftOut = 0;
    for (int first = 0; first < packetSize; first += width) {
        const Vector place = placesOf(x, first);
        const auto at = [&](std::size_t column) { return &rows[column][first]; };
        for (std::size_t i = 0; i < cage.pointCount; ++i) store(all(0), at(i));
        Mask near = forEachMeanValue(cage, place, scratch,
                                     [&](std::size_t, const std::uint32_t* corners, int count, const Lanes* weights) {
                                         for (int k = 0; k < count; ++k) add(weights[k], at(corners[k]));
                                     });
        Lanes sum = all(0), size = all(0);
        for (std::size_t i = 0; i < cage.pointCount; ++i) {
            sum += load(at(i));
            size += abs(load(at(i)));
        }
        near |= ~(abs(sum) > 0.5 * size); // far outside they cancel, and digits are lost
        leftOut |= bits(near) << first;
        restorePrecision(cage, place, rows, first, sum, Vector{});
    }
    return leftOut;
}

// --- Green and Somigliana coordinates

struct SeenPotential {
    Lanes potential; // -1 where the scalar formula computes it
    Lanes product;   // the dot product of its ends' places
};

void seePotentials(const KernelCage& cage, const Corner* corners, SeenPotential* edges)
{
    for (std::size_t i = 0; i < cage.edgeCount; ++i) {
        const KernelEdge& edge = cage.edges[i];
        const Corner &a = corners[edge.from], &b = corners[edge.to];
        const Lanes sum = a.distance + b.distance;
        const Mask far = edge.length < mostQuotient * sum;
        const Lanes potential = 2 * areaTangent(select(far, all(edge.length), all(0)), sum);
        edges[i] = {select(far, potential, all(-1)), dot(a.place, b.place)};
    }
}

/// The potentials of a triangle, see TrianglePotentials; edge i is opposite corner i.
struct SeenTriangle {
    Lanes height, solid, single, potentials[3], feet[3], hatSolid[3];
    Mask bad; // for the scalar formula
};

SeenTriangle seeTriangle(const KernelCage& cage, const KernelTriangle& t, const Corner* corners,
                         const SeenPotential* edges)
{
    SeenTriangle seen;
    const Corner &a = corners[t.corner[0]], &b = corners[t.corner[1]], &c = corners[t.corner[2]];
    seen.height = dot(t.normal, a.place);
    const Lanes below = a.distance * b.distance * c.distance + edges[t.edge[2]].product * c.distance +
                        edges[t.edge[0]].product * a.distance + edges[t.edge[1]].product * b.distance;
    seen.solid = signedBy(2 * angleOf(abs(seen.height) * t.area, below), seen.height);
    seen.single = -seen.height * seen.solid;
    seen.bad = t.sliver ? ~Mask{} : Mask{};
    for (int i = 0; i < 3; ++i) {
        seen.potentials[i] = edges[t.edge[i]].potential;
        seen.bad |= seen.potentials[i] < 0;
        seen.feet[i] = dot(t.outward[i], corners[t.corner[(i + 1) % 3]].place);
        seen.single += seen.feet[i] * seen.potentials[i];
    }
    for (int i = 0; i < 3; ++i) {
        const Lanes turned = t.along[i][0] * seen.potentials[0] + t.along[i][1] * seen.potentials[1] +
                             t.along[i][2] * seen.potentials[2];
        const double scale = cage.edges[t.edge[i]].length / t.area;
        seen.hatSolid[i] = scale * seen.feet[i] * seen.solid + seen.height * turned;
    }
    return seen;
}

/// Calls replace(lane, place) for each lane that the scalar formula computes.
template <typename Replace>
void forEachBad(Mask bad, Vector x, const Replace& replace)
{
    for (unsigned left = bits(bad); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const double place[3] = {x.x[lane], x.y[lane], x.z[lane]};
        replace(lane, place);
    }
}

/// Computes rows that begin with the solid angles of the points' hat functions. faces(x, first, corners, edges, near)
/// adds them, stores the other columns and marks lanes that are too near. It returns the part of the place at rest that
/// the normals add.
template <typename Faces>
unsigned solidAngleRows(const KernelCage& cage, const double (*x)[packetSize], void* scratch,
                        double (*rows)[packetSize], const Faces& faces)
{
    unsigned leftOut = 0;
    for (int first = 0; first < packetSize; first += width) {
        const Vector place = placesOf(x, first);
        auto* const corners = static_cast<Corner*>(scratch);
        auto* const edges = reinterpret_cast<SeenPotential*>(corners + cage.pointCount);
        Mask near = Mask{};
        seeCorners(cage, place, corners);
        seePotentials(cage, corners, edges);
        for (std::size_t i = 0; i < cage.pointCount; ++i) store(all(0), &rows[i][first]);
        const Vector normals = faces(place, first, corners, edges, near);
        Lanes sum = all(0);
        for (std::size_t i = 0; i < cage.pointCount; ++i) sum += load(&rows[i][first]);
        near |= ~(abs(1 - sum) < 1e-8); // digits are lost, or the point is on the cage or outside
        restorePrecision(cage, place, rows, first, sum, normals);
        leftOut |= bits(near) << first;
    }
    return leftOut;
}

unsigned greenRows(const KernelCage& cage, const double (*x)[packetSize], void* scratch, double (*rows)[packetSize])
{
    return solidAngleRows(
        cage, x, scratch, rows,
        [&](Vector place, int first, const Corner* corners, const SeenPotential* edges, Mask& near) {
            const auto at = [&](std::size_t column) { return &rows[column][first]; };
            Vector normals{};
            const auto storeNormal = [&](Lanes weight, std::size_t k) {
                const double(&normal)[3] = cage.normals[k];
                store(weight, at(cage.pointCount + k));
                normals = normals + weight * Vector{all(normal[0]), all(normal[1]), all(normal[2])};
            };
            for (std::size_t face = 0; face < cage.triangleCount; ++face) {
                const KernelTriangle& t = cage.triangles[face];
                const SeenTriangle seen = seeTriangle(cage, t, corners, edges);
                Lanes positions[3], normal = seen.single / (fourPi * t.area);
                for (int i = 0; i < 3; ++i) positions[i] = seen.hatSolid[i] / fourPi;
                forEachBad(seen.bad & ~near, place, [&](int lane, const double(&from)[3]) {
                    double exact[3] = {}, exactNormal = 0;
                    if (!exactGreen(*cage.cage, face, from, exact, exactNormal)) near[lane] = -1;
                    for (int i = 0; i < 3; ++i) positions[i][lane] = exact[i];
                    normal[lane] = exactNormal;
                });
                for (int i = 0; i < 3; ++i) add(positions[i], at(t.corner[i]));
                storeNormal(normal, face);
            }
            for (std::size_t q = 0; q < cage.quadCount; ++q) {
                const KernelQuad& quad = cage.quads[q];
                Lanes sums[2][4];
                near |= integratePatch(cage, quad, place, sums, [](Lanes product, Lanes square, Lanes* values) {
                    const Lanes inverse = 1 / (square * squareRoot(square));
                    values[0] = product * inverse;
                    values[1] = square * inverse;
                });
                for (int k = 0; k < 4; ++k) {
                    add(sums[0][k] / fourPi, at(quad.corner[k]));
                    storeNormal(sums[1][k] / fourPi, cage.triangleCount + 4 * q + static_cast<std::size_t>(k));
                }
            }
            return normals;
        });
}

unsigned somiglianaRows(const KernelCage& cage, const double (*x)[packetSize], void* scratch,
                        double (*rows)[packetSize])
{
    return solidAngleRows(
        cage, x, scratch, rows,
        [&](Vector place, int first, const Corner* corners, const SeenPotential* edges, Mask& near) {
            const auto at = [&](std::size_t column) { return &rows[column][first]; };
            Vector normals{};
            for (std::size_t face = 0; face < cage.triangleCount; ++face) {
                const KernelTriangle& t = cage.triangles[face];
                const SeenTriangle seen = seeTriangle(cage, t, corners, edges);
                Lanes m[somiglianaWeights] = {
                    seen.height * seen.solid, all(0), all(0), seen.single, all(0), seen.single};
                for (int i = 0; i < 3; ++i) {
                    const double m1 = t.flat[i][0], m2 = t.flat[i][1];
                    const Lanes across = seen.feet[i] * seen.potentials[i];
                    const Lanes along =
                        corners[t.corner[(i + 2) % 3]].distance - corners[t.corner[(i + 1) % 3]].distance;
                    const Lanes e1 = across * m1 - along * m2, e2 = across * m2 + along * m1;
                    const Lanes raised = seen.height * seen.potentials[i];
                    m[1] -= raised * m1;
                    m[2] -= raised * m2;
                    m[3] -= e1 * m1;
                    m[4] -= 0.5 * (e1 * m2 + e2 * m1);
                    m[5] -= e2 * m2;
                }
                Lanes positions[3];
                for (int i = 0; i < 3; ++i) positions[i] = seen.hatSolid[i] / fourPi;
                for (Lanes& entry : m) entry /= fourPi;
                forEachBad(seen.bad & ~near, place, [&](int lane, const double(&from)[3]) {
                    double exact[3] = {}, matrix[somiglianaWeights] = {};
                    if (!exactSomigliana(*cage.cage, face, from, exact, matrix)) near[lane] = -1;
                    for (int i = 0; i < 3; ++i) positions[i][lane] = exact[i];
                    for (std::size_t i = 0; i < somiglianaWeights; ++i) m[i][lane] = matrix[i];
                });
                for (int i = 0; i < 3; ++i) add(positions[i], at(t.corner[i]));
                for (std::size_t i = 0; i < somiglianaWeights; ++i) {
                    store(m[i], at(cage.pointCount + somiglianaWeights * face + i));
                }
                const Lanes trace = m[0] + m[3] + m[5];
                normals = normals + trace * Vector{all(t.normal[0]), all(t.normal[1]), all(t.normal[2])};
            }
            return normals;
        });
}

// --- Maximum likelihood coordinates

struct SeenFace {
    Vector vector;
    Lanes weights[4];
};

/// Does the same as balance() of likelihood.cpp. Returns the lanes where it did not converge.
Mask balance(const SeenFace* faces, std::size_t count, Vector& s)
{
    constexpr int mostSteps = 100;
    constexpr double damped = 0.3, done = 1e-16; // of Newton's decrement, and of its square
    s = Vector{};
    Mask active = ~Mask{};
    for (int step = 0; step < mostSteps && any(active); ++step) {
        Vector gradient{};
        Lanes xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
        for (std::size_t i = 0; i < count; ++i) {
            const Vector z = (1 / (1 + dot(s, faces[i].vector))) * faces[i].vector;
            gradient = gradient + z;
            xx += z.x * z.x;
            xy += z.x * z.y;
            xz += z.x * z.z;
            yy += z.y * z.y;
            yz += z.y * z.z;
            zz += z.z * z.z;
        }
        const Vector a{yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy};
        const Lanes determinant = xx * a.x + xy * a.y + xz * a.z;
        const Vector b{a.y, xx * zz - xz * xz, xy * xz - xx * yz}, c{a.z, b.z, xx * yy - xy * xy};
        const Vector solved{dot(a, gradient), dot(b, gradient), dot(c, gradient)};
        const Lanes square = dot(solved, gradient) / determinant;
        const Mask regular = (determinant > 0) & (square >= 0);
        const Lanes decrement = squareRoot(select(regular, square, all(0)));
        const Lanes length = select(decrement > damped, 1 / (1 + decrement), all(1)) / determinant;
        const Mask moves = active & regular;
        const Vector to = s + length * solved;
        s = Vector{select(moves, to.x, s.x), select(moves, to.y, s.y), select(moves, to.z, s.z)};
        active &= ~(regular & (square < done));
        if (!any(active & regular)) break;
    }
    return active;
}

unsigned likelihoodRows(const KernelCage& cage, const double (*x)[packetSize], void* scratch,
                        double (*rows)[packetSize])
{
    constexpr double nearby = 0.02; // as in likelihood.cpp
    unsigned leftOut = 0;
    const std::size_t faceCount = cage.triangleCount + cage.quadCount;
    auto* const faces = static_cast<SeenFace*>(scratch);
    for (int first = 0; first < packetSize; first += width) {
        const Vector place = placesOf(x, first);
        const auto at = [&](std::size_t column) { return &rows[column][first]; };
        Lanes winding = all(0);
        Mask bad = forEachMeanValue(cage, place, faces + faceCount,
                                    [&](std::size_t f, const std::uint32_t* corners, int count, const Lanes* weights) {
                                        SeenFace& face = faces[f];
                                        Vector vector{};
                                        Lanes total = all(0);
                                        for (int k = 0; k < count; ++k) {
                                            winding += weights[k];
                                            face.weights[k] = abs(weights[k]);
                                            total += face.weights[k];
                                            vector = vector + face.weights[k] * towards(cage.points[corners[k]], place);
                                        }
                                        const Lanes distance = squareRoot(dot(vector, vector)) / total + nearby;
                                        const Lanes locality = select(total > 0, 1 / (distance * distance), all(0));
                                        for (int k = 0; k < count; ++k) face.weights[k] *= locality;
                                        face.vector = locality * vector;
                                    });
        bad |= ~(winding > 0);
        Vector s{};
        bad |= balance(faces, faceCount, s);
        for (std::size_t i = 0; i < cage.pointCount; ++i) store(all(0), at(i));
        Lanes sum = all(0);
        for (std::size_t f = 0; f < faceCount; ++f) {
            const Lanes factor = 1 / (1 + dot(s, faces[f].vector));
            const bool isQuad = f >= cage.triangleCount;
            const std::uint32_t* const corners =
                isQuad ? cage.quads[f - cage.triangleCount].corner : cage.triangles[f].corner;
            for (int k = 0; k < (isQuad ? 4 : 3); ++k) {
                const Lanes weight = factor * faces[f].weights[k];
                add(weight, at(corners[k]));
                sum += weight;
            }
        }
        for (std::size_t i = 0; i < cage.pointCount; ++i) store(load(at(i)) / sum, at(i));
        leftOut |= bits(bad) << first;
    }
    return leftOut;
}

// --- Combinations of rows

typedef float Floats __attribute__((vector_size(8 * width)));
constexpr std::size_t floatStep = 2 * width, floatParts = floatLanes / floatStep;

Floats loadFloats(const float* from)
{
    Floats lanes;
    __builtin_memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

/// Returns the sum of `floatLanes` numbers, in order.
float sumOf(const Floats* parts)
{
    float sum = 0;
    for (std::size_t part = 0; part < floatParts; ++part) {
        for (std::size_t i = 0; i < floatStep; ++i) sum += parts[part][i];
    }
    return sum;
}

/// Projects `count` rows. Their sums are independent, so none waits for another.
template <std::size_t count>
void projectTogether(float* const* rows, const float* pivot, float inverseSquare, std::size_t columns, float* factors,
                     float* sizes)
{
    typedef std::int32_t Bits __attribute__((vector_size(sizeof(Floats))));
    Floats sums[count][floatParts] = {};
    for (std::size_t k = 0; k < columns; k += floatLanes) {
        for (std::size_t part = 0; part < floatParts; ++part) {
            const std::size_t at = k + part * floatStep;
            for (std::size_t r = 0; r < count; ++r) {
                sums[r][part] += loadFloats(rows[r] + at) * loadFloats(pivot + at);
            }
        }
    }
    for (std::size_t r = 0; r < count; ++r) {
        factors[r] = inverseSquare * sumOf(sums[r]);
        for (Floats& sum : sums[r]) sum = Floats{};
    }
    for (std::size_t k = 0; k < columns; k += floatLanes) {
        for (std::size_t part = 0; part < floatParts; ++part) {
            const std::size_t at = k + part * floatStep;
            for (std::size_t r = 0; r < count; ++r) {
                const Floats left = loadFloats(rows[r] + at) - factors[r] * loadFloats(pivot + at);
                __builtin_memcpy(rows[r] + at, &left, sizeof left);
                sums[r][part] += (Floats)((Bits)left & INT32_MAX);
            }
        }
    }
    for (std::size_t r = 0; r < count; ++r) sizes[r] = sumOf(sums[r]);
}

void projectRows(float* const* rows, std::size_t count, const float* pivot, float inverseSquare, std::size_t columns,
                 float* factors, float* sizes)
{
    constexpr std::size_t together = 4;
    std::size_t r = 0;
    for (; r + together <= count; r += together) {
        projectTogether<together>(rows + r, pivot, inverseSquare, columns, factors + r, sizes + r);
    }
    for (; r < count; ++r) projectTogether<1>(rows + r, pivot, inverseSquare, columns, factors + r, sizes + r);
}

static_assert(sizeof(Corner) == 4 * sizeof(Lanes) && sizeof(SeenEdge) == 5 * sizeof(Lanes) &&
                  sizeof(SeenFace) == 7 * sizeof(Lanes),
              "scratchSize() counts them");

} // namespace

const RowKernels VDBCAGE_KERNELS = {VDBCAGE_INSTRUCTIONS, meanValueRows,  greenRows,
                                    likelihoodRows,       somiglianaRows, projectRows};

} // namespace vdbcage::detail
