// SPDX-License-Identifier: MIT
#include "engine/render/passes/geometry_passes.h"

#include "shaders/shared/gpu_frame.h"
#include "shaders/viewport/depth.vert.h"
#include "shaders/viewport/depth_mask.frag.h"
#include "shaders/viewport/depth_mask.vert.h"
#include "shaders/viewport/surface.frag.h"
#include "shaders/viewport/surface.vert.h"

#include <algorithm>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn::render {

using shared::GpuDraw;

namespace {

const std::vector<VkVertexInputBindingDescription> kBindings = {
    {0, sizeof(glm::vec3), VK_VERTEX_INPUT_RATE_VERTEX},
    {1, sizeof(VertexAttributes), VK_VERTEX_INPUT_RATE_VERTEX},
    {2, sizeof(glm::vec2), VK_VERTEX_INPUT_RATE_VERTEX}};

const std::vector<VkVertexInputAttributeDescription> kAttributes = {
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
    {1, 1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexAttributes, normal)},
    {2, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(VertexAttributes, tangent)},
    {3, 1, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexAttributes, uv0)},
    {4, 1, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexAttributes, uv1)},
    {5, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(VertexAttributes, color)},
    {6, 2, VK_FORMAT_R32G32_SFLOAT, 0}};

// Binds what the variant reads of one instance. `number`: its index, where surfaces are drawn.
void bindInstance(VkCommandBuffer cmd, VkPipelineLayout layout, const GpuMesh& mesh,
                  const GpuInstance& instance, const glm::mat4& toClip, std::uint32_t flags,
                  std::uint32_t bindings, std::uint32_t number = 0) {
    GpuDraw draw{};
    draw.toClip = toClip * instance.toWorld;
    const glm::mat4 rows = glm::transpose(instance.toWorld);
    for (int r = 0; r < 3; ++r)
        draw.toWorld[r] = rows[r];
    draw.flags = flags;
    draw.backOffset = instance.backOffset;
    draw.nearReach = instance.nearReach;
    draw.instance = number;
    vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_ALL, 0, sizeof draw, &draw);
    const std::array buffers = {mesh.positions.handle, mesh.attributes.handle,
                                instance.lightmapUv ? instance.lightmapUv.handle
                                                    : mesh.positions.handle};
    const std::array<VkDeviceSize, 3> offsets{};
    vkCmdBindVertexBuffers(cmd, 0, bindings, buffers.data(), offsets.data());
    vkCmdBindIndexBuffer(cmd, mesh.indices.handle, 0, VK_INDEX_TYPE_UINT32);
}

bool isNear(const Bounds& bounds, const DepthView& view) {
    return distanceTo(bounds, view.eye) <= view.reach;
}

// Draws the chunks of the bound mesh that `view` may show, merging neighbouring chunks.
void drawChunks(VkCommandBuffer cmd, const GpuMesh& mesh, const glm::mat4& toWorld,
                const DepthView& view) {
    const glm::mat4 toClip = view.toClip * toWorld;
    constexpr std::uint32_t step = 3 * kChunkTriangles;
    std::uint32_t begin = 0, end = 0; // indices not yet drawn
    for (std::size_t i = 0; i < mesh.chunks.size(); ++i) {
        if (!mayBeVisible(mesh.chunks[i], toClip) ||
            !isNear(transformBounds(mesh.chunks[i], toWorld), view))
            continue;
        const auto first = std::uint32_t(i) * step;
        if (first != end && end > begin)
            vkCmdDrawIndexed(cmd, end - begin, 1, begin, 0, 0);
        if (first != end)
            begin = first;
        end = std::min(first + step, mesh.indexCount);
    }
    if (end > begin)
        vkCmdDrawIndexed(cmd, end - begin, 1, begin, 0, 0);
}

} // namespace

GeometryPasses::GeometryPasses(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                               VkDescriptorSetLayout materialLayout)
    : m_device(device) {
    const std::array layouts = {frameLayout, materialLayout};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(GpuDraw), "geometry");
}

