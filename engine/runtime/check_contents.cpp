// SPDX-License-Identifier: MIT
#include "engine/runtime/transport_view.h"

#include <cmath>
#include <cstdio>

namespace limn::runtime {

namespace {

constexpr float kFarthest = 1e12f;

/// Whether all of `n` values lie in [lower, upper]; NaN does not.
bool within(const float* v, std::uint64_t n, float lower, float upper) {
    bool all = true;
    for (std::uint64_t k = 0; k < n; ++k)
        all &= v[k] >= lower && v[k] <= upper;
    return all;
}
bool placed(const float* v, std::uint64_t points) {
    return within(v, 3 * points, -kFarthest, kFarthest);
}
bool unit(const float* v, std::uint64_t n) {
    bool all = true;
    for (std::uint64_t k = 0; k < n; ++k, v += 3)
        all &= std::fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) < 1e-2f;
    return all;
}
bool below(const std::uint32_t* v, std::uint64_t n, std::uint64_t limit) {
    bool all = true;
    for (std::uint64_t k = 0; k < n; ++k)
        all &= v[k] < limit;
    return all;
}
/// Whether n + 1 offsets begin with 0, end with `total`, and steps lie in [0, longest].
bool offsets(const std::uint32_t* v, std::uint64_t n, std::uint64_t total, std::uint64_t longest) {
    bool all = v[0] == 0 && v[n] == total;
    for (std::uint64_t k = 0; k < n; ++k)
        all &= v[k] <= v[k + 1] && std::uint64_t(v[k + 1]) - v[k] <= longest;
    return all;
}

bool readsCaches(const TransportView& v) {
    for (std::uint64_t k = 0; k < 4 * std::uint64_t(v.dims.surfels); ++k)
        if (v.surfelCache[k] == LIMNRT_NO_CACHE ? v.surfelCacheWeight[k] != 0
                                                : v.surfelCache[k] >= v.dims.lightmapCaches)
            return false;
    return true;
}

bool comesAfterItsChildren(const TransportView& v) {
    for (std::uint64_t k = 0; k < v.dims.innerNodes; ++k)
        if (v.child[2 * k] >= v.dims.leaves() + k || v.child[2 * k + 1] >= v.dims.leaves() + k)
            return false;
    return true;
}

/// Links bring finite light; several hundred times the possible maximum are refused.
bool linksAreBounded(const TransportView& v) {
    constexpr int kTwo = 0x4000, kLargest = 0x7bff; // halfs
    for (std::uint32_t c = 0; c < v.dims.caches; ++c) {
        const int power = 10 + v.linkExponent[c]; // 2^power is a transport of 1024
        const int maxTransport = power > 15 ? kLargest : power < -14 ? 0x3ff : (power + 15) << 10;
        for (std::uint32_t k = v.linkBegin[c]; k < v.linkBegin[c + 1]; ++k)
            if (v.links[k].node >= v.dims.nodes() || v.links[k].u > kTwo ||
                v.links[k].transport > maxTransport)
                return false;
    }
    return true;
}

bool fillsFromValid(const TransportView& v) {
    for (std::uint32_t c = 0; c < v.dims.caches; ++c)
        for (std::uint32_t k = v.fillBegin[c]; k < v.fillBegin[c + 1]; ++k) {
            const std::uint32_t source = v.fillSource[k];
            if (source >= v.dims.caches || v.fillBegin[source] != v.fillBegin[source + 1] ||
                (source < v.dims.lightmapCaches) != (c < v.dims.lightmapCaches))
                return false;
        }
    return true;
}

/// Boxes in breadth-first order, each with one parent, at most kMaxBoxDepth deep; the leaves share
/// out the triangles in order. A ray therefore visits each at most once.
const char* boxesDefect(const TransportView& v) {
    std::uint64_t children = 1, triangles = 0, levelEnd = 1;
    std::uint32_t depth = 0;
    for (std::uint64_t k = 0; k < v.dims.boxes; ++k) {
        if (k == levelEnd) {
            levelEnd = children;
            if (++depth > kMaxBoxDepth)
                return "deeper than 60 levels";
        }
        const Box& box = v.boxes[k];
        if (box.count == 0) {
            if (box.first != children)
                return "not in breadth-first order";
            children += 2;
        } else {
            if (box.first != triangles)
                return "leaves that do not follow each other";
            triangles += box.count;
        }
        if (children > v.dims.boxes || triangles > v.dims.triangles)
            return "a child or triangle out of range";
    }
    if (v.dims.boxes > 0 && (children != v.dims.boxes || triangles != v.dims.triangles))
        return "a box or triangle without parent";
    return nullptr;
}

bool boxesArePlaced(const TransportView& v) {
    for (std::uint64_t k = 0; k < v.dims.boxes; ++k)
        if (!placed(v.boxes[k].lower, 1) || !placed(v.boxes[k].upper, 1))
            return false;
    return true;
}

bool gridIsPlaced(const TransportView& v) {
    const Space& s = *v.space;
    for (int k = 0; v.dims.cells() > 0 && k < 3; ++k)
        if (!(s.gridLower[k] < s.gridUpper[k]))
            return false;
    return placed(s.gridLower, 1) && placed(s.gridUpper, 1) && s.magnitude >= 0 &&
           s.magnitude <= 2 * kFarthest;
}

bool namesAreWhole(const TransportView& v) {
    std::uint64_t ends = 0;
    for (std::size_t k = 0; k < v.nameBytes; ++k)
        ends += v.names[k] == 0;
    return ends == v.dims.materials && (v.nameBytes == 0 || v.names[v.nameBytes - 1] == 0);
}

bool areLights(const TransportView& v) {
    for (std::uint32_t k = 0; k < v.dims.lights; ++k)
        if (!isLight(v.lights[k]))
            return false;
    return true;
}

bool cutoutsAreNumbered(const TransportView& v) {
    for (std::uint32_t k = 0; k < v.dims.triangles; ++k)
        if (v.cutout[k] != kOpaque && v.cutout[k] >= v.dims.cutouts)
            return false;
    return true;
}

bool cutoutsAreBounded(const TransportView& v) {
    constexpr float kMaxUv = 1e4f, kMaxFactor = 1e10f;
    for (std::uint32_t k = 0; k < v.dims.cutouts; ++k) {
        if (v.cutouts[k].mask >= v.dims.masks)
            return false;
        for (const Cutout::Corner& c : v.cutouts[k].corner)
            if (!within(&c.u, 2, -kMaxUv, kMaxUv) || !within(&c.factor, 1, 0, kMaxFactor))
                return false;
    }
    return true;
}

/// Whether all of each mask's texels lie in the file.
bool masksAreHeld(const TransportView& v) {
    constexpr std::uint32_t kMaxSide = 1 << 16, kLastWrap = 2;
    for (std::uint32_t k = 0; k < v.dims.masks; ++k) {
        const Mask& m = v.masks[k];
        for (int axis = 0; axis < 2; ++axis)
            if (m.size[axis] < 1 || m.size[axis] > kMaxSide || m.wrap[axis] > kLastWrap)
                return false;
        const std::uint64_t texels = std::uint64_t(m.size[0]) * m.size[1];
        if (m.begin > v.maskTexelCount || texels > v.maskTexelCount - m.begin || m.nearest > 1 ||
            !within(&m.cutoff, 1, 0, kMaxLight))
            return false;
    }
    return true;
}

struct Defect {
    const char *tag, *what;
};

constexpr float kMaxWeight = 1 + 1e-3f;

Defect senderDefect(const TransportView& v) {
    const std::uint64_t n = v.dims.surfels, inner = v.dims.innerNodes, sky = v.dims.skyCells;
    if (!placed(v.surfelPosition, n))
        return {"SPOS", "out of range"};
    if (!placed(v.lightPoint, n * v.lightPointsEach))
        return {"SLPT", "out of range"};
    if (v.lightNormal && !unit(v.lightNormal, n * v.lightPointsEach))
        return {"SLNM", "not of unit length"};
    if (!unit(v.surfelNormal, n))
        return {"SNRM", "not of unit length"};
    if (!within(v.surfelAlbedo, 3 * n, 0, kMaxAlbedo))
        return {"SALB", "out of range"};
    if (!within(v.surfelEmission, 3 * n, 0, kMaxLight))
        return {"SEMI", "out of range"};
    if (!within(v.surfelArea, n, 0, 1e30f))
        return {"SARE", "out of range"};
    if (!below(v.surfelMaterial, n, v.dims.materials))
        return {"SMAT", "out of range"};
    if (!within(v.surfelCacheWeight, 4 * n, 0, kMaxWeight))
        return {"SCWT", "out of range"};
    if (!readsCaches(v))
        return {"SCAC", "out of range"};
    if (!comesAfterItsChildren(v))
        return {"TCHI", "a child that does not come before its parent"};
    if (!within(v.leftWeight, inner, 0, 1))
        return {"TWGT", "out of range"};
    if (!unit(v.skyDirection, sky))
        return {"SKYD", "not of unit length"};
    if (!within(v.skyRadiance, 3 * sky, 0, kMaxLight))
        return {"SKYL", "out of range"};
    return {};
}

Defect receiverDefect(const TransportView& v) {
    const std::uint64_t n = v.dims.caches;
    if (!placed(v.cachePosition, n))
        return {"CPOS", "out of range"};
    if (!unit(v.cacheNormal, v.dims.lightmapCaches) || !within(v.cacheNormal, 3 * n, -1.01f, 1.01f))
        return {"CNRM", "not of unit length"};
    if (!offsets(v.linkBegin, n, v.dims.links, ~0U))
        return {"LBEG", "not in order"};
    if (!linksAreBounded(v))
        return {"LINK", "out of range"};
    if (!offsets(v.fillBegin, n, v.dims.fills, ~0U))
        return {"FBEG", "not in order"};
    if (!fillsFromValid(v))
        return {"FSRC", "out of range, or a cache that is filled itself, or of another kind"};
    if (!within(v.fillWeight, v.dims.fills, 0, kMaxWeight))
        return {"FWGT", "out of range"};
    if (!offsets(v.partBegin, v.dims.texels(), v.dims.lightmapParts, 4))
        return {"LMBG", "not in order, or more than four caches for a texel"};
    if (!below(v.partCache, v.dims.lightmapParts, v.dims.lightmapCaches))
        return {"LMSR", "out of range"};
    return {};
}

Defect placeDefect(const TransportView& v) {
    if (!gridIsPlaced(v))
        return {"SPAC", "out of range"};
    if (!boxesArePlaced(v))
        return {"OBOX", "out of range"};
    if (const char* what = boxesDefect(v))
        return {"OBOX", what};
    if (!placed(v.triangles, 3 * std::uint64_t(v.dims.triangles)))
        return {"OTRI", "out of range"};
    if (!cutoutsAreNumbered(v))
        return {"OCUT", "out of range"};
    if (!cutoutsAreBounded(v))
        return {"CTRI", "out of range"};
    if (!masksAreHeld(v))
        return {"CMSK", "out of range"};
    if (!areLights(v))
        return {"LGHT", "out of range"};
    if (!namesAreWhole(v))
        return {"MNAM", "not one name for each material"};
    return {};
}

} // namespace

