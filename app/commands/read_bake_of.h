// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/lighting/technique.h"

#include <memory>
#include <string>

namespace limn {

/// Reads what a technique precomputed for `scene`, and gives the scene the settings that it was
/// made with. Fails, with the file's name, where it is of another scene than `sceneName`.
Result<std::shared_ptr<const Precomputed>> readBakeOf(Scene& scene, const std::string& sceneName,
                                                      const Precomputation& precomputation,
                                                      const std::string& file,
                                                      const MemoryBudget& memory);

} // namespace limn
