// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"
#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/stress/oracle.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// A scene to be put before oracles.
struct StressCase {
    std::uint64_t seed = 0; ///< of what oracles draw, and of the scene where it was generated
    Document document;
    std::shared_ptr<const Assets> assets;
    std::string description; ///< for people
};

/// hostileScene() of the seed.
StressCase generatedCase(std::uint64_t seed);

/// How a case ended. Refused: bake() said in words why it cannot be baked. Slow: it was stopped
/// when its time was up. Crashed: the process ended with it.
enum class CaseEnd : std::uint8_t { Done, Refused, Slow, Crashed };

struct CaseResult {
    std::uint64_t seed = 0;
    CaseEnd end = CaseEnd::Done;
    double milliseconds = 0;
    std::vector<Judgement> judgements; ///< per oracle; those of slow cases as far as they came
    std::string note;                  ///< description, or why it was refused
};

struct CaseLimits {
    double seconds = 30;
    std::string folder; ///< for files that oracles write and read; it exists
};

/// Bakes and lights the scene once, and asks every oracle.
CaseResult runCase(const StressCase& stressCase, const std::vector<Oracle>& oracles,
                   const CaseLimits& limits);

} // namespace limn
