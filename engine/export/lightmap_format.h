// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

/// The lightmap alone, as EXR of irradiance.
extern const ExportFormat kLightmapFormat;

} // namespace limn
