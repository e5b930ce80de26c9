// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

namespace limn {

/// Gives `other` what an edit changed from `before` to `after`: each field that differs gets its
/// new value, and positions move by as much as that of the edited object. Names stay. Objects of
/// another type, and those of which a document has one, are left alone.
void copyChanges(const Object& before, const Object& after, Object& other);

} // namespace limn
