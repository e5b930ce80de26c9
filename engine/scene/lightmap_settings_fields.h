// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/export_settings.h"
#include "engine/scene/export_value_names.h"
#include "engine/scene/setting.h"

#include <string>
#include <string_view>

namespace limn {

/// What the setting of that key needs beside it and the other settings do not give: without that,
/// it has no effect. Empty: nothing. `hasGrid`: the light has a grid, as far as is known.
std::string missingFor(const ExportSettings& settings, std::string_view key, bool hasGrid = true);

/// As visitExportSettings(), for those of how many texels a lightmap has and how true they are.
template <class S, class Visit>
void visitLightmapSettings(S& s, const Visit& visit) {
    visit(Setting{.key = "quality",
                  .flag = "--quality",
                  .label = "Lightmap's quality",
                  .help = "final: rays gather each texel's light; draft: the bake's caches hold it",
                  .tooltip = "Final: rays gather light under each texel, for seconds to minutes. "
                             "Draft: texels repeat what the bake's caches hold",
                  .invalidates = Invalidates::Light},
          s.quality, SettingChoices{kLightmapQualityNames, kLightmapQualityLabels});
    visit(Setting{.key = "texels",
                  .flag = "--texels",
                  .label = "Lightmap's texels",
                  .help = "Texels of a final lightmap; 0: as many as a draft has",
                  .tooltip = "About the number of texels of a final lightmap. 0: as many as a "
                             "draft of this bake has",
                  .invalidates = Invalidates::Light,
                  .replaces = "texelsPerMetre",
                  .applies = missingFor(s, "texels").empty()},
          s.texels, SettingRange{0, 1 << 24});
    visit(Setting{.key = "texelsPerMetre",
                  .flag = "--lightmap-texels-per-metre",
                  .label = "Lightmap's density (texels/m)",
                  .help = "Mean density of a final lightmap, instead of --texels; 0: none",
                  .tooltip = "Mean number of texels along a metre of surface [1/m]. 0: not set",
                  .invalidates = Invalidates::Light,
                  .applies = missingFor(s, "texelsPerMetre").empty()},
          s.texelsPerMetre, SettingRange{0, 1e6});
    visit(Setting{.key = "keepTriangles",
                  .flag = "--keep-triangles",
                  .label = "Triangles as they are",
                  .help = "Cut no triangles for a final lightmap",
                  .tooltip = "Exported meshes keep their triangles. Otherwise large surfaces are "
                             "cut into pieces, so that a final lightmap has more texels where "
                             "light varies",
                  .invalidates = Invalidates::Light,
                  .applies = missingFor(s, "keepTriangles").empty()},
          s.keepTriangles);
    visit(Setting{.key = "error",
                  .flag = "--error",
                  .label = "Largest error",
                  .help = "Maximum nRMSE of what the camera sees: texels double until it holds",
                  .tooltip = "Maximum error of the lightmap where the first camera looks (nRMSE, "
                             ".1 is 10 %). Texels double until it holds. 0: not set",
                  .invalidates = Invalidates::Light,
                  .applies = missingFor(s, "error").empty()},
          s.error, SettingRange{0, 10});
    visit(Setting{.key = "paths",
                  .flag = "--paths",
                  .label = "Paths to measure by",
                  .help = "Paths for each of 160 x 90 pixels to measure the lightmap's error by; "
                          "0: it is not measured",
                  .tooltip = "Paths for each of 160 x 90 pixels of the first camera's picture, to "
                             "measure the lightmap's error. 0: it is not measured",
                  .invalidates = Invalidates::Light},
          s.paths, SettingRange{0, 65536});
}

} // namespace limn
