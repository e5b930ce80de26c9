// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/export/sh_conventions.h"
#include "engine/field/indirect_field.h"
#include "engine/json/json.h"

#include <cstdint>
#include <string>

namespace limn {

/// Fails, and says how to bake one, if the field has no grid.
Result<void> checkGrid(const IndirectField& field);

/// The first three bands of grid cell `cell`, counted as in IndirectField::grid; bands that the
/// field lacks are 0.
Sh3 gridCell(const IndirectField& field, std::size_t cell);

/// Mean over the grid's cells, in double precision. Precondition: the field has a grid.
Sh3 meanProbe(const IndirectField& field);

/// The grid as a 3D KTX2 texture of x by y by 7 (z + 2) texels, the atlas of three.js'
/// LightProbeGridWebGL. Sub-volume t holds group t of threeGridCell(); slices before and behind
/// each repeat its first and last one, so that trilinear lookups stay inside. In half floats, or in
/// floats where the brightest number is above 65504 or below 2^-9. Fails without a grid.
Result<std::string> gridKtx2(const IndirectField& field, bool zstd);

/// About the size of that file, if it is not compressed.
std::uint64_t gridKtx2Bytes(const IndirectField& field);

/// Describes the grid for loaders: place, size, units, conventions, equation and mean probe.
/// `texture` is the name of the file from gridKtx2(). Precondition: the field has a grid.
Json gridJson(const ExportScene& scene, const std::string& texture);

/// Nine colours as lists of three numbers.
Json shJson(const Sh3& c);

} // namespace limn
