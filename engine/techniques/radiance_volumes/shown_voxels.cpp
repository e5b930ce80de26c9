// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/shown_voxels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limn {

std::optional<VoxelVolume> nearTarget(const VoxelVolume& shown, const VoxelVolume& target,
                                      float rate) {
    if (shown.lattice != target.lattice)
        return std::nullopt;
    const int step = std::max(int(std::lround(rate * 255)), 1);
    const std::size_t cells = target.lattice.cells();
    VoxelVolume nearer{.lattice = target.lattice, .solid = CellBits(cells)};
    nearer.opacity.resize(cells);
    bool arrived = true;
    for (std::size_t c = 0; c < cells; ++c) {
        const int before = solidOpacity(shown, c), wanted = solidOpacity(target, c);
        const int opacity = std::clamp(wanted, before - step, before + step);
        arrived &= opacity == wanted;
        nearer.opacity[c] = std::uint8_t(opacity);
        if (opacity > 0)
            nearer.solid.words[c / 64] |= std::uint64_t(1) << (c % 64);
    }
    if (arrived)
        return std::nullopt;
    averageVoxels(nearer);
    return nearer;
}

bool ShownVoxels::follow(const Scene& scene, const VolumeSettings& settings) {
    if (settings.shadow == ConeShadows::None) {
        const bool had = m_shown != nullptr;
        reset();
        return had;
    }
    if (!m_target || m_outdated)
        m_target = std::make_shared<const VoxelVolume>(voxelsOf(scene, settings.voxels));
    else if (!fading())
        return false;
    m_outdated = false;
    std::optional<VoxelVolume> nearer;
    if (m_shown && settings.rate > 0)
        nearer = nearTarget(*m_shown, *m_target, settings.rate);
    m_shown = nearer ? std::make_shared<const VoxelVolume>(std::move(*nearer)) : m_target;
    return true;
}

} // namespace limn
