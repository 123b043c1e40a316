// Which voxels of a column along z a triangle touches, and in which it crosses the rays through voxel centres; what
// vdbcage/voxelize/detail/face_scan.h says, bit for bit.
//
// Exact. A border between yes and no is guessed in floats to within half a voxel, and decided at the voxel next to it
// in doubles that hold whole numbers, or whole numbers by latticeStep, of at most 53 bits: sums and products of them
// have no rounding, fused or not. Sizes, up to resolution 4096 with positions counted from the middle of the
// triangle's box: positions 2^25, edges 2^26, twice the area of a projection 2^52, voxel indices 2^11. Products of the
// normal and a position are longer and are kept as high * limb + low.

const int latticeBits = 14;
const int latticeStep = 1 << latticeBits;
const int latticeReach = latticeStep / 2 + 1;
const double limb = 134217728.0LF; // 2^27

/// The planes of the grid that are worked on, and the words of 32 voxels: surface first, then the crossings of the
/// rays along x, y and z.
uniform int firstPlane;
uniform int rowsPerPlane;
uniform int wordsPerRow;
uniform int wordsPerGrid;

/// Or and exclusive or into a word, atomic; each path has its own.
void orWord(int at, uint bits);
void xorWord(int at, uint bits);

/// A triangle in its box of voxels, positions and indices counted from the voxel `middle`.
struct Face {
    ivec3 middle;
    ivec3 first, last; // the box
    dvec3 corners[3];  // lattice units
    dvec3 normal;      // twice the signed areas of the projections along x, y, z; the last is not negative
    dvec3 normalHigh, normalLow;
    dvec2 atCorner; // normal . corners[0]: high and low
    bvec3 edgesMatter;
    bvec3 crosses;
    bool planeMatters;
};

/// What holds for a whole row of columns: spans, ends included, of y or z.
struct Row {
    int x;
    ivec2 touchedY, touchedZ, centredY, centredZ;
};

const ivec2 nothing = ivec2(1, 0);

bool isEmpty(ivec2 span)
{
    return span.y < span.x;
}

ivec2 both(ivec2 a, ivec2 b)
{
    return ivec2(max(a.x, b.x), min(a.y, b.y));
}

double signOf(double number)
{
    return number < 0.0LF ? -1.0LF : 1.0LF;
}

Face makeFace(ivec3 a, ivec3 b, ivec3 c, bool counted)
{
    const ivec3 low = min(a, min(b, c)), high = max(a, max(b, c));
    Face face;
    const ivec3 first = (low - latticeReach + latticeStep - 1) >> latticeBits;
    const ivec3 last = (high + latticeReach) >> latticeBits;
    face.middle = (first + last) >> 1;
    face.first = first - face.middle;
    face.last = last - face.middle;
    const bvec3 hasCentres = lessThanEqual((low + latticeStep - 1) >> latticeBits, high >> latticeBits);
    const bvec3 wide = greaterThan(last, first);
    face.edgesMatter = bvec3(wide.y && wide.z, wide.x && wide.z, wide.x && wide.y);
    face.planeMatters = all(wide);

    const ivec3 origin = face.middle * latticeStep;
    face.corners[0] = dvec3(a - origin);
    face.corners[1] = dvec3(b - origin);
    face.corners[2] = dvec3(c - origin);
    const dvec3 d = face.corners[1] - face.corners[0], e = face.corners[2] - face.corners[0];
    face.normal = dvec3(d.y * e.z - d.z * e.y, d.z * e.x - d.x * e.z, d.x * e.y - d.y * e.x);
    if (face.normal.z < 0.0LF) {
        const dvec3 corner = face.corners[1];
        face.corners[1] = face.corners[2];
        face.corners[2] = corner;
        face.normal = -face.normal;
    }
    face.normalHigh = round(face.normal * (1.0LF / limb));
    face.normalLow = face.normal - face.normalHigh * limb;
    const double low0 = dot(face.normalLow, face.corners[0]);
    const double carry = round(low0 * (1.0LF / limb));
    face.atCorner = dvec2(dot(face.normalHigh, face.corners[0]) + carry, low0 - carry * limb);

    face.crosses = bvec3(counted && face.normal.x != 0.0LF && hasCentres.y && hasCentres.z,
                         counted && face.normal.y != 0.0LF && hasCentres.x && hasCentres.z,
                         counted && face.normal.z != 0.0LF && hasCentres.x && hasCentres.y);
    return face;
}

