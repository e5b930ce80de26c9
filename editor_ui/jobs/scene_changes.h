// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <string>

namespace limn {

/// True if a bake of `a` serves `b` as well, as far as can be told without hashing the meshes.
bool sameBakeInputs(const Scene& a, const Scene& b);

/// True if rays meet the same surfaces. sameStaticGeometry() ignores those of dynamic objects.
bool sameGeometry(const Scene& a, const Scene& b);
bool sameStaticGeometry(const Scene& a, const Scene& b);

/// True if the scenes list instances of the same meshes and nodes in the same order.
bool sameInstanceList(const Scene& a, const Scene& b);

/// True if the lights, the materials and the sky are equal.
bool sameLight(const Scene& a, const Scene& b);

/// In words and by name, what sameBakeInputs() finds different in `now`, which was flattened from
/// `document`: "Door moved, Rays per cache changed, and 12 more". Names at most three; empty if
/// nothing differs.
std::string bakeInputChanges(const Scene& baked, const Scene& now, const Document& document);

} // namespace limn
