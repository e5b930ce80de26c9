// SPDX-License-Identifier: MIT
#include "engine/render/viewport.h"
#include "tests/golden/cornell_golden.h"
#include "tests/gpu/test_device.h"

namespace limn::golden_test {
namespace {

/// Means of squares of `factor` pixels a side: the box filter of the path tracer.
ImageF shrink(const ImageF& image, std::uint32_t factor) {
    ImageF result{image.width / factor, image.height / factor, {}};
    for (std::uint32_t y = 0; y < result.height; ++y)
        for (std::uint32_t x = 0; x < result.width; ++x) {
            glm::vec3 sum(0);
            for (std::uint32_t k = 0; k < factor * factor; ++k)
                sum += image.rgb[(y * factor + k / factor) * image.width + x * factor + k % factor];
            result.rgb.push_back(sum / float(factor * factor));
        }
    return result;
}

class Golden : public DeviceTest {};

TEST_F(Golden, TheViewportsCornellBoxIsCloseToItsPathTracedPicture) {
    const golden::LitCornell lit = golden::litCornell();
    Viewport viewport(*device);
    viewport.setScene(lit.scene,
                      std::shared_ptr<const LightmapLayout>(lit.bake, &lit.bake->lightmap));
    viewport.setLighting(lit.scene);
    viewport.setIndirect(lit.relighter->field());
    ViewportOptions options;
    options.view = View::Irradiance;
    options.camera = lit.camera;
    options.width = options.height = 256;
    viewport.render(options);
    golden::expectCornellIrradiance(shrink(viewport.readLinear(), 4), "golden_viewport");
}

} // namespace
} // namespace limn::golden_test
