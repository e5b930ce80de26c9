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

/// What a glTF file brings that nobody edits. Shared and immutable after import.
struct Assets {
    std::vector<Mesh> meshes;
    std::vector<Image> images;
    MipStore mips; ///< of `images`, made when first needed
};

/// One mesh placed in the world.
struct Instance {
    std::uint32_t mesh = 0;     ///< index into Assets::meshes
    std::uint32_t material = 0; ///< index into Scene::materials
    ObjectId node = 0;          ///< the node it came from
    bool dynamic = false;
    glm::mat4 toWorld{1};
    /// sign(det) * cofactor matrix of toWorld; not normalised. As in glTF, a mirrored instance
    /// (negative determinant) has its front on the clockwise side, so the world's front normal of a
    /// triangle is normalToWorld * cross(p1 - p0, p2 - p0) with the object's positions, never the
    /// cross of world edges.
    glm::mat3 normalToWorld{1};
};

/// Whether the light is on and sends anything.
bool shines(const Light& light);

/// Whether anything within `bounds` can lie in the light's range.
bool reaches(const Light& light, const Bounds& bounds);

/// The document flattened: what the tracer, baker, reference and viewport read. Everything is in
/// world space, and nothing of it depends on where `origin` lies: it only tells people where things
/// are. So the same room at two places has the same scene hash, and may share a bake.
struct Scene {
    std::shared_ptr<const Assets> assets;
    std::vector<Instance> instances; ///< visible ones, ordered by node id, then mesh
    std::vector<Material> materials; ///< in id order; a plain one last if a mesh names none of them
    std::vector<Light> lights;       ///< enabled or not, ordered by id
    std::vector<Camera> cameras;
    Sky sky;
    BakeSettings bake;
    TechniqueChoice technique;
    Bounds bounds;        ///< world space, of all instances; 0 for an empty scene
    glm::dvec3 origin{0}; ///< of world space, in the file's coordinates [m]

    const Mesh& meshOf(const Instance& i) const { return assets->meshes[i.mesh]; }
    const Material& materialOf(const Instance& i) const { return materials[i.material]; }
};

/// World space, of the static instances: all that a bake may depend on. 0 where there are none.
Bounds staticBounds(const Scene& scene);

/// As it is `seconds` after the start of its films.
Scene flatten(const Document& document, std::shared_ptr<const Assets> assets, double seconds = 0);

/// Brings the films of the document's materials in a scene that was flattened from it to `seconds`.
/// True if that changed anything.
bool showTime(Scene& scene, const Document& document, double seconds);

/// `camera name`d, or the first, or one that shows the whole scene from a corner.
Camera chooseCamera(const Scene& scene, const std::optional<std::string>& name);

/// Alpha from which a Blend texel counts as solid: transport knows no partial cover.
inline constexpr float kBlendCutoff = 0.5f;

/// Whether the surface may have holes that rays pass: Mask, and Blend treated as Mask at
/// kBlendCutoff.
bool isCutout(const Material& material);

/// Alpha below which the surface is absent, to rays, shadow maps and cameras alike; 0 for Opaque.
float alphaCutoff(const Material& material);

/// Only the alpha of surfaceMaterial, 0 or 1; cheap where the material is opaque.
float surfaceAlpha(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v);

/// What a surface point is made of.
struct SurfaceMaterial {
    glm::vec3 albedo{0};   ///< diffuse reflectance, <= 0.99
    glm::vec3 emission{0}; ///< [nits]
    float alpha = 1;       ///< after the cutoff of Mask and Blend: 0 or 1
};

/// At barycentrics (u, v) of `triangle` (weights 1-u-v, u, v).
SurfaceMaterial surfaceMaterial(const Scene& scene, const Instance& instance,
                                std::uint32_t triangle, float u, float v);

/// The mean over a footprint of `area` [m^2, world] there, as textures have it; vertex colours
/// count at the point. Of a cutout, the mean of what is there besides the holes.
SurfaceMaterial surfaceMaterialOver(const Scene& scene, const Instance& instance,
                                    std::uint32_t triangle, float u, float v, float area);

} // namespace limn
