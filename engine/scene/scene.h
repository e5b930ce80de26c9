// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/image.h"
#include "engine/scene/mesh/bounds.h"
#include "engine/scene/mesh/mesh.h"
#include "engine/scene/surface/texture.h"

#include <memory>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace limn {

/// Immutable data of a glTF file that cannot be edited. Shared after import.
struct Assets {
    std::vector<Mesh> meshes;
    std::vector<Image> images;
    MipStore mips; ///< of `images`, built on first use
};

/// One mesh placed in the world.
struct Instance {
    std::uint32_t mesh = 0;     ///< index into Assets::meshes
    std::uint32_t material = 0; ///< index into Scene::materials
    ObjectId node = 0;          ///< the node it came from
    bool dynamic = false;
    /// Bakes leave out the backs, because they face sealed dark space. Set by leaveOutDarkBacks().
    bool darkBacks = false;
    float texelDensity = 1; ///< Placement::texelDensity
    glm::mat4 toWorld{1};
    /// sign(det) * cofactor matrix of toWorld; not normalised. As in glTF, a mirrored instance
    /// (negative determinant) has its front on the clockwise side, so the world's front normal of a
    /// triangle is normalToWorld * cross(p1 - p0, p2 - p0) with the object's positions, never the
    /// cross of world edges.
    glm::mat3 normalToWorld{1};
};

/// Whether the light is on and sends anything.
bool shines(const Light& light);

/// Whether the light's range includes any point within `bounds`.
bool reaches(const Light& light, const Bounds& bounds);

/// The flattened document, which the tracer, baker, reference and viewport read. Everything is in
/// world space and independent of `origin`, which is only used to display positions. The same room
/// at two places therefore has the same scene hash and may share a bake.
struct Scene {
    std::shared_ptr<const Assets> assets;
    std::vector<Instance> instances; ///< visible ones, ordered by node id, then mesh
    std::vector<Material> materials; ///< in id order; a plain one last if a mesh names none of them
    std::vector<Light> lights;       ///< enabled or not, ordered by id
    std::vector<Camera> cameras;
    Sky sky;
    BakeSettings bake;
    TechniqueChoice technique;
    RelightSettings relight;
    Bounds bounds;        ///< world space, of all instances; 0 for an empty scene
    glm::dvec3 origin{0}; ///< of world space, in the file's coordinates [m]

    const Mesh& meshOf(const Instance& i) const { return assets->meshes[i.mesh]; }
    const Material& materialOf(const Instance& i) const { return materials[i.material]; }
};

/// Whether light leaves both sides of an instance in a bake: those of a two-sided material whose
/// backs are not left out.
bool isTwoSided(const Scene& scene, const Instance& instance);

/// World-space bounding box of the static instances, which contains all that a bake may depend on.
/// 0 if there are none.
Bounds staticBounds(const Scene& scene);

/// Flattens the document, with its animated textures shown `seconds` after their start.
Scene flatten(const Document& document, std::shared_ptr<const Assets> assets, double seconds = 0);

/// Advances the animated textures of a scene that was flattened from `document` to `seconds`.
/// Returns whether anything changed.
bool showTime(Scene& scene, const Document& document, double seconds);

/// Returns the camera called `name`, else the first camera, else one that shows the whole scene
/// from a corner.
Camera chooseCamera(const Scene& scene, const std::optional<std::string>& name);

/// Alpha from which a Blend texel counts as solid: light transport supports no partial coverage.
inline constexpr float kBlendCutoff = 0.5f;

/// Whether the surface may have holes that rays pass through: Mask, and Blend, which is treated as
/// Mask with kBlendCutoff.
bool isCutout(const Material& material);

/// Whether the surface is a sheet of glass that light passes through straight on: at least half of
/// it transmits, and it neither shines nor bounds a body. Rays of light that look for no sheet meet
/// none: shadows of lamps, paths that gather light and shadow maps leave them out. They then lose
/// what a sheet reflects, 4 % of light straight on for clear glass, and what it tints.
bool isGlassSheet(const Material& material);

/// Alpha below which the surface is absent for rays, shadow maps and cameras alike; 0 for Opaque.
float alphaCutoff(const Material& material);

/// Alpha of surfaceMaterial(), 0 or 1, without the rest; cheap for opaque materials.
float surfaceAlpha(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v);

/// Material properties at a surface point.
struct SurfaceMaterial {
    glm::vec3 albedo{0};   ///< diffuse reflectance, <= 0.99
    glm::vec3 emission{0}; ///< [nits]
    float alpha = 1;       ///< after the cutoff of Mask and Blend: 0 or 1
};

/// Material at barycentrics (u, v) of `triangle` (weights 1-u-v, u, v).
SurfaceMaterial surfaceMaterial(const Scene& scene, const Instance& instance,
                                std::uint32_t triangle, float u, float v);

/// Mean material over a footprint of `area` [m^2, world] at that point. Textures are averaged;
/// vertex colours are taken at the point. For a cutout, the mean excludes the holes.
SurfaceMaterial surfaceMaterialOver(const Scene& scene, const Instance& instance,
                                    std::uint32_t triangle, float u, float v, float area);

} // namespace limn
