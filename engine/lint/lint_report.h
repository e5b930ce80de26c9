// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"
#include "engine/lint/finding.h"

#include <span>
#include <string>

namespace limn {

/// The findings as a JSON array, with "rule", "severity", "object" (id, 0: the scene), "path",
/// "problem", "advice" and "place" ([x, y, z] in the file's coordinates [m], or null).
Json findingsJson(std::span<const Finding> findings);

/// The findings as a log of the Static Analysis Results Interchange Format.
/// OASIS. Static Analysis Results Interchange Format (SARIF) Version 2.1.0. 2020
/// `scene`: path of the file; `version`: of the program.
Json sarifLog(std::span<const Finding> findings, const std::string& scene,
              const std::string& version);

} // namespace limn
