// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"

#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <limits>

namespace limn {

static bool nameTaken(const Document& document, const std::string& name) {
    return std::ranges::any_of(document.objects, [&](const auto& entry) {
        Object copy = entry.second;
        const std::string* other = nameOf(copy);
        return other && *other == name;
    });
}

static std::string freeName(const Document& document, const std::string& wanted) {
    if (!nameTaken(document, wanted))
        return wanted;
    for (int i = 2;; ++i)
        if (std::string name = wanted + " " + std::to_string(i); !nameTaken(document, name))
            return name;
}

static void applyEdit(EditorState& state, Edit edit) {
    apply(state.history, state.document, std::move(edit));
}

ObjectId addLight(EditorState& state, Light light) {
    commitGesture(state);
    light.name = freeName(state.document, light.name);
    const ObjectId id = state.document.nextId;
    applyEdit(state, {"Add " + light.name, {{id, {}, light}}});
    state.selection = {id};
    return id;
}

/// The change that makes `after` the document's only object of its type, which it may lack yet.
template <class T>
static Change changeOfSingle(const Document& document, const T& after) {
    for (const auto& [id, object] : document.objects)
        if (std::holds_alternative<T>(object))
            return {id, object, after};
    return {document.nextId, {}, after};
}

void setSkyImage(EditorState& state, const Sky& image) {
    commitGesture(state);
    Sky sky = singleton<Sky>(state.document);
    sky.kind = image.kind;
    sky.image = image.image;
    sky.panorama = image.panorama;
    applyEdit(state, {"Sky image", {changeOfSingle(state.document, sky)}});
}

void setExportSettings(EditorState& state, const ExportSettings& settings) {
    commitGesture(state);
    const Change change = changeOfSingle(state.document, settings);
    if (change.before != change.after)
        applyEdit(state, {"Export settings", {change}});
}

static bool isBelow(const Document& document, ObjectId id, ObjectId ancestor) {
    for (std::size_t depth = 0; id != 0 && depth <= document.objects.size(); ++depth) {
        if (id == ancestor)
            return true;
        const auto it = document.objects.find(id);
        const Node* node = it == document.objects.end() ? nullptr : std::get_if<Node>(&it->second);
        id = node ? node->parent : 0;
    }
    return false;
}

/// The selected deletable objects and the nodes below them, parents before children.
static std::vector<ObjectId> selectionWithChildren(const EditorState& state) {
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : state.document.objects) {
        if (!canDelete(object))
            continue;
        const bool in = std::ranges::any_of(state.selection, [&, objectId = id](ObjectId selected) {
            return isBelow(state.document, objectId, selected);
        });
        if (in)
            ids.push_back(id);
    }
    return ids;
}

static std::string labelFor(const EditorState& state, const char* verb,
                            const std::vector<ObjectId>& ids) {
    if (state.selection.size() == 1 && !ids.empty())
        return std::string(verb) + " " + objectName(state.document.objects.at(activeId(state)));
    return std::string(verb) + " " + std::to_string(ids.size()) + " objects";
}

void deleteSelection(EditorState& state) {
    commitGesture(state);
    const std::vector<ObjectId> ids = selectionWithChildren(state);
    Edit edit{labelFor(state, "Delete", ids), {}};
    for (ObjectId id : ids)
        edit.changes.push_back({id, state.document.objects.at(id), {}});
    applyEdit(state, std::move(edit));
    pruneSelection(state);
}

void duplicateSelection(EditorState& state) {
    commitGesture(state);
    const std::vector<ObjectId> ids = selectionWithChildren(state);
    Edit edit{labelFor(state, "Duplicate", ids), {}};
    std::map<ObjectId, ObjectId> copyOf;
    ObjectId next = state.document.nextId;
    for (ObjectId id : ids)
        copyOf[id] = next++;
    std::vector<ObjectId> selection;
    for (ObjectId id : ids) {
        Object copy = state.document.objects.at(id);
        *nameOf(copy) = freeName(state.document, *nameOf(copy));
        bool top = true;
        if (auto* node = std::get_if<Node>(&copy); node && copyOf.contains(node->parent)) {
            node->parent = copyOf.at(node->parent);
            top = false;
        }
        if (top)
            selection.push_back(copyOf.at(id));
        edit.changes.push_back({copyOf.at(id), {}, std::move(copy)});
    }
    applyEdit(state, std::move(edit));
    if (!selection.empty())
        state.selection = std::move(selection);
}

static bool* shownFlag(Object& object) {
    if (auto* node = std::get_if<Node>(&object))
        return &node->visible;
    if (auto* light = std::get_if<Light>(&object))
        return &light->enabled;
    return nullptr;
}

static void setShown(EditorState& state, const std::vector<ObjectId>& ids, bool shown,
                     const char* verb) {
    Edit edit{verb, {}};
    for (ObjectId id : ids) {
        const Object& before = state.document.objects.at(id);
        Object after = before;
        if (bool* flag = shownFlag(after); flag && *flag != shown) {
            *flag = shown;
            edit.changes.push_back({id, before, std::move(after)});
        }
    }
    if (edit.changes.size() == 1)
        edit.label += " " + objectName(*edit.changes[0].before);
    applyEdit(state, std::move(edit));
}

