// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace limn::runtime {

/// xxHash64 of bytes with seed 0. Collet. xxHash Fast Digest Algorithm, specification 0.1.1. 2018
std::uint64_t xxhash64(const void* bytes, std::size_t size);

} // namespace limn::runtime
