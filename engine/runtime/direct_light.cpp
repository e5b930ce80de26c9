// SPDX-License-Identifier: MIT
#include "engine/runtime/direct_light.h"

#include "engine/runtime/occluders.h"
#include "engine/runtime/rectangle.h"
#include "engine/runtime/scene.h"

#include <algorithm>
#include <limits>

namespace limn::runtime {

namespace {

/// Light at a point from a directional, point or spot light of strength 1.
struct PointSample {
    float irradiance = 0; ///< on a plane that faces the light
    F4 toLight{};         ///< unit
    float distance = 0;
};

// KHR_lights_punctual: ((cos - cosOuter) / (cosInner - cosOuter))^2.
float spotFalloff(const limnrt_light& light, F4 toLight) {
    const float cosOuter = std::cos(light.outer_angle);
    const float cosInner = std::max(std::cos(light.inner_angle), cosOuter + 1e-4f);
    const float* d = light.direction;
    const float cosine = -(toLight[0] * d[0] + toLight[1] * d[1] + toLight[2] * d[2]);
    const float t = std::clamp((cosine - cosOuter) / (cosInner - cosOuter), 0.f, 1.f);
    return t * t;
}

PointSample sampleLight(const limnrt_light& light, F4 p) {
    constexpr float kNearest = 1e-8f;
    PointSample s;
    if (light.kind == LIMNRT_DIRECTIONAL) {
        s = {1, -load3(light.direction), std::numeric_limits<float>::infinity()};
        return s;
    }
    const F4 way = load3(light.position) - p, square = way * way;
    const float d2 = square[0] + square[1] + square[2];
    if (!(d2 > 0))
        return s;
    s.distance = std::sqrt(d2);
    s.toLight = way / splat(s.distance);
    float window = 1;
    if (light.range > 0) {
        const float q = s.distance / light.range;
        window = std::clamp(1 - q * q * q * q, 0.f, 1.f);
    }
    if (light.kind == LIMNRT_SPOT)
        window *= spotFalloff(light, s.toLight);
    s.irradiance = std::min(window / std::max(d2, kNearest * kNearest), kMaxIrradiance);
    return s;
}

float pointShare(const TransportView& v, const limnrt_light& light, const float* position,
                 const float* normal) {
    const F4 p = load3(position), n = load3(normal);
    const PointSample s = sampleLight(light, p);
    const F4 product = n * s.toLight;
    const float cosTheta = product[0] + product[1] + product[2];
    if (!(cosTheta > 0) || !(s.irradiance > 0))
        return 0;
    const float offset = rayOffset(v, position);
    if ((light.flags & LIMNRT_NO_SHADOWS) == 0 &&
        occluded(v, p + n * splat(offset), s.toLight, s.distance - offset))
        return 0;
    return s.irradiance * cosTheta;
}

/// Wellons. Prospecting for Hash Functions. 2018
std::uint32_t mixBits(std::uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352dU;
    x = (x ^ x >> 15) * 0x846ca68bU;
    return x ^ x >> 16;
}
double unitFloat(std::uint32_t bits) {
    return double(bits >> 8) * 0x1p-24;
}
/// Digits of i in base 2, mirrored at the point.
double radicalInverse(std::uint32_t i) {
    double result = 0, digit = 0.5;
    for (; i > 0; i >>= 1, digit /= 2)
        result += digit * (i & 1);
    return result;
}

F4 rounded(Vec3 p) {
    return F4{float(p.x), float(p.y), float(p.z), 0};
}

bool blocked(const TransportView& v, F4 from, F4 to) {
    const F4 way = to - from, square = way * way;
    const float distance = std::sqrt(square[0] + square[1] + square[2]);
    return distance > 0 && occluded(v, from, way / splat(distance), distance);
}

/// The exact irradiance times the visible share of `samples` points of the rectangle, which are
/// Hammersley's, uniform in solid angle and weighted by their cosines. `number` shifts them, so
/// that neighbours have different ones.
float rectangleShare(const TransportView& v, const limnrt_light& light, const Rectangle& r,
                     const float* position, const float* normal, std::uint32_t number,
                     std::uint32_t samples) {
    const Vec3 p = vec3(position), n = vec3(normal);
    const double whole = rectangleIrradiance(r, p, n);
    if (!(whole > 0) || (light.flags & LIMNRT_NO_SHADOWS) != 0)
        return float(whole);
    const F4 origin = load3(position) + load3(normal) * splat(rayOffset(v, position));
    const std::uint32_t bits = mixBits(number);
    const double shiftU = unitFloat(bits), shiftV = unitFloat(mixBits(bits));
    const SphericalRectangle sphere(r, p);
    double sum = 0, seen = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        constexpr double kInset = 1e-3; // walls that bound the light would hide its edge
        const auto inset = [](double x) { return kInset + (1 - 2 * kInset) * (x - std::floor(x)); };
        const Vec3 onLight =
            sphere.at(inset((i + 0.5) / samples + shiftU), inset(radicalInverse(i) + shiftV));
        const Vec3 way = onLight - p;
        const double share = dot(way, n) / length(way);
        if (!(share > 0))
            continue;
        sum += share;
        const F4 end = rounded(onLight);
        const float ends[3] = {end[0], end[1], end[2]};
        if (!blocked(v, origin, end + rounded(r.normal) * splat(rayOffset(v, ends))))
            seen += share;
    }
    return sum > 0 ? float(whole * (seen / sum)) : 0;
}

/// Writes for each surfel the mean of share(position, normal, number of the point) over its light
/// points.
template <class Share>
void meanShares(const TransportView& v, const Share& share, float* mean) {
    const std::uint32_t each = v.lightPointsEach;
    for (std::size_t k = 0; k < v.dims.surfels; ++k) {
        float sum = 0;
        for (std::size_t point = k * each; point < (k + 1) * each; ++point)
            sum += share(v.lightPoint + 3 * point,
                         v.lightNormal ? v.lightNormal + 3 * point : v.surfelNormal + 3 * k,
                         std::uint32_t(point));
        mean[k] = sum / float(each);
    }
}

} // namespace

