// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

namespace limn {

/// The relightable transport file of docs/transport-format.md.
extern const ExportFormat kLimnrtFormat;

/// The bytes of that file, with a lightmap for plain bilinear lookups, as lightmapImage() has it.
/// Fails without a bake. `roundedLinks`: see TransportInput.
Result<std::string> transportBytes(const ExportScene& scene, const ExportSettings& settings,
                                   const Progress& progress, bool roundedLinks = false);

/// Its size, about.
ExportForecast forecastTransport(const ExportScene& scene, const ExportSettings& settings);

} // namespace limn
