// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/relight/relight.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace limn {

/// Finds the light of single sources for a relighter, a few bounces at a time.
class SourceSolver {
public:
    explicit SourceSolver(std::shared_ptr<const Bake> bake) : m_bake(std::move(bake)) {}

    /// Goes on with the source that `relighter` wants next. `unread`: as for lightUnreadGrid().
    /// Returns false if it wants none, or if the light of that source grows without end. A
    /// cancelled call loses nothing.
    bool solve(Relighter& relighter, const Scene& scene, const TraceScene& trace, bool unread,
               const Progress& progress);

private:
    std::shared_ptr<const Bake> m_bake;
    std::optional<LightSource> m_source; ///< that m_alone is being lit by
    std::uint64_t m_generation = 0;      ///< Relighter::sourcesGeneration() then
    Scene m_scene;                       ///< of m_source
    std::unique_ptr<Relighter> m_alone;
};

} // namespace limn
