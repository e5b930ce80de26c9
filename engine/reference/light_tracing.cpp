// SPDX-License-Identifier: MIT
#include "engine/reference/light_tracing.h"

#include "engine/core/parallel.h"
#include "engine/reference/half_sums.h"
#include "engine/reference/photon.h"
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
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

constexpr std::size_t kBlock = 1024;     ///< photons that one task traces
constexpr std::size_t kRound = 1u << 18; ///< photons between two merges, which bounds the memory

/// The eye as a sensor: where a point is in the picture, and how many pixels its surface covers.
class Sensor {
public:
    Sensor(const Camera& camera, std::uint32_t width, std::uint32_t height)
        : m_eye(camera.eye), m_size(width, height) {
        const PixelRays rays(camera, width, height);
        m_perPixel = {2.f / rays.size.x * rays.right, -2.f / rays.size.y * rays.up,
                      rays.centre - rays.right + rays.up};
        m_toPixel = glm::inverse(m_perPixel);
        m_volume = std::abs(double(glm::determinant(m_perPixel)));
    }

    struct Seen {
        std::uint32_t pixel = 0;  ///< y * width + x
        double pixelsPerArea = 0; ///< of the surface [m^-2]
    };
    /// Nothing where the surface faces away from the eye, or is outside of the picture.
    std::optional<Seen> find(const SurfacePoint& p) const {
        const glm::vec3 way = p.position - m_eye, onPlane = m_toPixel * way;
        const float cosine = -glm::dot(p.geometricNormal, way);
        if (!(cosine > 0) || !(onPlane.z > 0))
            return std::nullopt;
        const glm::vec2 pixel = glm::vec2(onPlane) / onPlane.z;
        if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x < m_size.x && pixel.y < m_size.y))
            return std::nullopt;
        // A pixel at D = centre + ... spans D_x x D_y, seen under the solid angle
        // (D_x x D_y) . D / |D|^3 = det(D_x, D_y, D) / |D|^3; with way = z D, an area dA is seen
        // under cos dA / |way|^2, where `cosine` is cos |way|.
        const double z = double(onPlane.z);
        return Seen{std::uint32_t(pixel.y) * std::uint32_t(m_size.x) + std::uint32_t(pixel.x),
                    double(cosine) / (z * z * z * m_volume)};
    }

private:
    glm::vec3 m_eye;
    glm::vec2 m_size;     ///< [pixels]
    glm::mat3 m_perPixel; ///< direction of a ray of (x, y, 1) in pixels
    glm::mat3 m_toPixel;  ///< its inverse
    double m_volume;      ///< its determinant
};

/// Light that a photon adds to a pixel.
struct Splat {
    std::uint32_t pixel = 0;
    std::uint32_t half = 0; ///< of the photons, see HalfSums
    glm::vec3 light{0};
};

struct LightTracer {
    const TraceScene& trace;
    const ReferenceOptions& options;
    LightSources sources;
    Sensor sensor;
    glm::vec3 eye;

    bool isSeen(const SurfacePoint& p, std::uint64_t& rays) const {
        ++rays;
        return !trace.occluded(rayBetween(rayOrigin(trace, p), eye), TraceMask::Seen);
    }

    /// Appends what photons [begin, end) add to the picture, times their number.
    void addSplats(std::uint64_t begin, std::uint64_t end, std::vector<Splat>& splats,
                   std::uint64_t& rays) const {
        std::vector<PhotonHit> hits;
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint32_t half = i & 1;
            const Sampler sampler{mixBits(options.seed, half), std::uint32_t(i >> 1)};
            hits.clear();
            tracePhoton(trace, sources, options.maxBounces, sampler, hits, rays);
            for (const PhotonHit& hit : hits) {
                if (hit.isDirect())
                    continue;
                glm::vec3 light = hit.power * hit.shadingRatio();
                if (options.view == View::Indirect)
                    light *= hit.surface.albedo / glm::pi<float>();
                const std::optional<Sensor::Seen> seen = sensor.find(hit.surface);
                if (seen && channelSum(light) > 0 && isSeen(hit.surface, rays))
                    splats.push_back({seen->pixel, half, light * float(seen->pixelsPerArea)});
            }
        }
    }
};

} // namespace

