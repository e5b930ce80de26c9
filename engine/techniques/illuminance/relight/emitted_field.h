// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <memory>

namespace limn {

/// The part of a relit bake's field that arrives from the sky and emissive surfaces of `scene`
/// without a bounce, through the same links, as for Lighting::emittedField(). Its lightmap and grid
/// have the sizes of Relighter::field() and three bands.
IndirectField emittedField(const std::shared_ptr<const Bake>& bake, const Scene& scene);

} // namespace limn
