// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/viewport.h"
#include "engine/techniques/light_skin/gather_light.h"
#include "engine/techniques/light_skin/importance.h"
#include "engine/techniques/light_skin/view_samples.h"
#include "shaders/shared/gpu_skin_steps.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace limn {

/// Virtual area lights of a light of colour 1 on the device.
struct MappedLights {
    gpu::Buffer texels;                  ///< GpuVirtualLight; empty where the light sends nothing
    std::uint32_t columns = 0, rows = 0; ///< of the views side by side
    std::uint32_t views = 0;             ///< drawn
    std::uint32_t count() const { return columns * rows; }
};

/// Which of them light the caches.
struct GatherOptions {
    std::uint32_t count = 1; ///< N; all where there are no more
    float defence = 0.1f;    ///< as ChoiceOptions::defence
    bool all = false;
    float nearest = 1;              ///< as for importances() [m]
    float diagonal = 1;             ///< as for gatheringLights() [m]
    const glm::vec3* eye = nullptr; ///< null: nothing glossy
    /// Of chosen lights: the draws that are made again, and those of the last time, or an empty
    /// buffer, which is made; null: all draws are made and none is kept. As drawLights().
    DrawBlock part;
    gpu::Buffer* draws = nullptr;
};

/// Reflective shadow maps that a viewport draws, their importance for a view, the choice of virtual
/// lights and what caches receive of these, as compute shaders. With all lights, sums are those of
/// gatherLights() but for rounding and for the edges of triangles; chosen lights are others,
/// because texels have another order. The same inputs give the same bits. Not thread-safe.
class GpuSkinLights {
public:
    /// Both outlive the object. Fails if the device has too few bindings.
    static Result<std::unique_ptr<GpuSkinLights>> create(gpu::Device& device, Viewport& viewport);

    /// Draws the map of a light, as unitLight() makes it, of the scene that the viewport shows.
    /// `size`: as for castRsm(); it is halved until the device can bind all texels. Waits for the
    /// device, as all of these do.
    MappedLights cast(const Light& light, const Bounds& bounds, std::uint32_t size);

    /// Draws the view at its size, or at 1024 rows where it has none, and finds samples in it.
    void findSamples(const Viewpoint& view, const Bounds& bounds, std::uint32_t count);
    void setSamples(const ViewSamples& samples);
    /// Draws the view and finds those of the caches that it shows, which become the samples.
    void findSeenCaches(const LightCaches& caches, const Viewpoint& view, const Bounds& bounds);

    /// `exponents`: of the caches' lobes; empty where nothing glossy is asked for.
    void setCaches(const LightCaches& caches, std::span<const float> exponents);

    /// What the caches of the last setCaches() receive, with samples of the last call of either
    /// function. Returns false if cancelled; `sums` is then incomplete.
    bool gather(const MappedLights& lights, const GatherOptions& options,
                std::vector<CacheSums>& sums, const Progress& progress = {});

    /// The samples, for tests. Those without a surface are left out.
    ViewSamples readSamples() const;

    std::uint64_t dispatches() const { return m_dispatches; } ///< so far
    std::uint64_t bytes() const; ///< of buffers and images, without lights

private:
    GpuSkinLights(gpu::Device& device, Viewport& viewport);
    void bindBuffers(const MappedLights* lights, const gpu::Buffer* draws = nullptr);
    void lookAt(const Viewpoint& view, const Bounds& bounds, const gpu::Pipeline& pipeline,
                float near);
    void makeRoom(const MappedLights& lights, const GatherOptions& options);
    void recordChoice(VkCommandBuffer cmd, const MappedLights& lights, shared::GpuSkinStep step);
    void record(VkCommandBuffer cmd, const gpu::Pipeline& pipeline, const shared::GpuSkinStep& step,
                std::size_t groups);

    gpu::Device& m_device;
    Viewport& m_viewport;
    gpu::Buffer m_importance, m_sums, m_samples, m_chosen, m_caches, m_received, m_draws;
    std::uint32_t m_sampleCount = 0, m_cacheCount = 0;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_readTexels, m_findSamples, m_seeCaches, m_measure, m_sumColumns, m_sumAlong,
        m_choose, m_gather;
    std::uint64_t m_dispatches = 0, m_mapBytes = 0;
};

} // namespace limn
