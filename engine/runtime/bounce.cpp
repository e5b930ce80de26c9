// SPDX-License-Identifier: MIT
#include "engine/runtime/gather.h"
#include "engine/runtime/scene.h"

#include <algorithm>

namespace limn::runtime {

namespace {

F4 positive(F4 v) {
    return v > 0.f ? v : F4{};
}

/// B = albedo (E_direct + E_indirect) + pi L_e.
RoundChange lightSurfels(limnrt_scene& s) {
    constexpr float kBlack = 1e-30f; // fading light must not end in denormals, which are slow
    RoundChange round;
    for (std::size_t i = 0; i < s.view.dims.surfels; ++i) {
        F4 b = s.albedo[i] * (s.direct[i] + s.indirect[i]) + s.emitted[i];
        b = b > kBlack ? b : F4{};
        const F4 before = s.radiosity[i], d = b - before;
        const float change = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]),
                    sum = b[0] + b[1] + b[2];
        round.change += double(change) * double(s.view.surfelArea[i]);
        round.total += double(sum) * double(s.view.surfelArea[i]);
        round.relative += double(relativeChange(change, sum) * s.seenShare[i]);
        b[3] = lumaOf(b);
        s.radiosity[i] = b;
    }
    return round;
}

void pull(limnrt_scene& s) {
    F4* parent = s.radiosity + s.view.dims.leaves();
    for (std::size_t k = 0; k < s.view.dims.innerNodes; ++k) {
        const float w = s.view.leftWeight[k];
        parent[k] = s.radiosity[s.view.child[2 * k]] * splat(w) +
                    s.radiosity[s.view.child[2 * k + 1]] * splat(1 - w);
    }
}

void fill(limnrt_scene& s, std::uint32_t begin, std::uint32_t end, std::size_t coefficients) {
    const TransportView& v = s.view;
    for (std::uint32_t c = begin; c < end; ++c) {
        if (v.fillBegin[c] == v.fillBegin[c + 1])
            continue;
        F4* out = s.sh + c * s.coefficients();
        std::fill(out, out + coefficients, F4{});
        for (std::uint32_t k = v.fillBegin[c]; k < v.fillBegin[c + 1]; ++k) {
            const F4* source = s.sh + v.fillSource[k] * s.coefficients();
            for (std::size_t i = 0; i < coefficients; ++i)
                out[i] += source[i] * splat(v.fillWeight[k]);
        }
    }
}

/// Lets the light of the lightmap's caches [begin, end), whose second band is in colour, continue
/// below their surfaces with an even radiance, as docs/transport-format.md says. `grey`: the second
/// band is to be grey.
void continueBelow(limnrt_scene& s, std::uint32_t begin, std::uint32_t end, bool grey) {
    constexpr float kC0 = 1.41047396f, kC1 = -0.977205024f;       // 5 / (2 sqrt(pi)), -sqrt(3 / pi)
    constexpr float kBelow0 = 1.77245385f, kBelow1 = 1.53499006f; // sqrt(pi), sqrt(3 pi) / 2
    for (std::uint32_t c = begin; c < end; ++c) {
        const float* n = s.view.cacheNormal + 3 * std::size_t(c);
        F4* sh = s.sh + c * s.coefficients();
        const F4 below =
            sh[0] * splat(kC0) +
            (sh[3] * splat(n[0]) + sh[1] * splat(n[1]) + sh[2] * splat(n[2])) * splat(kC1);
        sh[0] += below * splat(kBelow0);
        sh[1] -= below * splat(kBelow1 * n[1]);
        sh[2] -= below * splat(kBelow1 * n[2]);
        sh[3] -= below * splat(kBelow1 * n[0]);
        for (int i = 1; grey && i < 4; ++i)
            sh[i] = F4{1, 1, 1, 0} * splat(lumaOf(sh[i]));
    }
}

/// Lights the caches [begin, end) of which `read` has the value `which`; 2: all.
void gatherSome(limnrt_scene& s, Bands bands, std::uint32_t begin, std::uint32_t end, int which) {
    const bool lightmap = begin < s.view.dims.lightmapCaches;
    const Gather gather{s.view,
                        s.radiosity,
                        s.blackSky ? s.endBeforeSky : s.linkEnd,
                        bands.luma,
                        lightmap ? std::max(bands.chroma, 2U) : bands.chroma,
                        s.sh,
                        s.coefficients()};
    for (std::uint32_t first = begin; first < end;) {
        std::uint32_t last = which == 2 ? end : first;
        while (last < end && s.read[last] == which)
            ++last;
        if (first < last) {
            gatherCaches(gather, first, last);
            continueBelow(s, first, std::min(last, s.view.dims.lightmapCaches), bands.chroma < 2);
        }
        first = last == first ? first + 1 : last;
    }
}

void readSurfels(limnrt_scene& s) {
    const std::size_t count = std::size_t(s.inner.luma) * s.inner.luma, stride = s.coefficients();
    for (std::size_t i = 0; i < s.view.dims.surfels; ++i) {
        const std::uint32_t* cache = s.view.surfelCache + 4 * i;
        const float *weight = s.view.surfelCacheWeight + 4 * i, *basis = s.surfelBasis + count * i;
        F4 sum{};
        for (int j = 0; j < 4; ++j) {
            if (weight[j] == 0)
                continue;
            const F4* sh = s.sh + cache[j] * stride;
            F4 irradiance{};
            for (std::size_t k = 0; k < count; ++k)
                irradiance += sh[k] * splat(basis[k]);
            sum += irradiance * splat(weight[j]);
        }
        s.indirect[i] = positive(sum);
    }
}

