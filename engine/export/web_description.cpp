// SPDX-License-Identifier: MIT
#include "engine/export/web_description.h"

#include "engine/core/base64.h"
#include "engine/export/lightmap_image.h"
#include "engine/export/packed_transport.h"
#include "engine/export/vector_json.h"
#include "engine/math/packing.h"
#include "engine/shading/direct_light.h"
#include "engine/techniques/illuminance/transport/transport_sections.h"

#include <cmath>
#include <cstring>

#include <glm/vec3.hpp>

namespace limn {

namespace {

template <class T>
std::vector<T> elements(std::string_view transport, std::string_view tag) {
    const std::string_view bytes = transportSection(transport, tag);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

/// Mean direct irradiance of the surfaces [W m^-2], of all channels, at every 16th surfel.
double meanDirect(const ExportScene& scene, std::string_view transport) {
    constexpr std::size_t kStep = 16;
    const auto position = elements<glm::vec3>(transport, "SPOS");
    const auto normal = elements<glm::vec3>(transport, "SNRM");
    const auto area = elements<float>(transport, "SARE");
    double sum = 0, whole = 0;
    std::uint64_t rays = 0;
    for (std::size_t k = 0; k < position.size(); k += kStep) {
        const SurfacePoint p{position[k], normal[k], normal[k], {}, {}};
        sum += double(area[k]) * double(channelSum(directIrradiance(scene.trace, p, rays))) / 3;
        whole += double(area[k]);
    }
    return whole > 0 ? sum / whole : 0;
}

double meanOf(const LightmapImage& image) {
    double sum = 0;
    for (const glm::vec3& rgb : image.rgb)
        sum += double(channelSum(rgb)) / 3;
    return image.rgb.empty() ? 0 : sum / double(image.rgb.size());
}

/// Mean radiance of the sky's cells [nits].
glm::vec3 meanSky(std::string_view transport) {
    const auto cells = elements<glm::vec3>(transport, "SKYL");
    glm::dvec3 sum(0);
    for (const glm::vec3& cell : cells)
        sum += glm::dvec3(cell);
    return cells.empty() ? glm::vec3(0) : glm::vec3(sum / double(cells.size()));
}

std::string packed(const LightmapImage& image, float scale) {
    std::vector<std::uint32_t> words;
    words.reserve(image.rgb.size());
    for (const glm::vec3& rgb : image.rgb)
        words.push_back(packRgb9e5(rgb * scale));
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t)};
}

} // namespace

Result<FirstPicture> firstPicture(const ExportScene& scene, const ExportSettings& settings,
                                  std::string_view transport, const Progress& progress) {
    FirstPicture first;
    LightmapImage image;
    if (scene.layout.width > 0) {
        ExportSettings irradiance = settings;
        irradiance.quantity = LightmapQuantity::Irradiance;
        irradiance.bands = 1;
        irradiance.direct = false;
        Result<LightmapImage> evaluated = lightmapImage(scene, irradiance, progress);
        if (!evaluated)
            return tl::make_unexpected(evaluated.error());
        image = std::move(*evaluated);
    }
    const double mean = meanDirect(scene, transport) + meanOf(image);
    // Half floats and shared exponents hold 2^-14 to 2^16 times the mean.
    const double scale = mean > 0 ? std::exp2(-std::round(std::log2(mean))) : 1;
    first.description = {{"lights", base64(transportSection(transport, "LGHT"))},
                         {"meta", std::string(transportSection(transport, "META"))},
                         {"sky", vectorJson(meanSky(transport))},
                         {"meanIrradiance", mean}};
    if (image.width == 0)
        return first;
    first.description["lightmap"] = {{"file", "scene-lightmap.bin"},
                                     {"width", image.width},
                                     {"height", image.height},
                                     {"scale", scale}};
    Result<std::string> bytes = gzip(packed(image, float(scale)));
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    first.files.push_back({"scene-lightmap.bin", std::move(*bytes)});
    return first;
}

} // namespace limn
