// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include <tiny_gltf.h>

namespace limn {

/// A member of an extension's object; null if it has none of that name.
inline const tinygltf::Value* member(const tinygltf::Value& object, const char* key) {
    return object.IsObject() && object.Has(key) ? &object.Get(key) : nullptr;
}

/// A number of an extension; `missing` where it is absent or of another type.
inline float number(const tinygltf::Value* value, float missing) {
    return value && value->IsNumber() ? float(value->GetNumberAsDouble()) : missing;
}

/// A non-negative integer, such as an index; std::nullopt where it is absent or of another type.
inline std::optional<std::size_t> wholeNumber(const tinygltf::Value* value) {
    if (!value || !value->IsInt() || value->GetNumberAsInt() < 0)
        return {};
    return std::size_t(value->GetNumberAsInt());
}

} // namespace limn
