// SPDX-License-Identifier: MIT
// limn::Sampler of engine/shading/sampler.h, with the same bits.
// Burley. Practical Hash-based Owen Scrambling. 2020

/// The lower 64 bits of a product; x holds the lower half of each.
uvec2 multiply64(uvec2 a, uvec2 b) {
    uint high, low;
    umulExtended(a.x, b.x, high, low);
    return uvec2(low, high + a.x * b.y + a.y * b.x);
}

uvec2 shiftXor64(uvec2 x, uint bits) { // bits < 32
    return x ^ uvec2(x.x >> bits | x.y << (32u - bits), x.y >> bits);
}

uint mixBits(uint a, uint b) {
    uint carry;
    const uint low = uaddCarry(b, 0x7f4a7c15u, carry);
    uvec2 x = uvec2(low, a + 0x9e3779b9u + carry);
    x = multiply64(shiftXor64(x, 30u), uvec2(0x1ce4e5b9u, 0xbf58476du));
    x = multiply64(shiftXor64(x, 27u), uvec2(0x133111ebu, 0x94d049bbu));
    return shiftXor64(x, 31u).y;
}

uint scrambleReversed(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

uint sobolReversed(uint x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    x ^= (x >> 16) & 0x0000ffffu;
    return x;
}

/// A point that is uniform in [0, 1)^2.
vec2 samplerPair(uint seed, uint index, uint dimension) {
    const uint s = mixBits(seed, dimension);
    const uint shuffled = bitfieldReverse(scrambleReversed(bitfieldReverse(index), s));
    const uint x = bitfieldReverse(scrambleReversed(shuffled, mixBits(s, 1u)));
    const uint y = bitfieldReverse(scrambleReversed(sobolReversed(shuffled), mixBits(s, 2u)));
    return vec2(x >> 8, y >> 8) * 5.9604644775390625e-8;
}
