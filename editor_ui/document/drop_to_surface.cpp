// SPDX-License-Identifier: MIT
#include "editor_ui/document/drop_to_surface.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/manipulation.h"
#include "editor_ui/editor_state.h"

#include <unordered_set>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kClearance = 0.01f; ///< of lights and cameras, in radii of the scene
constexpr glm::vec3 kDown(0, -1, 0);

using Ids = std::unordered_set<ObjectId>;

} // namespace

/// Height of the first surface below a point, through those of the nodes in `ignored` [m].
static std::optional<float> surfaceBelow(const TraceScene& trace, glm::vec3 from,
                                         const Ids& ignored) {
    Ray ray{from, kDown};
    while (const Hit hit = trace.closestHit(ray, TraceMask::Seen)) {
        if (!ignored.contains(trace.scene().instances[hit.instance].node))
            return hit.position.y;
        ray.tNear = hit.t + trace.epsilonAt(hit.position);
    }
    return {};
}

/// How far up the object goes; negative: down [m].
static std::optional<float> riseOf(const EditorState& state, ObjectId id, const Object& object,
                                   const Ids& selected) {
    const auto bounds = boundsOf(state, id);
    const auto ground =
        bounds ? surfaceBelow(*state.trace, bounds->centre(), selected) : std::nullopt;
    if (!ground)
        return {};
    const float clearance = std::holds_alternative<Node>(object)
                                ? 0
                                : kClearance * glm::length(state.sceneBounds.size()) / 2;
    return *ground + clearance - bounds->lower.y;
}

void dropSelection(EditorState& state) {
    commitGesture(state);
    if (!state.trace)
        return;
    const std::vector<ObjectId> all = selectionWithChildren(state);
    const Ids selected(all.begin(), all.end());
    Edit edit{"Drop to the surface", {}};
    for (const auto& [id, object] : movableSelection(state)) {
        const auto rise = riseOf(state, id, object, selected);
        if (!rise)
            continue;
        Object after = manipulated(state.document, object, {.move = {0, *rise, 0}});
        if (after != object)
            edit.changes.push_back({id, object, std::move(after)});
    }
    applyEdit(state, std::move(edit));
}

} // namespace limn
