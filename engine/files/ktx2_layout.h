// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/bc6h.h"
#include "engine/files/ktx2.h"
#include "engine/scene/ktx2_header.h"

#include <cstdint>
#include <string>

namespace limn {

/// Bytes of the scalars that a texel is made of.
std::uint32_t ktx2TypeSize(Ktx2Format format);

/// Whether blocks of a format hold negative values.
inline Bc6hSign bc6hSignOf(Ktx2Format format) {
    return format == Ktx2Format::Bc6hSigned ? Bc6hSign::Signed : Bc6hSign::Unsigned;
}

/// Data format descriptor of a format, with its total size in front. `sized`: the texels are not
/// supercompressed, so their size is part of the descriptor.
std::string ktx2Descriptor(Ktx2Format format, bool sized);

} // namespace limn
