// SPDX-License-Identifier: MIT
#include "engine/reference/reference.h"

#include "engine/core/parallel.h"
#include "engine/reference/path.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kTile = 256;   ///< pixels
constexpr std::uint32_t kMaxPass = 16; ///< samples per pixel in one pass over all pixels
constexpr std::size_t kSampleBlock = 1024;

/// Sums of the two halves of a pixel's samples. The halves are scrambled independently, so their
/// difference measures the error of low-discrepancy points, which the samples' variance cannot.
struct PixelSum {
    glm::dvec3 half[2] = {glm::dvec3(0), glm::dvec3(0)};
};

glm::vec3 sampleView(const PathContext& c, View view, const Ray& ray, const Sampler& sampler,
                     std::uint64_t& rays) {
    ++rays;
    const Hit hit = c.trace.closestHit(ray);
    if (!hit)
        return view == View::Lit ? skyRadiance(c.trace.scene().sky, ray.direction) : glm::vec3(0);
    const std::optional<SurfacePoint> p = surfacePoint(c.trace, hit);
    if (!p)
        return glm::vec3(0);
    if (view == View::Albedo)
        return p->albedo;
    if (view == View::Irradiance)
        return sampleIndirectIrradiance(c, *p, sampler, rays);
    DirectSample direct;
    glm::vec3 indirect(0);
    if (view == View::Lit || view == View::Direct)
        direct = sampleDirectLight(c.trace, *p, sampler.pair(1).x, sampler.pair(kOnLightDimension),
                                   rays);
    if (view == View::Lit || view == View::Indirect)
        indirect = p->albedo / glm::pi<float>() * sampleIndirectIrradiance(c, *p, sampler, rays);
    if (view != View::Lit)
        return p->albedo / glm::pi<float>() * direct.irradiance + indirect;
    const GlossyPoint g = glossyPoint(c.trace, hit, ray, *p);
    const glm::vec3 glossy = sampleReflectedRadiance(c, g, sampler, rays);
    return p->emission + g.reflect(direct.irradiance, direct.toLight) + indirect + glossy;
}

/// Adds samples [begin, end) of one pixel.
void addSamples(const PathContext& c, const ReferenceOptions& o, const PixelRays& pixelRays,
                std::uint32_t pixel, std::uint32_t begin, std::uint32_t end, PixelSum& sum,
                std::uint64_t& rays) {
    const glm::vec2 corner(float(pixel % o.width), float(pixel / o.width));
    for (std::uint32_t s = begin; s < end; ++s) {
        const std::uint32_t half = s & 1;
        const Sampler sampler{mixBits(mixBits(o.seed, half), pixel), s >> 1};
        const Ray ray = pixelRays.through(corner + sampler.pair(0));
        sum.half[half] += glm::dvec3(sampleView(c, o.view, ray, sampler, rays));
    }
}

/// Sets image and noise. Var(mean) of n samples from their halves' means a, b: (a - b)^2 n_a n_b /
/// n^2.
void resolve(const std::vector<PixelSum>& sums, const std::vector<std::uint32_t>& tileSamples,
             ReferenceResult& result) {
    double variance = 0, total = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::uint32_t n = tileSamples[i / kTile], nb = n / 2, na = n - nb;
        if (n == 0)
            continue;
        const PixelSum& s = sums[i];
        const glm::dvec3 mean = (s.half[0] + s.half[1]) / double(n);
        result.image.rgb[i] = glm::vec3(mean);
        total += mean.x + mean.y + mean.z;
        if (nb == 0)
            continue;
        const glm::dvec3 d = s.half[0] / double(na) - s.half[1] / double(nb);
        variance += glm::dot(d, d) * double(na) * double(nb) / (double(n) * double(n));
    }
    const double values = 3 * double(sums.size());
    if (result.samplesPerPixel < 2)
        result.noise = std::numeric_limits<double>::infinity();
    else
        result.noise = variance > 0 ? std::sqrt(variance / values) / (total / values) : 0;
}

} // namespace

ReferenceResult renderReference(const TraceScene& trace, const ReferenceOptions& options,
                                const Progress& progress) {
    assert(options.width > 0 && options.height > 0);
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(trace.scene().sky);
    const PathContext context{trace, emitters, sky, options.maxBounces};
    const PixelRays pixelRays(options.camera, options.width, options.height);
    const std::size_t pixels = std::size_t(options.width) * options.height;
    std::vector<PixelSum> sums(pixels);
    std::vector<std::uint32_t> tileSamples((pixels + kTile - 1) / kTile, 0);
    std::atomic<std::uint64_t> rays = 0;

    std::uint32_t done = 0, pass = 1;
    while (done < options.samplesPerPixel) {
        const std::uint32_t end = std::min(done + pass, options.samplesPerPixel);
        Progress part;
        part.cancel = progress.cancel;
        part.report = [&](const char* stage, float f) {
            progress.at(stage,
                        (float(done) + f * float(end - done)) / float(options.samplesPerPixel));
        };
        const bool complete = parallelRanges(
            pixels, kTile, part, "samples", [&](std::size_t first, std::size_t last) {
                std::uint64_t traced = 0;
                for (std::size_t i = first; i < last; ++i)
                    addSamples(context, options, pixelRays, std::uint32_t(i), done, end, sums[i],
                               traced);
                tileSamples[first / kTile] = end;
                rays += traced;
            });
        if (!complete)
            break;
        done = end;
        pass = std::min(2 * pass, kMaxPass);
    }

    ReferenceResult result;
    result.image = {options.width, options.height, std::vector<glm::vec3>(pixels)};
    result.samplesPerPixel = *std::min_element(tileSamples.begin(), tileSamples.end());
    result.rays = rays;
    resolve(sums, tileSamples, result);
    return result;
}

glm::vec3 referenceIrradiance(const TraceScene& trace, glm::vec3 position, glm::vec3 normal,
                              std::uint32_t samples, std::uint32_t maxBounces, bool includeDirect,
                              std::uint32_t seed) {
    assert(samples > 0);
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(trace.scene().sky);
    const PathContext context{trace, emitters, sky, maxBounces};
    SurfacePoint p;
    p.position = position;
    p.normal = p.geometricNormal = normal;
    std::vector<glm::dvec3> sums((samples + kSampleBlock - 1) / kSampleBlock, glm::dvec3(0));
    parallelRanges(sums.size(), 1, [&](std::size_t first, std::size_t last) {
        std::uint64_t rays = 0;
        for (std::size_t block = first; block < last; ++block)
            for (std::size_t s = block * kSampleBlock;
                 s < std::min<std::size_t>((block + 1) * kSampleBlock, samples); ++s)
                sums[block] += glm::dvec3(sampleIndirectIrradiance(
                    context, p, {mixBits(seed, 0), std::uint32_t(s)}, rays));
    });
    glm::dvec3 sum(0);
    for (const glm::dvec3& s : sums)
        sum += s;
    std::uint64_t rays = 0;
    const glm::vec3 direct = includeDirect ? directIrradiance(trace, p, rays) : glm::vec3(0);
    return glm::vec3(sum / double(samples)) + direct;
}

} // namespace limn