bool sameShape(const limnrt_light& a, const limnrt_light& b) {
    const auto same3 = [](const float* x, const float* y) {
        return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
    };
    return a.kind == b.kind && a.flags == b.flags && same3(a.position, b.position) &&
           same3(a.direction, b.direction) && a.range == b.range &&
           a.inner_angle == b.inner_angle && a.outer_angle == b.outer_angle && a.width == b.width &&
           a.height == b.height && a.roll == b.roll;
}

void lightShares(const TransportView& view, const limnrt_light& light, float* share) {
    if (light.kind == LIMNRT_RECTANGLE) {
        const Rectangle rectangle(light);
        const std::uint32_t samples = std::max(kRectanglePoints / view.lightPointsEach, 1U);
        meanShares(
            view,
            [&](const float* position, const float* normal, std::uint32_t number) {
                return rectangleShare(view, light, rectangle, position, normal, number, samples);
            },
            share);
        return;
    }
    meanShares(
        view,
        [&](const float* position, const float* normal, std::uint32_t) {
            return pointShare(view, light, position, normal);
        },
        share);
}

static bool shines(const limnrt_light& l) {
    return (l.flags & LIMNRT_LIGHT_OFF) == 0 && l.strength > 0 &&
           (l.color[0] > 0 || l.color[1] > 0 || l.color[2] > 0);
}

/// Gives each light that shines a slot with its shadows: first to those that are known, then to the
/// rest, which are traced.
static void takeSlots(limnrt_scene& s) {
    LightSlot* const end = s.slots + s.options.max_lights;
    for (LightSlot* slot = s.slots; slot != end; ++slot)
        slot->used = false;
    for (std::uint32_t k = 0; k < s.lightCount; ++k) {
        s.slotOf[k] = ~0U;
        LightSlot* const slot = std::find_if(s.slots, end, [&](const LightSlot& other) {
            return other.known && !other.used && sameShape(other.light, s.lights[k]);
        });
        if (slot == end || !shines(s.lights[k]))
            continue;
        slot->used = true;
        s.slotOf[k] = std::uint32_t(slot - s.slots);
    }
    for (std::uint32_t k = 0; k < s.lightCount; ++k) {
        if (s.slotOf[k] != ~0U || !shines(s.lights[k]))
            continue;
        LightSlot* slot = // rather not one that a light may want back
            std::find_if(s.slots, end, [](const LightSlot& o) { return !o.used && !o.known; });
        if (slot == end)
            slot = std::find_if(s.slots, end, [](const LightSlot& other) { return !other.used; });
        lightShares(s.view, s.lights[k], slot->share);
        slot->light = s.lights[k];
        slot->known = slot->used = true;
        s.slotOf[k] = std::uint32_t(slot - s.slots);
    }
}

void takeLights(limnrt_scene& s) {
    takeSlots(s);
    const std::size_t surfels = s.view.dims.surfels;
    std::fill(s.direct, s.direct + surfels, F4{});
    for (std::uint32_t k = 0; k < s.lightCount; ++k) {
        if (s.slotOf[k] == ~0U)
            continue;
        const F4 strength = load3(s.lights[k].color) * splat(s.lights[k].strength),
                 maximum = splat(kMaxIrradiance);
        const float* share = s.slots[s.slotOf[k]].share;
        for (std::size_t i = 0; i < surfels; ++i) {
            const F4 irradiance = strength * splat(share[i]);
            s.direct[i] += irradiance < maximum ? irradiance : maximum;
        }
    }
}

} // namespace limn::runtime
