// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gpu/skin_pass.h"

#include "engine/gpu/uploader.h"
#include "shaders/light_skin/skin_light.frag.h"
#include "shaders/shared/gpu_skin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

using namespace shared;

static_assert(NearestCaches::kNone == SKIN_NO_CACHE && NearestCaches::kLength == 16);
static_assert(kNormalBins < 1 << SKIN_LIST_BITS);

constexpr VkDescriptorType kSkinBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array<VkDescriptorType, SKIN_BINDINGS> kSkinTypes = {
    kSkinBuffer, kSkinBuffer, kSkinBuffer, kSkinBuffer, kSkinBuffer};

/// Buffers hold one element at least, because empty ones cannot be bound.
template <class T>
gpu::Buffer uploaded(gpu::Uploader& uploader, std::vector<T> values, const char* name) {
    if (values.empty())
        values.resize(1);
    return uploader.buffer(std::as_bytes(std::span(values)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           name);
}

/// Cubes and lists of all meshes, each once.
struct MeshTables {
    std::vector<GpuSkinCube> cubes;
    std::vector<GpuSkinList> lists;
    std::map<const MeshSkin*, std::uint32_t> firstCube;

    std::uint32_t add(const MeshSkin& skin) {
        const auto [place, added] = firstCube.try_emplace(&skin, std::uint32_t(cubes.size()));
        if (!added)
            return place->second;
        const auto firstList = std::uint32_t(lists.size());
        for (const CubeLists& cube : skin.cubes)
            cubes.push_back({.cube = cube.cube,
                             .lists = (firstList + cube.first) << SKIN_LIST_BITS | cube.count});
        for (std::size_t i = 0; i < skin.lists.size(); ++i) {
            GpuSkinList list{.normal = skin.cubeBins[i]};
            for (std::size_t k = 0; k < NearestCaches::kLength; ++k)
                list.cache[k / 4][int(k % 4)] = skin.lists[i].cache[k];
            lists.push_back(list);
        }
        return place->second;
    }
};

GpuSkinInstance instanceOf(const LightCaches::Placed& placed, MeshTables& tables) {
    GpuSkinInstance instance{};
    instance.edge = 1;
    if (!placed.skin)
        return instance;
    const glm::mat4 rows = glm::transpose(placed.toObject);
    for (int k = 0; k < 3; ++k)
        instance.toObject[k] = rows[k];
    const glm::mat3 normalRows = glm::transpose(placed.normalToObject);
    instance.normalRow0 = normalRows[0];
    instance.normalRow1 = normalRows[1];
    instance.normalRow2 = normalRows[2];
    instance.cache = placed.first;
    instance.cube = tables.add(*placed.skin);
    instance.cubes = std::uint32_t(placed.skin->cubes.size());
    instance.edge = placed.skin->raster.edge;
    return instance;
}

} // namespace

std::shared_ptr<const GpuSkin> uploadSkin(gpu::Device& device, const LightCaches& caches) {
    std::vector<GpuSkinCache> places;
    for (std::size_t c = 0; c < caches.size(); ++c)
        places.push_back({.position = caches.position[c], .normal = caches.normal[c]});
    MeshTables tables;
    std::vector<GpuSkinInstance> instances;
    for (const LightCaches::Placed& placed : caches.instances)
        instances.push_back(instanceOf(placed, tables));
    gpu::Uploader uploader(device);
    GpuSkin skin;
    skin.caches = uploaded(uploader, std::move(places), "light caches");
    skin.lists = uploaded(uploader, std::move(tables.lists), "lists of light caches");
    skin.cubes = uploaded(uploader, std::move(tables.cubes), "cubes of light caches");
    skin.instances = uploaded(uploader, std::move(instances), "objects with light caches");
    uploader.flush();
    return std::make_shared<const GpuSkin>(std::move(skin));
}

gpu::Buffer uploadProxies(gpu::Device& device, const SkinPart::Light& light) {
    const std::size_t count = light.proxies.size();
    std::vector<GpuSkinProxies> proxies;
    for (std::size_t c = 0; c < count; ++c) {
        const CacheProxies& both = light.proxies[c];
        const glm::vec3 cache = light.caches->position[c];
        proxies.push_back({.diffusePlace = both.diffuse.position,
                           .diffuseDistance = glm::distance(both.diffuse.position, cache),
                           .diffuseFlux = light.flux[c],
                           .glossyPlace = both.glossy.position,
                           .glossyDistance = glm::distance(both.glossy.position, cache),
                           .glossyFlux = light.flux[count + c]});
    }
    gpu::Uploader uploader(device);
    return uploaded(uploader, std::move(proxies), "proxy lights");
}

SkinPass::SkinPass(gpu::Device& device, Viewport& viewport, std::shared_ptr<const GpuSkin> skin,
                   std::shared_ptr<const gpu::Buffer> proxies, bool glossy)
    : m_skin(std::move(skin)), m_proxies(std::move(proxies)),
      m_set(device, viewport.lightPipelines().of(
                        {kSkinLightFrag,
                         kSkinTypes,
                         {glossy ? 1U : 0U, std::bit_cast<std::uint32_t>(kNearestProxy)},
                         "light on objects"})) {
    m_set.bind(SKIN_CACHES, m_skin->caches);
    m_set.bind(SKIN_LISTS, m_skin->lists);
    m_set.bind(SKIN_CUBES, m_skin->cubes);
    m_set.bind(SKIN_PROXIES, *m_proxies);
    m_set.bind(SKIN_INSTANCES, m_skin->instances);
}

void SkinPass::record(const LightPassFrame& frame) {
    m_set.draw(frame);
}

std::shared_ptr<LightPass> uploadSkinPart(gpu::Device& device, Viewport& viewport,
                                          const IndirectField& field) {
    for (const auto& part : field.parts)
        if (const auto* skin = dynamic_cast<const SkinPart*>(part.get())) {
            const SkinPart::Light& light = skin->light();
            return std::make_shared<SkinPass>(
                device, viewport, uploadSkin(device, *light.caches),
                std::make_shared<const gpu::Buffer>(uploadProxies(device, light)),
                light.eye.has_value());
        }
    return nullptr;
}

} // namespace limn
