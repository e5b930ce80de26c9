// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_uri.h"
#include "engine/scene/animation.h"
#include "engine/scene/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limn {

struct ImportedScene {
    Document document;
    std::shared_ptr<const Assets> assets;
    std::vector<std::string>
        repairs; ///< one sentence each: what was repaired or left out, with counts
    std::shared_ptr<const SceneAnimation> animation = nullptr; ///< null: nothing moves
};

struct ImportOptions {
    FileReach reach = FileReach::Folder; ///< of the files that a glTF names
    MemoryBudget memory;
    /// Time at which animated nodes, lights and morph weights are read [s]; std::nullopt: as the
    /// file has them at rest.
    std::optional<double> seconds;
    /// Triangles that lie back to back become two-sided, as joinBacks() says. Baked light needs
    /// them apart, since each has texels of its own.
    bool joinsBacks = true;
};

/// Reads a .gltf or .glb (glTF 2.0). Fails, with file and field, on what cannot be repaired:
/// malformed JSON, indices or accessors out of range, missing buffers, unsupported required
/// extensions and cycles; and on what would not fit into memory.
Result<ImportedScene> importGltf(const std::string& path, const Progress& progress = {},
                                 const ImportOptions& options = {});

} // namespace limn
