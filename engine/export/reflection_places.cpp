// SPDX-License-Identifier: MIT
#include "engine/export/reflection_places.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/bounds.h"
#include "engine/shading/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Candidates along the longest side of the scene, and cells in which surfaces are counted as seen.
constexpr int kCandidates = 12, kCells = 32;
/// Directions in which a candidate looks, and a place that was chosen.
constexpr std::uint32_t kRays = 128, kChosenRays = 4096;
/// Distance of surfaces to a place in the open, as a share of a candidate's cell.
constexpr float kClearance = 0.25f;
/// What a further place must add, as a share of what the first one sees.
constexpr double kWorth = 0.2;

/// A place from which reflections may be seen.
struct Candidate {
    glm::vec3 place{0};
    std::vector<std::uint32_t> seen; ///< cells with surfaces, sorted; empty if not in the open
};

std::vector<glm::vec3> lattice(const Bounds& bounds, float spacing) {
    const glm::ivec3 n = glm::max(glm::ivec3(glm::round(bounds.size() / spacing)), 1);
    std::vector<glm::vec3> points;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x)
                points.push_back(bounds.lower +
                                 (glm::vec3(x, y, z) + 0.5f) / glm::vec3(n) * bounds.size());
    return points;
}

std::vector<std::uint32_t> seenFrom(const ExportScene& in, glm::vec3 p, float clearance,
                                    float edge) {
    const DirectionSet directions(kRays, true, 0);
    std::vector<std::uint32_t> cells;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const Hit hit = in.trace.closestHit({.origin = p, .direction = directions[i]});
        if (!hit)
            continue;
        if (!surfacePoint(in.trace, hit) || glm::distance(hit.position, p) < clearance)
            return {};
        const glm::ivec3 cell =
            glm::clamp(glm::ivec3((hit.position - in.scene.bounds.lower) / edge * float(kCells)), 0,
                       kCells - 1);
        cells.push_back(std::uint32_t((cell.z * kCells + cell.y) * kCells + cell.x));
    }
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

/// Number of the cells that are not known yet.
std::size_t added(std::span<const std::uint32_t> cells, const std::vector<bool>& known) {
    return std::size_t(std::ranges::count_if(cells, [&](std::uint32_t c) { return !known[c]; }));
}

std::vector<glm::vec3> chosenPlaces(const std::vector<Candidate>& candidates, std::uint32_t count) {
    std::vector<bool> known(std::size_t(kCells) * kCells * kCells, false);
    std::vector<glm::vec3> places;
    std::size_t first = 0;
    while (places.size() < count) {
        const auto gain = [&](const Candidate& c) { return added(c.seen, known); };
        const auto best = std::ranges::max_element(candidates, {}, gain);
        const std::size_t more = best == candidates.end() ? 0 : gain(*best);
        if (more == 0 || double(more) < kWorth * double(first))
            break;
        first = std::max(first, more);
        places.push_back(best->place);
        for (const std::uint32_t cell : best->seen)
            known[cell] = true;
    }
    return places;
}

/// Directions in which each instance is seen from `p`, of kChosenRays.
std::vector<std::uint32_t> viewsOf(const ExportScene& in, glm::vec3 p) {
    const DirectionSet directions(kChosenRays, true, 0);
    std::vector<std::uint32_t> views(in.scene.instances.size(), 0);
    for (std::uint32_t i = 0; i < kChosenRays; ++i)
        if (const Hit hit = in.trace.closestHit({.origin = p, .direction = directions[i]}); hit)
            ++views[hit.instance];
    return views;
}

glm::vec3 middleOf(const Scene& scene, const Instance& instance) {
    const glm::vec3 middle = boundsOf(scene.meshOf(instance).positions).centre();
    return glm::vec3(instance.toWorld * glm::vec4(middle, 1));
}

} // namespace

ReflectionPlaces reflectionPlaces(const ExportScene& scene, std::uint32_t count) {
    const glm::vec3 size = scene.scene.bounds.size();
    const float edge = std::max({size.x, size.y, size.z, 1e-6f});
    const float spacing = edge / float(kCandidates);
    std::vector<Candidate> candidates;
    for (const glm::vec3& p : lattice(scene.scene.bounds, spacing))
        candidates.push_back({p, {}});
    parallelRanges(candidates.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            candidates[k].seen = seenFrom(scene, candidates[k].place, kClearance * spacing, edge);
    });
    ReflectionPlaces found{chosenPlaces(candidates, count), {}};
    if (found.places.empty())
        found.places = {scene.scene.bounds.centre()};
    std::vector<std::vector<std::uint32_t>> views;
    for (const glm::vec3& p : found.places)
        views.push_back(viewsOf(scene, p));
    for (std::size_t i = 0; i < scene.scene.instances.size(); ++i) {
        const glm::vec3 middle = middleOf(scene.scene, scene.scene.instances[i]);
        std::uint32_t best = 0;
        for (std::uint32_t k = 1; k < found.places.size(); ++k) {
            const bool isNearer =
                glm::distance(found.places[k], middle) < glm::distance(found.places[best], middle);
            if (views[k][i] > views[best][i] || (views[k][i] == views[best][i] && isNearer))
                best = k;
        }
        found.ofInstance.push_back(best);
    }
    return found;
}

} // namespace limn
