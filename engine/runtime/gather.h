// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/transport_view.h"
#include "engine/runtime/vectors.h"

namespace limn::runtime {

/// What caches gather from and where to. Bands in [2, 8], chroma in [1, bands].
struct Gather {
    const TransportView& view;
    const F4* radiosity;          ///< per node: red, green, blue and luma
    const std::uint32_t* linkEnd; ///< per cache, the end of the links that are read
    std::uint32_t bands, chroma;
    F4* sh; ///< `stride` coefficients per cache, of which bands^2 are written
    std::size_t stride;
};

/// Lights the valid caches [begin, end): coefficient i is the sum over links of radiosity times
/// transport times the cone's projection onto Y_i. From band `chroma` on the light is grey. Takes
/// the widest vectors that the machine has.
void gatherCaches(const Gather& gather, std::uint32_t begin, std::uint32_t end);

// The same with vectors of a given width. The wide ones exist on x86-64 only.
void gatherNarrow(const Gather& gather, std::uint32_t begin, std::uint32_t end);
void gatherWide(const Gather& gather, std::uint32_t begin, std::uint32_t end);
void gatherWidest(const Gather& gather, std::uint32_t begin, std::uint32_t end);

#if defined(__x86_64__) && !defined(LIMNRT_NO_WIDE_VECTORS)
#define LIMNRT_WIDE_VECTORS 1
#else
#define LIMNRT_WIDE_VECTORS 0
#endif

} // namespace limn::runtime
