// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/shading/surface_point.h"

#include <array>
#include <vector>

namespace limn {

/// The point at which a field is looked up for the surface that was hit. The arguments must outlive
/// it.
FieldPoint fieldPoint(const IndirectField& field, const LightmapLayout& layout, const Scene& scene,
                      const Hit& hit, const SurfacePoint& p);

/// A lobe that approximates specular reflection at a point: the reflected radiance of a field is
/// weight * sampleLobe(axis, bands, factors).
struct FieldLobe {
    glm::vec3 axis{0}; ///< unit
    int bands = 0;
    std::array<float, kMaxBands> factors{};
    glm::vec3 weight{0};
};

/// The lobe of a glossy point. `bands`: number of bands that the material reflects. `windowed`: the
/// lobe's bands fade out, so that it hardly rings; else they are cut off.
FieldLobe fieldLobe(const FieldPoint& point, const GlossyPoint& g, int bands, bool windowed);

/// Whether each material of the scene is that of a glossy receiver
/// (engine/scene/surface/receiver_bands.h), which reflects what FieldPart::reflectionTaps() finds.
std::vector<bool> glossyReceivers(const Scene& scene);

/// What such a receiver reflects: weight times the mean radiance in the lobe.
struct FieldReflection {
    ReflectedLobe lobe;
    glm::vec3 weight{0};
};
FieldReflection fieldReflection(const TraceScene& trace, const GlossyPoint& g);

/// Number of bands of `field` that each material of the scene reflects.
std::vector<int> reflectedBands(const Scene& scene, const IndirectField& field);

} // namespace limn
