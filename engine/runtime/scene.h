// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/convergence.h"
#include "engine/runtime/extrapolation.h"
#include "engine/runtime/transport_view.h"
#include "engine/runtime/vectors.h"

#include <cstddef>
#include <cstdint>

namespace limn::runtime {

inline constexpr std::uint32_t kIrradianceBands = 3;
inline constexpr float kPi = 3.14159265f;

/// Shadows of a light that were traced once.
struct LightSlot {
    limnrt_light light;
    bool known; ///< `share` belongs to a light of this shape
    bool used;  ///< by a light of the latest limnrt_set_lights()
    float* share;
};

/// Results that were kept, three numbers per coefficient of a cache: value / 32767 times its scale.
struct KeptLight {
    bool used;
    float* scale;
    std::int16_t* values;
};

/// Bands that are gathered.
struct Bands {
    std::uint32_t luma, chroma;
    bool operator==(const Bands&) const = default;
};

} // namespace limn::runtime

/// An opened file and its light. All arrays lie in one block.
struct limnrt_scene {
    limn::runtime::TransportView view;
    limnrt_options options;              ///< with its defaults filled in
    std::size_t memory;                  ///< bytes of the block, which begins with this struct
    limn::runtime::Bands results, inner; ///< bands of results, and of what surfels read
    limn::runtime::Convergence convergence;
    limn::runtime::Extrapolation ahead;
    bool blackSky, ownDirect;
    /// What `sh` holds of the present radiosity: what the surfels read, in `inner`; or results.
    bool bounceLit, lightmapLit, gridLit;
    std::uint32_t lightCount;

    limn::runtime::F4 *albedo, *emitted;  ///< per surfel; emitted: pi L_e [W m^-2]
    limn::runtime::F4 *direct, *indirect; ///< irradiance per surfel [W m^-2]
    limn::runtime::F4* radiosity;         ///< per node: red, green, blue, luma [W m^-2]
    limn::runtime::F4* sh;                ///< bands^2 per cache [W m^-2 sr^-1]
    limn::runtime::F4* cacheIrradiance;   ///< per lightmap cache, working space
    float *seenShare, *surfelBasis;       ///< per surfel: one, and `inner`'s coefficients
    std::uint32_t* endBeforeSky;          ///< per cache
    std::uint32_t* linkEnd;               ///< per cache: all links
    std::uint8_t* read;                   ///< per cache: some surfel reads it, or a source of it
    limnrt_light* lights;                 ///< the latest, of max_lights
    limn::runtime::LightSlot* slots;      ///< max_lights
    std::uint32_t* slotOf;                ///< per light: its slot, or ~0 where it is off
    limn::runtime::KeptLight* kept;       ///< max_kept

    std::size_t coefficients() const { return std::size_t(results.luma) * results.luma; }
};

namespace limn::runtime {

/// Factors with which 4 or 9 coefficients of radiance make irradiance at normal `n`.
/// Ramamoorthi and Hanrahan. An Efficient Representation for Irradiance Environment Maps. 2001
void irradianceBasis(std::uint32_t bands, const float* n, float* factor);

/// Fills in what follows from the file: albedo, emission, shares, flags. The block is zeroed.
void prepare(limnrt_scene& scene);

/// One bounce.
RoundChange bounce(limnrt_scene& scene);

/// Makes `sh` hold the results of the lightmap's or the grid's caches.
void lightResults(limnrt_scene& scene, bool grid);

/// The radiosity of the sky's cells from their radiance.
void takeSky(limnrt_scene& scene, const float* rgb);

/// Traces what is new among the scene's lights and sums their light.
void takeLights(limnrt_scene& scene);

/// Whether `v` is not null and its `n` numbers lie within [lower, upper].
inline bool finiteWithin(const float* v, std::size_t n, float lower, float upper) {
    bool all = v != nullptr;
    for (std::size_t k = 0; all && k < n; ++k)
        all = v[k] >= lower && v[k] <= upper;
    return all;
}

/// Green half, red and blue a quarter each.
inline float lumaOf(F4 rgb) {
    return rgb[1] * 0.5f + (rgb[0] + rgb[2]) * 0.25f;
}

/// Irradiance, >= 0, of bands^2 coefficients.
F4 irradianceOf(const limnrt_scene& scene, const F4* sh, const float* normal);

} // namespace limn::runtime
