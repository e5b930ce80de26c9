// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace limn {

struct ImportedScene {
    Document document;
    std::shared_ptr<const Assets> assets;
    std::vector<std::string>
        repairs; ///< one sentence each: what was mended or left out, with counts
};

/// Reads a .gltf or .glb (glTF 2.0). Fails with file and field on what cannot be repaired:
/// malformed JSON, indices or accessors out of range, missing buffers, required extensions we lack,
/// cycles.
Result<ImportedScene> importGltf(const std::string& path, const Progress& progress = {});

} // namespace limn
