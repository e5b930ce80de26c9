// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

enum class MarkShape : std::uint32_t { Disc, Square, Ring };

/// A flat mark in the world, drawn as one instance.
struct OverlayMark {
    glm::vec3 position{0};   ///< [m]
    float radius = 0;        ///< [m]; of Square: half a side
    glm::vec3 normal{0};     ///< unit, visible from its front only; 0: faces the viewer
    std::uint32_t color = 0; ///< sRGB-encoded bytes R, G, B, A
    MarkShape shape = MarkShape::Disc;

    bool operator==(const OverlayMark&) const = default;
};
static_assert(sizeof(OverlayMark) == 36);

/// Meaning of an overlay's colours.
struct OverlayLegend {
    struct Entry {
        std::uint32_t color; ///< as OverlayMark::color
        std::string text;
    };
    std::string title;
    std::vector<Entry> entries;
    std::vector<std::string> notes;
};

/// An overlay ready to draw: marks in the world, or colours of the lightmap's texels.
struct OverlayData {
    std::vector<OverlayMark> marks;
    std::uint32_t width = 0, height = 0; ///< of `texels`
    /// Colours per lightmap texel, row by row, as OverlayMark::color; A = 0: not painted. Empty:
    /// surfaces are unchanged.
    std::vector<std::uint32_t> texels;
    /// Per texel: the first texel of the block of finer texels that is painted instead of the
    /// square between the centres of this texel and the next ones to the right and below; ~0: none.
    /// Empty: the lightmap has no finer texels.
    std::vector<std::uint32_t> finer;
    OverlayLegend legend;
};

} // namespace limn
