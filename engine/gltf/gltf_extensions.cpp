// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_extensions.h"

#include <algorithm>

namespace limn {

static constexpr GltfExtension kExtensions[] = {
    {"EXT_lights_area", true, "the shape of round lights, which are squares of their area"},
    {"EXT_lights_ies", true, "photometry of types A and B, and tilts"},
    {"EXT_mesh_gpu_instancing", true, ""},
    {"EXT_meshopt_compression", true, ""},
    {"EXT_texture_webp", true, "moving pictures"},
    {"KHR_animation_pointer", true, "all but nodes and lamps"},
    {"KHR_draco_mesh_compression", true, "versions of the format before 2.2"},
    {"KHR_lights_punctual", true, ""},
    {"KHR_materials_emissive_strength", true, ""},
    {"KHR_materials_ior", true, ""},
    {"KHR_materials_pbrSpecularGlossiness", true,
     "glossiness textures, and the colour of reflections of what is no metal"},
    {"KHR_materials_specular", true,
     "textures, the colour of reflections, and all of what light passes through"},
    {"KHR_materials_transmission", true, "transmission textures"},
    {"KHR_materials_unlit", true, "that it lights nothing: its surfaces emit their colour in nits"},
    {"KHR_materials_volume", true, "thickness textures and absorption"},
    {"KHR_mesh_quantization", true, ""},
    {"KHR_node_visibility", true, ""},
    {"KHR_texture_basisu", true, "Basis Universal itself (ETC1S, UASTC), ETC2, ASTC, BC4 to BC7"},
    {"KHR_texture_transform", true, ""},
    {"EXT_lights_image_based", false, "the sky is black"},
    {"KHR_materials_anisotropy", false, "reflections are as wide in all directions"},
    {"KHR_materials_clearcoat", false, "surfaces have no coat"},
    {"KHR_materials_diffuse_transmission", false, "sheets let no light through"},
    {"KHR_materials_dispersion", false, "glass bends all colours alike"},
    {"KHR_materials_iridescence", false, "surfaces have no thin film"},
    {"KHR_materials_sheen", false, "cloth has no sheen"},
    {"KHR_materials_variants", false, "the first variant is shown"},
    {"KHR_meshopt_compression", false, "meshes that use it are absent"},
    {"KHR_xmp_json_ld", false, ""},
    {"MSFT_lod", false, "the finest level is shown"},
    {"MSFT_texture_dds", false, "its textures are white where there is no other image"},
};

std::span<const GltfExtension> gltfExtensions() {
    return kExtensions;
}

const GltfExtension* findGltfExtension(std::string_view name) {
    const auto* found = std::ranges::find(kExtensions, name, &GltfExtension::name);
    return found == std::end(kExtensions) ? nullptr : found;
}

} // namespace limn
