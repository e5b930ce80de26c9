// SPDX-License-Identifier: MIT
#include "engine/scene/export_settings.h"

#include "engine/scene/export_settings_fields.h"
#include "engine/scene/setting_text.h"

#include <fmt/format.h>

namespace limn {

std::string settingsDefect(const ExportSettings& settings) {
    std::string defect;
    visitExportSettings(settings,
                        [&](const Setting& setting, const auto& value, const auto&... limits) {
                            const std::string wrong = valueDefect(value, limits...);
                            if (defect.empty() && !wrong.empty())
                                defect = fmt::format("{} {}", setting.flag, wrong);
                        });
    if (defect.empty() && settings.detail % 2 == 0)
        defect = fmt::format("--detail: {} is not odd", settings.detail);
    return defect;
}

bool writesKtx2(const ExportSettings& settings) {
    return settings.encoding != TextureEncoding::Exr || settings.format == "grid" ||
           settings.format == "three";
}

std::string missingFor(const ExportSettings& settings, std::string_view key, bool hasGrid) {
    const bool onlyExr = settings.format == "three" && !hasGrid && settings.bands < 2 &&
                         settings.encoding == TextureEncoding::Exr;
    if (key == "compress" && (onlyExr || !writesKtx2(settings)))
        return "--encoding ktx2-half or ktx2-rgb9e5, since EXR is not compressed with Zstandard";
    if ((key == "texels" || key == "texelsPerMetre" || key == "keepTriangles" || key == "error") &&
        settings.quality != LightmapQuality::Final)
        return "--quality final";
    if (key == "texels" && settings.texelsPerMetre > 0)
        return "--lightmap-texels-per-metre 0";
    if (key == "layers" && settings.bands < 2)
        return "--lightmap-bands 2 or 3";
    return {};
}

std::string setExportSetting(ExportSettings& settings, std::string_view key,
                             const std::string& text) {
    return setByKey([&](const auto& visit) { visitExportSettings(settings, visit); }, key, text);
}

} // namespace limn
