// SPDX-License-Identifier: MIT
#include "engine/files/ktx2_layout.h"

#include "engine/core/append_word.h"

#include <bit>
#include <vector>

namespace limn {

namespace {

/// A sample of the basic descriptor block: bits of a texel that belong to one channel.
struct Sample {
    std::uint32_t bitOffset, bits;
    std::uint32_t channel; ///< with its qualifiers in the upper four bits
    std::uint32_t lower, upper;
};

constexpr std::uint32_t kAlpha = 15, kExponent = 0x20, kSigned = 0x40, kFloat = 0x80;

std::vector<Sample> floatSamples(std::uint32_t bits) {
    const auto minusOne = std::bit_cast<std::uint32_t>(-1.f);
    const auto one = std::bit_cast<std::uint32_t>(1.f);
    std::vector<Sample> samples;
    for (const std::uint32_t channel : {0U, 1U, 2U, kAlpha})
        samples.push_back({std::uint32_t(samples.size()) * bits, bits, channel | kSigned | kFloat,
                           minusOne, one});
    return samples;
}

/// Each channel has a sample of its mantissa and one of the exponent that all share. The limits are
/// those of the table "E5B9G9R9" in section 10 of the Khronos Data Format Specification.
std::vector<Sample> sharedExponentSamples() {
    std::vector<Sample> samples;
    for (const std::uint32_t channel : {0U, 1U, 2U}) {
        samples.push_back({channel * 9, 9, channel, 0, 8448});
        samples.push_back({27, 5, channel | kExponent, 15, 31});
    }
    return samples;
}

std::vector<Sample> samplesOf(Ktx2Format format) {
    switch (format) {
    case Ktx2Format::Rgba16f:
        return floatSamples(16);
    case Ktx2Format::Rgba32f:
        return floatSamples(32);
    case Ktx2Format::Rgb9e5:
        return sharedExponentSamples();
    case Ktx2Format::Bc6hUnsigned:
        return {{0, 128, kFloat, 0, std::bit_cast<std::uint32_t>(1.f)}};
    case Ktx2Format::Bc6hSigned:
        return {{0, 128, kFloat | kSigned, std::bit_cast<std::uint32_t>(-1.f),
                 std::bit_cast<std::uint32_t>(1.f)}};
    }
    return {};
}

} // namespace

std::uint32_t ktx2BlockSide(Ktx2Format format) {
    return format == Ktx2Format::Bc6hUnsigned || format == Ktx2Format::Bc6hSigned ? 4 : 1;
}

std::uint32_t ktx2BlockBytes(Ktx2Format format) {
    switch (format) {
    case Ktx2Format::Rgba16f:
        return 8;
    case Ktx2Format::Rgb9e5:
        return 4;
    case Ktx2Format::Rgba32f:
    case Ktx2Format::Bc6hUnsigned:
    case Ktx2Format::Bc6hSigned:
        return 16;
    }
    return 0;
}

std::uint32_t ktx2TypeSize(Ktx2Format format) {
    if (ktx2BlockSide(format) > 1)
        return 1;
    return format == Ktx2Format::Rgba16f ? 2 : 4;
}

std::string ktx2Descriptor(Ktx2Format format, bool sized) {
    constexpr std::uint32_t kVersion = 2, kRgbsda = 1, kBc6h = 133, kBt709 = 1, kLinear = 1;
    const std::uint32_t side = ktx2BlockSide(format);
    const std::vector<Sample> samples = samplesOf(format);
    const auto block = std::uint32_t(24 + 16 * samples.size());
    std::string out;
    appendWord(out, 4 + block);
    appendWord(out, 0); // vendor: Khronos; type: basic format
    appendWord(out, kVersion | block << 16);
    appendWord(out, (side > 1 ? kBc6h : kRgbsda) | kBt709 << 8 | kLinear << 16);
    appendWord(out, (side - 1) | (side - 1) << 8); // of side x side x 1 x 1 texels
    appendWord(out, sized ? ktx2BlockBytes(format) : 0);
    appendWord(out, 0);
    for (const Sample& s : samples) {
        appendWord(out, s.bitOffset | (s.bits - 1) << 16 | s.channel << 24);
        appendWord(out, 0); // position within the texel
        appendWord(out, s.lower);
        appendWord(out, s.upper);
    }
    return out;
}

} // namespace limn
