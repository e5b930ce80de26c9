// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>

namespace limn {

/// The technique's settings in documents.
extern const std::array<TechniqueSetting, 15> kPhotonSettings;

enum class PhotonSplats : std::uint8_t { None, Caustics, All };

/// What paths of photons depend on.
struct PathSettings {
    std::uint32_t photons = 0, bounces = 0, specular = 0;
    bool operator==(const PathSettings&) const = default;
};

/// What the sums of photons in cells depend on besides.
struct InjectionSettings {
    bool incident = false;
    std::uint32_t low = 0, mid = 0, high = 0;
    PhotonSplats splats = PhotonSplats::None;
    std::uint32_t few = 0;
    bool operator==(const InjectionSettings&) const = default;
};

/// Weights with which cells of the coarse lattices are averaged.
enum class PhotonBlur : std::uint8_t {
    None,
    SixNeighbours, ///< the cell and those that share a face with it
    Weighted3,     ///< 3^3 cells by the products of 1, 2, 1
    Uniform3,
    Weighted5, ///< 5^3 cells by the products of 1, 4, 6, 4, 1
    Uniform5
};

/// The settings' values.
struct PhotonSettings {
    PathSettings paths;
    InjectionSettings injection;
    PhotonBlur blur = PhotonBlur::None;
    bool trilinear = false, emitters = false, sky = false;
    float splatRadius = 0;   ///< over the scene's longest side
    std::uint32_t still = 0; ///< photons of a light at rest
    bool operator==(const PhotonSettings&) const = default;
};

PhotonSettings photonSettingsOf(const TechniqueChoice& choice);

} // namespace limn
