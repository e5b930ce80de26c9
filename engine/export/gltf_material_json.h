// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"
#include "engine/scene/surface/material.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace limn {

/// TEXCOORD set of an exported texture that a document's material reads from set `texCoord`. Set 1
/// is the lightmap's, so the scene's own sets from 1 on move up by one.
inline std::uint32_t exportedTexCoord(std::uint32_t texCoord) {
    return texCoord == 0 ? 0 : texCoord + 1;
}

/// Materials of a glTF file with the textures and samplers that they use.
struct GltfMaterials {
    Json materials = Json::array();
    Json textures = Json::array();
    Json samplers = Json::array();
    std::vector<std::int32_t> images; ///< index into Assets::images of each glTF image
    std::set<std::string> extensions; ///< that they use

    /// Index of the exported material: `source`, which has that index in Scene::materials, or a
    /// one-sided version of it, with `number` in extras.limn.material. For surfaces on another page
    /// of the lightmap than the first, it is another material, with the page in
    /// extras.limn.lightmapPage. Animated textures show their first frame.
    std::size_t index(const Material& source, std::uint32_t number, bool oneSided,
                      std::uint32_t page);

private:
    std::map<std::tuple<std::uint32_t, bool, std::uint32_t>, std::size_t> m_known;

    Json texture(const TextureRef& ref);
    void putTransmission(const Material& source, Json& json);
};

} // namespace limn