/// Takes from `span` the v that are not in the half plane direction.x * v - direction.y * u >= threshold.
void clip(inout ivec2 span, dvec2 direction, double threshold, int u)
{
    const double rest = threshold + direction.y * u;
    if (direction.x == 0.0LF) {
        if (rest > 0.0LF) span = nothing;
        return;
    }
    const float guess = clamp(float(rest) / float(direction.x), float(span.x - 1), float(span.y + 1));
    const int near = int(round(guess));
    const bool holds = direction.x * near >= rest;
    if (direction.x > 0.0LF) {
        span.x = max(span.x, holds ? near : near + 1);
    } else {
        span.y = min(span.y, holds ? near : near - 1);
    }
}

/// Clips by the half plane to the left of an edge from p, widened for squares of half width `reach`, or narrowed by
/// `less`.
void clipByEdge(inout ivec2 span, dvec2 p, dvec2 direction, int u, double reach, double less)
{
    const double atOrigin = direction.y * p.x - direction.x * p.y;
    const double room = reach * (abs(direction.x) + abs(direction.y)) - less;
    clip(span, direction, (atOrigin + room) * (-1.0LF / latticeStep), u);
}

/// The v of `span` where the square of voxel (u, v) touches the projection (a, b, c) or, where it has no area, the line
/// that it lies on. `area` is twice the signed area.
ivec2 touched(dvec2 a, dvec2 b, dvec2 c, double area, int u, ivec2 span)
{
    const double reach = latticeReach;
    if (area == 0.0LF) {
        const bool point = a == b;
        const dvec2 direction = point ? c - b : b - a;
        clipByEdge(span, a, direction, u, reach, 0.0LF);
        clipByEdge(span, a, -direction, u, reach, 0.0LF);
        return span;
    }
    const double side = signOf(area);
    clipByEdge(span, a, side * (b - a), u, reach, 0.0LF);
    clipByEdge(span, b, side * (c - b), u, reach, 0.0LF);
    clipByEdge(span, c, side * (a - c), u, reach, 0.0LF);
    return span;
}

/// Centres on an edge are in the projection of one of its two triangles: see Projection::centred.
void clipByCentredEdge(inout ivec2 span, dvec2 p, dvec2 direction, int u)
{
    const bool keepsTies = direction.y < 0.0LF || (direction.y == 0.0LF && direction.x > 0.0LF);
    clipByEdge(span, p, direction, u, 0.0LF, keepsTies ? 0.0LF : 1.0LF);
}

/// The v of `span` where the centre of voxel (u, v) lies in the projection, which has an area.
ivec2 centred(dvec2 a, dvec2 b, dvec2 c, double area, int u, ivec2 span)
{
    const double side = signOf(area);
    clipByCentredEdge(span, a, side * (b - a), u);
    clipByCentredEdge(span, b, side * (c - b), u);
    clipByCentredEdge(span, c, side * (a - c), u);
    return span;
}

/// Takes from `span` the z of column (x, y) where normal . (centre - corner) is below -room or above room - less.
void clipByPlane(inout ivec2 span, Face face, int x, int y, dvec2 room, double less)
{
    const dvec2 perZ = dvec2(face.normalHigh.z, face.normalLow.z);
    const dvec2 here = dvec2(face.normalHigh.x * x + face.normalHigh.y * y, face.normalLow.x * x + face.normalLow.y * y);
    const double unit = 1.0LF / latticeStep;
    // perZ * z >= from, perZ * z <= to
    const dvec2 from = (face.atCorner - room) * unit - here;
    const dvec2 to = (face.atCorner + room - dvec2(0.0LF, less)) * unit - here;
    const double fromWhole = from.x * limb + from.y, toWhole = to.x * limb + to.y;
    if (face.normal.z == 0.0LF) {
        if (fromWhole > 0.0LF || toWhole < 0.0LF) span = nothing;
        return;
    }
    const vec2 ends = vec2(float(span.x - 1), float(span.y + 1));
    const float slope = float(face.normal.z);
    const int first = int(round(clamp(float(fromWhole) / slope, ends.x, ends.y)));
    const int last = int(round(clamp(float(toWhole) / slope, ends.x, ends.y)));
    const dvec2 atFirst = perZ * first - from, atLast = to - perZ * last;
    span.x = max(span.x, atFirst.x * limb + atFirst.y >= 0.0LF ? first : first + 1);
    span.y = min(span.y, atLast.x * limb + atLast.y >= 0.0LF ? last : last - 1);
}

