// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/occluder_cutouts.h"

#include <algorithm>
#include <cmath>

namespace limn {

/// The corner with numbers that the file may hold. The tracer, too, takes coordinates to be 0 where
/// they lie ten thousand images away.
static AlphaCorner inRange(AlphaCorner corner) {
    constexpr float kMaxUv = 1e4f, kMaxFactor = 1e10f;
    for (int k = 0; k < 2; ++k)
        corner.uv[k] = std::abs(corner.uv[k]) < kMaxUv ? corner.uv[k] : 0;
    corner.factor = corner.factor > 0 ? std::min(corner.factor, kMaxFactor) : 0;
    return corner;
}

void CutoutCollector::begin(const Instance& instance) {
    const Material& material = m_scene.materialOf(instance);
    m_number.reset();
    m_mask.reset();
    if (isCutout(material) && alphaCutoff(material) > 0)
        m_mask = makeAlphaMask(*m_scene.assets, m_scene.meshOf(instance), material, m_images);
}

std::optional<std::uint32_t> CutoutCollector::add(std::uint32_t triangle) {
    if (!m_mask)
        return kOpaque;
    OccluderCutout cutout{alphaCorners(*m_mask, triangle)};
    std::ranges::transform(cutout.corner, cutout.corner.begin(), inRange);
    const auto isThere = [&](const AlphaCorner& c) { return c.factor >= m_mask->cutoff; };
    if (std::ranges::none_of(cutout.corner, isThere))
        return std::nullopt; // alpha of an image is 1 at most
    if (!m_mask->image && std::ranges::all_of(cutout.corner, isThere))
        return kOpaque;
    if (!m_number)
        m_number = maskNumber();
    cutout.mask = *m_number;
    m_out.triangles.push_back(cutout);
    return std::uint32_t(m_out.triangles.size() - 1);
}

std::uint32_t CutoutCollector::maskNumber() {
    const AlphaImage white{1, 1, {255}}, &image = m_mask->image ? *m_mask->image : white;
    const auto [entry, isNew] = m_begin.try_emplace(m_mask->image.get(), m_out.texels.size());
    if (isNew)
        m_out.texels.insert(m_out.texels.end(), image.alpha.begin(), image.alpha.end());
    m_out.masks.push_back({entry->second, std::uint32_t(image.width), std::uint32_t(image.height),
                           std::uint32_t(m_mask->texture.wrapU),
                           std::uint32_t(m_mask->texture.wrapV), m_mask->texture.nearest ? 1U : 0U,
                           m_mask->cutoff});
    return std::uint32_t(m_out.masks.size() - 1);
}

} // namespace limn
