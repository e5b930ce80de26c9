// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/draw_renewal.h"

#include <cmath>

namespace limn {

void DrawRenewal::begin(const DrawKey& key) {
    const bool anew = m_key != key || !key.ofView;
    m_key = key;
    // Rounding must not make a part more of a share such as 1/3.
    const auto blocks = std::uint32_t(std::ceil(1 / key.settings.renew - 1e-4f));
    m_blocks = anew ? 1 : blocks;
    m_next = anew ? 0 : m_next % blocks;
    m_due = m_blocks;
}

DrawBlock DrawRenewal::next() {
    const DrawBlock block{m_next, m_blocks};
    m_next = (m_next + 1) % m_blocks;
    --m_due;
    return block;
}

} // namespace limn