Row makeRow(Face face, int x)
{
    const dvec2 a = face.corners[0].xy, b = face.corners[1].xy, c = face.corners[2].xy;
    const dvec2 p = face.corners[0].xz, q = face.corners[1].xz, r = face.corners[2].xz;
    const ivec2 ys = ivec2(face.first.y, face.last.y), zs = ivec2(face.first.z, face.last.z);
    Row row;
    row.x = x;
    row.touchedY = face.edgesMatter.z ? touched(a, b, c, face.normal.z, x, ys) : ys;
    // Along y the order (x, z) of the axes turns the sense of rotation round.
    row.touchedZ = face.edgesMatter.y ? touched(p, q, r, -face.normal.y, x, zs) : zs;
    row.centredY = face.crosses.z ? centred(a, b, c, face.normal.z, x, ys) : nothing;
    row.centredZ = face.crosses.y ? centred(p, q, r, -face.normal.y, x, zs) : nothing;
    return row;
}

/// The word of a row and the bits of it that hold the voxels of `run`.
int wordOf(int z)
{
    return z >> 5;
}
uint bitsIn(int word, ivec2 run)
{
    const int first = max(run.x - 32 * word, 0), last = min(run.y - 32 * word, 31);
    return (0xffffffffu << first) & (0xffffffffu >> (31 - last));
}

/// Flips the voxels of `inside` where the crossing of a ray along this axis lies in the voxel.
void flipCrossings(Face face, Row row, int y, int axis, ivec2 inside, int at)
{
    // A voxel holds a crossing if the plane's value at its centre is within half a cell of zero.
    const dvec2 cell = signOf(face.normal[axis]) * (latticeStep / 2) * dvec2(face.normalHigh[axis], face.normalLow[axis]);
    clipByPlane(inside, face, row.x, y, cell, 1.0LF);
    if (isEmpty(inside)) return;
    const ivec2 run = inside + face.middle.z;
    for (int word = wordOf(run.x); word <= wordOf(run.y); ++word) {
        xorWord(at + (1 + axis) * wordsPerGrid + word, bitsIn(word, run));
    }
}

/// Sets what the triangle touches in column (row.x, y) of its box, where y lies in row.touchedY, and flips the
/// crossings that it has there.
void scanColumn(Face face, Row row, int y)
{
    const dvec2 a = face.corners[0].yz, b = face.corners[1].yz, c = face.corners[2].yz;
    const ivec2 zs = ivec2(face.first.z, face.last.z);
    ivec2 span = row.touchedZ;
    if (face.edgesMatter.x) span = both(span, touched(a, b, c, face.normal.x, y, zs));
    if (face.planeMatters && !isEmpty(span)) {
        const dvec3 signs = dvec3(signOf(face.normal.x), signOf(face.normal.y), signOf(face.normal.z));
        const dvec2 reach = latticeReach * dvec2(dot(signs, face.normalHigh), dot(signs, face.normalLow));
        clipByPlane(span, face, row.x, y, reach, 0.0LF);
    }
    if (isEmpty(span)) return;

    const ivec3 voxel = face.middle + ivec3(row.x, y, 0);
    const int at = ((voxel.x - firstPlane) * rowsPerPlane + voxel.y) * wordsPerRow;
    const ivec2 run = span + voxel.z;
    for (int word = wordOf(run.x); word <= wordOf(run.y); ++word) orWord(at + word, bitsIn(word, run));

    if (face.crosses.x) {
        const ivec2 inside = centred(a, b, c, face.normal.x, y, zs);
        if (!isEmpty(inside)) flipCrossings(face, row, y, 0, inside, at);
    }
    if (!isEmpty(row.centredZ)) flipCrossings(face, row, y, 1, row.centredZ, at);
    if (row.centredY.x <= y && y <= row.centredY.y) flipCrossings(face, row, y, 2, zs, at);
}
