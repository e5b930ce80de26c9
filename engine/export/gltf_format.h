// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

/// glTF with texture coordinates for the lightmap, and the lightmap beside it.
extern const ExportFormat kGltfFormat;

} // namespace limn
