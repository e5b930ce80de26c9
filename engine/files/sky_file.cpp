// SPDX-License-Identifier: MIT
#include "engine/files/sky_file.h"

#include "engine/files/image_file.h"
#include "engine/scene/light/light.h"
#include "engine/scene/sky_sun.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

Result<void> readSkyImage(Sky& sky, const MemoryBudget& memory) {
    const bool withoutSun = sky.image.ends_with(kWithoutSun);
    const std::string file =
        sky.image.substr(0, sky.image.size() - (withoutSun ? kWithoutSun.size() : 0));
    Result<ImageF> image = readFloatImage(file, memory);
    if (!image)
        return tl::make_unexpected(image.error());
    if (image->rgb.empty())
        return fail(fmt::format("{}: no pixels", file));
    for (glm::vec3& p : image->rgb)
        for (int c = 0; c < 3; ++c)
            p[c] = p[c] >= 0 && std::isfinite(p[c]) ? std::min(p[c], kMaxLight) : 0;
    sky.panorama = makeSkyImage(std::move(*image));
    if (withoutSun) {
        Sky whole{.kind = SkyKind::Image, .image = file, .panorama = sky.panorama};
        if (extractSun(whole))
            sky.panorama = whole.panorama;
    }
    return {};
}

} // namespace limn
