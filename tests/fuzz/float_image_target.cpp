// SPDX-License-Identifier: MIT
// EXR and HDR, as a sky.
#include "tests/fuzz/target.h"

#include "engine/files/sky_file.h"

#include <cmath>

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Sky sky;
    sky.kind = SkyKind::Image;
    sky.image = scratchFile("sky", textOf(data, size));
    sky.rotation = 1;
    if (!readSkyImage(sky, kFuzzMemory))
        return 0;
    require(sky.showsImage(), "a sky that was read is shown");
    for (const glm::vec3& cell : skyCellRadiance(sky))
        for (int c = 0; c < 3; ++c)
            require(cell[c] >= 0 && std::isfinite(cell[c]), "a sky's light is a number");
    for (const glm::vec3 d : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0, -0.8f)})
        require(std::isfinite(skyRadiance(sky, d).x), "a sky's radiance is a number");
    return 0;
}
