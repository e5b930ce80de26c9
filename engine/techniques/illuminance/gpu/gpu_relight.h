// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/render/gpu_field.h"
#include "engine/render/shadowed_lights.h"
#include "engine/techniques/illuminance/bake/bake.h"
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
    /// Where set, irradiance comes from these and their shadow maps, anew when their version is.
    const ShadowedLights* lights = nullptr;
    /// That the caches are lit in: [2, the bake's], by receiverBands(); 0: all of the bake's.
    std::uint32_t bands = 0;
    /// As BakeSettings::maxBounces: up to kFewBounces they begin anew with every changed input.
    std::uint32_t maxBounces = ~0U;
    bool grid = true; ///< the grid is read, as by needsGrid(); else its caches keep older light
    /// Whose dynamic objects dim links, where dimsLinks(): as for Relighter. Null: none do.
    const Scene* dimming = nullptr;
};

/// Milliseconds and counters of one GpuRelighter::relight() call, where they differ from
/// Relighter's: steps are in the GPU's time, without surfelReadMs; fieldMs is with the last bands
/// of caches, dimMs with what is sent; linksPassedOver are those to a black sky; lightsTraced are
/// also those without room to be kept. shadowRays, lightsOff, bandsLit and bandsSkipped are the
/// caller's to say.
struct GpuRelightStats : RelightStats {
    double uploadMs = 0;          ///< of what had changed
    std::uint32_t dispatches = 0; ///< 0 when skipped
    std::uint64_t bytesUploaded = 0;
};

/// Relighter's steps as Vulkan compute. The same light up to the rounding of 32-bit sums in another
/// order; the same bits whenever the same device is given the same inputs. Keeps what did not
/// change since the last call. Not thread-safe; the device outlives it.
class GpuRelighter {
public:
    /// Uploads the bake. Fails when a part of it is larger than the device can bind, or when the
    /// device has too few bindings; the message says the sizes. Throws VulkanError when out of
    /// memory.
    static Result<std::unique_ptr<GpuRelighter>> create(gpu::Device& device,
                                                        std::shared_ptr<const Bake> bake);
    ~GpuRelighter();

    /// Brings the field up to date by at most `bounces` iterations of B = albedo (E_direct +
    /// E_indirect(B)) + pi L_e. Call again to converge further. Uploads the inputs that differ from
    /// those of the last call. Waits for the GPU. Cancelled calls leave a valid field. `seen`: as
    /// Relighter::relight(); nothing is put off where chrominance has fewer bands.
    GpuRelightStats relight(const SurfelInputs& inputs, std::uint32_t bounces,
                            const Progress& progress = {}, const CacheFlags* seen = nullptr);

    const std::shared_ptr<const Bake>& bake() const;

    /// The field for the viewport, without a way through the CPU. Each relight() that is not
    /// skipped writes it anew, after the frames that were submitted before; it outlives this.
    /// Another one after a relight() in other bands than the last.
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
