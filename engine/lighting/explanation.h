// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What a row of an explanation stands for.
enum class LightRowKind : std::uint8_t {
    Group,     ///< the rows below it
    Light,     ///< index: of Scene::lights
    Sky,       ///< or a technique's constant light
    SkyCell,   ///< a part of the sky; index: of the technique
    Surface,   ///< index: of Scene::instances
    Cluster,   ///< some samples of a surface taken together; index: of the technique
    Surfel,    ///< a sample of a surface; index: of the technique
    Others,    ///< the rows that are not listed
    Remainder, ///< bounces that were not followed
};

/// A part of the light of a pixel. The rows below a row sum to it.
struct LightRow {
    static constexpr std::uint32_t kNone = ~0U;

    LightRowKind kind = LightRowKind::Group;
    std::string label;
    std::uint32_t index = kNone;  ///< see LightRowKind
    std::uint32_t parent = kNone; ///< index of an earlier row of the same table
    glm::vec3 value{0};           ///< in the unit of what is explained
};

/// Where light comes from, split in two ways. The top rows of each table sum to all of it.
struct Explanation {
    std::vector<LightRow> byOrigin; ///< lights, sky and emissive surfaces, over all bounces
    std::vector<LightRow> bySender; ///< what light arrives from directly, however it got there
    std::uint32_t bounces = 0;      ///< number that byOrigin follows
};

struct ExplainOptions {
    /// Bounces are followed until the rest is at most this share of the bounced light.
    double tolerance = 2e-3;
    std::uint32_t rows = 8; ///< listed at each level of bySender, the strongest; then Others
    /// If not empty, byOrigin is that of a scene in which these instances reflect nothing, and
    /// bySender stays empty.
    std::vector<std::uint32_t> black;
};

/// The name of a kind of row in JSON.
std::string_view nameOf(LightRowKind kind);

/// Sum of the rows without parent.
glm::vec3 totalOf(const std::vector<LightRow>& rows);

/// Appends a row and returns its index.
std::uint32_t addRow(std::vector<LightRow>& rows, LightRow row);

/// Appends the rows of `more`, those without parent below `parent`.
void addRows(std::vector<LightRow>& rows, const std::vector<LightRow>& more, std::uint32_t parent);

/// Name of an instance in a row: of its mesh, with that of its material.
std::string objectLabel(const Scene& scene, std::uint32_t instance);

/// The `maxRows` strongest of `found`, which have the same parent, and then one row for the others.
std::vector<LightRow> strongest(std::vector<LightRow> found, std::size_t maxRows);

/// Order by which rows are listed: the strongest first, by the sum of their colours.
bool isStronger(glm::vec3 a, glm::vec3 b);

} // namespace limn