bool isLight(const limnrt_light& light) {
    constexpr float kHalfTurn = 1.5708f;
    const bool turned = light.kind == LIMNRT_POINT || unit(light.direction, 1);
    const bool coned = light.kind != LIMNRT_SPOT ||
                       (light.inner_angle >= 0 && light.inner_angle < light.outer_angle &&
                        light.outer_angle <= kHalfTurn);
    const bool sized = light.kind != LIMNRT_RECTANGLE || (within(&light.width, 1, 1e-6f, 1e6f) &&
                                                          within(&light.height, 1, 1e-6f, 1e6f) &&
                                                          within(&light.roll, 1, -1e6f, 1e6f));
    return light.kind <= LIMNRT_RECTANGLE && placed(light.position, 1) && turned && coned &&
           sized && within(light.direction, 3, -2, 2) && within(light.color, 3, 0, kMaxLight) &&
           within(&light.strength, 1, 0, kMaxLight) && within(&light.range, 1, 0, kFarthest);
}

bool checkContents(const TransportView& view, ErrorText error) {
    Defect defect = senderDefect(view);
    if (!defect.tag)
        defect = receiverDefect(view);
    if (!defect.tag)
        defect = placeDefect(view);
    if (defect.tag && error.size > 0)
        std::snprintf(error.text, error.size, "section %s: %s", defect.tag, defect.what);
    return !defect.tag;
}

} // namespace limn::runtime