gpu::Pipeline GeometryPasses::createSurface(const Variant& variant) {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = kSurfaceVert;
    desc.fragment = kSurfaceFrag;
    desc.layout = m_layout.handle;
    desc.bindings = kBindings;
    desc.attributes = kAttributes;
    if (!(variant.features & FEATURE_LIGHTMAP)) {
        desc.bindings.pop_back();
        desc.attributes.back() = {6, 0, VK_FORMAT_R32G32_SFLOAT, 0}; // declared, not used
    }
    desc.colorFormats = {kLinearFormat, kSurfaceFormat, kReceiverFormat};
    desc.depthFormat = kDepthFormat;
    desc.depthCompare = VK_COMPARE_OP_GREATER;
    desc.dynamicFrontFace = true;
    desc.constants = {std::uint32_t(variant.view), variant.features, variant.bands};
    desc.name = "surfaces";
    return gpu::createGraphicsPipeline(m_device, desc);
}

gpu::Pipeline GeometryPasses::createDepth(std::uint32_t features) {
    const bool mask = features & FEATURE_ALPHA_MASK;
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = mask ? gpu::Spirv(kDepthMaskVert) : gpu::Spirv(kDepthVert);
    if (mask)
        desc.fragment = kDepthMaskFrag;
    desc.layout = m_layout.handle;
    desc.bindings = {kBindings[0]};
    desc.attributes = {kAttributes[0]};
    if (mask) {
        desc.bindings.push_back(kBindings[1]);
        desc.attributes.insert(desc.attributes.end(),
                               {kAttributes[3], kAttributes[4], kAttributes[5]});
    }
    desc.depthFormat = kDepthFormat;
    desc.depthCompare = VK_COMPARE_OP_GREATER;
    desc.constants = {0, features};
    desc.name = mask ? "depth, masked" : "depth";
    return gpu::createGraphicsPipeline(m_device, desc);
}

void GeometryPasses::drawDepth(VkCommandBuffer cmd, const RenderScene& scene,
                               const MaterialSet& materials, const DepthView& view,
                               std::uint32_t slot) {
    constexpr std::uint32_t kUsed = FEATURE_ALPHA_MASK | FEATURE_BASE_COLOR_TEXTURE;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const GpuInstance& instance : scene.instances) {
        const GpuMesh& mesh = scene.meshes[instance.mesh];
        if (mesh.indexCount == 0 || materials.isGlassSheet[instance.material] ||
            !isNear(instance.bounds, view) || !mayBeVisible(instance.bounds, view.toClip))
            continue;
        const std::uint32_t all = materials.features[instance.material];
        const std::uint32_t features = all & FEATURE_ALPHA_MASK ? all & kUsed : 0;
        gpu::Pipeline& pipeline = m_depth[features];
        if (!pipeline)
            pipeline = createDepth(features);
        if (bound != pipeline.handle)
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
        bound = pipeline.handle;
        if (features)
            materials.bind(cmd, m_layout.handle, instance.material, slot);
        bindInstance(cmd, m_layout.handle, mesh, instance, view.toClip, 0, features ? 2 : 1);
        drawChunks(cmd, mesh, instance.toWorld, view);
    }
}

bool showsGlass(const RenderScene& scene, const MaterialSet& materials, const GeometryView& view) {
    return std::ranges::any_of(scene.instances, [&](const GpuInstance& instance) {
        return materials.transmits[instance.material] && mayBeVisible(instance.bounds, view.toClip);
    });
}

// Sorts instances nearest first, so that later instances fail the depth test before they are
// shaded.
void GeometryPasses::orderByDistance(const RenderScene& scene, const MaterialSet& materials,
                                     const GeometryView& view) {
    m_order.clear();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const GpuInstance& instance = scene.instances[i];
        if (scene.meshes[instance.mesh].indexCount > 0 &&
            !(view.throughGlass && materials.transmits[instance.material]) &&
            mayBeVisible(instance.bounds, view.toClip))
            m_order.emplace_back(distanceTo(instance.bounds, view.eye), i);
    }
    std::sort(m_order.begin(), m_order.end());
}

// Depths of a triangle are rounded to 2^-23 of the nearest of them: for a triangle that spans 1 cm
// to 30 m, this is 4e-4 of the far depth.
constexpr float kBehind = 0.998f;

