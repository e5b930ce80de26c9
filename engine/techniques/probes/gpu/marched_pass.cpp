// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/gpu/marched_pass.h"

#include "engine/core/log.h"
#include "engine/techniques/probes/marched_part.h"
#include "shaders/probes/probe_reflections.frag.h"
#include "shaders/shared/gpu_probes.h"

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace limn {

static constexpr std::array kMarchedTypes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                             VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                             VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

MarchedPass::MarchedPass(gpu::Device& device, Viewport& viewport,
                         std::shared_ptr<const GpuMarchedMaps> maps)
    : m_maps(std::move(maps)),
      m_set(device,
            viewport.lightPipelines().of(
                {kProbeReflectionsFrag, kMarchedTypes, {m_maps->side}, "marched reflections"})) {
    m_set.bind(MARCHED_PLANES, m_maps->planes);
    m_set.bind(MARCHED_NEAREST, m_maps->nearest);
    m_set.bind(MARCHED_RADIANCE, m_maps->radiance);
}

void MarchedPass::record(const LightPassFrame& frame) {
    if (frame.view == View::Lit) // the other views show diffuse light
        m_set.draw(frame);
}

std::shared_ptr<LightPass> uploadMarchedPart(gpu::Device& device, Viewport& viewport,
                                             const IndirectField& field) {
    const MarchedMaps* maps = marchedMapsOf(field.parts);
    if (!maps)
        return nullptr;
    auto onDevice = createMarchedMaps(device, std::uint32_t(maps->probes()), maps->side);
    if (!onDevice) {
        logWarning(fmt::format("maps of {} MiB are larger than this device can bind: glossy "
                               "surfaces reflect the harmonics",
                               maps->bytes() >> 20));
        return nullptr;
    }
    std::vector<std::uint32_t> all(maps->probes());
    std::iota(all.begin(), all.end(), 0U);
    uploadMarchedPlanes(device, *maps, all, *onDevice);
    uploadMarchedRadiance(device, *maps, *onDevice);
    return std::make_shared<MarchedPass>(device, viewport, std::move(onDevice));
}

} // namespace limn
