// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <vector>

namespace limn {

/// The object with this id, or null if there is none or it is not a T.
template <class T>
const T* findObjectAs(const Document& document, ObjectId id) {
    const auto it = document.objects.find(id);
    return it == document.objects.end() ? nullptr : std::get_if<T>(&it->second);
}

/// The objects of type T in the order of the document; for lights, that of Scene::lights.
template <class T>
std::vector<ObjectId> idsOf(const Document& document) {
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : document.objects)
        if (std::holds_alternative<T>(object))
            ids.push_back(id);
    return ids;
}

} // namespace limn
