// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace limn {

struct EditorState;

/// The textures of a material, in the order of texturesOf().
enum class TextureSlot : std::uint8_t { BaseColor, MetallicRoughness, Normal, Emissive };

inline constexpr std::array<TextureSlot, 4> kTextureSlots = {
    TextureSlot::BaseColor, TextureSlot::MetallicRoughness, TextureSlot::Normal,
    TextureSlot::Emissive};

/// "Base colour", "Metal, roughness", "Normal" or "Emission"
const char* textureSlotName(TextureSlot slot);

TextureRef& textureIn(Material& material, TextureSlot slot);

/// The material of the node's mesh with this index in Node::meshes, or 0 if it has none of the
/// document's.
ObjectId materialOf(const EditorState& state, const Node& node, std::size_t mesh);

/// A matte grey material of albedo 0.5.
Material greyMaterial(std::string name);

/// Each of the functions below is one undo step. Where it does not apply, it changes and records
/// nothing.

/// Gives `material` to all meshes of `nodes`, or only to `mesh` of them (an index into
/// Assets::meshes).
void assignMaterial(EditorState& state, const std::vector<ObjectId>& nodes, ObjectId material,
                    std::optional<std::uint32_t> mesh = {});

/// Adds a copy of `original` under a name of its own, gives it to `nodes` as assignMaterial() does,
/// and returns its id. `original` 0: of greyMaterial().
ObjectId assignNewMaterial(EditorState& state, const std::vector<ObjectId>& nodes,
                           ObjectId original, std::optional<std::uint32_t> mesh = {});

/// Makes an image of the assets the texture of a material; -1: none. A new texture multiplies by
/// the whole image, once over [0, 1]. An emissive texture on a material that emits nothing makes it
/// emit 1 nit.
void setTexture(EditorState& state, ObjectId material, TextureSlot slot, std::int32_t image);

} // namespace limn
