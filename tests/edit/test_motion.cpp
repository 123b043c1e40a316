#include <boost/test/unit_test.hpp>

#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <openvdb/math/Mat.h>
#include <openvdb/math/Mat3.h>
#include <tools/edit/motion.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec3d;

namespace {

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Vec3d vector() { return {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)}; }
    Vec3d unit() { return vector().unit(); }

private:
    std::mt19937 engine_;
};

std::vector<Vec3d> somePoints(Random& random, std::size_t count = 50)
{
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(10 * random.vector());
    return points;
}

/// A motion of each kind.
std::vector<Motion> someMotions(Random& random)
{
    const Vec3d x = random.unit(), y = x.cross(random.unit()).unit();
    return {Move{random.vector()}, Rotate{random.unit(), random(-720, 720), random.vector()},
            Scale{random.vector(), {x, y, x.cross(y)}, random.vector()}};
}

/// What a whole motion does, by matrices.
Vec3d reference(const Vec3d& point, double weight, const Motion& motion)
{
    if (const auto* move = std::get_if<Move>(&motion)) return point + weight * move->by;
    if (const auto* rotate = std::get_if<Rotate>(&motion)) {
        const auto matrix =
            openvdb::math::rotation<openvdb::Mat3d>(rotate->axis, weight * rotate->degrees * detail::pi / 180);
        return rotate->pivot + (point - rotate->pivot) * matrix;
    }
    const auto& scale = std::get<Scale>(motion);
    Vec3d result = scale.pivot;
    for (int i = 0; i < 3; ++i) {
        const Vec3d& axis = scale.axes[std::size_t(i)];
        result += (1 + weight * (scale.factors[i] - 1)) * axis.dot(point - scale.pivot) * axis;
    }
    return result;
}

bool sameBits(const Vec3d& a, const Vec3d& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

BOOST_AUTO_TEST_SUITE(motion)

BOOST_AUTO_TEST_CASE(points_go_where_matrices_put_them_by_their_weights)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const auto points = somePoints(random);
        std::vector<double> weights;
        for (std::size_t i = 0; i < points.size(); ++i) weights.push_back(i == 0 ? 1 : random(0, 1));
        for (const Motion& motion : someMotions(random)) {
            const auto result = moved(points, weights, motion);
            for (std::size_t i = 0; i < points.size(); ++i) {
                BOOST_TEST((result[i] - reference(points[i], weights[i], motion)).length() < 1e-12);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_turn_is_counter_clockwise_seen_against_the_axis)
{
    const auto turned = moved({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1}, Rotate{{0, 0, 1}, 90, {0, 0, 0}});
    BOOST_CHECK((turned == std::vector<Vec3d>{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}));
}

BOOST_AUTO_TEST_CASE(quarter_turns_are_exact_and_four_return)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const auto points = somePoints(random);
        const std::vector<double> ones(points.size(), 1);
        const Vec3d pivot = random.vector();
        const Vec3d axis = random.unit();
        for (const double degrees : {90.0, -90.0, 810.0, -2610.0, 180.0}) {
            auto turned = points;
            for (int i = 0; i < (degrees == 180 ? 2 : 4); ++i)
                turned = moved(turned, ones, Rotate{axis, degrees, pivot});
            for (std::size_t i = 0; i < points.size(); ++i) BOOST_TEST((turned[i] - points[i]).length() < 1e-12 * 17);
        }
        for (const int quarters : {-7, -2, -1, 1, 2, 3, 4, 6, 1000001}) { // coordinates change places
            const auto turned = moved({{2, 3, 5}}, {1}, Rotate{{0, 0, 1}, 90.0 * quarters, {0, 0, 0}});
            const std::vector<Vec3d> expected{{2, 3, 5}, {-3, 2, 5}, {-2, -3, 5}, {3, -2, 5}};
            BOOST_CHECK(turned[0] == expected[std::size_t(quarters & 3)]);
        }
    }
}

BOOST_AUTO_TEST_CASE(what_has_no_weight_stays_bit_for_bit)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        auto points = somePoints(random);
        points[0] = {-0.0, 0.0, 5e-324};
        std::vector<double> weights(points.size(), 0);
        for (std::size_t i = 1; i < points.size(); i += 2) weights[i] = random(0, 1);
        for (const Motion& motion : someMotions(random)) {
            const auto result = moved(points, weights, motion);
            for (std::size_t i = 0; i < points.size(); i += 2) BOOST_TEST(sameBits(result[i], points[i]));
        }
        const std::vector<double> ones(points.size(), 1);
        for (const Motion& nothing : {Motion(Move{}), Motion(Rotate{random.unit(), 360, random.vector()}),
                                      Motion(Scale{Vec3d(1), Scale{}.axes, random.vector()})}) {
            BOOST_CHECK(moved(points, ones, nothing) == points);
        }
    }
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_refused)
{
    const std::vector<Vec3d> points{{1, 2, 3}};
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    for (const double weight : {-0.1, 1.1, nan}) BOOST_CHECK_THROW(moved(points, {weight}, Move{}), InputError);
    BOOST_CHECK_THROW(moved(points, {}, Move{}), InputError);
    const std::array<Vec3d, 3> skewed{Vec3d(1, 0, 0), Vec3d(0.8, 0.6, 0), Vec3d(0, 0, 1)};
    const std::vector<Motion> bad{Move{{nan, 0, 0}},
                                  Rotate{{0, 0, 2}, 1, {0, 0, 0}},
                                  Rotate{{0, 0, nan}, 1, {0, 0, 0}},
                                  Rotate{{0, 0, 1}, infinite, {0, 0, 0}},
                                  Rotate{{0, 0, 1}, 1, {0, nan, 0}},
                                  Scale{{1, nan, 1}, Scale{}.axes, {0, 0, 0}},
                                  Scale{Vec3d(1), skewed, {0, 0, 0}},
                                  Scale{Vec3d(1), Scale{}.axes, {0, infinite, 0}}};
    for (const Motion& motion : bad) BOOST_CHECK_THROW(moved(points, {1}, motion), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
