// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/lit_scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// A scene under test, baked and lit once for all oracles.
struct Subject {
    std::uint64_t seed = 0; ///< for an oracle's random numbers
    LitScene base;
    std::string folder;                 ///< for files that oracles write and read back
    Progress progress;                  ///< cancelled when a case takes too long
    const Document* document = nullptr; ///< of the scene, where there is one
};

/// An oracle's judgement of a subject.
struct Judgement {
    bool judged = false; ///< false: the oracle does not apply to such scenes
    double value = 0;    ///< measured value
    double limit = 0;    ///< maximum allowed value

    bool failed() const { return judged && !(value <= limit); }
};

inline Judgement notJudged() {
    return {};
}
inline Judgement judged(double value, double limit) {
    return {true, value, limit};
}
/// Judgement of a quantity that should be measurable and is not; it always fails.
inline Judgement broken() {
    return judged(std::numeric_limits<double>::infinity(), 0);
}

/// Raises `worst` to `value` where that is larger, and to infinity where `value` is NaN.
inline void raise(double& worst, double value) {
    if (!(value <= worst))
        worst = value > worst ? value : std::numeric_limits<double>::infinity();
}

/// A property that holds for every scene, whatever it contains.
struct Oracle {
    std::string_view name; ///< one word, for tables
    std::string_view what; ///< one sentence
    std::function<Judgement(const Subject&)> judge;
};

/// All oracles that need no device. Limits are explained where they are defined.
std::vector<Oracle> engineOracles();

// Groups of engineOracles(), one per file.
void addLightOracles(std::vector<Oracle>& to);  ///< bounds on light
void addSumOracles(std::vector<Oracle>& to);    ///< light adds up, in any steps
void addChangeOracles(std::vector<Oracle>& to); ///< scenes that look alike are lit alike
void addRepeatOracles(std::vector<Oracle>& to); ///< repetition gives the same bits

} // namespace limn
