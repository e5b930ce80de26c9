// SPDX-License-Identifier: MIT
#include "engine/files/sky_file.h"

#include "engine/files/image_file.h"
#include "engine/scene/light/light.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

Result<void> readSkyImage(Sky& sky, const MemoryBudget& memory) {
    Result<ImageF> image = readFloatImage(sky.image, memory);
    if (!image)
        return tl::make_unexpected(image.error());
    if (image->rgb.empty())
        return fail(fmt::format("{}: no pixels", sky.image));
    for (glm::vec3& p : image->rgb)
        for (int c = 0; c < 3; ++c)
            p[c] = p[c] >= 0 && std::isfinite(p[c]) ? std::min(p[c], kMaxLight) : 0;
    sky.panorama = makeSkyImage(std::move(*image));
    return {};
}

} // namespace limn
