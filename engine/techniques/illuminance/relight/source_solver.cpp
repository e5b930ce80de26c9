// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/source_solver.h"

namespace limn {

bool SourceSolver::solve(Relighter& relighter, const Scene& scene, const TraceScene& trace,
                         bool unread, const Progress& progress) {
    constexpr std::uint32_t kBounces = 2; // of a call, so that others do not wait for long
    const std::optional<LightSource> wanted = relighter.wantedSource(scene);
    if (!wanted) {
        m_source.reset();
        m_alone.reset();
        return false;
    }
    if (m_source != wanted || m_generation != relighter.sourcesGeneration()) {
        m_source = wanted;
        m_generation = relighter.sourcesGeneration();
        m_scene = litByOne(scene, *wanted);
        m_alone = std::make_unique<Relighter>(m_bake);
        m_alone->lightUnreadGrid(unread);
    }
    const RelightStats stats = m_alone->relight(m_scene, trace, kBounces, progress);
    if (!stats.converged || progress.cancelled())
        return true;
    if (stats.grows)
        return false; // it would be wanted again and again
    relighter.keepSource(*m_source, m_alone->cacheSh());
    m_source.reset();
    return true;
}

} // namespace limn
