// Based on: Thiery, Michel, Chen, "Biharmonic Coordinates and their Derivatives for Triangular 3D Cages", 2024; Weber,
// Poranne, Gotsman, "Biharmonic Coordinates", 2012.
// Differs: the Laplacian's data are found from both of its equations at all points of the cage and at the middles of
// all faces, by regularised least squares, see `laplaciansOf`. Points on the cage are the limit from inside: the
// difference of the solid angles from the whole sphere belongs to the nearest place of the cage, as in green.cpp.

#include <vdbcage/deform/detail/families/biharmonic.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/families/patch_quadrature.h>
#include <vdbcage/deform/detail/stretched_normals.h>
#include <vdbcage/deform/detail/triangle_potentials.h>
#include <vdbcage/deform/detail/triangles.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

BiharmonicPart integrated(const std::array<Vec3d, 3>& c)
{
    BiharmonicPart part;
    samplePatch({c[0], c[1], c[2], c[2]}, 1e-10, [&](const PatchSample& sample) {
        const double square = sample.point.lengthSqr(), distance = std::sqrt(square);
        const double height = sample.point.dot(sample.normal);
        const double solid = height / (fourPi * square * distance), bent = -height / (2 * fourPi * distance);
        const std::array<double, 3> hats{sample.basis[0], sample.basis[1], sample.basis[2] + sample.basis[3]};
        for (std::size_t i = 0; i < 3; ++i) {
            part.values[i] += solid * hats[i];
            part.laplacians[i] += bent * hats[i];
        }
        const double density = sample.area * (sample.basis[0] + sample.basis[1]); // of (u, v) on the triangle
        part.slope += density / (fourPi * distance);
        part.laplacianSlope += density * distance / (2 * fourPi);
    });
    return part;
}

/// Computes the closed form. In the plane, from the origin's foot on it, the gradient of the distance r is the foot's
/// offset over r. By the divergence theorem, integrals of r and its powers over the triangle thus become integrals
/// along the edges.
BiharmonicPart closedForm(const std::array<Vec3d, 3>& c, bool onFace)
{
    const TrianglePotentials t = trianglePotentials(c, onFace);
    BiharmonicPart part;
    Vec3d offset(0);     // the integral of the offset over r
    double distance = 0; // the integral of r
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d &from = c[i], &to = c[(i + 1) % 3];
        const double square = t.foot[i] * t.foot[i] + t.height * t.height; // of the distance to the edge's line
        const double ends = to.dot(t.along[i]) * to.length() - from.dot(t.along[i]) * from.length();
        const double alongEdge = 0.5 * (ends + square * t.edge[i]); // the integral of r
        offset += alongEdge * t.outward(i);
        distance += t.foot[i] * alongEdge;
    }
    distance = (distance + t.height * t.height * t.single) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d &from = c[(i + 1) % 3], &to = c[(i + 2) % 3];
        const double atFoot = t.normal.dot(from.cross(to)) / t.area; // the corner's hat function
        const Vec3d gradient = t.normal.cross(to - from) / t.area;   // the gradient of the hat function
        part.values[i] = t.hatSolid[i] / fourPi;
        part.laplacians[i] = -t.height * (atFoot * t.single + gradient.dot(offset)) / (2 * fourPi);
    }
    part.slope = t.single / (fourPi * t.area);
    part.laplacianSlope = distance / (2 * fourPi * t.area);
    return part;
}

/// The factors of the whole cage's data at a point, before the solid angles are completed.
struct Potentials {
    double* data;       ///< of values, then of derivatives
    double* laplacians; ///< both of the Laplacian
    std::size_t stride; ///< from number to number, of both
};

/// Returns the difference of the solid angles from the whole sphere.
double addPotentials(const UnitCage& cage, const Vec3d& x, bool touches, const Potentials& to)
{
    const std::size_t points = cage.points().size();
    double lacking = 1;
    for (std::size_t i = 0; i < cage.faces().size(); ++i) {
        const UnitCage::Face& face = cage.faces()[i];
        const PatchCorners c = cage.cornersFrom(face, x);
        const bool onFace = touches && cage.nearestOf(i, x).distance <= 2 * UnitCage::touching;
        const BiharmonicPart part = biharmonicPart({c[0], c[1], c[2]}, onFace);
        for (std::size_t k = 0; k < 3; ++k) {
            to.data[face.at[k] * to.stride] += part.values[k];
            to.laplacians[face.at[k] * to.stride] += part.laplacians[k];
            lacking -= part.values[k];
        }
        to.data[(points + i) * to.stride] = part.slope;
        to.laplacians[(points + i) * to.stride] = part.laplacianSlope;
    }
    return lacking;
}