/// Per node its share of everything that caches see; `share` has an entry for each.
void seenShares(const TransportView& v, float* share) {
    std::fill(share, share + v.dims.nodes(), 0.f);
    share[v.dims.nodes() - 1] = 1;
    for (std::size_t k = v.dims.innerNodes; k-- > 0;) {
        const float whole = share[v.dims.leaves() + k], left = whole * v.leftWeight[k];
        share[v.child[2 * k]] += left;
        share[v.child[2 * k + 1]] += whole - left;
    }
}

/// Links that lead to nothing but sky and come last need not be read while the sky is black.
void endLinks(limnrt_scene& s, std::uint8_t* onlySky) {
    const TransportView& v = s.view;
    for (std::size_t k = 0; k < v.dims.nodes(); ++k)
        onlySky[k] = k < v.dims.leaves() ? k >= v.dims.surfels
                                         : onlySky[v.child[2 * (k - v.dims.leaves())]] &&
                                               onlySky[v.child[2 * (k - v.dims.leaves()) + 1]];
    for (std::uint32_t c = 0; c < v.dims.caches; ++c) {
        std::uint32_t end = v.linkBegin[c + 1];
        s.linkEnd[c] = end;
        while (end > v.linkBegin[c] && onlySky[v.links[end - 1].node])
            --end;
        s.endBeforeSky[c] = end;
    }
}

void flagCachesRead(limnrt_scene& s) {
    const TransportView& v = s.view;
    for (std::size_t k = 0; k < 4 * std::size_t(v.dims.surfels); ++k)
        if (v.surfelCacheWeight[k] > 0)
            s.read[v.surfelCache[k]] = 1;
    for (std::uint32_t c = 0; c < v.dims.caches; ++c)
        for (std::uint32_t k = v.fillBegin[c]; s.read[c] && k < v.fillBegin[c + 1]; ++k)
            s.read[v.fillSource[k]] = 1;
}

} // namespace

void irradianceBasis(std::uint32_t bands, const float* n, float* factor) {
    const float x = n[0], y = n[1], z = n[2];
    constexpr float k0 = 0.282094792f * kPi, k1 = 0.488602512f * 2 * kPi / 3,
                    k2 = 1.092548431f * kPi / 4;
    factor[0] = k0;
    factor[1] = k1 * y, factor[2] = k1 * z, factor[3] = k1 * x;
    if (bands < kIrradianceBands)
        return;
    factor[4] = k2 * x * y;
    factor[5] = k2 * y * z;
    factor[6] = k2 * 0.288675135f * (3 * z * z - 1);
    factor[7] = k2 * x * z;
    factor[8] = k2 * 0.5f * (x * x - y * y);
}

F4 irradianceOf(const limnrt_scene& s, const F4* sh, const float* normal) {
    float factor[9];
    irradianceBasis(s.inner.luma, normal, factor);
    F4 sum{};
    for (std::size_t k = 0; k < std::size_t(s.inner.luma) * s.inner.luma; ++k)
        sum += sh[k] * splat(factor[k]);
    return positive(sum);
}

void prepare(limnrt_scene& s) {
    const TransportView& v = s.view;
    const std::size_t count = std::size_t(s.inner.luma) * s.inner.luma;
    auto* shares = reinterpret_cast<float*>(s.radiosity); // its memory is free until the end
    seenShares(v, shares);
    for (std::size_t i = 0; i < v.dims.surfels; ++i) {
        s.seenShare[i] = shares[i];
        s.albedo[i] = load3(v.surfelAlbedo + 3 * i);
        s.emitted[i] = load3(v.surfelEmission + 3 * i) * splat(kPi);
        irradianceBasis(s.inner.luma, v.surfelNormal + 3 * i, s.surfelBasis + count * i);
    }
    endLinks(s, reinterpret_cast<std::uint8_t*>(s.radiosity));
    std::fill(s.radiosity, s.radiosity + v.dims.nodes(), F4{});
    flagCachesRead(s);
    for (std::uint32_t k = 0; k < s.options.max_lights; ++k)
        s.slotOf[k] = ~0U;
}

RoundChange bounce(limnrt_scene& s) {
    const RoundChange round = lightSurfels(s);
    pull(s);
    gatherSome(s, s.inner, 0, s.view.dims.lightmapCaches, 1);
    fill(s, 0, s.view.dims.lightmapCaches, std::size_t(s.inner.luma) * s.inner.luma);
    readSurfels(s);
    s.bounceLit = true;
    s.lightmapLit = s.gridLit = false;
    return round;
}

void lightResults(limnrt_scene& s, bool grid) {
    bool& lit = grid ? s.gridLit : s.lightmapLit;
    if (lit)
        return;
    const std::uint32_t begin = grid ? s.view.dims.lightmapCaches : 0,
                        end = grid ? s.view.dims.caches : s.view.dims.lightmapCaches;
    const bool restOnly = !grid && s.bounceLit && s.inner == s.results;
    gatherSome(s, s.results, begin, end, restOnly ? 0 : 2);
    fill(s, begin, end, s.coefficients());
    lit = true;
}

void takeSky(limnrt_scene& s, const float* rgb) {
    s.blackSky = true;
    for (std::size_t k = 0; k < s.view.dims.skyCells; ++k) {
        F4 b = load3(rgb + 3 * k) * splat(kPi);
        s.blackSky = s.blackSky && b[0] == 0 && b[1] == 0 && b[2] == 0;
        b[3] = lumaOf(b);
        s.radiosity[s.view.dims.surfels + k] = b;
    }
}

} // namespace limn::runtime
