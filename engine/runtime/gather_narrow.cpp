// SPDX-License-Identifier: MIT
#include "engine/runtime/gather.h"

#define LIMNRT_LANES 4
#include "engine/runtime/gather_range.h"

namespace limn::runtime {

void gatherNarrow(const Gather& gather, std::uint32_t begin, std::uint32_t end) {
    gatherRange(gather, begin, end);
}

} // namespace limn::runtime
