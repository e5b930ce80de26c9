// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/trace/alpha_mask.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace limn {

/// An alpha test: a surface exists where its factor times the image's alpha reaches the cutoff.
struct OccluderMask {
    std::uint64_t begin = 0; ///< of the image's texels
    std::uint32_t width = 0, height = 0;
    std::uint32_t wrapU = 0, wrapV = 0; ///< Wrap
    std::uint32_t nearest = 0;          ///< 1: texels are not interpolated
    float cutoff = 0;
};
static_assert(sizeof(OccluderMask) == 32);

/// A triangle with holes.
struct OccluderCutout {
    std::array<AlphaCorner, 3> corner;
    std::uint32_t mask = 0;
};
static_assert(sizeof(OccluderCutout) == 40);

/// The triangles that have holes, and where those are.
struct OccluderCutouts {
    std::vector<OccluderCutout> triangles;
    std::vector<OccluderMask> masks;
    std::vector<std::uint8_t> texels; ///< alpha of all images, row 0 at the top
};

/// Number of a triangle without holes.
inline constexpr std::uint32_t kOpaque = ~0U;

/// Collects the alpha tests of a scene's triangles. Images that masks share are stored once.
class CutoutCollector {
public:
    explicit CutoutCollector(const Scene& scene) : m_scene(scene) {}

    /// Selects the instance whose triangles the next calls of add() name.
    void begin(const Instance& instance);

    /// The number of a triangle's cutout, or kOpaque; nothing where all of it is a hole.
    std::optional<std::uint32_t> add(std::uint32_t triangle);

    OccluderCutouts take() { return std::move(m_out); }

private:
    std::uint32_t maskNumber();

    const Scene& m_scene;
    AlphaImages m_images;
    std::optional<AlphaMask> m_mask;       ///< none: the instance is no cutout
    std::optional<std::uint32_t> m_number; ///< of m_mask; none: no triangle has used it yet
    std::map<const AlphaImage*, std::uint64_t> m_begin; ///< of images in m_out.texels
    OccluderCutouts m_out;
};

} // namespace limn
