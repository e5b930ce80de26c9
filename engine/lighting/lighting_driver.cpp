// SPDX-License-Identifier: MIT
#include "engine/lighting/lighting_driver.h"

#include <utility>

namespace limn {

std::uint32_t bouncesPerUpdate(std::uint32_t maxBounces) {
    return maxBounces <= kFewBounces ? maxBounces : 2;
}

LightingDriver::LightingDriver(std::unique_ptr<Lighting> lighting)
    : m_lighting(std::move(lighting)) {}

void LightingDriver::lightChanged() {
    m_converged = m_whole = false;
    m_unsolved = true;
    m_bounces = 0;
}

void LightingDriver::viewIs(const Viewpoint& view) {
    if (!m_lighting || !m_lighting->isOfView() || m_view == view)
        return;
    m_view = view;
    lightChanged();
}

std::optional<LightingReport> LightingDriver::step(LightingInput input, Rest rest,
                                                   const Progress& progress) {
    if (input.view)
        viewIs(*input.view);
    if (done() || (m_converged && rest == Rest::Later))
        return {};
    const bool resting = m_converged;
    const std::uint32_t maxBounces = input.scene.relight.maxBounces;
    input.bounces = resting ? 0 : bouncesPerUpdate(maxBounces);
    const bool ofView = input.view && m_lighting->isOfView();
    if (!ofView && (!m_everWhole || (resting && rest == Rest::All)))
        input.view = nullptr;
    LightingReport report = m_lighting->update(input, progress);
    m_whole = report.whole || ofView;
    m_everWhole |= report.whole;
    if (resting)
        return {};
    m_bounces += report.bounces;
    m_converged = report.converged || m_bounces >= maxBounces;
    return report;
}

void LightingDriver::solveSources(const LightingInput& input, const Progress& progress) {
    if (canSolve())
        m_unsolved = m_lighting->solveSources(input, progress);
}

} // namespace limn
