// SPDX-License-Identifier: MIT
#include "editor_ui/document/selection.h"

#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/find_object.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <unordered_set>

namespace limn {

namespace {

/// A box that grows point by point.
struct Grown {
    Bounds bounds;
    bool any = false;

    void add(glm::vec3 p) {
        bounds.lower = any ? glm::min(bounds.lower, p) : p;
        bounds.upper = any ? glm::max(bounds.upper, p) : p;
        any = true;
    }
};

using Ids = std::unordered_set<ObjectId>;

} // namespace

static Ids selectedIds(const EditorState& state) {
    return {state.selection.begin(), state.selection.end()};
}

bool inOrBelow(const Document& document, ObjectId id, const std::unordered_set<ObjectId>& ids) {
    for (std::size_t depth = 0; id != 0 && depth <= document.objects.size(); ++depth) {
        if (ids.contains(id))
            return true;
        const Node* node = findObjectAs<Node>(document, id);
        id = node ? node->parent : 0;
    }
    return false;
}

void pruneSelection(EditorState& state) {
    std::erase_if(state.selection,
                  [&](ObjectId id) { return !state.document.objects.contains(id); });
}

std::vector<ObjectId> withChildren(const Document& document,
                                   const std::unordered_set<ObjectId>& tops) {
    std::vector<ObjectId> ids;
    if (tops.empty()) // asked in every frame
        return ids;
    for (const auto& [id, object] : document.objects)
        if (canDelete(object) && inOrBelow(document, id, tops))
            ids.push_back(id);
    return ids;
}

std::vector<ObjectId> selectionWithChildren(const EditorState& state) {
    return withChildren(state.document, selectedIds(state));
}

std::map<ObjectId, Object> movableSelection(const EditorState& state) {
    const Ids selected = selectedIds(state);
    std::map<ObjectId, Object> objects;
    for (ObjectId id : state.selection) {
        const auto it = state.document.objects.find(id);
        if (it == state.document.objects.end() || !canDelete(it->second))
            continue;
        const Node* node = std::get_if<Node>(&it->second);
        if (!node || !inOrBelow(state.document, node->parent, selected))
            objects.emplace(id, it->second);
    }
    return objects;
}

/// Position of an object that has one.
static std::optional<glm::vec3> placeOf(Placements& placements, ObjectId id, const Object& object) {
    if (const auto* light = std::get_if<Light>(&object))
        return light->position;
    if (const auto* camera = std::get_if<Camera>(&object))
        return camera->eye;
    if (std::holds_alternative<Node>(object))
        return glm::vec3(placements.of(id).toWorld[3]);
    return std::nullopt;
}

static void growByNode(const EditorState& state, const glm::mat4& toWorld, const Node& node,
                       Grown& grown) {
    if (node.meshes.empty())
        grown.add(toWorld[3]);
    for (std::uint32_t mesh : node.meshes) {
        if (mesh >= state.meshBounds.size())
            continue;
        const Bounds& b = state.meshBounds[mesh];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? b.upper.x : b.lower.x,
                              corner & 2 ? b.upper.y : b.lower.y,
                              corner & 4 ? b.upper.z : b.lower.z);
            grown.add(toWorld * glm::vec4(p, 1));
        }
    }
}

static Grown grownBy(const EditorState& state, const std::vector<ObjectId>& ids) {
    Placements placements(state.document);
    Grown grown;
    for (ObjectId id : ids) {
        const Object& object = state.document.objects.at(id);
        if (const auto* node = std::get_if<Node>(&object))
            growByNode(state, glm::mat4(placements.of(id).toWorld), *node, grown);
        else if (const auto place = placeOf(placements, id, object))
            grown.add(*place);
    }
    return grown;
}

static Grown grownBySelection(const EditorState& state) {
    return grownBy(state, selectionWithChildren(state));
}

static std::optional<glm::vec3> meanOrigin(const EditorState& state) {
    Placements placements(state.document);
    glm::vec3 sum(0);
    int count = 0;
    for (const auto& [id, object] : movableSelection(state))
        if (const auto place = placeOf(placements, id, object))
            sum += *place, ++count;
    return count ? std::optional(sum / float(count)) : std::nullopt;
}

std::optional<glm::vec3> selectionOrigin(const EditorState& state) {
    if (state.view.gizmoPlace == GizmoPlace::Origins)
        return meanOrigin(state);
    const PickedSurface* picked = pickedSurface(state);
    if (state.view.gizmoPlace == GizmoPlace::Click && picked)
        return picked->position;
    const Grown grown = grownBySelection(state);
    return grown.any ? std::optional(grown.bounds.centre()) : std::nullopt;
}

Bounds selectionBounds(const EditorState& state) {
    const Grown grown = grownBySelection(state);
    return grown.any ? grown.bounds : state.sceneBounds;
}

std::optional<Bounds> boundsOf(const EditorState& state, ObjectId id) {
    const Grown grown = grownBy(state, withChildren(state.document, {id}));
    return grown.any ? std::optional(grown.bounds) : std::nullopt;
}

const PickedSurface* pickedSurface(const EditorState& state) {
    const auto& picked = state.view.picked;
    return picked && picked->node == activeId(state) ? &*picked : nullptr;
}

} // namespace limn
