// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string>

namespace limn {

inline constexpr int kProjectVersion = 1;

/// A document as a project file states it.
struct ProjectText {
    Document document;
    bool hasObjects = false; ///< false: the file leaves the objects to the scene's import
};

/// Fails, naming the field, on what documentFromJson refuses.
Result<ProjectText> readProjectText(const std::string& json);

} // namespace limn
