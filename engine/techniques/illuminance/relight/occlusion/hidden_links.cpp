// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs. A sum
// of a product is never fused, so that all of them agree.
#include "engine/techniques/illuminance/relight/occlusion/hidden_links.h"

#include "engine/core/vector_targets.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/relight/occlusion/hidden_links.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef LIMN_HIDDEN_LINKS_ONCE
#define LIMN_HIDDEN_LINKS_ONCE
namespace limn {
namespace {

/// How a cache sees a blocker's sphere.
struct Sight {
    glm::vec3 direction{0, 0, 1}; ///< unit
    float cosine = -1, sine = 0;  ///< of the half-angle; all directions where the cache is inside
};

/// Returns false where the blocker takes no light from the cache.
bool sees(const Bake& bake, std::uint32_t cache, const Blocker& b, glm::vec3 cell, Sight& sight) {
    const glm::vec3 x = bake.caches.position[cache], way = b.centre - x;
    const float distance = glm::length(way);
    const CacheKind kind = bake.caches.kind[cache];
    if (kind == CacheKind::Hemisphere && glm::dot(bake.caches.normal[cache], way) < -b.radius)
        return false;
    if (kind == CacheKind::Grid && glm::all(glm::greaterThan(x, b.bounds.lower - cell)) &&
        glm::all(glm::lessThan(x, b.bounds.upper + cell)))
        return false;
    sight = {};
    if (distance <= b.radius)
        return true;
    const float sine = b.radius / distance, cosine = std::sqrt(1 - sine * sine);
    sight = {way / distance, cosine, sine};
    return sine * sine / (1 + cosine) >= kMinBlocked; // 1 - cosine, without cancellation
}

/// The lattice of DirectionSet, as strata of height and directions about the axis.
struct Spread {
    std::uint32_t count;
    float stratum[kManyDirections], x[kManyDirections], y[kManyDirections];

    explicit Spread(std::uint32_t directions) : count(directions) {
        const DirectionSet set(count, false, 0);
        for (std::uint32_t k = 0; k < count; ++k) {
            const glm::vec3 d = set[k];
            const float r = std::sqrt(d.x * d.x + d.y * d.y);
            stratum[k] = 1 - d.z, x[k] = d.x / r, y[k] = d.y / r;
        }
    }
};

} // namespace
} // namespace limn
#endif

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Uints = hn::RebindToUnsigned<Floats>;
using Ints = hn::RebindToSigned<Floats>;
using V = hn::Vec<Floats>;
using U = hn::Vec<Uints>;
using M = hn::Mask<Floats>;

constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);

HWY_INLINE V set(float v) {
    return hn::Set(Floats(), v);
}

