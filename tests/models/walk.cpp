// vdbcage-walk CAGE DIR: poses a cage of the creature as it walks in place, one stride in 12 frames, and writes them as
// DIR/walk.0000.obj to walk.0011.obj.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <system_error>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

#include "vec3.h"

namespace data {

namespace {

using openvdb::Vec2d;
using openvdb::Vec3d;

constexpr int frames = 12;

constexpr double stance = 0.62; // share of the stride that a hoof is on the ground
constexpr double reach = 10;    // of a hoof before and behind its place, in centimetres as all lengths
constexpr double lift = 6;      // of a hoof in the air

double angleOf(const Vec2d& v)
{
    return std::atan2(v[1], v[0]);
}

/// In the plane of z and y. Angles are from +z to +y.
Vec2d turned(const Vec2d& p, const Vec2d& around, double angle)
{
    const Vec2d d = p - around;
    const double c = std::cos(angle), s = std::sin(angle);
    return around + Vec2d(c * d[0] - s * d[1], s * d[0] + c * d[1]);
}

/// Joints as (z, y), as in creature.cpp; the hoof hangs at the fetlock.
struct Leg {
    Vec2d hip, knee, fetlock;
    double place;  // z of the hoof's joint in the middle of its step
    double bend;   // 1 if the knee (the hock behind) points forward, -1 backward
    double behind; // share of the stride that it follows the left hind leg by
};

constexpr double forelegs = 24, hindlegs = -27; // z of the hips

Leg foreleg(double step, double behind)
{
    return {{forelegs, 60}, {25 + 0.7 * step, 27.5}, {24 + step, 8.6}, forelegs, 1, behind};
}

Leg hindleg(double step, double behind)
{
    return {{hindlegs, 60}, {-40 + 0.7 * step, 29.5}, {-35.5 + step, 8.6}, -33, -1, behind};
}

// Each hind hoof lands half a stride after the other, the fore hoof of its side a quarter later.
const Leg leftFore = foreleg(5, 0.25), rightFore = foreleg(-3, 0.75);
const Leg leftHind = hindleg(-5, 0), rightHind = hindleg(4, 0.5);

/// How far the back has sunk at `z`: most when a hoof there lands, the legs being spread.
double sinking(double time, double z)
{
    const auto at = [&](double behind) { return 0.9 + 0.5 * std::cos(4 * pi * (time - behind)); };
    return lerp(at(leftHind.behind), at(leftFore.behind), smoothStep(hindlegs, forelegs, z));
}

/// Angles by which a leg turns at its joints.
struct Turn {
    double hip, knee, fetlock;
};

Turn turnOf(const Leg& leg, double time)
{
    const double phase = time - leg.behind - std::floor(time - leg.behind);
    Vec2d hoof(leg.place, leg.fetlock[1]);
    double tilt = 0;
    if (phase < stance) {
        hoof[0] += reach * (1 - 2 * phase / stance);
    } else {
        const double s = (phase - stance) / (1 - stance);
        hoof[0] += reach * (2 * smoothStep(0, 1, s) - 1);
        hoof[1] += lift * std::sin(pi * s);
        tilt = -0.6 * std::sin(pi * std::min(1.0, 1.3 * s)); // toes down, level again before it lands
    }
    // Two bones between the hip and the hoof: the law of cosines.
    hoof[1] += sinking(time, leg.hip[0]);
    const Vec2d to = hoof - leg.hip;
    const double upper = (leg.knee - leg.hip).length(), lower = (leg.fetlock - leg.knee).length();
    const double distance = std::min(to.length(), 0.999 * (upper + lower));
    const double inner = std::acos((upper * upper + distance * distance - lower * lower) / (2 * upper * distance));
    const Vec2d knee = turned(leg.hip + upper * to / to.length(), leg.hip, leg.bend * inner);
    const Vec2d fetlock = leg.hip + distance * to / to.length();
    const double hipTurn = angleOf(knee - leg.hip) - angleOf(leg.knee - leg.hip);
    const double lowerTurn = angleOf(fetlock - knee) - angleOf(leg.fetlock - leg.knee);
    return {hipTurn, lowerTurn - hipTurn, tilt - lowerTurn};
}

Vec2d withLeg(Vec2d p, const Leg& leg, double time, double belongs)
{
    const Turn turn = turnOf(leg, time);
    const double y = p[1];
    const auto below = [&](double joint, double width) { return smoothStep(joint + width, joint - width, y); };
    p = turned(p, leg.fetlock, belongs * below(leg.fetlock[1], 3) * turn.fetlock);
    p = turned(p, leg.knee, belongs * below(leg.knee[1], 5) * turn.knee);
    return turned(p, leg.hip, belongs * below(54, 10) * turn.hip);
}

/// Where a point of a cage goes. `time` is the share of a stride that has passed. A point is turned around the joints
/// of the leg it belongs to, the further below a joint the more; the angles put the hoofs where the stride needs them.
Vec3d walking(const Vec3d& p, double time)
{
    Vec2d q(p.z(), p.y());
    const double middle = lerp(3, 8, smoothStep(30, 44, p.y())); // half as wide as what both legs pull at
    const double left = smoothStep(-middle, middle, p.x());
    const auto withLegs = [&](const Leg& right, const Leg& leftLeg, double belongs) {
        q = (1 - left) * withLeg(q, right, time, belongs) + left * withLeg(q, leftLeg, time, belongs);
    };
    withLegs(rightFore, leftFore, smoothStep(-2, 18, p.z()));
    withLegs(rightHind, leftHind, smoothStep(6, -24, p.z()));
    // The head nods twice a stride.
    const Vec2d neck(32, 70);
    const double head = smoothStep(-6, 34, 0.6 * (p.y() - neck[1]) + 0.6 * (p.z() - neck[0]));
    q = turned(q, neck, 0.06 * head * std::sin(4 * pi * (time - leftFore.behind)));
    return {p.x(), q[1] - sinking(time, p.z()), q[0]};
}

} // namespace

} // namespace data

int main(int argc, char** argv)
{
    if (argc != 3 || argv[2][0] == '-') {
        std::fputs("usage: vdbcage-walk CAGE DIR\n", stderr);
        return 1;
    }
    try {
        const vdbcage::Mesh cage = vdbcage::readMesh(argv[1]);
        std::filesystem::create_directories(argv[2]);
        vdbcage::PendingFiles files;
        for (int frame = 0; frame < data::frames; ++frame) {
            vdbcage::Mesh pose = cage;
            for (openvdb::Vec3d& p : pose.points) p = data::walking(p, static_cast<double>(frame) / data::frames);
            std::array<char, 32> name{};
            std::snprintf(name.data(), name.size(), "walk.%04d.obj", frame);
            const std::filesystem::path path = std::filesystem::path(argv[2]) / name.data();
            std::error_code ignored;
            if (std::filesystem::equivalent(path, argv[1], ignored)) {
                throw vdbcage::InputError(path.string(), "is the cage itself; it would be overwritten");
            }
            files.add(path, [&](std::ostream& out) { vdbcage::writeMesh(pose, out, path); });
        }
        files.commit();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-walk: %s\n", error.what());
        return 1;
    }
    return 0;
}
