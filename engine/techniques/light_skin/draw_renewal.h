// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"
#include "engine/techniques/light_skin/importance.h"
#include "engine/techniques/light_skin/skin_settings.h"

#include <cstdint>
#include <optional>

namespace limn {

/// What a light's draws have in common with those before, for any of them to be kept.
struct DrawKey {
    LightKind kind = LightKind::Point;
    std::uint32_t columns = 0, rows = 0; ///< of the raster
    std::uint32_t sources = 0;           ///< lights that shine: their numbers then mean the same
    SkinSettings settings;
    bool ofView = false; ///< else all draws are renewed at once
    bool operator==(const DrawKey&) const = default;
};

/// Says which draws of a light an update renews where SkinSettings::renew is less than 1: a part of
/// them, in turn, until all follow the importance of the present map. The other draws keep the
/// texels that they chose and their weights; the light of these texels is the present map's.
class DrawRenewal {
public:
    /// All draws are out of date.
    void begin(const DrawKey& key);
    /// Whether any draws are.
    bool isDue() const { return m_due > 0; }
    /// The draws to renew now. Precondition: isDue().
    DrawBlock next();

private:
    std::optional<DrawKey> m_key; ///< of the draws; none before the first
    std::uint32_t m_blocks = 1, m_next = 0, m_due = 0;
};

} // namespace limn
