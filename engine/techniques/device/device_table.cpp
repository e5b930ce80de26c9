// SPDX-License-Identifier: MIT
#include "engine/techniques/device/device_table.h"

#include "engine/techniques/illuminance/gpu/device_illuminance.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/light_skin/gpu/device_skin.h"
#include "engine/techniques/light_skin/gpu/skin_pass.h"
#include "engine/techniques/light_skin/light_skin.h"
#include "engine/techniques/lpv/gpu/device_lpv.h"
#include "engine/techniques/lpv/lpv.h"
#include "engine/techniques/photon_lattices/gpu/device_photons.h"
#include "engine/techniques/photon_lattices/gpu/photon_pass.h"
#include "engine/techniques/photon_lattices/photon_lattices.h"
#include "engine/techniques/probes/gpu/device_probes.h"
#include "engine/techniques/probes/gpu/marched_pass.h"
#include "engine/techniques/probes/probes.h"
#include "engine/techniques/radiance_volumes/gpu/device_volumes.h"
#include "engine/techniques/radiance_volumes/gpu/volume_pass.h"
#include "engine/techniques/radiance_volumes/radiance_volumes.h"
#include "engine/techniques/sparse_probes/gpu/device_sparse.h"
#include "engine/techniques/sparse_probes/sparse_probes.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace limn {

namespace {

struct Row {
    const Technique* technique;
    Result<std::unique_ptr<Lighting>> (*light)(gpu::Device&, Viewport&, const Prepared&);
    /// Uploads the parts of a field of the CPU; null where its light has none.
    std::shared_ptr<LightPass> (*pass)(gpu::Device&, Viewport&, const IndirectField&) = nullptr;
};

constexpr std::array kRows = {
    Row{&kIlluminanceTechnique, lightIlluminanceOnDevice},
    Row{&kLightSkinTechnique, lightSkinOnDevice, uploadSkinPart},
    Row{&kLpvTechnique, lightLpvOnDevice},
    Row{&kProbesTechnique, lightProbesOnDevice, uploadMarchedPart},
    Row{&kSparseProbesTechnique, lightSparseOnDevice},
    Row{&kRadianceVolumesTechnique, lightVolumesOnDevice, uploadVolumePart},
    Row{&kPhotonTechnique, lightPhotonsOnDevice, photonPass}};

} // namespace

bool lightsOnDevice(const Technique& technique) {
    return std::ranges::any_of(
        kRows, [&](const Row& row) { return row.technique == &technique && row.light; });
}

void showLight(const Technique* technique, gpu::Device& device, Viewport& viewport,
               const IndirectField& field) {
    const auto row = std::ranges::find(kRows, technique, &Row::technique);
    const bool drawn = row != kRows.end() && row->pass && !field.parts.empty();
    viewport.setIndirect(field, drawn ? row->pass(device, viewport, field) : nullptr);
}

Result<std::unique_ptr<Lighting>> lightOnDevice(const Technique& technique, gpu::Device& device,
                                                Viewport& viewport, const Prepared& prepared) {
    for (const Row& row : kRows)
        if (row.technique == &technique && row.light)
            return row.light(device, viewport, prepared);
    return fail(fmt::format("the technique \"{}\" lights on the CPU only", technique.name));
}

} // namespace limn
