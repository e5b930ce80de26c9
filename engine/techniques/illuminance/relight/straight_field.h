// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <memory>

namespace limn {

/// The part of a relit bake's field that arrives straight from the sky and emissive surfaces of
/// `scene`, through the same links, as for Lighting::straightField(). Its lightmap and grid have
/// the sizes of Relighter::field() and three bands.
IndirectField straightField(const std::shared_ptr<const Bake>& bake, const Scene& scene);

} // namespace limn
