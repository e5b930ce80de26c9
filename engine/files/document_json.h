// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string>

namespace limn {

inline constexpr int kProjectVersion = 1;

/// The contents of a project file.
struct ProjectText {
    Document document;
    bool hasObjects = false; ///< false: the objects come from the scene's import
};

/// Parses a project file. Fails, naming the field, on whatever documentFromJson() rejects.
Result<ProjectText> readProjectText(const std::string& json);

} // namespace limn
