// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace limn {

inline constexpr float kMinIconScale = 0.25f;

/// For icons of diameter `size` centred at `places` [px]: what to multiply each diameter by, in
/// [kMinIconScale, 1], so that an icon ends where its nearest neighbour begins. Icons at the same
/// place are one and are not shrunk on each other's account.
std::vector<float> iconScales(const std::vector<glm::vec2>& places, float size);

} // namespace limn
