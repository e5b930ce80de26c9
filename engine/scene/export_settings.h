// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace limn {

/// File format of exported textures.
enum class TextureEncoding : std::uint8_t {
    Exr,        ///< 32-bit float, row 0 at the top
    Ktx2Half,   ///< RGBA, binary16
    Ktx2Rgb9e5, ///< 32 bits per texel: 9 bits per channel with a shared exponent
    Ktx2Bc6h,   ///< 8 bits per texel: blocks of 4 x 4 texels; signed for harmonics
};

/// Quantity that the texels of a lightmap hold. E is irradiance [W m^-2], rho the albedo.
enum class LightmapQuantity : std::uint8_t {
    Irradiance,       ///< E
    IrradianceOverPi, ///< E / pi
    Radiance,         ///< rho E / pi [W m^-2 sr^-1]
};

/// Where the light of a lightmap's texels comes from.
enum class LightmapQuality : std::uint8_t {
    Final, ///< rays gather it at points under each texel
    Draft  ///< the caches hold it
};

/// How the coefficients of a lightmap of spherical harmonics are stacked in a texture.
enum class ShLayers : std::uint8_t { Array, Volume };

/// How a document's light is exported. Each format reads some of the settings:
/// ExportFormat::settings.
struct ExportSettings {
    std::string format = "gltf"; ///< ExportFormat::name
    LightmapQuality quality = LightmapQuality::Final;
    /// Number of texels of a final lightmap, about; 0: as many as `detail` gives a draft.
    std::uint32_t texels = 0;
    /// > 0: takes the place of `texels`. So many texels along each metre of surface, on the mean
    /// over all lit sides [1/m]; charts in which light varies more have more.
    float texelsPerMetre = 0;
    /// A final lightmap has whole charts, so that exported meshes have no triangles of their own.
    bool keepTriangles = false;
    float error = 0; ///< maximum nRMSE of the lightmap; 0: none is asked for
    /// Paths for each pixel of a picture in which the lightmap's error is measured, a quarter of
    /// them from each of four points, in each of two references; 0: it is not measured, unless
    /// `error` asks for it.
    std::uint32_t paths = 8;
    TextureEncoding encoding = TextureEncoding::Exr;
    bool compress = false;
    bool quantize = false;
    bool meshopt = false;
    LightmapQuantity quantity = LightmapQuantity::Irradiance;
    bool direct = false;
    std::uint32_t bands = 1;
    ShLayers layers = ShLayers::Array;
    std::uint32_t detail = 3;
    std::uint32_t maxSize = 4096;

    bool operator==(const ExportSettings&) const = default;
};

/// What is wrong with the settings: a number outside its range, or an even number of texels per
/// cache. Empty: nothing.
std::string settingsDefect(const ExportSettings& settings);

/// Whether the export has KTX2 files. The grid is one whatever the encoding of the lightmap.
bool writesKtx2(const ExportSettings& settings);

/// Parses a value of the setting of that key, as setting_text.h does, and sets the setting that it
/// replaces to 0. Returns what is wrong with the text; empty: nothing.
std::string setExportSetting(ExportSettings& settings, std::string_view key,
                             const std::string& text);

} // namespace limn