void GeometryPasses::drawDepthAhead(VkCommandBuffer cmd, const RenderScene& scene,
                                    const MaterialSet& materials, const GeometryView& view) {
    glm::mat4 toClip = view.toClip;
    for (int column = 0; column < 4; ++column)
        toClip[column][2] *= kBehind;
    orderByDistance(scene, materials, view);
    gpu::Pipeline& pipeline = m_depth[0];
    if (!pipeline)
        pipeline = createDepth(0);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    for (const auto& [distance, index] : m_order) {
        const GpuInstance& instance = scene.instances[index];
        if (materials.features[instance.material] & FEATURE_ALPHA_MASK)
            continue;
        const GpuMesh& mesh = scene.meshes[instance.mesh];
        bindInstance(cmd, m_layout.handle, mesh, instance, toClip, 0, 1);
        vkCmdDrawIndexed(cmd, mesh.indexCount, 1, 0, 0, 0);
    }
}

// Keeps only the features that the view shows, so that there are fewer variants and none reads a
// texture for nothing.
static std::uint32_t variantFeatures(std::uint32_t material, std::uint32_t bands,
                                     const GpuMesh& mesh, const GpuInstance& instance,
                                     const GeometryView& view) {
    const bool lit = view.view == View::Lit;
    const bool albedo = lit || view.view == View::Direct || view.view == View::Indirect ||
                        view.view == View::Albedo;
    const bool indirect = lit || view.view == View::Indirect || view.view == View::Irradiance;
    std::uint32_t f = material;
    if (!albedo)
        f &= ~FEATURE_METALLIC_ROUGHNESS_TEXTURE;
    if (!albedo && !(f & FEATURE_ALPHA_MASK))
        f &= ~FEATURE_BASE_COLOR_TEXTURE;
    if (!lit)
        f &= ~FEATURE_EMISSIVE_TEXTURE;
    if (!mesh.tangents || view.view == View::Albedo)
        f &= ~FEATURE_NORMAL_TEXTURE;
    if (indirect)
        f |= instance.hasLightmap ? FEATURE_LIGHTMAP : view.grid ? FEATURE_GRID : 0u;
    if (lit && view.reflectedApart && bands > std::uint32_t(kIrradianceBands))
        f |= FEATURE_REFLECTED_APART;
    return f;
}

// Reflections read as many bands as their material needs; irradiance reads the first three.
static std::uint32_t bandsRead(std::uint32_t needed, std::uint32_t features,
                               const GeometryView& view) {
    const bool indirect = features & (FEATURE_LIGHTMAP | FEATURE_GRID);
    const std::uint32_t wanted =
        indirect && view.view == View::Lit ? needed : std::uint32_t(kIrradianceBands);
    return std::min(wanted, view.bands);
}

SurfacesDrawn GeometryPasses::drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene,
                                           const MaterialSet& materials, const GeometryView& view,
                                           std::uint32_t slot) {
    orderByDistance(scene, materials, view);
    SurfacesDrawn drawn;
    VkPipeline bound = VK_NULL_HANDLE;
    for (const auto& [distance, index] : m_order) {
        const GpuInstance& instance = scene.instances[index];
        const GpuMesh& mesh = scene.meshes[instance.mesh];
        const std::uint32_t features =
            variantFeatures(materials.features[instance.material],
                            materials.bands[instance.material], mesh, instance, view);
        const Variant variant{view.view, features,
                              bandsRead(materials.bands[instance.material], features, view)};
        if (features & (FEATURE_LIGHTMAP | FEATURE_GRID)) {
            drawn.features |=
                features & (FEATURE_LIGHTMAP | FEATURE_GRID | FEATURE_REFLECTED_APART);
            drawn.bands[variant.bands] = true;
        }
        gpu::Pipeline& pipeline = m_surface[variant];
        if (!pipeline)
            pipeline = createSurface(variant);
        if (bound != pipeline.handle)
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
        bound = pipeline.handle;
        const bool bothSides = materials.doubleSided[instance.material];
        vkCmdSetFrontFace(cmd, instance.mirrored ? VK_FRONT_FACE_CLOCKWISE
                                                 : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        materials.bind(cmd, m_layout.handle, instance.material, slot);
        const std::uint32_t flags =
            (bothSides ? DRAW_DOUBLE_SIDED : 0u) | (instance.mirrored ? DRAW_MIRRORED : 0u);
        bindInstance(cmd, m_layout.handle, mesh, instance, view.toClip, flags,
                     features & FEATURE_LIGHTMAP ? 3 : 2, index);
        vkCmdDrawIndexed(cmd, mesh.indexCount, 1, 0, 0, 0);
    }
    return drawn;
}

} // namespace limn::render
