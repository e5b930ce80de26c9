// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace limn {

/// How much a finding matters, in ascending order. A note may be meant; a warning makes the light
/// wrong or wastes the bake somewhere; an error keeps the scene from being baked.
enum class Severity : std::uint8_t { Note, Warning, Error };

inline constexpr std::array<std::string_view, 3> kSeverityNames = {"note", "warning", "error"};

constexpr std::string_view severityName(Severity severity) {
    return kSeverityNames[std::size_t(severity)];
}

/// What is looked for in a scene.
struct LintRule {
    std::string_view name; ///< kebab-case, as in reports and docs/lint.md
    Severity severity;     ///< of its findings, at worst
    std::string_view summary;
};

/// One fault of a scene.
struct Finding {
    const LintRule* rule = nullptr; ///< of lintRules(), never null in a report
    Severity severity = Severity::Warning;
    ObjectId object = 0; ///< what it is about; 0: the scene as a whole
    std::string path;    ///< objectPath() of the object
    std::string problem; ///< one sentence: what is wrong
    std::string advice;  ///< one sentence: what to do
    /// Where to look, in the file's coordinates [m].
    std::optional<glm::dvec3> place = std::nullopt;
};

} // namespace limn
