// SPDX-License-Identifier: MIT
// A technique's own pass, here a trivial one: light kept on objects.
#include "tests/render/viewport_fixture.h"

#include "engine/gpu/uploader.h"
#include "engine/render/light_pass.h"
#include "shaders/tests/instance_light.frag.h"

namespace limn::light_pass_test {
namespace {

constexpr std::array kTypes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

class InstanceLight : public LightPass {
public:
    InstanceLight(gpu::Device& device, Viewport& viewport, std::vector<glm::vec4> light)
        : m_set(device, viewport.lightPipelines().of(
                            {kInstanceLightFrag, kTypes, {3}, "light of instances"})) {
        gpu::Uploader uploader(device);
        m_light = uploader.buffer(std::as_bytes(std::span(light)),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "light of instances");
        uploader.flush();
        m_set.bind(0, m_light);
    }

    void record(const LightPassFrame& frame) override { m_set.draw(frame); }
    std::uint64_t bytes() const override { return m_light.size; }

private:
    gpu::Buffer m_light;
    LightPassSet m_set;
};

constexpr glm::vec3 kPlaneLight{1, 2, 3}, kPaneLight{5, 7, 0.5f};

/// A plane, and 1 m above it a pane over the right half of the picture, whose back is black.
simple::SceneBuilder planeAndPane(bool turned = false) {
    simple::SceneBuilder b = plane();
    const glm::vec3 x(4, 0, 0), z(0, 0, -10), o(0, 1, 5);
    b.add(turned ? simple::quad(o, z, x) : simple::quad(o, x, z));
    return b;
}

class LightPassTest : public ViewportTest {
protected:
    std::shared_ptr<LightPass> pass() {
        return std::make_shared<InstanceLight>(
            *device, *viewport, std::vector{glm::vec4(kPlaneLight, 0), glm::vec4(kPaneLight, 0)});
    }
};

// The constant of the pass is 3, the albedo (0.2, 0.4, 0.8).
TEST_F(LightPassTest, LightsEachInstanceInEachViewOfBouncedLight) {
    const glm::vec3 albedo(0.2f, 0.4f, 0.8f);
    viewport->setIndirect(pass());
    for (const bool diffuse : {true, false}) {
        options.diffuse = diffuse;
        const float share = diffuse ? 3 : 0;
        const Scene scene = planeAndPane().build();
        const ImageF irradiance = draw(scene, View::Irradiance);
        const ImageF indirect = draw(scene, View::Indirect), lit = draw(scene, View::Lit);
        for (const auto& [x, light] : {std::pair{4U, kPlaneLight}, std::pair{27U, kPaneLight}}) {
            EXPECT_EQ(pixel(irradiance, x, 9), light * share);
            expectNear(pixel(indirect, x, 9), albedo * light * (share / kPi), 2e-3f);
            expectNear(pixel(lit, x, 9), albedo * light * (share / kPi) + light * 0.1f, 2e-3f);
        }
        EXPECT_EQ(pixel(draw(scene, View::Direct), 4, 9), glm::vec3(0));
    }
}

TEST_F(LightPassTest, LeavesBacksAndTheBackgroundBlack) {
    viewport->setIndirect(pass());
    options.camera.fovY = 2.4f; // beyond the plane's edge
    const ImageF image = draw(planeAndPane(true).build(), View::Irradiance);
    EXPECT_EQ(pixel(image, 0, 0), glm::vec3(0)) << "background";
    EXPECT_EQ(pixel(image, 17, 15), glm::vec3(0)) << "back";
    EXPECT_EQ(pixel(image, 14, 15), kPlaneLight * 3.f);
}

/// A part of which only the name is read.
struct NamedPart : FieldPart {
    const char* name() const override { return "named part"; }
    void irradianceTaps(const FieldPoint&, FieldTaps&) const override {}
    void radianceTaps(const FieldPoint&, glm::vec3, FieldTaps&) const override {}
    void lobeTaps(const FieldPoint&, glm::vec3, int, const std::array<float, kMaxBands>&,
                  FieldTaps&) const override {}
    glm::vec3 sum(std::span<const FieldTap>) const override { return glm::vec3(0); }
    bool equals(const FieldPart&) const override { return true; }
};

// The grid's light of radiance 1 is irradiance pi, to which the pass adds. Other light replaces
// both.
TEST_F(LightPassTest, AddsToTheRestOfItsField) {
    IndirectField field;
    field.gridSize = glm::uvec3(1);
    field.gridBounds = {glm::vec3(-10), glm::vec3(10)};
    field.grid.assign(9, glm::vec4(0));
    field.grid[0] = glm::vec4(glm::vec3(2 * std::sqrt(kPi)), 0);
    field.parts.push_back(std::make_shared<const NamedPart>());
    viewport->setIndirect(field, pass());
    const Scene scene = planeAndPane().build();
    expectNear(pixel(draw(scene, View::Irradiance), 4, 9), kPlaneLight * 3.f + kPi, kHalf * 2);
    viewport->setIndirect(field);
    expectNear(pixel(draw(scene, View::Irradiance), 4, 9), glm::vec3(kPi), kHalf * 2);
    viewport->setIndirect(pass());
    EXPECT_EQ(pixel(draw(scene, View::Irradiance), 4, 9), kPlaneLight * 3.f);
    EXPECT_GT(pass()->bytes(), 0U);
}

TEST_F(LightPassTest, SharesPipelinesOfEqualShaders) {
    const auto of = [&](std::uint32_t constant) {
        return viewport->lightPipelines().of({kInstanceLightFrag, kTypes, {constant}, "light"});
    };
    const auto three = of(3);
    EXPECT_EQ(of(3), three);
    EXPECT_NE(of(4), three);
    EXPECT_EQ(of(3), three);
}

} // namespace
} // namespace limn::light_pass_test
