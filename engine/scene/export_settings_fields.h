// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/export_settings.h"
#include "engine/scene/export_value_names.h"
#include "engine/scene/lightmap_settings_fields.h"
#include "engine/scene/setting.h"

namespace limn {

/// Calls visit(setting, value) for a switch and visit(setting, value, range or choices) for any
/// other setting; the format is not one. `s` is an ExportSettings, const or not.
template <class S, class Visit>
void visitExportSettings(S& s, const Visit& visit) {
    visitLightmapSettings(s, visit);
    visit(Setting{.key = "encoding",
                  .flag = "--encoding",
                  .label = "Texture files",
                  .help = "File format of textures",
                  .tooltip = "File format of the light's textures. KTX2 loads fastest; EXR is "
                             "read by most tools. BC6H takes a byte a texel, an eighth of half "
                             "floats, on GPUs that know it: those of computers, not of phones",
                  .invalidates = Invalidates::Light},
          s.encoding, SettingChoices{kTextureEncodingNames, kTextureEncodingLabels});
    visit(Setting{.key = "compress",
                  .flag = "--compress",
                  .label = "Zstandard",
                  .help = "Compress KTX2 files with Zstandard",
                  .tooltip = "Compresses KTX2 files with Zstandard. The consumer must support it",
                  .invalidates = Invalidates::Light,
                  .applies = missingFor(s, "compress").empty()},
          s.compress);
    visit(Setting{.key = "quantize",
                  .flag = "--quantize",
                  .label = "Quantised geometry",
                  .help = "Store vertices as integers, by KHR_mesh_quantization",
                  .tooltip = "Stores vertices as integers of 8 and 16 bits, about half the bytes. "
                             "The consumer must support KHR_mesh_quantization",
                  .invalidates = Invalidates::Light},
          s.quantize);
    visit(Setting{.key = "meshopt",
                  .flag = "--meshopt",
                  .label = "Compressed geometry",
                  .help = "Compress geometry, by EXT_meshopt_compression",
                  .tooltip = "Compresses geometry without loss. The consumer must support "
                             "EXT_meshopt_compression",
                  .invalidates = Invalidates::Light},
          s.meshopt);
    visit(Setting{.key = "quantity",
                  .flag = "--quantity",
                  .label = "Texels hold",
                  .help = "Quantity of the lightmap's texels",
                  .tooltip = "Irradiance E [W/m\u00b2], E / \u03c0, or the radiance \u03c1 E / "
                             "\u03c0 that a surface of albedo \u03c1 sends [W/m\u00b2/sr]",
                  .invalidates = Invalidates::Light},
          s.quantity, SettingChoices{kLightmapQuantityNames, kLightmapQuantityLabels});
    visit(Setting{.key = "direct",
                  .flag = "--direct",
                  .label = "Direct light",
                  .help = "Add the lights' direct light to the lightmap",
                  .tooltip = "Adds the direct light of the scene's lights, with shadows. Leave it "
                             "off where the engine computes direct light itself",
                  .invalidates = Invalidates::Light},
          s.direct);
    visit(Setting{.key = "bands",
                  .flag = "--lightmap-bands",
                  .label = "Lightmap's SH bands",
                  .help = "Bands of spherical harmonics per texel; 1: irradiance only",
                  .tooltip = "1: texels hold one colour. 2 or 3: texels hold spherical harmonics "
                             "of incident radiance, so that normal maps are lit by them",
                  .invalidates = Invalidates::Light},
          s.bands, SettingRange{1, 3});
    visit(Setting{.key = "layers",
                  .flag = "--layers",
                  .label = "Harmonics as",
                  .help = "How a texture stacks the harmonics' coefficients",
                  .tooltip = "How a texture stacks the harmonics' coefficients: as layers of an "
                             "array or as slices of a 3D texture",
                  .invalidates = Invalidates::Light,
                  .applies = missingFor(s, "layers").empty()},
          s.layers, SettingChoices{kShLayersNames, kShLayersLabels});
    visit(Setting{.key = "detail",
                  .flag = "--detail",
                  .label = "Texels per cache",
                  .help = "Texels per cache along each side; odd",
                  .tooltip = "Texels per light cache along each side, an odd number. More texels "
                             "keep light from leaking where walls meet, and take more memory",
                  .invalidates = Invalidates::Light},
          s.detail, SettingRange{1, 9});
    visit(Setting{.key = "maxSize",
                  .flag = "--max-size",
                  .label = "Largest texture (texels)",
                  .help = "Maximum width and height of a texture",
                  .tooltip = "Maximum width and height of a texture [texels]. A larger lightmap is "
                             "divided into several textures. Formats with a single texture take "
                             "fewer texels per cache instead",
                  .invalidates = Invalidates::Light},
          s.maxSize, SettingRange{64, 16384});
}

} // namespace limn
