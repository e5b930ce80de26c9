// SPDX-License-Identifier: MIT
#include "engine/runtime/occluders.h"

#include <algorithm>

namespace limn::runtime {

namespace {

struct TracedRay {
    F4 origin, direction, inverse;
    float distance;
};

/// Three components; the fourth of the file's boxes is an index.
F4 corner(const float* p) {
    typedef int I4 __attribute__((vector_size(16)));
    I4 bits;
    std::memcpy(&bits, p, sizeof bits);
    bits &= I4{-1, -1, -1, 0};
    F4 v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
}

float maxComponent(F4 v) {
    return std::max(std::max(v[0], v[1]), v[2]);
}
float minComponent(F4 v) {
    return std::min(std::min(v[0], v[1]), v[2]);
}

/// Where the ray enters the box, or a negative number where it misses it.
float enter(const TracedRay& ray, const Box& box) {
    constexpr float kRounding = 1 + 4e-7f;
    const F4 a = (corner(box.lower) - ray.origin) * ray.inverse,
             b = (corner(box.upper) - ray.origin) * ray.inverse;
    const float in = std::max(maxComponent(a < b ? a : b), 0.f);
    const float out = std::min(minComponent(a < b ? b : a) * kRounding, ray.distance);
    return in <= out ? in : -1;
}

F4 crossed(F4 a, F4 b) {
    return F4{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}
float dotted(F4 a, F4 b) {
    const F4 p = a * b;
    return p[0] + p[1] + p[2];
}

std::int32_t wrapped(std::int32_t i, std::int32_t size, std::uint32_t wrap) {
    if (wrap == 1)
        return std::clamp(i, 0, size - 1);
    const std::int32_t period = wrap == 0 ? size : 2 * size;
    i %= period;
    i += i < 0 ? period : 0;
    return i < size ? i : period - 1 - i;
}

/// The image's alpha at a place in it, [0, 1].
float alphaAt(const TransportView& view, const Mask& mask, const float* uv) {
    float position[2];
    for (int k = 0; k < 2; ++k)
        position[k] = (mask.wrap[k] == 0 ? uv[k] - std::floor(uv[k]) : uv[k]) * float(mask.size[k]);
    const auto texel = [&](std::int32_t x, std::int32_t y) {
        x = wrapped(x, std::int32_t(mask.size[0]), mask.wrap[0]);
        y = wrapped(y, std::int32_t(mask.size[1]), mask.wrap[1]);
        const std::size_t row = std::size_t(y) * mask.size[0];
        return float(view.maskTexels[std::size_t(mask.begin) + row + std::size_t(x)]) / 255.f;
    };
    if (mask.nearest != 0)
        return texel(std::int32_t(std::floor(position[0])), std::int32_t(std::floor(position[1])));
    const float left = std::floor(position[0] - 0.5f), upper = std::floor(position[1] - 0.5f);
    const float fx = position[0] - 0.5f - left, fy = position[1] - 0.5f - upper;
    const auto x = std::int32_t(left), y = std::int32_t(upper);
    const float above = texel(x, y) * (1 - fx) + texel(x + 1, y) * fx,
                below = texel(x, y + 1) * (1 - fx) + texel(x + 1, y + 1) * fx;
    return above * (1 - fy) + below * fy;
}

/// Whether a triangle is there at the barycentrics (1 - u - v, u, v).
bool opaqueAt(const TransportView& view, std::uint32_t triangle, float u, float v) {
    const std::uint32_t number = view.cutout[triangle];
    if (number == kOpaque)
        return true;
    const Cutout& cutout = view.cutouts[number];
    const Cutout::Corner &a = cutout.corner[0], &b = cutout.corner[1], &c = cutout.corner[2];
    const float uv[2] = {a.u + u * (b.u - a.u) + v * (c.u - a.u),
                         a.v + u * (b.v - a.v) + v * (c.v - a.v)};
    const float factor = a.factor + u * (b.factor - a.factor) + v * (c.factor - a.factor);
    const Mask& mask = view.masks[cutout.mask];
    return factor * alphaAt(view, mask, uv) >= mask.cutoff;
}

bool meets(const TransportView& view, const TracedRay& ray, std::uint32_t number) {
    // An edge belongs to both triangles that share it, so that no ray slips through between them.
    constexpr float kEdge = 1e-6f;
    const float* const triangle = view.triangles + 9 * std::size_t(number);
    const F4 a = load3(triangle), ab = load3(triangle + 3) - a, ac = load3(triangle + 6) - a;
    const F4 p = crossed(ray.direction, ac);
    const float determinant = dotted(ab, p);
    if (determinant == 0)
        return false;
    const float inverse = 1 / determinant;
    const F4 from = ray.origin - a;
    const float u = dotted(from, p) * inverse;
    if (!(u >= -kEdge && u <= 1 + kEdge))
        return false;
    const F4 q = crossed(from, ab);
    const float v = dotted(ray.direction, q) * inverse;
    if (!(v >= -kEdge && u + v <= 1 + kEdge))
        return false;
    const float t = dotted(ac, q) * inverse;
    return t >= 0 && t <= ray.distance && opaqueAt(view, number, u, v);
}

bool meetsAny(const TransportView& view, const TracedRay& ray, const Box& leaf) {
    for (std::uint32_t k = 0; k < leaf.count; ++k)
        if (meets(view, ray, leaf.first + k))
            return true;
    return false;
}

} // namespace

bool occluded(const TransportView& view, F4 origin, F4 direction, float distance) {
    if (view.dims.boxes == 0)
        return false;
    TracedRay ray{origin, direction, {}, distance};
    for (int k = 0; k < 3; ++k) // never infinite, which times 0 would be NaN
        ray.inverse[k] = 1 / std::copysign(std::max(std::fabs(direction[k]), 1e-20f), direction[k]);
    std::uint32_t waiting[kMaxBoxDepth + 2];
    std::uint32_t count = 0, index = 0;
    if (enter(ray, view.boxes[0]) < 0)
        return false;
    for (;;) {
        const Box& box = view.boxes[index];
        if (box.count == 0) {
            const float left = enter(ray, view.boxes[box.first]),
                        right = enter(ray, view.boxes[box.first + 1]);
            const bool rightFirst = left < 0 || (right >= 0 && right < left);
            if (left >= 0 && right >= 0)
                waiting[count++] = box.first + (rightFirst ? 0 : 1);
            if (left >= 0 || right >= 0) {
                index = box.first + (rightFirst ? 1 : 0);
                continue;
            }
        } else if (meetsAny(view, ray, box)) {
            return true;
        }
        if (count == 0)
            return false;
        index = waiting[--count];
    }
}

float rayOffset(const TransportView& view, const float* p) {
    const float coordinate = std::max(std::max(std::fabs(p[0]), std::fabs(p[1])), std::fabs(p[2]));
    return 0x1p-19f * coordinate + 0x1p-20f * view.space->magnitude;
}

} // namespace limn::runtime
