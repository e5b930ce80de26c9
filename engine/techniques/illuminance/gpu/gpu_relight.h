// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/field/grid_placement.h"
#include "engine/render/gpu_field.h"
#include "engine/render/shadowed_lights.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace limn {

/// Light and materials as the surfels of a bake see them, one value per surfel, all finite.
struct SurfelInputs {
    /// Irradiance from lights, shadows included [W m^-2], >= 0. Not read where `lights` is set.
    std::span<const glm::vec3> direct;
    std::span<const glm::vec3> albedo;  ///< [0, 0.99]
    std::span<const glm::vec3> emitted; ///< pi L_e [W m^-2], >= 0
    std::span<const glm::vec3> sky;     ///< of each of the tree's sky cells, pi L [W m^-2], >= 0
    /// Where set, irradiance is computed from these and their shadow maps, again whenever their
    /// version changes.
    const ShadowedLights* lights = nullptr;
    /// Number of bands in which the caches are lit: [2, the bake's], by receiverBands(); 0: all of
    /// the bake's.
    std::uint32_t bands = 0;
    RelightSettings settings; ///< those on which the end of bounces depends
    bool grid = true; ///< the grid is read, as by needsGrid(); else its caches keep older light
    /// Scene whose dynamic objects occlude links, where occludesLinks(), as for Relighter. Null:
    /// none do.
    const Scene* occluders = nullptr;
};

/// Milliseconds and counters of one GpuRelighter::relight() call. They differ from Relighter's as
/// follows. Steps are measured in GPU time, without surfelReadMs. fieldMs includes the last bands
/// of caches, occlusionMs the upload. linksSkipped counts links to a black sky. lightsTraced
/// includes lights without room to be kept. The caller fills shadowRays, lightsOff, bandsLit and
/// bandsSkipped.
struct GpuRelightStats : RelightStats {
    double uploadMs = 0;          ///< upload of what had changed
    std::uint32_t dispatches = 0; ///< 0 when skipped
    std::uint64_t bytesUploaded = 0;
};

/// Runs Relighter's steps as Vulkan compute shaders. The light equals Relighter's up to the
/// rounding of 32-bit sums in another order, and has the same bits whenever the same device gets
/// the same inputs. Results that did not change since the last call are kept. Not thread-safe; the
/// device must outlive the object.
class GpuRelighter {
public:
    /// Uploads the bake. Fails when a part of it is larger than the device can bind, or when the
    /// device has too few bindings; the message names the sizes. Throws VulkanError when out of
    /// memory.
    static Result<std::unique_ptr<GpuRelighter>> create(gpu::Device& device,
                                                        std::shared_ptr<const Bake> bake);
    ~GpuRelighter();

    /// Brings the field up to date by at most `bounces` iterations of B = albedo (E_direct +
    /// E_indirect(B)) + pi L_e. Call again to converge further. Uploads the inputs that differ from
    /// those of the last call. Waits for the GPU. Cancelled calls leave a valid field. `seen`: as
    /// in Relighter::relight(), but nothing is postponed where chrominance has fewer bands.
    GpuRelightStats relight(const SurfelInputs& inputs, std::uint32_t bounces,
                            const Progress& progress = {}, const CacheFlags* seen = nullptr);

    const std::shared_ptr<const Bake>& bake() const;

    /// The field for the viewport, which never passes through the CPU. Each relight() that is not
    /// skipped rewrites it, after the frames that were submitted before. A relight() in other bands
    /// than the last replaces it. It may outlive this object.
    std::shared_ptr<const GpuField> field() const;
    std::uint64_t fieldVersion() const; ///< grows with every change of the field; 0: still black

    // Read-back, for tests and for what needs the numbers on the CPU. Each waits.
    std::vector<glm::vec3> readRadiosity() const; ///< as Relighter::radiosity()
    std::vector<glm::vec3> readCacheSh() const;   ///< as Relighter::cacheSh(), in field()'s bands
    IndirectField readField() const;              ///< as Relighter::field()

private:
    struct State;
    explicit GpuRelighter(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace limn
