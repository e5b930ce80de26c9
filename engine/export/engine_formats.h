// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

// Light as particular programs want it; each is defined in the file of its name. docs/export.md
// says what each writes.

extern const ExportFormat kBabylonFormat;    ///< babylon_format.cpp
extern const ExportFormat kBlenderFormat;    ///< blender_format.cpp
extern const ExportFormat kFilamentFormat;   ///< filament_format.cpp
extern const ExportFormat kGodotFormat;      ///< godot_format.cpp
extern const ExportFormat kGridFormat;       ///< grid_format.cpp
extern const ExportFormat kIblFormat;        ///< ibl_format.cpp
extern const ExportFormat kJsonFormat;       ///< json_format.cpp
extern const ExportFormat kPlaycanvasFormat; ///< playcanvas_format.cpp
extern const ExportFormat kThreeFormat;      ///< three_format.cpp

} // namespace limn
