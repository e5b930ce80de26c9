// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_repairs.h"
#include "engine/gltf/gltf_uri.h"
#include "engine/scene/light/light_profile.h"

#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// Reads the photometric files of EXT_lights_ies, which are data, buffer views or files that a glTF
/// in `folder` may refer to. One that cannot be read is none, and a repair names it.
std::vector<ProfileRef> readProfiles(const tinygltf::Model& model, const std::string& folder,
                                     FileReach reach, GltfRepairs& repairs);

} // namespace limn
