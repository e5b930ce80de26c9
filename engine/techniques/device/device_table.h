// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"
#include "engine/render/viewport.h"

#include <memory>

namespace limn {

/// Whether there is a row for the technique.
bool lightsOnDevice(const Technique& technique);

/// Creates light on the device of a viewport, which shows it where it was written, so that it never
/// passes through the CPU. Before each update the viewport must show the lights and objects of the
/// scene; it must outlive the light. Fails if the technique lights on the CPU only, or the prepared
/// data is too large for the device.
Result<std::unique_ptr<Lighting>> lightOnDevice(const Technique& technique, gpu::Device& device,
                                                Viewport& viewport, const Prepared& prepared);

/// Shows light of the CPU in a viewport: its lightmap and grid, and its parts by the technique's
/// own pass. `technique`: whose light it is; null where the field has no parts.
void showLight(const Technique* technique, gpu::Device& device, Viewport& viewport,
               const IndirectField& field);

} // namespace limn
