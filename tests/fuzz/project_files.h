// SPDX-License-Identifier: MIT
#pragma once

#include "tests/gltf/gltf_builder.h"
#include "tests/scene/small_png.h"

#include <string>

namespace limn {

/// What the fuzzed projects' scene.glb is: two textured triangles that a lamp lights.
inline std::string projectScene() {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int uv = b.accessor(b.view(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}), "VEC2",
                              GltfBuilder::kFloat, 4);
    const int normal = b.vec3(std::vector<glm::vec3>(4, {0, 0, 1}));
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
            {"indices", b.indices({0, 1, 2, 0, 2, 3})},
            {"material", 0}});
    b.json["images"] = {{{"bufferView", b.view(greyPng())}, {"mimeType", "image/png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 5}}};
    b.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    return b.glb();
}

/// And their sky.hdr: two texels, not packed.
inline std::string projectSky() {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
           std::string("\x80\x80\x80\x80\x10\x20\x40\x82", 8);
}

} // namespace limn
