// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace limn {

/// What a picture shows; the same for `render` and `reference`. Direct: the first hit of
/// directional, point and spot lights. Indirect: everything else that reaches a diffuse surface
/// (bounces, light of emissive materials, sky). Irradiance: Indirect with the first surface's
/// albedo replaced by 1, not divided by pi [W m^-2]. Lit: direct + indirect + the surface's own
/// emission + specular; the background is the sky. In every other view the background is 0.
enum class View : std::uint32_t { Lit, Direct, Indirect, Irradiance, Albedo, Normals };

constexpr bool showsBouncedLight(View view) {
    return view == View::Lit || view == View::Indirect || view == View::Irradiance;
}

/// How finely pictures are sampled that are meant to be right rather than fast.
struct PictureSamples {
    std::uint32_t perPixel;
    std::uint32_t nearRays;   ///< of each sample, which look for near surfaces
    std::uint32_t gatherRays; ///< of each sample, for final gathering
};

/// Of pictures in files, unless one asks for others. With 16 samples, the rim of a bright lamp is
/// wrong by more than its bounced light.
inline constexpr PictureSamples kFileSamples{.perPixel = 64, .nearRays = 1, .gatherRays = 1};

/// Of what an editor shows at rest: as many rays, with fewer samples to draw.
inline constexpr PictureSamples kScreenSamples{.perPixel = 16, .nearRays = 4, .gatherRays = 4};

/// What is drawn over a picture, which fades beneath it, to find faults: the edges of all
/// triangles, or pixels with a NaN or Inf.
enum class Inspection : std::uint32_t { None, Wireframe, InvalidPixels };

enum class Tonemap : std::uint32_t { None, Aces, Agx, PbrNeutral };

inline constexpr std::array<std::string_view, 6> kViewNames = {"lit",        "direct", "indirect",
                                                               "irradiance", "albedo", "normals"};
inline constexpr std::array<std::string_view, 3> kInspectionNames = {"none", "wireframe",
                                                                     "invalid-pixels"};
inline constexpr std::array<std::string_view, 4> kTonemapNames = {"none", "aces", "agx", "neutral"};

} // namespace limn
