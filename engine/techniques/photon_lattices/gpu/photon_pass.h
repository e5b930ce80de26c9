// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/render/viewport.h"

#include <memory>

namespace limn {

/// Uploads the parts of a field that photonParts() made, and draws them. Both arguments outlive the
/// pass.
std::shared_ptr<LightPass> photonPass(gpu::Device& device, Viewport& viewport,
                                      const IndirectField& field);

} // namespace limn
