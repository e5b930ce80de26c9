// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace limn {

/// Bandwidth [bytes per second] at which all threads together read `bytes` of memory in order, the
/// best of several passes: a lower bound for the time of any step that must read that much. `bytes`
/// should exceed the caches.
double measureReadBandwidth(std::size_t bytes);

} // namespace limn
