// SPDX-License-Identifier: MIT
#include "engine/lighting/explanation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace limn {

std::string_view nameOf(LightRowKind kind) {
    switch (kind) {
    case LightRowKind::Group:
        return "group";
    case LightRowKind::Light:
        return "light";
    case LightRowKind::Sky:
        return "sky";
    case LightRowKind::SkyCell:
        return "sky_cell";
    case LightRowKind::Surface:
        return "surface";
    case LightRowKind::Cluster:
        return "cluster";
    case LightRowKind::Surfel:
        return "surfel";
    case LightRowKind::Others:
        return "others";
    case LightRowKind::Remainder:
        return "remainder";
    }
    return "";
}

glm::vec3 totalOf(const std::vector<LightRow>& rows) {
    glm::vec3 sum(0);
    for (const LightRow& row : rows)
        if (row.parent == LightRow::kNone)
            sum += row.value;
    return sum;
}

std::uint32_t addRow(std::vector<LightRow>& rows, LightRow row) {
    rows.push_back(std::move(row));
    return std::uint32_t(rows.size() - 1);
}

void addRows(std::vector<LightRow>& rows, const std::vector<LightRow>& more, std::uint32_t parent) {
    const auto first = std::uint32_t(rows.size());
    for (const LightRow& row : more) {
        rows.push_back(row);
        rows.back().parent = row.parent == LightRow::kNone ? parent : first + row.parent;
    }
}

std::string objectLabel(const Scene& scene, std::uint32_t instance) {
    const Instance& i = scene.instances[instance];
    const std::string &mesh = scene.meshOf(i).name, &material = scene.materialOf(i).name;
    const std::string name = mesh.empty() ? fmt::format("Object {}", instance) : mesh;
    return material.empty() || material == name ? name : fmt::format("{} ({})", name, material);
}

std::vector<LightRow> strongest(std::vector<LightRow> found, std::size_t maxRows) {
    std::ranges::stable_sort(found, isStronger, &LightRow::value);
    if (found.size() <= maxRows + 1) // a single one that is left is listed
        return found;
    LightRow others{.kind = LightRowKind::Others,
                    .label = fmt::format("{} more", found.size() - maxRows),
                    .parent = found[0].parent};
    for (std::size_t k = maxRows; k < found.size(); ++k)
        others.value += found[k].value;
    found.resize(maxRows);
    found.push_back(std::move(others));
    return found;
}

bool isStronger(glm::vec3 a, glm::vec3 b) {
    return a.x + a.y + a.z > b.x + b.y + b.z;
}

} // namespace limn
