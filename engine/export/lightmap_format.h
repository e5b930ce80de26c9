// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

/// The lightmap alone, as EXR or KTX2.
extern const ExportFormat kLightmapFormat;

} // namespace limn
