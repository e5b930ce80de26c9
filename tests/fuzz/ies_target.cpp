// SPDX-License-Identifier: MIT
// Photometric files of IES LM-63.
#include "tests/fuzz/target.h"

#include "engine/scene/light/ies_file.h"
#include "engine/scene/light/light.h"
#include "engine/scene/light/photometry.h"

#include <cmath>

#include <glm/geometric.hpp>

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Result<PhotometricFile> file = parseIes(textOf(data, size));
    if (!file)
        return 0;
    require(profileDefect(file->profile).empty(), "what is read is a profile");
    require(file->ratedFlux >= 0, "lamps have some flux");
    Light light;
    light.strength = file->profile.peak;
    light.profile = {std::make_shared<const LightProfile>(file->profile)};
    const float flux = lumen(light);
    require(flux >= 0 && std::isfinite(flux), "a profile has a flux");
    for (int k = 0; k < 64; ++k) { // directions around a spiral from pole to pole
        const float y = 1 - float(k) / 31.5f, r = std::sqrt(std::max(1 - y * y, 0.f));
        const LightSample s =
            sampleLight(light, {r * std::cos(2.4f * float(k)), y, r * std::sin(2.4f * float(k))});
        require(s.irradiance.x >= 0 && s.irradiance.x <= 1.001f * light.strength,
                "no direction is brighter than the brightest");
    }
    return 0;
}
