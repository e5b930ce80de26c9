// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace limn {

/// Bytes per second at which all threads together read `bytes` of memory in order: the best of
/// several passes, so the floor of any step that must read so much. `bytes` should exceed the
/// caches.
double measureReadBandwidth(std::size_t bytes);

} // namespace limn
