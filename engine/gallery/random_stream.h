// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace limn {

/// Pseudo-random numbers that are identical on every machine: SplitMix64, computed with integers
/// and exact divisions only.
/// Steele, Lea, Flood. Fast Splittable Pseudorandom Number Generators. 2014
class RandomStream {
public:
    explicit RandomStream(std::uint64_t seed) : m_state(seed) {}

    std::uint64_t bits() {
        m_state += 0x9e3779b97f4a7c15U;
        std::uint64_t z = m_state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1), with 53 bits.
    double number() { return double(bits() >> 11) * 0x1p-53; }
    /// Uniform in [a, b).
    double between(double a, double b) { return a + (b - a) * number(); }
    /// Uniform in {first, ..., last}.
    int whole(int first, int last) { return first + int(bits() % std::uint64_t(last - first + 1)); }
    bool chance(double share) { return number() < share; }

private:
    std::uint64_t m_state;
};

} // namespace limn
