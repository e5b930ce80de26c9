// SPDX-License-Identifier: MIT
#include "engine/scene/dynamic_spec.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

namespace limn {

Result<void> makeDynamic(Document& document, std::string_view spec) {
    const std::size_t separator = spec.rfind('@');
    const std::string_view name = spec.substr(0, separator);
    glm::dvec3 offset(0);
    if (separator != std::string_view::npos) {
        const std::string way(spec.substr(separator + 1));
        int end = 0;
        if (std::sscanf(way.c_str(), "%lf,%lf,%lf%n", &offset.x, &offset.y, &offset.z, &end) != 3 ||
            std::size_t(end) != way.size() || !std::isfinite(float(offset.x + offset.y + offset.z)))
            return fail(fmt::format("dynamic '{}': expected three numbers x,y,z after @", spec));
    }
    bool found = false;
    for (auto& [id, object] : document.objects)
        if (Node* node = std::get_if<Node>(&object); node && node->name == name) {
            node->dynamic = found = true;
            node->transform.translation += offset;
        }
    if (!found)
        return fail(fmt::format("dynamic '{}': there is no object of that name", name));
    return {};
}

} // namespace limn
