// SPDX-License-Identifier: MIT
// The Halton sequence in bases 2 and 3, as radicalInverse() of engine/math/sampling.h.

float radicalInverse(uint i, uint base) {
    float result = 0.0, digit = 1.0 / float(base);
    for (; i > 0u; i /= base, digit /= float(base))
        result += digit * float(i % base);
    return result;
}

vec2 haltonPoint(uint i) {
    return vec2(radicalInverse(i, 2u), radicalInverse(i, 3u));
}
