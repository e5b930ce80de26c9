// SPDX-License-Identifier: MIT
#include "engine/lighting/convergence.h"

#include <cmath>

namespace limn {

namespace {

constexpr double kRounding = 1.001, kMaximum = 0.99999;

/// The sum of all changes that would follow the latest one, relative to it and at least 1, as a
/// geometric series of ratio q below 1.
double following(double q) {
    return std::max(q / (1 - q), 1.);
}

} // namespace

std::uint32_t Convergence::expectedRounds() const {
    if (m_rounds < kBringing)
        return kBringing - m_rounds;
    double q = 1;
    for (const double share : m_latest)
        if (share > 0)
            q = std::min(q, share);
    if (!(q < 1 && m_excess > 1))
        return 1;
    return std::uint32_t(std::clamp(std::ceil(std::log(m_excess) / -std::log(q)), 1., 1e6));
}

void Convergence::addRound(RoundChange round, bool uncertain) {
    const bool reflects = ++m_rounds > kBringing && m_before > 0;
    m_passedOn = reflects ? round.change / m_before : 0;
    m_before = round.change;
    m_latest[m_rounds % m_latest.size()] = m_passedOn;
    // Where changes are as small as a hundred roundings, shares scatter by some per cent: in a
    // white room the first low one would end bounces 0.03 % to 0.1 % too early.
    constexpr double kNoise = 0.999;
    const double q = uncertain ? kMaximum : std::min(std::ranges::max(m_latest), kNoise);
    const bool converged = isReached(round, following(q));
    const bool more = m_passedOn > kRounding && !converged;
    m_growing = more ? m_growing + 1 : 0;
    m_grown = more ? m_grown * m_passedOn : 1;
    m_reached = (converged && m_unseenRounds == 0 && m_rounds >= kBringing) || grows();
    m_unseenRounds -= m_unseenRounds > 0;
}

void Convergence::addResidual(RoundChange residual, double passedOn) {
    constexpr double kStricter = 4; // the share is measured over other sums than the change
    ++m_rounds;
    m_passedOn = passedOn;
    m_before = residual.change;
    m_latest = {passedOn};
    m_reached = isReached(residual, kStricter * following(std::min(passedOn, kMaximum))) &&
                m_unseenRounds == 0;
    m_growing = 0;
    m_grown = 1;
    m_unseenRounds -= m_unseenRounds > 0;
}

bool Convergence::isReached(const RoundChange& round, double toCome) {
    const double tolerance = double(m_settings.tolerance) / 100;
    m_excess = std::max(round.ofAll(), round.relative) * toCome / tolerance;
    return round.ofAll() * toCome < tolerance && round.relative * toCome < tolerance;
}

} // namespace limn
