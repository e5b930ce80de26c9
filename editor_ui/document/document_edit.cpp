// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"

#include "editor_ui/document/object_rules.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/find_object.h"
#include "engine/scene/placement.h"
#include "engine/scene/sky_sun.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace limn {

static bool nameTaken(const Document& document, const std::string& name) {
    return std::ranges::any_of(document.objects, [&](const auto& entry) {
        Object copy = entry.second;
        const std::string* other = nameOf(copy);
        return other && *other == name;
    });
}

std::string freeName(const Document& document, const std::string& wanted) {
    if (!nameTaken(document, wanted))
        return wanted;
    for (int i = 2;; ++i)
        if (std::string name = wanted + " " + std::to_string(i); !nameTaken(document, name))
            return name;
}

void applyEdit(EditorState& state, Edit edit) {
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

void addLightAndSky(EditorState& state, Light light, const Sky& sky) {
    commitGesture(state);
    light.name = freeName(state.document, light.name);
    const ObjectId id = state.document.nextId;
    Edit edit{"Add " + light.name + " and sky", {{id, {}, light}}};
    Change change = changeOfSingle(state.document, sky);
    if (!change.before)
        change.id = id + 1;
    if (change.before != change.after)
        edit.changes.push_back(std::move(change));
    applyEdit(state, std::move(edit));
    state.selection = {id};
}

void setSkyImage(EditorState& state, const Sky& image) {
    commitGesture(state);
    Sky sky = singleton<Sky>(state.document);
    sky.kind = image.kind;
    sky.image = image.image;
    sky.panorama = image.panorama;
    applyEdit(state, {"Sky image", {changeOfSingle(state.document, sky)}});
}

bool extractSkySun(EditorState& state) {
    Sky sky = singleton<Sky>(state.document);
    const std::optional<Light> sun = extractSun(sky);
    if (sun)
        addLightAndSky(state, *sun, sky);
    return sun.has_value();
}

void setLightProfile(EditorState& state, ObjectId id, const LightProfile& profile) {
    const Light* before = findObjectAs<Light>(state.document, id);
    if (!before)
        return;
    commitGesture(state);
    Light light = *before;
    if (light.kind != LightKind::Spot)
        light.kind = LightKind::Point;
    light.profile = {std::make_shared<const LightProfile>(profile)};
    light.strength = std::min(profile.peak, kMaxLight);
    applyEdit(state, {"IES profile of " + light.name, {{id, *before, light}}});
}

void setExportSettings(EditorState& state, const ExportSettings& settings) {
    commitGesture(state);
    const Change change = changeOfSingle(state.document, settings);
    if (change.before != change.after)
        applyEdit(state, {"Export settings", {change}});
}

void setBakeSettings(EditorState& state, const BakeSettings& settings, const char* label) {
    commitGesture(state);
    const Change change = changeOfSingle(state.document, settings);
    if (change.before != change.after)
        applyEdit(state, {label, {change}});
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

Copies copiesOf(const Document& document, const ObjectsById& originals) {
    std::map<ObjectId, ObjectId> copyOf;
    ObjectId next = document.nextId;
    for (const auto& [id, object] : originals)
        copyOf[id] = next++;
    Copies copies;
    for (const auto& [id, object] : originals) {
        Object copy = object;
        *nameOf(copy) = freeName(document, *nameOf(copy));
        auto* node = std::get_if<Node>(&copy);
        if (node && copyOf.contains(node->parent))
            node->parent = copyOf.at(node->parent);
        else
            copies.tops.push_back(copyOf.at(id));
        copies.objects.emplace(copyOf.at(id), std::move(copy));
    }
    return copies;
}

Copies copiesOfSelection(const EditorState& state) {
    ObjectsById originals;
    for (ObjectId id : selectionWithChildren(state))
        originals.emplace(id, state.document.objects.at(id));
    return copiesOf(state.document, originals);
}

void duplicateSelection(EditorState& state) {
    commitGesture(state);
    Copies copies = copiesOfSelection(state);
    Edit edit{labelFor(state, "Duplicate", selectionWithChildren(state)), {}};
    for (auto& [id, copy] : copies.objects)
        edit.changes.push_back({id, {}, std::move(copy)});
    applyEdit(state, std::move(edit));
    if (!copies.tops.empty())
        state.selection = std::move(copies.tops);
}

static bool* shownFlag(Object& object) {
    if (auto* node = std::get_if<Node>(&object))
        return &node->visible;
    if (auto* light = std::get_if<Light>(&object))
        return &light->enabled;
    return nullptr;
}

/// Ids of objects that are gone are skipped.
static void setShown(EditorState& state, const std::vector<ObjectId>& ids, bool shown,
                     const char* verb) {
    Edit edit{verb, {}};
    for (ObjectId id : ids) {
        const Object* before = findObject(state, id);
        if (!before)
            continue;
        Object after = *before;
        if (bool* flag = shownFlag(after); flag && *flag != shown) {
            *flag = shown;
            edit.changes.push_back({id, *before, std::move(after)});
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

/// Nodes with meshes that are visible and neither selected nor above or below what is.
static std::vector<ObjectId> shownOthers(const EditorState& state) {
    const std::vector<ObjectId> inside = selectionWithChildren(state);
    std::set<ObjectId> kept(inside.begin(), inside.end());
    for (ObjectId id : state.selection)
        for (std::size_t depth = 0; id != 0 && depth <= state.document.objects.size(); ++depth) {
            kept.insert(id);
            const Node* node = findObjectAs<Node>(state.document, id);
            id = node ? node->parent : 0;
        }
    std::vector<ObjectId> others;
    for (const auto& [id, object] : state.document.objects)
        if (const auto* node = std::get_if<Node>(&object);
            node && node->visible && !node->meshes.empty() && !kept.contains(id))
            others.push_back(id);
    return others;
}

bool isIsolated(const EditorState& state) {
    return std::ranges::any_of(state.isolated, [&](ObjectId id) {
        const Node* node = findObjectAs<Node>(state.document, id);
        return node && !node->visible;
    });
}

void toggleIsolated(EditorState& state) {
    commitGesture(state);
    if (isIsolated(state)) {
        setShown(state, std::exchange(state.isolated, {}), true, "Show the others");
        return;
    }
    if (!std::ranges::any_of(state.selection,
                             [&](ObjectId id) { return findObjectAs<Node>(state.document, id); }))
        return;
    state.isolated = shownOthers(state);
    setShown(state, state.isolated, false, "Isolate: hide");
}

void toggleDynamic(EditorState& state) {
    commitGesture(state);
    Edit edit;
    const bool anyStatic = std::ranges::any_of(state.selection, [&](ObjectId id) {
        const Node* node = findObjectAs<Node>(state.document, id);
        return node && !node->dynamic;
    });
    for (ObjectId id : state.selection) {
        const Node* node = findObjectAs<Node>(state.document, id);
        if (!node || node->dynamic == anyStatic)
            continue;
        Node after = *node;
        after.dynamic = anyStatic;
        edit.changes.push_back({id, *node, std::move(after)});
    }
    edit.label = anyStatic ? "Make dynamic" : "Make static";
    applyEdit(state, std::move(edit));
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

glm::mat4 worldMatrix(const Document& document, ObjectId node) {
    return glm::mat4(Placements(document).of(node).toWorld);
}

} // namespace limn
