// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/indirect_field.h"
#include "engine/lighting/direct_irradiance.h"
#include "engine/lighting/light_sources.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace limn {

/// Milliseconds and counters of one relight() call, for the statistics panel and --json.
struct RelightStats {
    double directMs = 0;      ///< lights onto the surfels, with shadow rays
    double surfelLightMs = 0; ///< radiosity of the surfels: their light times their albedo
    double pullMs = 0;        ///< radiosity of the clusters, up the tree
    double cacheLightMs = 0;  ///< light of the caches, through their links
    double surfelReadMs = 0;  ///< bounced light at the surfels, from the caches
    double fieldMs = 0;       ///< the field that the viewport samples
    double basisMs = 0;       ///< sum of sources' light, in place of all steps but the field
    double occlusionMs = 0;   ///< which links dynamic objects block; 0 while they stand still
    double totalMs = 0;
    std::uint32_t bounces = 0; ///< iterations run by this call
    std::uint64_t shadowRays = 0;
    bool converged = false; ///< another bounce would change almost nothing (Convergence)
    double passedOn = 0; ///< share of a bounce's light that the next one passes on (Convergence);
                         ///< 0: not known yet
    bool grows = false;  ///< bounces were stopped because they brought ever more light
    std::uint32_t lightsTraced = 0; ///< lights whose shadows were traced: they or an object moved
    std::uint32_t lightsOff = 0; ///< off, black or out of reach of every surfel: they cost nothing
    std::uint64_t links = 0;     ///< of the caches lit by this call, once for each bounce
    std::uint64_t linksSkipped = 0;      ///< of those: skipped, as their senders send no light
    std::uint32_t bandsLit = 0;          ///< of the caches
    std::uint32_t bandsSkipped = 0;      ///< bands of the bake that no surface's reflection needs
    std::uint32_t gridCachesSkipped = 0; ///< the grid's caches, where nothing reads them
    std::uint32_t cachesUnread = 0;   ///< lightmap caches that no surfel reads and no bounce lights
    std::uint32_t cachesUnseen = 0;   ///< lightmap caches for which the field keeps older light
    std::uint32_t cachesOccluded = 0; ///< caches that dynamic objects take light from
    std::uint64_t linksOccluded = 0;  ///< of those
    bool summed = false;              ///< all bounces at once, from sources' light (LightBasis)
    std::uint32_t sourcesKept = 0;    ///< whose light is known alone
    std::uint64_t bytes = 0;          ///< that this relighter keeps beside the bake; 0: not known
    bool skipped = false; ///< no work was done: nothing had changed and bounces had converged
};

/// Which of a bake's bands are lit: those that the scene's surfaces need (receiverBands()), 3 where
/// none is glossy, or all. Needed copies the bands it lights of links stored as harmonics, 18 bytes
/// a link for 3 bands.
enum class LitBands : std::uint8_t { Needed, All };

/// What a relight() computed with and what it left, for those who follow its light backwards. Valid
/// until the next relight().
struct RelightState {
    const Bake& bake;
    const Caches& links; ///< LinkStorage::Rtp: those with what dynamic objects leave of them
    LinkHalfs halfs;     ///< LinkStorage::Sh: the same
    LinkEnds ends;
    int bands;        ///< of the field
    LightBands inner; ///< of what surfels read
    int chroma;       ///< bands in colour of the field
    std::uint32_t maxBounces;
    std::span<const glm::vec4> radiosity; ///< per node, as withLuma [W m^-2]
    std::span<const glm::vec3> albedo;    ///< per surfel, as the next two
    std::span<const glm::vec3> emitted;   ///< pi L_e [W m^-2]; empty: no surfel emits
    std::span<const glm::vec3> indirect;  ///< irradiance [W m^-2]
    const DirectIrradiance& direct;
};

/// Relights a bake on the CPU, at run time. Results that did not change since the last call are
/// kept. Not thread-safe: one thread at a time calls relight().
class Relighter {
public:
    /// `bake` must come from a scene with the same bakeInputHash as the scenes passed to relight().
    explicit Relighter(std::shared_ptr<const Bake> bake, LitBands lit = LitBands::Needed);
    ~Relighter();

    /// Brings the field up to date with the lights, materials, sky and, with
    /// scene.relight.dynamicOcclusion, the dynamic objects of `scene`, by at most `bounces`
    /// iterations of B = albedo (E_direct + E_indirect(B)) + pi L_e. Call again to converge
    /// further. Where scene.relight.maxBounces is kFewBounces or less, a change restarts from no
    /// bounced light. `trace` answers the shadow rays. Cancelled calls leave a valid field.
    ///
    /// `seen`: lightmap caches where the field is needed, by seenCaches(); null: all. Others keep
    /// older light. Bounces light the caches that surfels read, and the last bounce lights those
    /// that are seen. What surfels read of the rest is postponed to the next call, which drops it
    /// if the light has changed and otherwise continues with it. Static light is therefore the
    /// same, bit by bit, for every view; in moving light surfels start from what they read one
    /// bounce earlier. Calls of one bounce postpone nothing. Where nothing has changed, or without
    /// bounces, only seen caches with older light are lit.
    RelightStats relight(const Scene& scene, const TraceScene& trace, std::uint32_t bounces,
                         const Progress& progress = {}, const CacheFlags* seen = nullptr);

    /// Whether the grid is lit even where no instance is lit from it; initially false.
    void lightUnreadGrid(bool light);

    /// The relit field. It holds the light of the last relight() in all but
    /// RelightStats::cachesUnseen.
    const IndirectField& field() const;
    const Bake& bake() const;

    /// Radiosity of the tree's nodes, as withLuma [W m^-2]; valid after relight().
    const std::vector<glm::vec4>& radiosity() const;

    /// SH of incident radiance of cache c [W m^-2 sr^-1]: bands^2 values at c * bands^2; bands as
    /// field()'s. From band chromaBandsOf(settings) on they are grey. They hold older light where
    /// field() does.
    const std::vector<glm::vec3>& cacheSh() const;

    RelightState state() const;

    // Where nothing but colours and strengths of sources whose light is kept has changed since the
    // light was converged, relight() sets it to the sum of theirs. It adds no bounce then and does
    // not report the light as converged: the next call goes on with bounces, which change little.
    // Radiosity, state() and direct light remain those of the last call with bounces.

    /// A source of `scene` whose light is worth keeping. None unless the light is converged,
    /// nothing of it is older, and changes do not restart from no bounced light.
    std::optional<LightSource> wantedSource(const Scene& scene);

    /// Keeps cacheSh() of a relighter of the same bake and bands that has lit litByOne(scene,
    /// source), as wantedSource() named it.
    void keepSource(const LightSource& source, std::span<const glm::vec3> light);

    /// Changes when what was kept of sources no longer holds.
    std::uint64_t sourcesGeneration() const;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

} // namespace limn
