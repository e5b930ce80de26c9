// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Where a scene's reflections are seen from, and which of these places reflects best what an
/// object does.
struct ReflectionPlaces {
    std::vector<glm::vec3> places;         ///< [m, world], at least one
    std::vector<std::uint32_t> ofInstance; ///< index into `places` for each of Scene::instances
};

/// At most `count` places in the open: from none a surface shows a black back, as it does inside of
/// solid objects, or is close. The first place sees more of the surfaces than any other; each
/// further one sees the most of what those before it do not, and there is none where that is
/// little. An instance belongs to the place that sees it under the largest solid angle, or the
/// nearest if none does. The middle of the scene where no place is in the open. Deterministic.
ReflectionPlaces reflectionPlaces(const ExportScene& scene, std::uint32_t count);

} // namespace limn
