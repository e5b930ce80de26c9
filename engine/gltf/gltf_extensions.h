// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace limn {

/// An extension of glTF.
struct GltfExtension {
    std::string_view name;
    bool isRead = false; ///< files that require it can be opened
    /// What is left out of it, or what a picture lacks where it is not read; empty: nothing.
    std::string_view leftOut;
};

/// The extensions that are read, and those known well enough to say what a picture lacks without
/// them, each ordered by name. docs/gltf.md lists them.
std::span<const GltfExtension> gltfExtensions();

/// The extension of that name; null if it is not known.
const GltfExtension* findGltfExtension(std::string_view name);

} // namespace limn
