// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

namespace limn {

/// The object with this id, or null if there is none or it is not a T.
template <class T>
const T* findObjectAs(const Document& document, ObjectId id) {
    const auto it = document.objects.find(id);
    return it == document.objects.end() ? nullptr : std::get_if<T>(&it->second);
}

} // namespace limn
