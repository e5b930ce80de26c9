// SPDX-License-Identifier: MIT
#include "editor_ui/document/tree_edit.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/manipulation.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/find_object.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <glm/matrix.hpp>

namespace limn {

/// `node` as a child of `parent`, at the same place in the world; std::nullopt where its transform
/// would not be valid.
static std::optional<Node> below(const Document& document, Node node, ObjectId parent) {
    if (node.parent == parent)
        return node;
    Placements placements(document, glm::dvec3(0));
    const glm::dmat4 inParent =
        glm::inverse(placements.of(parent).toWorld) * placements.of(node.parent).toWorld;
    node.transform = transformed(inParent, node.transform);
    node.parent = parent;
    return isValid(node) ? std::optional(node) : std::nullopt;
}

/// The selected nodes that are not below another selected one, in the order of their ids.
static std::vector<ObjectId> topNodes(const EditorState& state) {
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : movableSelection(state))
        if (std::holds_alternative<Node>(object))
            ids.push_back(id);
    return ids;
}

static ObjectId commonParent(const Document& document, const std::vector<ObjectId>& nodes) {
    const ObjectId parent = findObjectAs<Node>(document, nodes.front())->parent;
    const bool same = std::ranges::all_of(
        nodes, [&](ObjectId id) { return findObjectAs<Node>(document, id)->parent == parent; });
    return same && findObjectAs<Node>(document, parent) ? parent : 0;
}

/// Puts the nodes below `parent`, as part of `edit`.
static void addMoves(Edit& edit, const Document& document, const std::vector<ObjectId>& nodes,
                     ObjectId parent, ObjectId shownParent) {
    for (ObjectId id : nodes) {
        const Node& node = *findObjectAs<Node>(document, id);
        auto after = below(document, node, parent);
        if (!after)
            continue;
        after->parent = shownParent;
        if (*after != node)
            edit.changes.push_back({id, node, std::move(*after)});
    }
}

void groupSelection(EditorState& state) {
    commitGesture(state);
    const std::vector<ObjectId> nodes = topNodes(state);
    if (nodes.empty())
        return;
    Node group;
    group.name = freeName(state.document, "Group");
    group.parent = commonParent(state.document, nodes);
    const ObjectId id = state.document.nextId;
    Edit edit{"Group " + std::to_string(nodes.size()) + " objects", {{id, {}, group}}};
    // The group has its parent's space.
    addMoves(edit, state.document, nodes, group.parent, id);
    applyEdit(state, std::move(edit));
    state.selection = {id};
}

static std::vector<ObjectId> childrenOf(const Document& document, ObjectId parent) {
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : document.objects)
        if (const auto* node = std::get_if<Node>(&object); node && node->parent == parent)
            ids.push_back(id);
    return ids;
}

static bool isGroup(const Document& document, ObjectId id) {
    const Node* node = findObjectAs<Node>(document, id);
    return node && node->meshes.empty() && !childrenOf(document, id).empty();
}

bool canUngroup(const EditorState& state) {
    return std::ranges::any_of(state.selection,
                               [&](ObjectId id) { return isGroup(state.document, id); });
}

void ungroupSelection(EditorState& state) {
    commitGesture(state);
    const Document& document = state.document;
    Edit edit{"Ungroup", {}};
    std::vector<ObjectId> freed;
    for (ObjectId id : topNodes(state)) {
        if (!isGroup(document, id))
            continue;
        const Node& group = *findObjectAs<Node>(document, id);
        const std::vector<ObjectId> children = childrenOf(document, id);
        const std::size_t first = edit.changes.size();
        addMoves(edit, document, children, group.parent, group.parent);
        if (edit.changes.size() - first != children.size()) { // one has no valid transform there
            edit.changes.resize(first);
            continue;
        }
        for (std::size_t i = first; i < edit.changes.size(); ++i) {
            Node& child = std::get<Node>(*edit.changes[i].after);
            child.visible = child.visible && group.visible;
            child.dynamic = child.dynamic || group.dynamic;
            child.texelDensity = std::clamp(child.texelDensity * group.texelDensity,
                                            kMinTexelDensity, kMaxTexelDensity);
        }
        edit.changes.push_back({id, group, {}});
        freed.insert(freed.end(), children.begin(), children.end());
    }
    if (edit.changes.empty())
        return;
    applyEdit(state, std::move(edit));
    state.selection = std::move(freed);
}

void reparent(EditorState& state, const std::vector<ObjectId>& nodes, ObjectId parent) {
    commitGesture(state);
    const Document& document = state.document;
    if (parent != 0 && !findObjectAs<Node>(document, parent))
        return;
    std::vector<ObjectId> moved;
    for (ObjectId id : nodes)
        if (findObjectAs<Node>(document, id) && !inOrBelow(document, parent, {id}))
            moved.push_back(id);
    const Object* target = findObject(state, parent);
    Edit edit{target ? "Put below " + objectName(*target) : "Put at the root", {}};
    addMoves(edit, document, moved, parent, parent);
    applyEdit(state, std::move(edit));
}

} // namespace limn
