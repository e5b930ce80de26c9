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

/// A scene to be judged by oracles.
struct StressCase {
    std::uint64_t seed = 0; ///< for the oracles' random numbers and a generated scene
    Document document;
    std::shared_ptr<const Assets> assets;
    std::string description; ///< for people
};

/// The case of hostileScene() with this seed.
StressCase generatedCase(std::uint64_t seed);

/// How a case ended. Refused: bake() failed with a message. Slow: it was stopped when its time was
/// up. Crashed: the process ended while the case ran.
enum class CaseEnd : std::uint8_t { Done, Refused, Slow, Crashed };

struct CaseResult {
    std::uint64_t seed = 0;
    CaseEnd end = CaseEnd::Done;
    double milliseconds = 0;
    std::vector<Judgement> judgements; ///< per oracle; for slow cases, only those reached in time
    std::string note;                  ///< description, or the reason why it was refused
};

struct CaseLimits {
    double seconds = 30;
    std::string folder; ///< existing folder for files that oracles write and read
};

/// Bakes and lights the scene once, then runs every oracle on it.
CaseResult runCase(const StressCase& stressCase, const std::vector<Oracle>& oracles,
                   const CaseLimits& limits);

} // namespace limn
