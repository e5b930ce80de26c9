// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/scene_options.h"

#include "engine/core/result.h"
#include "engine/lighting/converged_light.h"

#include <string>

namespace limn {

/// Lights the scene by its technique, from `bakeFile` or, where that is empty, from a bake made in
/// memory if the technique needs one. `view`: as of convergeLight(). `options` are those that the
/// scene was opened with. Shows progress on stderr.
Result<ConvergedLight> lightOnCpu(const SceneOptions& options, const std::string& bakeFile,
                                  Scene scene, LitFor reader, const Viewpoint* view = nullptr);

} // namespace limn
