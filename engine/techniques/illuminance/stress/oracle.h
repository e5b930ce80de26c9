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
    std::uint64_t seed = 0; ///< of what an oracle draws
    LitScene base;
    std::string folder;                 ///< for files that are written and read back
    Progress progress;                  ///< cancelled where a case takes too long
    const Document* document = nullptr; ///< of the scene, where there is one
};

/// What an oracle says of a subject.
struct Judgement {
    bool judged = false; ///< false: the oracle says nothing of such scenes
    double value = 0;    ///< what was measured
    double limit = 0;    ///< the most that it may be

    bool failed() const { return judged && !(value <= limit); }
};

inline Judgement notJudged() {
    return {};
}
inline Judgement judged(double value, double limit) {
    return {true, value, limit};
}
/// Of what cannot be measured, and should.
inline Judgement broken() {
    return judged(std::numeric_limits<double>::infinity(), 0);
}

/// Keeps the larger one in `worst`: infinity where `value` is NaN.
inline void raise(double& worst, double value) {
    if (!(value <= worst))
        worst = value > worst ? value : std::numeric_limits<double>::infinity();
}

/// Something that holds of every scene, whatever is in it.
struct Oracle {
    std::string_view name; ///< a word, as in tables
    std::string_view what; ///< a sentence
    std::function<Judgement(const Subject&)> judge;
};

/// Everything that needs no device. Limits are explained where they are defined.
std::vector<Oracle> engineOracles();

// Parts of it, one per file.
void addLightOracles(std::vector<Oracle>& to);  ///< what light may be
void addSumOracles(std::vector<Oracle>& to);    ///< light adds up, in whatever steps
void addChangeOracles(std::vector<Oracle>& to); ///< scenes that look alike are lit alike
void addRepeatOracles(std::vector<Oracle>& to); ///< the same, bit by bit

} // namespace limn
