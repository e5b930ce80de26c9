// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/bake_job.h"
#include "engine/lightmap/layout/lightmap_layout.h"

#include <memory>

namespace limn {

/// Layout of the light that the scene's technique makes, with the bake where it lights bakes; null
/// if there is none.
std::shared_ptr<const LightmapLayout> layoutOf(const Scene& scene, const BakedScene& baked);

} // namespace limn
