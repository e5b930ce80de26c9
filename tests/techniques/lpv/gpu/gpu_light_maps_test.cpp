// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/gpu_light_maps.h"

#include "engine/lightmap/atlas.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/lpv/gpu/gpu_propagation.h"
#include "engine/techniques/lpv/lpv_overlay.h"
#include "tests/render/viewport_fixture.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::gpu_light_maps_test {
namespace {

/// A texture of 4 x 4 texels, half of which are holes.
Image fence() {
    Image image;
    image.width = image.height = 4;
    for (std::uint32_t k = 0; k < 16; ++k)
        for (const int value : {200, 100, 50, (k + k / 4) % 2 == 0 ? 255 : 0})
            image.rgba.push_back(std::uint8_t(value));
    return image;
}

/// A block, its mirror image, a metal, a sheet that reflects on both sides, one that reflects on
/// its front only, and a fence with holes, in a room or, for a sun, in the open.
Scene clutter(bool open) {
    simple::SceneBuilder b;
    b.assets->images.push_back(fence());
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    Material metal = simple::lambert({0.9f, 0.8f, 0.2f}),
             sheet = simple::lambert({0.1f, 0.6f, 0.2f}), holes = simple::lambert({1, 1, 1});
    metal.metallic = 0.75f;
    sheet.doubleSided = true;
    holes.doubleSided = true;
    holes.alphaMode = AlphaMode::Mask;
    holes.baseColorTexture.image = 0;
    holes.baseColorTexture.nearest = true;
    for (const Material& material : {metal, sheet, holes})
        b.addMaterial(material);
    if (open)
        b.add(simple::quad({0, 0, 5}, {4, 0, 0}, {0, 0, -5}));
    else
        b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    const Mesh block = simple::box(glm::vec3(0), glm::vec3(0.6f, 0.9f, 0.5f), false, 1);
    b.add(block, glm::translate(glm::mat4(1), {0.7f, 0, 1.1f})).material = 1;
    b.add(block, glm::scale(glm::translate(glm::mat4(1), {3.3f, 0.2f, 2.9f}), {-1, 1.3f, 1}))
        .material = 1;
    b.add(simple::quad({1.1f, 0.8f, 3.9f}, {0.9f, 0.1f, 0}, {0, 0.7f, 0.2f}, 2)).material = 2;
    b.add(simple::quad({3, 0.6f, 1.2f}, {0, 0.1f, 0.9f}, {0.2f, 0.8f, 0}, 0));
    b.add(simple::quad({1.6f, 0.3f, 1.3f}, {0.9f, 0, 0.2f}, {0, 0.9f, 0}, 3)).material = 3;
    return b.build();
}

struct Case {
    const char* name;
    Light light;
};

std::vector<Case> cases() {
    Light light;
    light.position = {2.0137f, 1.7821f, 2.5219f};
    light.direction = glm::normalize(glm::vec3(-0.31f, -1, -0.23f));
    light.size = {0.71f, 0.43f};
    std::vector<Case> all;
    const auto add = [&](const char* name, LightKind kind) -> Light& {
        light.kind = kind;
        all.push_back({name, light});
        return all.back().light;
    };
    add("sun", LightKind::Directional);
    add("point", LightKind::Point);
    add("near", LightKind::Point).range = 2;
    add("spot", LightKind::Spot).outerAngle = 0.6f;
    Light& wide = add("wide", LightKind::Spot);
    wide.innerAngle = 0.9f;
    wide.outerAngle = 1.4f;
    add("rectangle", LightKind::Rectangle);
    return all;
}

class GpuLightMapsTest : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        if (!device)
            return;
        auto made = GpuPropagation::create(*device);
        ASSERT_TRUE(made) << made.error().message;
        gpu = std::move(*made);
        maps = std::make_unique<GpuLightMaps>(*device, *viewport);
    }
    void TearDown() override {
        maps.reset();
        gpu.reset();
        ViewportTest::TearDown();
    }
    /// What the light sends into the lattice, and what one round in the open makes of it.
    std::vector<Lobe> lit(const Scene& scene, const Light& light, const Lattice& lattice,
                          std::uint32_t size) {
        viewport->setScene(scene, std::make_shared<LightmapLayout>(layoutWithoutLightmap(scene)));
        MappedLight mapped = maps->cast(unitLight(light), scene.bounds, size, lattice);
        count = mapped.count;
        gpu->setLattice(lattice, FaceBlockers(lattice.size));
        const GpuLobes lobes = gpu->lobesOf(std::move(mapped.cells), mapped.count);
        const GpuSource source{&lobes, glm::vec3(1)};
        GpuPropagationCost cost;
        EXPECT_TRUE(gpu->light(std::span(&source, 1), 1, {1, -1}, {}, cost));
        return gpu->readSum();
    }

    std::unique_ptr<GpuPropagation> gpu;
    std::unique_ptr<GpuLightMaps> maps;
    std::uint32_t count = 0; ///< cells that the last map was sent into
};

std::vector<Lobe> litOnCpu(const Scene& scene, const Light& light, const Lattice& lattice,
                           std::uint32_t size) {
    CellLight cells(lattice.size);
    const InjectedLight injected =
        injectLight(TraceScene(scene), scene, unitLight(light), size, lattice);
    addInjected(injected.parts, glm::vec3(1), lattice, {}, cells);
    const CellLight sum = propagate(cells, nullptr, 1);
    std::vector<Lobe> lobes;
    for (std::uint32_t cell = 0; cell < lattice.cells(); ++cell)
        lobes.push_back(sum.lobe(glm::ivec3(lattice.place(cell))));
    return lobes;
}

TEST_F(GpuLightMapsTest, SendIntoCellsWhatRaysDo) {
    for (const auto& [name, light] : cases()) {
        const Scene scene = clutter(light.kind == LightKind::Directional);
        const Lattice lattice = latticeOver(scene.bounds, 15);
        const std::vector<Lobe> mine = lit(scene, light, lattice, 64),
                                expected = litOnCpu(scene, light, lattice, 64);
        double total = 0, sum = 0, apart = 0;
        for (std::size_t cell = 0; cell < mine.size(); ++cell)
            for (int c = 0; c < 3; ++c) {
                const double a = double(fluxOf(mine[cell])[c]),
                             b = double(fluxOf(expected[cell])[c]);
                sum += a;
                total += b;
                apart += std::abs(a - b);
            }
        std::printf("%-9s %4u cells, flux differs by %.1e in all, %.1e in cells\n", name, count,
                    std::abs(sum / total - 1), apart / total);
        ASSERT_GT(total, 0) << name;
        // Single texels on edges of triangles, holes and cells fall to one side or the other.
        EXPECT_NEAR(sum / total, 1, 2e-3) << name;
        EXPECT_LT(apart / total, 1e-2) << name;
    }
}

TEST_F(GpuLightMapsTest, AreEmptyWhereALightReachesNothing) {
    const Scene scene = clutter(true);
    const Lattice lattice = latticeOver(scene.bounds, 8);
    Light away = cases()[3].light;
    away.position = {2, 20, 2};
    away.direction = {0, 1, 0};
    lit(scene, away, lattice, 16);
    EXPECT_EQ(count, 0U);
    const Scene empty = simple::SceneBuilder().build();
    lit(empty, cases()[0].light, latticeOver(empty.bounds, 4), 16);
    EXPECT_EQ(count, 0U);
}

} // namespace
} // namespace limn::gpu_light_maps_test