void toggleHidden(EditorState& state) {
    commitGesture(state);
    const bool anyShown = std::ranges::any_of(state.selection, [&](ObjectId id) {
        Object* object = findObject(state, id);
        const bool* flag = object ? shownFlag(*object) : nullptr;
        return flag && *flag;
    });
    setShown(state, state.selection, !anyShown, anyShown ? "Hide" : "Show");
}

void showAll(EditorState& state) {
    commitGesture(state);
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : state.document.objects)
        ids.push_back(id);
    setShown(state, ids, true, "Show all");
}

void rename(EditorState& state, ObjectId id, const std::string& name) {
    commitGesture(state);
    Object* object = findObject(state, id);
    if (!object || name.empty() || !nameOf(*object) || *nameOf(*object) == name)
        return;
    Object after = *object;
    *nameOf(after) = name;
    applyEdit(state, {"Rename " + objectName(*object), {{id, *object, std::move(after)}}});
}

bool undoEdit(EditorState& state) {
    commitGesture(state);
    state.view.drag.reset();
    const bool done = undo(state.history, state.document);
    pruneSelection(state);
    return done;
}

bool redoEdit(EditorState& state) {
    commitGesture(state);
    state.view.drag.reset();
    const bool done = redo(state.history, state.document);
    pruneSelection(state);
    return done;
}

void pruneSelection(EditorState& state) {
    std::erase_if(state.selection,
                  [&](ObjectId id) { return !state.document.objects.contains(id); });
}

glm::mat4 worldMatrix(const Document& document, ObjectId node) {
    return glm::mat4(Placements(document).of(node).toWorld);
}

static bool placeOf(const Document& document, ObjectId id, glm::vec3& place) {
    const Object& object = document.objects.at(id);
    if (const auto* light = std::get_if<Light>(&object))
        place = light->position;
    else if (const auto* camera = std::get_if<Camera>(&object))
        place = camera->eye;
    else if (std::holds_alternative<Node>(object))
        place = worldMatrix(document, id)[3];
    else
        return false;
    return true;
}

bool selectionOrigin(const EditorState& state, glm::vec3& origin) {
    glm::vec3 sum(0);
    int count = 0;
    for (const auto& [id, object] : movableSelection(state))
        if (glm::vec3 p; placeOf(state.document, id, p))
            sum += p, ++count;
    if (count == 0)
        return false;
    origin = sum / float(count);
    return true;
}

Object displaced(const Document& document, const Object& object, glm::vec3 d) {
    Object moved = object;
    if (auto* light = std::get_if<Light>(&moved)) {
        light->position += d;
    } else if (auto* camera = std::get_if<Camera>(&moved)) {
        camera->eye += d;
        camera->target += d;
    } else if (auto* node = std::get_if<Node>(&moved)) {
        if (node->parent != 0)
            d = glm::inverse(glm::mat3(worldMatrix(document, node->parent))) * d;
        node->transform.translation += glm::dvec3(d);
    }
    return moved;
}

std::map<ObjectId, Object> movableSelection(const EditorState& state) {
    std::map<ObjectId, Object> objects;
    for (ObjectId id : state.selection) {
        const auto it = state.document.objects.find(id);
        if (it == state.document.objects.end() || !canDelete(it->second))
            continue;
        const bool carried = std::ranges::any_of(state.selection, [&](ObjectId other) {
            return other != id && isBelow(state.document, id, other);
        });
        if (!carried)
            objects.emplace(id, it->second);
    }
    return objects;
}

static void grow(Bounds& bounds, bool& any, glm::vec3 p) {
    bounds.lower = any ? glm::min(bounds.lower, p) : p;
    bounds.upper = any ? glm::max(bounds.upper, p) : p;
    any = true;
}

static void growByNode(const EditorState& state, ObjectId id, const Node& node, Bounds& bounds,
                       bool& any) {
    const glm::mat4 m = worldMatrix(state.document, id);
    if (node.meshes.empty())
        grow(bounds, any, m[3]);
    for (std::uint32_t mesh : node.meshes) {
        if (mesh >= state.meshBounds.size())
            continue;
        const Bounds& b = state.meshBounds[mesh];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? b.upper.x : b.lower.x,
                              corner & 2 ? b.upper.y : b.lower.y,
                              corner & 4 ? b.upper.z : b.lower.z);
            grow(bounds, any, m * glm::vec4(p, 1));
        }
    }
}

Bounds selectionBounds(const EditorState& state) {
    Bounds bounds;
    bool any = false;
    for (ObjectId id : selectionWithChildren(state)) {
        const Object& object = state.document.objects.at(id);
        if (const auto* node = std::get_if<Node>(&object))
            growByNode(state, id, *node, bounds, any);
        else if (glm::vec3 p; placeOf(state.document, id, p))
            grow(bounds, any, p);
    }
    return any ? bounds : state.sceneBounds;
}

} // namespace limn