// --- Dense matrices, in square tiles. Every number of a tile is a sum in the order of the rows, by one thread.

constexpr std::size_t tile = 64;

class Matrix {
public:
    explicit Matrix(std::size_t size) : size_(size), numbers_(size * size, 0.0) {}

    std::size_t size() const { return size_; }
    double* row(std::size_t i) { return numbers_.data() + i * size_; }
    const double* row(std::size_t i) const { return numbers_.data() + i * size_; }

private:
    std::size_t size_;
    std::vector<double> numbers_;
};

/// A part of a matrix.
template <typename Number>
struct View {
    Number* at;
    std::size_t stride; ///< from row to row
    Number* row(std::size_t i) const { return at + i * stride; }
};

/// Packs numbers of a view side by side, for the cache: `depth` rows of a tile's width, filled up with zeros.
void pack(View<const double> from, std::size_t depth, std::size_t columns, double* to)
{
    for (std::size_t k = 0; k < depth; ++k, to += tile) {
        std::fill(std::copy_n(from.row(k), columns, to), to + tile, 0.0);
    }
}

/// Adds `factor` times the product of the transpose of `a`, which has `depth` rows of `rows` numbers, and `b`, which
/// has as many rows of `columns` numbers. Neither is wider than a tile.
void addProduct(double factor, View<const double> a, View<const double> b, std::size_t depth, View<double> to,
                std::size_t rows, std::size_t columns)
{
    typedef double Pair __attribute__((vector_size(16)));
    constexpr std::size_t side = 4; // registers hold the sums of a square of this side
    constexpr std::size_t most = 128;
    std::vector<double> packed(2 * most * tile);
    for (std::size_t begin = 0; begin < depth; begin += most) {
        const std::size_t count = std::min(most, depth - begin);
        double *const lefts = packed.data(), *const rights = lefts + most * tile;
        pack({a.row(begin), a.stride}, count, rows, lefts);
        pack({b.row(begin), b.stride}, count, columns, rights);
        for (std::size_t i = 0; i < rows; i += side) {
            for (std::size_t j = 0; j < columns; j += side) {
                Pair sums[side][2] = {};
                const double *left = lefts + i, *right = rights + j;
                for (std::size_t k = 0; k < count; ++k, left += tile, right += tile) {
                    const Pair low{right[0], right[1]}, high{right[2], right[3]};
                    for (std::size_t p = 0; p < side; ++p) {
                        sums[p][0] += left[p] * low;
                        sums[p][1] += left[p] * high;
                    }
                }
                for (std::size_t p = 0; p < std::min(side, rows - i); ++p) {
                    for (std::size_t q = 0; q < std::min(side, columns - j); ++q) {
                        to.row(i + p)[j + q] += factor * sums[p][q / 2][q % 2];
                    }
                }
            }
        }
    }
}

View<double> part(Matrix& matrix, std::size_t i, std::size_t j)
{
    return {matrix.row(i) + j, matrix.size()};
}

View<const double> part(const Matrix& matrix, std::size_t i, std::size_t j)
{
    return {matrix.row(i) + j, matrix.size()};
}

template <typename Function>
void forEachTile(std::size_t first, std::size_t size, const Function& function)
{
    const std::size_t end = (size + tile - 1) / tile;
    parallelFor(tbb::blocked_range<std::size_t>(first / tile, end, 1), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            function(k * tile, std::min(tile, size - k * tile));
        }
    });
}

