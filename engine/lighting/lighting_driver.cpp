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
    m_bounces = 0;
}

std::optional<LightingReport> LightingDriver::step(LightingInput input, Rest rest,
                                                   const Progress& progress) {
    if (done() || (m_converged && rest == Rest::Later))
        return {};
    const bool resting = m_converged;
    const std::uint32_t maxBounces = input.scene.relight.maxBounces;
    input.bounces = resting ? 0 : bouncesPerUpdate(maxBounces);
    if (!m_everWhole || (resting && rest == Rest::All))
        input.view = nullptr;
    LightingReport report = m_lighting->update(input, progress);
    m_whole = report.whole;
    m_everWhole |= m_whole;
    if (resting)
        return {};
    m_bounces += report.bounces;
    m_converged = report.converged || m_bounces >= maxBounces;
    return report;
}

} // namespace limn
