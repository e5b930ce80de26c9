// SPDX-License-Identifier: MIT
#include "engine/reference/reference.h"

#include "engine/core/parallel.h"
#include "engine/reference/half_sums.h"
#include "engine/reference/path.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/passed_ray.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kTile = 256;   ///< pixels
constexpr std::uint32_t kMaxPass = 16; ///< samples per pixel in one pass over all pixels
constexpr std::size_t kSampleBlock = 1024;
constexpr std::uint32_t kPassingSeed = 0x70617373; ///< separates the numbers of passRay()

/// Radiance that a surface, met by `ray`, sends to the eye.
glm::vec3 sampleRadiance(const PathContext& c, const Hit& hit, const Ray& ray,
                         const SurfacePoint& p, bool diffuseBounces, const Sampler& sampler,
                         std::uint64_t& rays) {
    const DirectSample direct = sampleDirectLight(
        c.trace, p, sampler.pair(1).x, sampler.pair(kOnLightDimension), rays, c.lampShadows);
    glm::vec3 indirect(0);
    if (diffuseBounces)
        indirect = p.albedo / glm::pi<float>() * sampleIndirectIrradiance(c, p, sampler, rays);
    const GlossyPoint g = glossyPoint(c.trace, hit, ray, p);
    const glm::vec3 glossy = sampleReflectedRadiance(c, g, sampler, rays);
    return p.emission + g.reflect(direct.irradiance, direct.toLight) + indirect + glossy;
}

/// Radiance that reaches the eye along a ray, and through transmissive surfaces.
glm::vec3 sampleSight(const PathContext& c, Ray ray, bool diffuseBounces, const Sampler& sampler,
                      std::uint64_t& rays) {
    const Sampler passing{mixBits(sampler.seed, kPassingSeed), sampler.index};
    glm::vec3 L(0), weight(1);
    for (std::uint32_t crossing = 0; crossing <= kMaxCrossings; ++crossing) {
        ++rays;
        const Hit hit = c.trace.closestHit(ray, TraceMask::Seen);
        if (!hit)
            return L + weight * skyRadiance(c.trace.scene().sky, ray.direction);
        const std::optional<SurfacePoint> p = surfacePoint(c.trace, hit);
        if (p && !isWithinBody(c.trace.scene(), hit))
            L += weight *
                 sampleRadiance(c, hit, ray, *p, diffuseBounces || crossing > 0, sampler, rays);
        const PassedRay passed = passRay(c.trace, hit, ray, passing.pair(2 * crossing).x,
                                         passing.pair(2 * crossing + 1));
        if (passed.weight == glm::vec3(0))
            break;
        weight *= passed.weight;
        ray = passed.ray;
    }
    return L;
}

glm::vec3 sampleView(const PathContext& c, const ReferenceOptions& o, const Ray& ray,
                     const Sampler& sampler, std::uint64_t& rays) {
    const View view = o.view;
    if (view == View::Lit)
        return sampleSight(c, ray, o.showsDiffuseBounces, sampler, rays);
    ++rays;
    const Hit hit = c.trace.closestHit(ray, TraceMask::Seen);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(c.trace, hit) : std::nullopt;
    if (!p)
        return glm::vec3(0);
    if (view == View::Albedo)
        return p->albedo;
    if (view == View::Direct)
        return p->albedo / glm::pi<float>() *
               sampleDirectLight(c.trace, *p, sampler.pair(1).x, sampler.pair(kOnLightDimension),
                                 rays, c.lampShadows)
                   .irradiance;
    const glm::vec3 E = sampleIndirectIrradiance(c, *p, sampler, rays);
    return view == View::Irradiance ? E : p->albedo / glm::pi<float>() * E;
}

/// Adds samples [begin, end) of one pixel.
void addSamples(const PathContext& c, const ReferenceOptions& o, const PixelRays& pixelRays,
                std::uint32_t pixel, std::uint32_t begin, std::uint32_t end, HalfSums& sum,
                std::uint64_t& rays) {
    const glm::vec2 corner(float(pixel % o.width), float(pixel / o.width));
    for (std::uint32_t s = begin; s < end; ++s) {
        const std::uint32_t half = s & 1;
        const Sampler sampler{mixBits(mixBits(o.seed, half), pixel), s >> 1};
        const Ray ray = pixelRays.through(corner + sampler.pair(0));
        sum.half[half] += glm::dvec3(sampleView(c, o, ray, sampler, rays));
    }
}

/// Sets image and noise.
void resolve(const std::vector<HalfSums>& sums, const std::vector<std::uint32_t>& tileSamples,
             ReferenceResult& result) {
    PictureNoise noise;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::uint32_t n = tileSamples[i / kTile];
        if (n == 0)
            continue;
        result.image.rgb[i] = glm::vec3(sums[i].mean(n));
        noise.add(sums[i], n);
    }
    result.noise = noise.relative(sums.size(), result.samplesPerPixel);
}

} // namespace

ReferenceResult renderReference(const TraceScene& trace, const ReferenceOptions& options,
                                const Progress& progress) {
    assert(options.width > 0 && options.height > 0);
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(trace.scene().sky);
    const PathContext context{trace, emitters, sky, options.maxBounces, options.lampShadows};
    const PixelRays pixelRays(options.camera, options.width, options.height);
    const std::size_t pixels = std::size_t(options.width) * options.height;
    std::vector<HalfSums> sums(pixels);
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