/// Replaces `right` by the solution x of `matrix` x = `right`. Only the numbers from the diagonal on are read of
/// `matrix`, which is positive definite; they become its Cholesky factor.
void solve(Matrix& matrix, Matrix& right, Interrupter* interrupter)
{
    const std::size_t size = matrix.size();
    // Subtracts from rows `i` to i + `rows` the part of the rows above them.
    const auto reduce = [&](std::size_t i, std::size_t rows, Matrix& of, std::size_t j, std::size_t columns) {
        addProduct(-1, part(std::as_const(matrix), 0, i), part(std::as_const(of), 0, j), i, part(of, i, j), rows,
                   columns);
    };
    const auto forward = [&](std::size_t i, std::size_t rows, Matrix& of, std::size_t j, std::size_t columns) {
        for (std::size_t p = i; p < i + rows; ++p) {
            for (std::size_t k = i; k < p; ++k) {
                const double factor = matrix.row(k)[p];
                for (std::size_t q = j; q < j + columns; ++q) of.row(p)[q] -= factor * of.row(k)[q];
            }
            const double inverse = 1 / matrix.row(p)[p];
            for (std::size_t q = j; q < j + columns; ++q) of.row(p)[q] *= inverse;
        }
    };
    for (std::size_t i = 0; i < size; i += tile) {
        throwIfInterrupted(interrupter);
        const std::size_t rows = std::min(tile, size - i);
        reduce(i, rows, matrix, i, rows);
        for (std::size_t p = i; p < i + rows; ++p) {
            for (std::size_t k = i; k < p; ++k) {
                const double factor = matrix.row(k)[p];
                for (std::size_t q = p; q < i + rows; ++q) matrix.row(p)[q] -= factor * matrix.row(k)[q];
            }
            const double pivot = std::sqrt(matrix.row(p)[p]);
            matrix.row(p)[p] = pivot;
            for (std::size_t q = p + 1; q < i + rows; ++q) matrix.row(p)[q] /= pivot;
        }
        forEachTile(i + tile, size, [&](std::size_t j, std::size_t columns) {
            reduce(i, rows, matrix, j, columns);
            forward(i, rows, matrix, j, columns);
        });
        forEachTile(0, size, [&](std::size_t j, std::size_t columns) {
            reduce(i, rows, right, j, columns);
            forward(i, rows, right, j, columns);
        });
    }
    std::vector<double> turned; // the rows' numbers after the tile on the diagonal, as columns
    for (std::size_t i = (size - 1) / tile * tile;; i -= tile) {
        throwIfInterrupted(interrupter);
        const std::size_t rows = std::min(tile, size - i), after = i + rows;
        turned.resize((size - after) * tile);
        for (std::size_t p = 0; p < rows; ++p) {
            for (std::size_t k = after; k < size; ++k) turned[(k - after) * tile + p] = matrix.row(i + p)[k];
        }
        forEachTile(0, size, [&](std::size_t j, std::size_t columns) {
            if (after < size) {
                addProduct(-1, {turned.data(), tile}, part(std::as_const(right), after, j), size - after,
                           part(right, i, j), rows, columns);
            }
            for (std::size_t p = after; p-- > i;) {
                for (std::size_t k = p + 1; k < after; ++k) {
                    const double factor = matrix.row(p)[k];
                    for (std::size_t q = j; q < j + columns; ++q) right.row(p)[q] -= factor * right.row(k)[q];
                }
                const double inverse = 1 / matrix.row(p)[p];
                for (std::size_t q = j; q < j + columns; ++q) right.row(p)[q] *= inverse;
            }
        });
        if (i == 0) return;
    }
}

/// The equations of a cage. With the data of a function, `data` and `laplacians` are the rows of the equations
///   data (values, derivatives) + laplacians (both of the Laplacian) = 0
///   data (both of the Laplacian) = 0
/// at the points of the cage and at the middles of its faces, in this order. The first is the function's value from
/// inside, minus itself; the second is the same for its Laplacian, which is harmonic. Each is multiplied by the square
/// root of the area for which it stands.
struct Equations {
    Matrix data, laplacians;
};

Equations equations(const UnitCage& cage, const std::vector<double>& areas, Interrupter* interrupter)
{
    const std::size_t points = cage.points().size();
    Equations of{Matrix(areas.size()), Matrix(areas.size())};
    parallelFor(tbb::blocked_range<std::size_t>(0, areas.size(), 8), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            throwIfInterrupted(interrupter);
            if (!(areas[i] > 0)) continue;
            Vec3d x(0);
            if (i < points) {
                x = cage.points()[i];
            } else {
                for (std::size_t k = 0; k < 3; ++k) x += cage.points()[cage.faces()[i - points].at[k]] / 3;
            }
            double *data = of.data.row(i), *laplacians = of.laplacians.row(i);
            // The difference from the whole sphere goes to the place itself, and 1 is subtracted there.
            const double self = addPotentials(cage, x, true, {data, laplacians, 1}) - 1;
            if (i < points) {
                data[i] += self;
            } else {
                for (std::size_t k = 0; k < 3; ++k) data[cage.faces()[i - points].at[k]] += self / 3;
            }
            const double weight = std::sqrt(areas[i]);
            for (std::size_t k = 0; k < areas.size(); ++k) {
                data[k] *= weight;
                laplacians[k] *= weight;
            }
        }
    });
    return of;
}