/// The parts of a job that run one after the other, each with its share of the progress.
static Progress partOf(const Progress& whole, float begin, float end) {
    Progress part;
    part.cancel = whole.cancel;
    part.report = [&whole, begin, end](const char* stage, float f) {
        whole.at(stage, begin + f * (end - begin));
    };
    return part;
}

static ReferenceResult tracePhotons(const TraceScene& trace, const ReferenceOptions& options,
                                    const Progress& progress) {
    const LightTracer tracer{trace, options, findLightSources(trace),
                             Sensor(options.camera, options.width, options.height),
                             options.camera.eye};
    const std::uint64_t pixels = std::uint64_t(options.width) * options.height,
                        photons = pixels * options.samplesPerPixel;
    std::vector<HalfSums> sums(pixels);
    std::vector<std::vector<Splat>> splats(kRound / kBlock);
    std::atomic<std::uint64_t> rays = 0;
    std::uint64_t done = 0;
    while (done < photons && !tracer.sources.empty()) {
        const std::uint64_t count = std::min<std::uint64_t>(kRound, photons - done);
        const Progress part =
            partOf(progress, float(done) / float(photons), float(done + count) / float(photons));
        const bool complete = parallelRanges(
            count, kBlock, part, "photons", [&](std::size_t first, std::size_t last) {
                std::uint64_t traced = 0;
                splats[first / kBlock].clear();
                tracer.addSplats(done + first, done + last, splats[first / kBlock], traced);
                rays += traced;
            });
        if (!complete)
            break;
        for (std::size_t block = 0; block * kBlock < count; ++block)
            for (const Splat& splat : splats[block])
                sums[splat.pixel].half[splat.half] += glm::dvec3(splat.light);
        done += count;
    }
    if (tracer.sources.empty())
        done = photons; // of darkness, whose picture is exact

    ReferenceResult result;
    result.image = {options.width, options.height, std::vector<glm::vec3>(pixels)};
    result.samplesPerPixel = std::uint32_t(done / pixels);
    result.rays = rays;
    PictureNoise noise;
    for (std::size_t i = 0; i < pixels && done > 0; ++i) {
        result.image.rgb[i] = glm::vec3(sums[i].mean(done));
        noise.add(sums[i], done);
    }
    result.noise = noise.relative(pixels, done);
    return result;
}

bool canBeLightTraced(View view) {
    return view == View::Lit || view == View::Irradiance || view == View::Indirect;
}

ReferenceResult renderLightTraced(const TraceScene& trace, const ReferenceOptions& options,
                                  const Progress& progress) {
    assert(options.width > 0 && options.height > 0 && canBeLightTraced(options.view));
    if (options.view != View::Lit)
        return tracePhotons(trace, options, progress);
    ReferenceOptions seen = options, bounced = options;
    seen.showsDiffuseBounces = false;
    seen.lampShadows = TraceMask::Seen; // photons bring what passes sheets
    bounced.view = View::Indirect;
    ReferenceResult sum = renderReference(trace, seen, partOf(progress, 0, 0.5f));
    const ReferenceResult added = tracePhotons(trace, bounced, partOf(progress, 0.5f, 1));
    double before = 0, whole = 0, brought = 0; // sums of light, in which the noises are relative
    for (std::size_t i = 0; i < sum.image.rgb.size(); ++i) {
        before += double(channelSum(sum.image.rgb[i]));
        brought += double(channelSum(added.image.rgb[i]));
        sum.image.rgb[i] += added.image.rgb[i];
        whole += double(channelSum(sum.image.rgb[i]));
    }
    sum.samplesPerPixel = std::min(sum.samplesPerPixel, added.samplesPerPixel);
    if (sum.samplesPerPixel < 2)
        sum.noise = std::numeric_limits<double>::infinity();
    else if (whole > 0)
        sum.noise = std::hypot(sum.noise * before, added.noise * brought) / whole;
    sum.rays += added.rays;
    return sum;
}

} // namespace limn
