// SPDX-License-Identifier: MIT
// Values of a GpuField as compute shaders store them.

/// Rounds to the nearest normal half float, as packField() does, because the store may truncate bits.
float roundedToHalf(float value) {
    const uint bits = floatBitsToUint(value);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & ~0x1fffu);
}

/// A value that is multiplied by the field's scale already: within the range of halfs, 0 for NaN.
float fieldValue(float scaled) {
    return isnan(scaled) ? 0.0 : roundedToHalf(clamp(scaled, -65504.0, 65504.0));
}
