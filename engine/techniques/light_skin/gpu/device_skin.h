// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/viewport.h"
#include "engine/techniques/light_skin/draw_renewal.h"
#include "engine/techniques/light_skin/gpu/gpu_skin_lights.h"
#include "engine/techniques/light_skin/gpu/skin_pass.h"
#include "engine/techniques/light_skin/skin_objects.h"

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace limn {

/// LightSkin on the device of a viewport, which draws the lights' maps and the view, measures
/// importance, chooses virtual lights, gathers them and draws what the proxies give. The CPU makes
/// the caches, and places and shades the proxies from what caches received.
class DeviceSkin : public Lighting {
public:
    /// Fails as GpuSkinLights::create(). The viewport outlives the object.
    static Result<std::unique_ptr<DeviceSkin>> create(gpu::Device& device, Viewport& viewport);

    /// Precondition: the viewport shows the objects and materials of input.scene. Traces no ray.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override;
    bool isOfView() const override { return true; }
    /// That of the CPU, which traces rays for it.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

    const SkinObjects& objects() const { return m_objects; }

private:
    /// A light with what follows from it but its colour.
    struct Kept {
        Light shape; ///< unitLight()
        MappedLights lights;
        std::vector<CacheSums> sums;
        std::uint64_t gathering = 0, choice = 0; ///< versions of those that `sums` are of
    };
    struct SampleKey {
        std::uint64_t surfaces = 0;
        std::optional<Viewpoint> view;
        std::uint32_t count = 0, vals = 0;
        float defence = 0;
        bool all = false, visibleCaches = false;
        bool operator==(const SampleKey&) const = default;
    };
    /// The draws of a light, which last when it moves or an object does.
    struct KeptDraws {
        Light shape; ///< of the light for which they were made last
        gpu::Buffer draws;
        DrawRenewal renewal;
    };
    struct Cost : SkinCost {
        std::uint64_t views = 0, dispatches = 0, bytesUploaded = 0;
        double fieldMs = 0;
    };

    DeviceSkin(gpu::Device& device, Viewport& viewport, std::unique_ptr<GpuSkinLights> lights)
        : m_device(device), m_viewport(viewport), m_lights(std::move(lights)) {}
    bool relight(const Scene& scene, const SkinInputs& now, const Progress& progress, Cost& cost);
    bool castMaps(const Scene& scene, const SkinInputs& now, const Progress& progress, Cost& cost);
    void followSamples(const Scene& scene, const SkinInputs& now, Cost& cost);
    bool gather(const SkinInputs& now, const Progress& progress, Cost& cost);
    std::optional<DrawBlock> drawsOf(const SkinInputs& now, const RsmSource& source,
                                     const Kept& light);
    bool isRenewing() const;
    std::vector<GatheredSource> gathered(const SkinInputs& now) const;
    SkinPart::Light lightOf(const SkinInputs& now) const;
    void show(const SkinInputs& now, Cost& cost);
    void describe(const Cost& cost, LightingReport& report) const;

    gpu::Device& m_device;
    Viewport& m_viewport;
    std::unique_ptr<GpuSkinLights> m_lights;
    SkinObjects m_objects;
    std::vector<Kept> m_kept;                   ///< each shape once
    std::map<std::uint32_t, KeptDraws> m_draws; ///< by index into Scene::lights
    Versioned<SampleKey> m_samples;
    std::uint64_t m_gathers = 0;                ///< of lights, since the beginning
    std::uint64_t m_skinOf = 0, m_cachesOf = 0; ///< versions in m_objects of what was sent
    std::shared_ptr<const GpuSkin> m_skin;
    std::shared_ptr<SkinPass> m_pass;   ///< of the last light
    std::optional<SkinInputs> m_inputs; ///< of that; none before the first update
    Scene m_scene;                      ///< of m_inputs
};

/// DeviceSkin for the table of techniques. Fails as GpuSkinLights::create().
Result<std::unique_ptr<Lighting>> lightSkinOnDevice(gpu::Device& device, Viewport& viewport,
                                                    const Prepared& prepared);

} // namespace limn