/// Returns for each datum of the cage the area for which it stands. Points have a third of their faces' areas.
std::vector<double> areasOf(const UnitCage& cage, const std::vector<Vec3d>& normals)
{
    std::vector<double> areas(cage.points().size(), 0.0);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double area = 0.5 * normals[i].length();
        for (std::size_t k = 0; k < 3; ++k) areas[cage.faces()[i].at[k]] += area / 3;
        areas.push_back(area);
    }
    return areas;
}

/// Returns the matrix from values and derivatives to the Laplacian's, see Equations. It makes least the sum of the
/// squares of all equations, plus a little of that of the Laplacian's data over the cage.
///
/// As many equations as data would be enough, for example the first at the cage's points and the second at the faces.
/// But their condition grows as the third power of the fineness: it is 1e10 in a cage of 400 faces, with weights in the
/// thousands. That of all equations grows little faster than the fineness, and is 1e4 there. Errors fall with the
/// square of the triangles' size in both. The weight between the two kinds, from 0.1 to 10, matters little.
Matrix laplaciansOf(const UnitCage& cage, const std::vector<Vec3d>& normals, Interrupter* interrupter)
{
    constexpr double little = 0.03; // damps functions as fine as the triangles, not smooth ones
    const std::vector<double> areas = areasOf(cage, normals);
    const std::size_t points = cage.points().size(), size = areas.size();
    double total = 0;
    for (std::size_t i = points; i < size; ++i) total += areas[i];
    const double damping = std::max(little * total / static_cast<double>(size - points), 1e-5);

    // The unknowns are scaled so that the sum of their squares is the integral's: by the roots of the areas.
    std::vector<double> scales(size);
    for (std::size_t i = 0; i < size; ++i) {
        scales[i] = i >= points ? 2 * std::sqrt(areas[i]) : areas[i] > 0 ? 1 / std::sqrt(areas[i]) : 0;
    }
    Matrix matrix(size), right(size);
    {
        Equations of = equations(cage, areas, interrupter);
        for (std::size_t i = 0; i < size; ++i) {
            double* row = of.laplacians.row(i);
            for (std::size_t k = 0; k < size; ++k) row[k] *= scales[k];
        }
        for (std::size_t i = 0; i < size; i += tile) {
            throwIfInterrupted(interrupter);
            const std::size_t rows = std::min(tile, size - i);
            forEachTile(0, size, [&](std::size_t j, std::size_t columns) {
                const auto product = [&](double factor, const Matrix& a, const Matrix& b, Matrix& to) {
                    addProduct(factor, part(a, 0, i), part(b, 0, j), size, part(to, i, j), rows, columns);
                };
                product(-1, of.laplacians, of.data, right);
                if (j < i) return;
                product(1, of.data, of.data, matrix);
                for (std::size_t p = i; p < i + rows; ++p) {
                    for (std::size_t q = j; q < j + columns; ++q) matrix.row(p)[q] *= scales[p] * scales[q];
                }
                product(1, of.laplacians, of.laplacians, matrix);
            });
        }
    }
    for (std::size_t i = 0; i < size; ++i) matrix.row(i)[i] += damping * damping;
    solve(matrix, right, interrupter);
    for (std::size_t i = 0; i < size; ++i) {
        double* row = right.row(i);
        for (std::size_t k = 0; k < size; ++k) row[k] *= scales[i];
    }
    return right;
}

constexpr std::size_t together = 2; // columns of a solution

} // namespace

BiharmonicPart biharmonicPart(const std::array<Vec3d, 3>& corners, bool onFace)
{
    return isSliver(corners[1] - corners[0], corners[2] - corners[0]) ? integrated(corners)
                                                                      : closedForm(corners, onFace);
}

