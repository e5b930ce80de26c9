// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/math/sh.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstdint>

namespace limn {

/// A surface point at which a field is looked up: in the lightmap, or in the grid if its instance
/// has no lightmap.
struct FieldPoint {
    const IndirectField& field;
    const LightmapLayout& layout;
    const Scene& scene;
    std::uint32_t instance, triangle;
    float u, v; ///< barycentrics of the triangle
    glm::vec3 position;
    glm::vec3 normal;     ///< unit, of the side that is looked up
    bool back = false;    ///< whether that side is the back of a two-sided surface
    glm::vec3 surface{0}; ///< unit geometric normal of that side; 0: that is `normal`

    glm::vec3 surfaceNormal() const { return surface == glm::vec3(0) ? normal : surface; }
};

/// The texels or cells that a lookup blends.
struct FieldLookup {
    bool grid = false;     ///< whether they are cells of the grid
    std::size_t count = 0; ///< 4 texels, 8 cells, or 0 where there is no light to look up
    std::array<std::uint32_t, 8> index{};
    std::array<float, 8> weight{}; ///< their sum is 1
};
FieldLookup lookUp(const FieldPoint& point);
/// The eight cells of the field's grid around a point of a surface with unit `normal`: trilinear
/// weights, times what the cells see. None where all these are 0. Precondition: there is a grid.
FieldLookup gridLookup(const IndirectField& field, glm::vec3 position, glm::vec3 normal);

/// Irradiance at the point [W m^-2], >= 0.
glm::vec3 sampleIrradiance(const FieldPoint& point);

/// Radiance [W m^-2 sr^-1], >= 0, that arrives from unit `direction` above a surface with a
/// lightmap, as far as up to three of the field's bands tell.
glm::vec3 sampleRadiance(const FieldPoint& point, glm::vec3 direction);

/// Mean radiance [W m^-2 sr^-1], >= 0, in a lobe about unit `direction`. Uses the first `bands`
/// bands, or as many as the field has, each weighted by its factor in `factors`.
glm::vec3 sampleLobe(const FieldPoint& point, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors);

/// The part of a field that FieldPart::reflects(); null: glossy surfaces reflect its harmonics.
const FieldPart* reflectingPart(const IndirectField& field);

/// A reflection of that part.
struct SampledReflection {
    glm::vec3 radiance{0}; ///< mean in the lobe [W m^-2 sr^-1]
    bool known = false;    ///< as FieldPart::reflectionTaps() returns
};
SampledReflection sampleReflection(const FieldPart& part, const ReflectedLobe& lobe);

} // namespace limn