struct V3 {
    V x, y, z;
};
HWY_INLINE V dot(V3 a, V3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE V3 operator-(V3 a, V3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE V3 set(glm::vec3 v) {
    return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE V3 turn(const glm::mat3& m, V3 v) {
    const auto row = [&](int i) {
        return set(m[0][i]) * v.x + set(m[1][i]) * v.y + set(m[2][i]) * v.z;
    };
    return {row(0), row(1), row(2)};
}
/// fields[i * stride + offset], …
HWY_INLINE V gather(const float* fields, U i, std::uint32_t stride, std::uint32_t offset) {
    const U index = i * hn::Set(Uints(), stride) + hn::Set(Uints(), offset);
    return hn::GatherIndex(Floats(), fields, hn::BitCast(Ints(), index));
}
HWY_INLINE V3 gather3(const float* fields, U i, std::uint32_t stride, std::uint32_t offset) {
    return {gather(fields, i, stride, offset), gather(fields, i, stride, offset + 1),
            gather(fields, i, stride, offset + 2)};
}

struct Cones {
    V3 direction; ///< of this length
    V length, u;
    U node;
};

/// Converts halfs to floats, including denormal ones.
HWY_INLINE V lowHalf(U word) {
    const hn::Rebind<hwy::float16_t, Floats> dh;
    const hn::Rebind<std::uint16_t, Floats> dh16;
    return hn::PromoteTo(
        Floats(), hn::BitCast(dh, hn::TruncateTo(dh16, hn::And(word, hn::Set(Uints(), 0xffffU)))));
}
HWY_INLINE V highHalf(U word) {
    return lowHalf(hn::ShiftRight<16>(word));
}

HWY_INLINE Cones unpack(U node, U oct, U cone) {
    const Floats d;
    const Ints di;
    const auto snorm = [&](auto shifted) { return hn::ConvertTo(d, hn::ShiftRight<16>(shifted)); };
    V x = snorm(hn::BitCast(di, hn::ShiftLeft<16>(oct))), y = snorm(hn::BitCast(di, oct));
    const V z = set(32767) - hn::Abs(x) - hn::Abs(y), fold = hn::Max(hn::Neg(z), hn::Zero(d));
    x = x - hn::CopySignToAbs(fold, x);
    y = y - hn::CopySignToAbs(fold, y);
    const V3 direction{x, y, z};
    return {direction, hn::Sqrt(dot(direction, direction)), lowHalf(cone), node};
}

/// Vector form of coneOfHarmonics(), from the first four harmonics.
HWY_INLINE Cones coneOf(U node, U first, U second) {
    const Floats d;
    const V zeroth = lowHalf(first), zero = hn::Zero(d);
    const V3 along{highHalf(second), highHalf(first), lowHalf(second)};
    const V length = hn::Sqrt(dot(along, along));
    const M some = hn::And(hn::Gt(length, zero), hn::Gt(zeroth, zero));
    const V u = set(2) * (set(1) - length / (set(std::numbers::sqrt3_v<float>) * zeroth));
    return {{hn::IfThenElseZero(some, along.x), hn::IfThenElseZero(some, along.y),
             hn::IfThenElse(some, along.z, set(1))},
            hn::IfThenElse(some, length, set(1)),
            hn::IfThenElse(some, hn::Min(hn::Max(u, zero), set(2)), set(2)),
            node};
}

struct ConeReader {
    const Caches& caches;
    std::size_t coefficients; ///< of a link; 0: cones
    std::uint32_t first;      ///< lowest link that is requested

    /// Links before the first count as that one.
    HWY_INLINE Cones harmonicsAt(U links) const {
        const Uints d;
        const Ints di;
        const U known = hn::Max(links, hn::Set(d, first));
        const std::uint16_t* halfs = caches.shCoefficients.data() + first * coefficients;
        const auto pairs = [&](std::size_t offset) { // two bytes are all that they are aligned to
            const U bytes = (known - hn::Set(d, first)) *
                            hn::Set(d, std::uint32_t(coefficients * sizeof *halfs));
            return hn::GatherOffset(d, reinterpret_cast<const std::uint32_t*>(halfs + offset),
                                    hn::BitCast(di, bytes));
        };
        return coneOf(hn::GatherIndex(d, caches.shNode.data(), hn::BitCast(di, known)), pairs(0),
                      pairs(2));
    }

    HWY_INLINE Cones at(U links) const {
        if (coefficients > 0)
            return harmonicsAt(links);
        const auto* words = reinterpret_cast<const std::uint32_t*>(caches.links.data());
        const auto word = [&](std::uint32_t k) {
            const U i = links * hn::Set(Uints(), 3) + hn::Set(Uints(), k);
            return hn::GatherIndex(Uints(), words, hn::BitCast(Ints(), i));
        };
        return unpack(word(0), word(1), word(2));
    }

    /// Cones of link k and those after it; lanes past the last link repeat it.
    HWY_INLINE Cones from(std::uint32_t k) const {
        const Uints d;
        const auto count = std::uint32_t(caches.linkCount());
        if (coefficients > 0 || k + hn::Lanes(d) > count)
            return at(hn::Min(hn::Iota(d, k), hn::Set(d, count - 1)));
        U node, oct, cone;
        hn::LoadInterleaved3(d, reinterpret_cast<const std::uint32_t*>(caches.links.data() + k),
                             node, oct, cone);
        return unpack(node, oct, cone);
    }
};

/// Queue of links for a closer test, until there are enough for whole vectors.
struct Waiting {
    static constexpr std::size_t kRoom = 512;
    std::uint32_t link[kRoom + kMaxLanes], cache[kRoom + kMaxLanes];
    std::size_t count = 0;

    HWY_INLINE void add(U links, U caches, M which) {
        const Uints d;
        const auto mask = hn::RebindMask(d, which);
        hn::StoreU(hn::Compress(links, mask), d, link + count);
        hn::StoreU(hn::Compress(caches, mask), d, cache + count);
        count += hn::CountTrue(d, mask);
    }
    bool full() const { return count + kMaxLanes > kRoom; }
};

/// Data of some links during a test.
struct Links {
    M valid;
    U link;
    Cones cones;
    V3 unit; ///< the cone's axis
    V3 from; ///< from the blocker's origin to the cache
    V3 way;  ///< from the cache to the sender's centre
    V distance, radius;
};

struct Range {
    V first, last; ///< [m]
};

/// Side of a blocker, in world axes from its origin: dot(normal, p) <= offset within.
struct Side {
    glm::vec3 normal; ///< of this length
    float length, offset;
    bool there;
};

/// Finds the links that one blocker hides.
struct Finder {
    const LinksAndBlockers& scene;
    const Blocker& blocker;
    ConeReader cones;
    std::uint32_t firstLink; ///< hidden[0]
    std::uint16_t* hidden;
    const Spread &few, &many;
    const BlockerShape& shape = *blocker.shape;
    std::size_t count = 0; ///< of sides
    Side sides[BlockerShape::kMaxSides];
    Sight sight; ///< of the cache at hand
    Waiting seen, ofFew, ofMany;

    Finder(const LinksAndBlockers& links, const Blocker& b, std::size_t coefficients,
           std::uint32_t first, std::uint16_t* out, const Spread& spreadOfFew,
           const Spread& spreadOfMany)
        : scene(links), blocker(b), cones{links.bake.caches, coefficients, first}, firstLink(first),
          hidden(out), few(spreadOfFew), many(spreadOfMany) {
        for (const BlockerShape::Side& side : shape.sides) {
            const glm::vec3 normal = side.normal * blocker.toObject;
            sides[count++] = {normal, glm::length(normal), side.offset, side.there};
        }
    }

    /// Queues the `valid` cones that meet the blocker's bounding sphere.
    HWY_INLINE void keep(const Cones& c, V cos, V sin, U links, std::uint32_t cache, M valid) {
        const Floats d;
        const V cosine = set(sight.cosine), sine = set(sight.sine);
        const M round = hn::Le(cos, hn::Neg(cosine)), // together they cover all directions
            meets = hn::Ge(dot(c.direction, set(sight.direction)),
                           (cos * cosine - sin * sine) * c.length);
        const M found = hn::And(hn::Or(round, meets), valid);
        if (hn::AllFalse(d, found))
            return;
        seen.add(links, hn::Set(Uints(), cache), found);
        if (seen.full())
            sift(cache);
    }

    void finish() {
        sample(ofFew, few);
        sample(ofMany, many);
    }

    HWY_INLINE Links look(U links, M valid, V3 x) const {
        Links l;
        l.valid = valid;
        l.link = links;
        l.cones = cones.at(links);
        const V perLength = set(1) / l.cones.length;
        l.unit = {l.cones.direction.x * perLength, l.cones.direction.y * perLength,
                  l.cones.direction.z * perLength};
        l.from = x - set(blocker.origin);
        l.way = gather3(&scene.places[0].centre.x, l.cones.node, kPlaceFloats, 0) - x;
        l.distance = hn::Sqrt(dot(l.way, l.way));
        l.radius = gather(&scene.places[0].centre.x, l.cones.node, kPlaceFloats, 3);
        return l;
    }

    /// Tests the whole cones of `seen`: no direction is blocked, all are, or neither can be
    /// decided. A direction is at most the chord, 2 sin(half-angle / 2), from the axis.
    void sift(std::uint32_t cache) {
        const Floats d;
        const Uints du;
        const glm::vec3 x = scene.bake.caches.position[cache];
        float height[BlockerShape::kMaxSides];
        for (std::size_t i = 0; i < count; ++i)
            height[i] = sides[i].offset - glm::dot(sides[i].normal, x - blocker.origin);
        for (std::size_t k = 0; k < seen.count; k += hn::Lanes(d)) {
            const M valid = hn::FirstN(d, seen.count - k);
            const U links =
                hn::IfThenElseZero(hn::RebindMask(du, valid), hn::LoadU(du, seen.link + k));
            const Links l = look(links, valid, set(x));
            const V chord = hn::Sqrt(l.cones.u + l.cones.u) + set(4e-6f); // of float rounding
            Range outer{hn::Zero(d), set(1e30f)}, inner = outer;
            for (std::size_t i = 0; i < count; ++i) {
                const V component = dot(set(sides[i].normal), l.unit),
                        spread = chord * set(sides[i].length);
                bound(component - spread, set(height[i]), outer);
                bound(component + spread, set(height[i]), inner);
            }
            const M maybe = hn::And(hn::Le(outer.first, outer.last),
                                    hn::Lt(outer.first, l.distance + l.radius));
            const M surely = fillsCones(outer, inner, (l.distance - l.radius) * set(0.9989f));
            hideAll(l, hn::And(surely, l.valid));
            const M open = hn::And(hn::AndNot(surely, maybe), l.valid),
                    isFew = hn::Lt(l.cones.u, set(kNarrow));
            ofFew.add(l.link, hn::Set(du, cache), hn::And(open, isFew));
            if (ofFew.full())
                sample(ofFew, few);
            ofMany.add(l.link, hn::Set(du, cache), hn::AndNot(isFew, open));
            if (ofMany.full())
                sample(ofMany, many);
        }
        seen.count = 0;
    }

    /// Whether all directions are blocked, for light from a distance of at least `nearest`. Where
    /// one side of a convex solid is missing, a ray still meets another one from outside, on the
    /// way in or out.
    HWY_INLINE M fillsCones(const Range& outer, const Range& inner, V nearest) const {
        const Floats d;
        if (shape.triangles)
            return hn::FirstN(d, 0);
        const M passes = hn::Le(inner.first, inner.last);
        if (shape.closed)
            return hn::And(passes, hn::Lt(inner.first, nearest));
        const M outside = hn::Gt(outer.first, hn::Zero(d));
        return hn::And(passes, hn::And(outside, hn::Lt(outer.last, nearest)));
    }

    /// Clips a ray to the part behind a side; the ray starts `height` from the side and approaches
    /// it at the rate `component`.
    static HWY_INLINE void bound(V component, V height, Range& range) {
        const V t = height / awayFrom0(component);
        const M isLast = hn::Ge(component, hn::Zero(Floats()));
        range.last = hn::IfThenElse(isLast, hn::Min(range.last, t), range.last);
        range.first = hn::IfThenElse(isLast, range.first, hn::Max(range.first, t));
    }
    /// Replaces 0 by a small number, to avoid 0 / 0.
    static HWY_INLINE V awayFrom0(V v) {
        return hn::IfThenElse(hn::Gt(hn::Abs(v), set(1e-18f)), v, hn::CopySign(set(1e-18f), v));
    }

    void hideAll(const Links& l, M which) {
        const Uints d;
        if (hn::AllFalse(Floats(), which))
            return;
        HWY_ALIGN std::uint32_t link[kMaxLanes], bits[kMaxLanes];
        const auto mask = hn::RebindMask(d, which),
                   isFew = hn::RebindMask(d, hn::Lt(l.cones.u, set(kNarrow)));
        const U all = hn::IfThenElse(isFew, hn::Set(d, (1U << kFewDirections) - 1),
                                     hn::Set(d, (1U << kManyDirections) - 1));
        hn::Store(hn::Compress(l.link, mask), d, link);
        hn::Store(hn::Compress(all, mask), d, bits);
        for (std::size_t i = 0; i < hn::CountTrue(d, mask); ++i)
            hidden[link[i] - firstLink] |= std::uint16_t(bits[i]);
    }

    /// Tests each direction of the cones.
    void sample(Waiting& waiting, const Spread& spread) {
        const Floats d;
        const Uints du;
        for (std::size_t k = 0; k < waiting.count; k += hn::Lanes(d)) {
            const M valid = hn::FirstN(d, waiting.count - k);
            const auto known = hn::RebindMask(du, valid);
            const U link = hn::IfThenElseZero(known, hn::LoadU(du, waiting.link + k)),
                    cache = hn::IfThenElseZero(known, hn::LoadU(du, waiting.cache + k));
            const Links l =
                look(link, valid, gather3(&scene.bake.caches.position[0].x, cache, 3, 0));
            HWY_ALIGN std::uint32_t blocked[kMaxLanes];
            hn::Store(blockedDirections(l, spread), du, blocked);
            for (std::size_t i = 0; i < std::min(hn::Lanes(d), waiting.count - k); ++i)
                hidden[waiting.link[k + i] - firstLink] |= std::uint16_t(blocked[i]);
        }
        waiting.count = 0;
    }

    U blockedDirections(const Links& l, const Spread& spread) const {
        const Floats d;
        const V3 n = l.unit;
        const V one = set(1), sign = hn::CopySign(one, n.z); // as basisAround
        const V a = hn::Neg(one) / (sign + n.z), b = n.x * n.y * a;
        const V3 s{one + sign * n.x * n.x * a, sign * b, hn::Neg(sign) * n.x},
            t{b, sign + n.y * n.y * a, hn::Neg(n.y)};
        const V3 normal = gather3(&scene.places[0].centre.x, l.cones.node, kPlaceFloats, 4);
        const V toPlane = dot(normal, l.way);
        const M planar = hn::Gt(dot(normal, normal), hn::Zero(d));
        const Heights heights = heightsOf(l);
        U bits = hn::Zero(Uints());
        for (std::uint32_t k = 0; k < spread.count; ++k) {
            const V z = one - l.cones.u * set(spread.stratum[k]); // equal solid angles
            const V r = hn::Sqrt(hn::Max(one - z * z, hn::Zero(d)));
            const V x = set(spread.x[k]) * r, y = set(spread.y[k]) * r;
            const V3 way{s.x * x + t.x * y + n.x * z, s.y * x + t.y * y + n.y * z,
                         s.z * x + t.z * y + n.z * z};
            // Light comes from the cluster's plane, or from behind all of it.
            const V along = dot(normal, way);
            V from =
                hn::IfThenElse(hn::Gt(hn::Abs(along), set(0.02f)), toPlane / along, l.distance);
            from = hn::Min(hn::Max(from, l.distance - l.radius), l.distance + l.radius);
            from = hn::IfThenElse(planar, from, l.distance + l.radius) * set(0.999f);
            const M hit = blocks(l, heights, way, from);
            bits = hn::Or(
                bits, hn::IfThenElseZero(hn::RebindMask(Uints(), hit), hn::Set(Uints(), 1U << k)));
        }
        return bits;
    }

    /// Heights of the sides above caches.
    struct Heights {
        V height[BlockerShape::kMaxSides];
        M within; ///< the cache is below all of them
    };
    Heights heightsOf(const Links& l) const {
        Heights h;
        V minimum = set(0);
        for (std::size_t i = 0; i < count; ++i) {
            h.height[i] = set(sides[i].offset) - dot(set(sides[i].normal), l.from);
            minimum = hn::Min(minimum, h.height[i]);
        }
        h.within = hn::Ge(minimum, set(0));
        return h;
    }

    /// Whether the blocker begins before `tMost` along a unit direction from the cache. From inside
    /// a closed solid everything is blocked, so a surface that a box stands on gets no light there.
    HWY_INLINE M blocks(const Links& l, const Heights& heights, V3 way, V tMost) const {
        const Floats d;
        Range through{set(-1e30f), set(1e30f)};
        M enters = hn::FirstN(d, 0), leaves = enters; // through a side that is there
        for (std::size_t i = 0; i < count; ++i) {
            const Range before = through;
            bound(dot(set(sides[i].normal), way), heights.height[i], through);
            if (shape.closed || shape.triangles)
                continue;
            const M there = hn::FirstN(d, sides[i].there ? hn::Lanes(d) : 0),
                    first = hn::Gt(through.first, before.first),
                    last = hn::Lt(through.last, before.last);
            enters = hn::Or(hn::AndNot(first, enters), hn::And(first, there));
            leaves = hn::Or(hn::AndNot(last, leaves), hn::And(last, there));
        }
        const V zero = hn::Zero(d), first = hn::Max(through.first, zero);
        const M hit = hn::And(hn::And(hn::Le(first, through.last), hn::Gt(through.last, zero)),
                              hn::And(hn::Lt(first, tMost), l.valid));
        if (shape.closed || hn::AllFalse(d, hit))
            return hit;
        if (shape.triangles)
            return meetsTriangles(turn(blocker.toObject, l.from), turn(blocker.toObject, way),
                                  tMost, hit, heights.within);
        enters = hn::And(enters, hn::Gt(through.first, zero));
        leaves = hn::And(leaves, hn::Lt(through.last, tMost));
        return hn::And(hit, hn::Or(enters, leaves));
    }

    /// Whether rays that enter the mesh's bounding box, or start in it, meet its triangles.
    HWY_INLINE M meetsTriangles(V3 origin, V3 way, V tMost, M which, M startWithin) const {
        const Floats d;
        const V3 centre = set(shape.box.centre()) - origin;
        const V square = dot(way, way), along = dot(centre, way), apart = dot(centre, centre);
        // A quarter of the discriminant of the ray's intersection with a ball.
        const auto discriminant = [&](float radius) {
            return along * along - square * (apart - set(radius * radius));
        };
        which = hn::And(which, hn::Gt(discriminant(shape.outerBall), hn::Zero(d)));
        // A ray from outside that enters the inner ball crosses a closed mesh.
        const V inner = discriminant(shape.innerBall), root = hn::Sqrt(hn::Max(inner, hn::Zero(d)));
        const M ends = hn::And(hn::Gt(inner, hn::Zero(d)),
                               hn::Gt(along, set(shape.innerBall > 0 ? 0.f : 1e30f))),
                met = hn::And(hn::And(which, ends),
                              hn::AndNot(startWithin, hn::Lt(along - root, tMost * square)));
        const M open = hn::AndNot(met, which);
        return hn::AllFalse(d, open) ? met : hn::Or(met, trace(origin, way, tMost, open));
    }

    M trace(V3 origin, V3 way, V tMost, M which) const {
        const Floats d;
        HWY_ALIGN float ox[kMaxLanes], oy[kMaxLanes], oz[kMaxLanes], x[kMaxLanes], y[kMaxLanes],
            z[kMaxLanes], t[kMaxLanes], hit[kMaxLanes];
        hn::Store(origin.x, d, ox), hn::Store(origin.y, d, oy), hn::Store(origin.z, d, oz);
        hn::Store(way.x, d, x), hn::Store(way.y, d, y), hn::Store(way.z, d, z);
        hn::Store(tMost, d, t);
        hn::Store(hn::IfThenElseZero(which, set(1)), d, hit);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i)
            // The direction is not normalised in object space, so t is the same as in the world.
            if (hit[i] > 0 &&
                !shape.triangles->occluded({{ox[i], oy[i], oz[i]}, {x[i], y[i], z[i]}, 0, t[i]}))
                hit[i] = 0;
        return hn::Gt(hn::Load(d, hit), hn::Zero(d));
    }

    static constexpr std::uint32_t kPlaceFloats = sizeof(SenderPlace) / sizeof(float);
};

void lookFrom(const Caches& caches, std::uint32_t cache, const ConeReader& cones,
              const std::vector<Finder*>& finders) {
    const Floats d;
    const Uints du;
    const std::uint32_t end = caches.linkBegin[cache + 1];
    for (std::uint32_t k = caches.linkBegin[cache]; k < end; k += std::uint32_t(hn::Lanes(du))) {
        const Cones c = cones.from(k);
        const V cos = set(1) - c.u, sin = hn::Sqrt(c.u * (set(2) - c.u));
        const M valid = hn::FirstN(d, end - k);
        for (Finder* f : finders)
            f->keep(c, cos, sin, hn::Iota(du, k), cache, valid);
    }
    for (Finder* f : finders)
        f->sift(cache);
}

} // namespace

void findHiddenLinks(const LinksAndBlockers& scene, std::uint32_t begin, std::uint32_t end,
                     std::uint16_t* hidden) {
    const Bake& bake = scene.bake;
    static const Spread few(kFewDirections), many(kManyDirections);
    const glm::vec3 cell =
        bake.gridBounds.size() / glm::vec3(glm::max(bake.gridSize, glm::uvec3(1)));
    const std::size_t coefficients =
        bake.caches.shNode.empty() ? 0 : std::size_t(bake.settings.bands) * bake.settings.bands;
    const std::uint32_t firstLink = bake.caches.linkBegin[begin];
    std::fill(hidden, hidden + (bake.caches.linkBegin[end] - firstLink), std::uint16_t(0));
    std::vector<Finder> finders;
    finders.reserve(scene.blockers.size());
    for (const Blocker& b : scene.blockers)
        finders.emplace_back(scene, b, coefficients, firstLink, hidden, few, many);
    std::vector<Finder*> looking;
    for (std::uint32_t c = begin; c < end; ++c) {
        looking.clear();
        for (Finder& f : finders)
            if (sees(bake, c, f.blocker, cell, f.sight))
                looking.push_back(&f);
        if (!looking.empty())
            lookFrom(bake.caches, c, {bake.caches, coefficients, firstLink}, looking);
    }
    for (Finder& f : finders)
        f.finish();
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(findHiddenLinks);

void findHiddenLinks(const LinksAndBlockers& scene, std::uint32_t begin, std::uint32_t end,
                     std::uint16_t* hidden) {
    HWY_DYNAMIC_DISPATCH(findHiddenLinks)(scene, begin, end, hidden);
}

} // namespace limn
#endif