BiharmonicCage::BiharmonicCage(const UnitCage& cage, Interrupter* interrupter) : cage_(cage)
{
    const std::size_t size = columns();
    if (size > mostData) {
        throw InputError("cage", "it has " + std::to_string(cage.points().size()) + " points and " +
                                     std::to_string(cage.faces().size()) + " triangles; biharmonic coordinates allow " +
                                     std::to_string(mostData) + " of both together");
    }
    for (const UnitCage::Face& face : cage.faces()) {
        const auto at = [&](std::size_t k) { return cage.points()[face.at[k]]; };
        normals_.push_back((at(1) - at(0)).cross(at(2) - at(0)));
    }
    const Matrix solution = laplaciansOf(cage, normals_, interrupter);
    solution_.assign((size + 1) / together * together * size, 0.0);
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t k = 0; k < size; ++k) {
            solution_[(k / together * size + i) * together + k % together] = solution.row(i)[k];
        }
    }
}

unsigned BiharmonicCage::rows(const Vec3d* points, std::size_t count, Packet* rows) const
{
    const std::size_t size = columns(), pointCount = cage_.points().size();
    struct Laplacians {
        Packet of;
    };
    std::vector<Laplacians> laplacians(size, Laplacians{});
    std::array<UnitCage::Place, packetSize> nearest;
    unsigned outside = 0;
    for (std::size_t k = 0; k < size; ++k) std::fill_n(rows[k], packetSize, 0.0);
    for (std::size_t lane = 0; lane < count; ++lane) {
        const Vec3d& x = points[lane];
        bool isInside = x.length() < tooFar;
        if (isInside) {
            nearest[lane] = cage_.nearest(x);
            const bool touches = nearest[lane].distance <= UnitCage::touching;
            const double lacking =
                addPotentials(cage_, x, touches, {&rows[0][lane], &laplacians[0].of[lane], packetSize});
            isInside = touches || std::abs(lacking) <= 0.5;
        }
        if (!isInside) outside |= 1U << lane;
    }
    for (std::size_t k = 0; k < size; k += together) {
        typedef double Pair __attribute__((vector_size(16)));
        constexpr std::size_t pairs = packetSize / 2;
        Pair first[pairs] = {}, second[pairs] = {};
        const double* factor = solution_.data() + k * size;
        for (std::size_t i = 0; i < size; ++i, factor += together) {
            for (std::size_t p = 0; p < pairs; ++p) {
                const Pair of{laplacians[i].of[2 * p], laplacians[i].of[2 * p + 1]};
                first[p] += of * factor[0];
                second[p] += of * factor[1];
            }
        }
        for (std::size_t lane = 0; lane < packetSize; ++lane) {
            rows[k][lane] += first[lane / 2][lane % 2];
            if (k + 1 < size) rows[k + 1][lane] += second[lane / 2][lane % 2];
        }
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
        if (outside >> lane & 1) continue;
        // The difference from the whole sphere, and the rounding error of the sum.
        double sum = 0;
        for (std::size_t k = 0; k < pointCount; ++k) sum += rows[k][lane];
        for (std::size_t k = 0; k < 4; ++k) {
            rows[cage_.faces()[nearest[lane].face].at[k]][lane] += (1 - sum) * nearest[lane].weights[k];
        }
        Vec3d missing = points[lane];
        for (std::size_t k = 0; k < pointCount; ++k) missing -= rows[k][lane] * cage_.points()[k];
        for (std::size_t k = 0; k < normals_.size(); ++k) missing -= rows[pointCount + k][lane] * normals_[k];
        for (std::size_t k = 0; k < pointCount; ++k) rows[k][lane] += cage_.restoring()[k].dot(missing);
    }
    return outside;
}

namespace {

CageRows solvedRows(const UnitCage& cage, const CoordinateOptions& /*options*/, Interrupter* interrupter)
{
    const auto solved = std::make_shared<const BiharmonicCage>(cage, interrupter);
    return {nullptr, [solved](const Vec3d* points, std::size_t count, Packet* rows) {
                return solved->rows(points, count, rows);
            }};
}

constexpr FamilyInfo info{Coordinates::biharmonic,
                          "biharmonic",
                          "biharmonic",
                          "Biharmonic",
                          "follows normals as green, closer to the cage",
                          "Thiery, Michel, Chen 2024",
                          /*isEverywhere*/ false,
                          /*splitsQuads*/ true,
                          /*hasResolution*/ false,
                          /*hasElasticity*/ false};

} // namespace

extern constexpr CoordinateFamily biharmonic{info, solvedRows, nullptr,
                                             stretchedNormals<triangulateByShorterDiagonal>(1, 2)};

} // namespace vdbcage::detail
