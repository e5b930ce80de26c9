// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/json/json.h"

#include <cstdint>
#include <string>
#include <vector>

namespace limn {

/// Panoramas around a scene, and what asset.extras.limn says of them: `sky`, unless it is black,
/// and the list `reflections`, what is seen from places in the open.
struct Surroundings {
    std::vector<ExportFile> files; ///< "room-sky.ktx2", "room-reflection-1.ktx2", and so on
    Json json = Json::object();
    std::vector<std::uint32_t> ofInstance; ///< number of each instance's reflection; empty: none
};

/// With at most that many reflections. The encoding is Exr, or Ktx2Half, in which radiance above
/// 65504 is cut.
Result<Surroundings> surroundings(const ExportScene& scene, std::uint32_t reflections,
                                  TextureEncoding encoding, const std::string& stem,
                                  const Progress& progress);

/// Bytes of these files, about.
std::uint64_t surroundingsBytes(const ExportScene& scene, std::uint32_t reflections);

} // namespace limn
