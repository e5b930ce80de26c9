// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/converged_light.h"
#include "engine/lighting/explanation.h"
#include "engine/scene/camera.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The quantity of a pixel that is explained, as the mean over its samples.
enum class PixelLight : std::uint8_t {
    Radiance,  ///< that reaches the eye, as View::Lit shows it [W m^-2 sr^-1]
    Irradiance ///< that arrives at the surfaces that the pixel shows [W m^-2]
};

/// "W m^-2 sr^-1" or "W m^-2"
const char* unitOf(PixelLight light);

struct PixelQuestion {
    Camera camera;
    std::uint32_t width = 1280, height = 720; ///< size of the picture [pixels]
    std::uint32_t x = 0, y = 0;               ///< the pixel; (0, 0) is the upper left
    PixelLight light = PixelLight::Radiance;
    std::uint32_t samples = kScreenSamples.perPixel, seed = 1, nearRays = 0,
                  gatherRays = 0; ///< as FieldRenderOptions

    bool operator==(const PixelQuestion&) const = default;
};

struct PixelExplanation {
    Explanation tables;
    glm::vec3 total{0};              ///< light of the pixel
    std::vector<std::uint32_t> seen; ///< instances that the pixel shows, each once
};

/// Explains the pixel that renderField() draws of the same light: its rows sum to it. Direct light
/// is that of every light, where renderField() picks one for each sample. Instances in
/// `options.black` reflect no diffuse light where the pixel shows them, either.
PixelExplanation explainPixel(const ConvergedLight& lit, const PixelQuestion& question,
                              const ExplainOptions& options = {});

/// Luminance of a row's value as a share of the total's; 0 where that is black.
double shareOf(glm::vec3 value, glm::vec3 total);

/// Lights and reflections that a scene is imagined without.
struct Muted {
    std::vector<std::uint32_t> lights; ///< indices into Scene::lights
    std::vector<std::uint32_t>
        surfaces; ///< indices into Scene::instances that reflect no diffuse light
    bool sky = false;
};

/// The light of the pixel without what is muted, without lighting the scene again. The bounces that
/// are not followed stay in it (ExplainOptions::tolerance).
glm::vec3 lightWithout(const ConvergedLight& lit, const PixelQuestion& question,
                       const Muted& muted);

} // namespace limn
