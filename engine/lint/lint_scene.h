// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/lint/finding.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace limn {

/// What the rules read.
struct LintScene {
    const Document& document;
    const Scene& scene; ///< flatten() of the document
    const TraceScene& trace;
    std::span<const std::string> repairs; ///< ImportedScene::repairs
    MemoryBudget memory = {};             ///< of a bake
};

/// Names of an object and of the groups that hold it, "House/Wall"; objects without a name are
/// called by their number, "#12".
std::string objectPath(const Document& document, ObjectId id);

/// A finding about an object; 0: about the scene.
Finding findingAbout(const LintScene& in, const LintRule& rule, ObjectId object,
                     std::string problem, std::string advice);

/// Middle of an instance's bounding box in the file's coordinates [m].
glm::dvec3 middleInFile(const Scene& scene, const Instance& instance);

/// "Material "Oak"", for a sentence about an instance of a node with several meshes; else "It".
std::string partText(const Scene& scene, const Instance& instance);

/// Instances that show one mesh in one material.
struct MeshUse {
    std::uint32_t instance = 0; ///< the one of the largest area
    double area = 0;            ///< of that one, one side [m^2, world]
    std::size_t count = 0;
};

/// All uses of meshes, in the order of their first instances.
std::vector<MeshUse> meshUses(const Scene& scene);

/// Collects uses that share a fault, by material, so that each material gets one finding. It is
/// about the use of the largest area, and counts the instances of all.
class UsesByMaterial {
public:
    void add(const Scene& scene, const MeshUse& use);
    /// By index into Scene::materials.
    const std::map<std::uint32_t, MeshUse>& uses() const { return m_uses; }

private:
    std::map<std::uint32_t, MeshUse> m_uses;
};

/// "" for 1 object, " It is one of 3 objects so." and the like for more.
std::string othersText(std::size_t count);

/// A point of a surface and the side from which it is lit.
struct LintPoint {
    std::uint32_t instance = 0;
    glm::vec3 position{0}; ///< clear of the surface, on that side, world
    glm::vec3 normal{0};   ///< unit, out of that side, world
};

/// At most `count` points spread over all surfaces by area, of two-sided ones on both sides in
/// turn; sheets of glass have none. The same for the same scene.
std::vector<LintPoint> spreadPoints(const LintScene& in, std::size_t count);

/// Whether light gets to a place: less than 7/16 of what it sees are backs of one-sided surfaces.
/// Within a solid it would be all, and behind a plane half. `p` is clear of surfaces; a `normal` of
/// 0 looks all around.
bool isOpen(const TraceScene& trace, glm::vec3 p, glm::vec3 normal);

} // namespace limn
