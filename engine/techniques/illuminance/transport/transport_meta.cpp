// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/transport_meta.h"

#include "engine/core/hash.h"
#include "engine/json/json.h"
#include "engine/scene/bake_settings_fields.h"

#include <algorithm>
#include <type_traits>

namespace limn {

namespace {

Json settingsOf(const BakeSettings& settings) {
    Json json;
    visitBakeSettings(settings, [&](const Setting& s, const auto& value, const auto&... limits) {
        Json& out = json[s.key];
        if constexpr (requires { value.x; })
            out = {value.x, value.y, value.z};
        else if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
            ((out = limits.names[std::size_t(value)]), ...);
        else
            out = value;
    });
    return json;
}

Json conventions() {
    return {
        {"axes", "right-handed, +Y up"},
        {"length", "m"},
        {"color", "linear Rec. 709"},
        {"light", "candela, lux and nits as W/sr, W/m^2 and W/(sr m^2), without a factor of 683"},
        {"sphericalHarmonics", "real, orthonormal, no Condon-Shortley sign, coefficient (l, m) "
                               "at l(l+1)+m, of incident radiance"},
        {"irradiance", "E(n) = max(0, sum over l < 3 of A_l c_lm Y_lm(n)), A = pi, 2 pi/3, pi/4"},
        {"shading", "radiance to the eye = albedo E / pi + emission + direct light"},
        {"textureOrigin", "upper left"}};
}

Json receiptOf(const TransportInput& input) {
    const BakeCounts& c = input.bake.counts;
    return {{"sceneHash", hexHash(input.bake.sceneHash)},
            {"bakeHash", hexHash(input.bake.hash())},
            {"settings", settingsOf(input.bake.settings)},
            {"triangles", c.triangles},
            {"rays", c.rays},
            {"invalidCaches", c.invalidCaches}};
}

} // namespace

std::string transportMeta(const TransportInput& input, const OccluderTree& occluders,
                          std::uint32_t width, std::uint32_t height) {
    const Scene& scene = input.scene;
    Json lights = Json::array(), instances = Json::array();
    for (const Light& light : scene.lights)
        lights.push_back(light.name);
    std::size_t dynamic = 0;
    for (const Instance& instance : scene.instances) {
        instances.push_back(scene.meshOf(instance).name);
        dynamic += instance.dynamic;
    }
    const Json meta = {{"format", "limn transport"},
                       {"program", input.program},
                       {"conventions", conventions()},
                       {"lightmap",
                        {{"width", width},
                         {"height", height},
                         {"lookup", input.lightmap ? "bilinear" : "limn layout"}}},
                       {"lights", lights},
                       {"instances", instances},
                       {"dynamicInstances", dynamic},
                       {"occluders",
                        {{"triangles", occluders.triangles.size()},
                         {"cutouts", occluders.cutouts.triangles.size()}}},
                       {"origin", {scene.origin.x, scene.origin.y, scene.origin.z}},
                       {"receipt", receiptOf(input)}};
    // Names may hold bytes that are not UTF-8; they are replaced.
    return meta.dump(1);
}

} // namespace limn
