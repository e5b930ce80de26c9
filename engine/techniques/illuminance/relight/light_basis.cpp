// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/light_basis.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace limn {

static constexpr float kLargestValue = 32767;

bool LightBasis::holdFor(const Scene& scene) {
    if (m_sum.empty() && m_kept.empty())
        return false;
    if (isTransportOf(m_transport, scene))
        return true;
    const std::uint64_t generation = m_generation + 1;
    *this = LightBasis(m_budget);
    m_generation = generation;
    return false;
}

void LightBasis::setSum(const Scene& scene, std::vector<WeightedSource> sources,
                        std::span<const glm::vec3> light, std::size_t coefficients) {
    m_transport = sourceTransport(scene);
    m_sources = std::move(sources);
    m_sum.assign(light.begin(), light.end());
    m_coefficients = coefficients;
}

bool LightBasis::hasSum(std::span<const WeightedSource> sources) const {
    return !m_sum.empty() && std::ranges::equal(sources, m_sources);
}

void LightBasis::keep(const LightSource& source, std::span<const glm::vec3> light) {
    const std::size_t caches = light.size() / m_coefficients, numbers = 3 * m_coefficients;
    SourceLight kept{source, std::vector<float>(caches),
                     std::vector<std::int16_t>(caches * numbers)};
    parallelRanges(caches, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const float* from = &light[c * m_coefficients].x;
            float peak = 0;
            for (std::size_t i = 0; i < numbers; ++i)
                peak = std::max(peak, std::abs(from[i]));
            kept.scale[c] = peak / kLargestValue;
            for (std::size_t i = 0; peak > 0 && i < numbers; ++i)
                kept.values[c * numbers + i] =
                    std::int16_t(std::lround(from[i] / peak * kLargestValue));
        }
    });
    if (const auto old = find(source); old != m_kept.end())
        m_kept.erase(old);
    if (m_lacking == source)
        m_lacking.reset();
    m_kept.push_front(std::move(kept));
    std::uint64_t bytes = 0;
    for (const SourceLight& l : m_kept)
        bytes += l.bytes();
    for (; bytes > m_budget && !m_kept.empty(); m_kept.pop_back())
        bytes -= m_kept.back().bytes();
}

std::optional<LightSource> LightBasis::wanted() const {
    const auto isOfSum = [&](const LightSource& source) {
        return std::ranges::find(m_sources, source, &WeightedSource::source) != m_sources.end();
    };
    if (m_lacking && isOfSum(*m_lacking))
        return m_lacking;
    const auto lacking = std::ranges::find_if(
        m_sources, [&](const WeightedSource& s) { return find(s.source) == m_kept.end(); });
    if (lacking == m_sources.end())
        return {};
    std::uint64_t bytes = m_sum.size() * 3 * sizeof(std::int16_t) +
                          m_sum.size() / m_coefficients * sizeof(float); // of one more
    for (const SourceLight& l : m_kept)
        bytes += isOfSum(l.source) ? l.bytes() : 0;
    return bytes <= m_budget ? std::optional(lacking->source) : std::nullopt;
}

LightBasis::Kept::const_iterator LightBasis::find(const LightSource& source) const {
    return std::ranges::find(m_kept, source, &SourceLight::source);
}

/// What the weights of the sum's sources change by; none if `now` has others.
std::optional<std::vector<glm::vec3>>
LightBasis::changes(std::span<const WeightedSource> now) const {
    std::vector<glm::vec3> changes;
    changes.reserve(m_sources.size());
    auto next = now.begin();
    for (const WeightedSource& s : m_sources) {
        const bool stays = next != now.end() && next->source == s.source;
        changes.push_back((stays ? next->weight : glm::vec3(0)) - s.weight);
        next += stays;
    }
    if (next != now.end())
        return {};
    return changes;
}

bool LightBasis::sum(std::span<const WeightedSource> now, std::vector<glm::vec3>& light) {
    if (m_sum.empty())
        return false;
    const std::optional<std::vector<glm::vec3>> changed = changes(now);
    if (!changed)
        return false;
    std::vector<Term> terms;
    for (std::size_t i = 0; i < changed->size(); ++i) {
        if ((*changed)[i] == glm::vec3(0))
            continue;
        const auto found = find(m_sources[i].source);
        if (found == m_kept.end()) {
            m_lacking = m_sources[i].source;
            return false;
        }
        m_kept.splice(m_kept.begin(), m_kept, found);
        terms.push_back({&*found, (*changed)[i]});
    }
    addTerms(terms, light);
    return true;
}

/// Reads each number of a source once, and writes each of the light once.
void LightBasis::addTerms(std::span<const Term> terms, std::vector<glm::vec3>& light) const {
    const std::size_t numbers = 3 * m_coefficients;
    light.resize(m_sum.size());
    parallelRanges(m_sum.size() / m_coefficients, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const float* sum = &m_sum[c * m_coefficients].x;
            float* out = &light[c * m_coefficients].x;
            std::copy_n(sum, numbers, out);
            for (const Term& term : terms) {
                const glm::vec3 f = term.factor * term.light->scale[c];
                const std::int16_t* values = term.light->values.data() + c * numbers;
                for (std::size_t i = 0; i < numbers; i += 3) {
                    out[i] += f.x * float(values[i]);
                    out[i + 1] += f.y * float(values[i + 1]);
                    out[i + 2] += f.z * float(values[i + 2]);
                }
            }
        }
    });
}

std::uint64_t LightBasis::bytes() const {
    std::uint64_t bytes = m_sum.size() * sizeof(glm::vec3);
    for (const SourceLight& l : m_kept)
        bytes += l.bytes();
    return bytes;
}

} // namespace limn
