// SPDX-License-Identifier: MIT
#include "engine/files/hdr_image.h"

#include "engine/scene/decode_image.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace limn {

namespace {

using Bytes = std::span<const std::uint8_t>;
using Rgbe = std::array<std::uint8_t, 4>;

tl::unexpected<Error> malformed() {
    return fail("malformed HDR");
}
tl::unexpected<Error> truncated() {
    return fail("truncated HDR");
}

/// Reads up to the end of the line, which is consumed, too. Lines may end as on Windows.
std::string_view takeLine(std::string_view& rest) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    return line;
}

/// Reads a number, and the spaces after it.
template <class T>
bool takeNumber(std::string_view& line, T& number) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    line.remove_prefix(std::size_t(end - line.data()));
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    return error == std::errc();
}

/// Size and direction of texels along an axis.
struct Axis {
    std::uint32_t texels = 0;
    bool isReversed = false; ///< from the bottom, or from the right
};

/// Parses one axis of "-Y 480 +X 640". Rows usually go down, against Y, and columns along X.
bool takeAxis(std::string_view& line, char letter, char usualSign, Axis& axis) {
    if (line.size() < 2 || (line[0] != '-' && line[0] != '+') || line[1] != letter)
        return false;
    axis.isReversed = line[0] != usualSign;
    line.remove_prefix(2);
    return takeNumber(line, axis.texels) && axis.texels > 0;
}

/// What texels are to be divided by: their exposures and colour corrections, which may be given
/// several times (Ward. The RADIANCE Lighting Simulation and Rendering System. 1994).
struct Correction {
    glm::dvec3 factor{1};

    Result<void> read(std::string_view line) {
        const bool isColor = line.starts_with("COLORCORR=");
        if (!isColor && !line.starts_with("EXPOSURE="))
            return {};
        line.remove_prefix(line.find('=') + 1);
        glm::dvec3 number(1);
        for (int c = 0; c < (isColor ? 3 : 1); ++c)
            if (!takeNumber(line, number[c]) || !(number[c] > 0) || !std::isfinite(number[c]))
                return fail("malformed HDR: EXPOSURE or COLORCORR is not above 0");
        factor *= isColor ? number : glm::dvec3(number.x);
        return {};
    }
};

glm::vec3 colorOf(const Rgbe& texel) {
    constexpr int kBias = 128 + 8; // of the exponent, and of mantissas of 8 bits
    const float scale = texel[3] ? std::ldexp(1.f, texel[3] - kBias) : 0;
    return glm::vec3(texel[0], texel[1], texel[2]) * scale;
}

/// Unpacks a row whose channels follow one another, each as runs of one byte and as literal bytes.
Result<void> unpackRow(Bytes& rest, std::vector<Rgbe>& row) {
    constexpr std::size_t kRun = 128; // and what is above counts
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t x = 0; x < row.size();) {
            if (rest.empty())
                return truncated();
            const bool isRun = rest[0] > kRun;
            const std::size_t count = isRun ? rest[0] - kRun : rest[0];
            rest = rest.subspan(1);
            if (count == 0 || count > row.size() - x)
                return malformed();
            if (rest.size() < (isRun ? 1 : count))
                return truncated();
            for (std::size_t i = 0; i < count; ++i)
                row[x++][channel] = rest[isRun ? 0 : i];
            rest = rest.subspan(isRun ? 1 : count);
        }
    return {};
}

Result<void> readRow(Bytes& rest, std::vector<Rgbe>& row) {
    constexpr std::size_t kMinPacked = 8, kMaxPacked = 32767;
    const bool canBePacked = row.size() >= kMinPacked && row.size() <= kMaxPacked;
    if (canBePacked && rest.size() >= 4 && rest[0] == 2 && rest[1] == 2 && rest[2] < 128) {
        if (std::size_t(rest[2] << 8 | rest[3]) != row.size())
            return malformed();
        rest = rest.subspan(4);
        return unpackRow(rest, row);
    }
    if (rest.size() < row.size() * sizeof(Rgbe))
        return truncated();
    for (Rgbe& texel : row) {
        std::copy_n(rest.begin(), texel.size(), texel.begin());
        rest = rest.subspan(texel.size());
    }
    return {};
}

/// Turns an image upside down.
void flipRows(ImageF& image) {
    const auto row = [&](std::uint32_t y) {
        return image.rgb.begin() + std::ptrdiff_t(y) * image.width;
    };
    for (std::uint32_t y = 0; y < image.height / 2; ++y)
        std::swap_ranges(row(y), row(y + 1), row(image.height - 1 - y));
}

} // namespace

bool isHdr(Bytes file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

Result<ImageF> decodeHdr(Bytes file, const MemoryBudget& memory) {
    std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    bool isRgbe = false;
    Correction correction;
    for (std::string_view line = takeLine(text); !line.empty(); line = takeLine(text)) {
        isRgbe = isRgbe || line == "FORMAT=32-bit_rle_rgbe";
        if (line == "FORMAT=32-bit_rle_xyze")
            return fail("HDR in CIE XYZ is not supported");
        if (const Result<void> read = correction.read(line); !read)
            return tl::make_unexpected(read.error());
    }
    std::string_view size = takeLine(text);
    if (size.size() > 1 && size[1] == 'X')
        return fail("HDR whose columns come one after another is not supported");
    Axis rows, columns;
    if (!isRgbe || !takeAxis(size, 'Y', '-', rows) || !takeAxis(size, 'X', '+', columns))
        return malformed();
    ImageF image;
    image.width = columns.texels;
    image.height = rows.texels;
    const std::uint64_t texels = std::uint64_t(image.width) * image.height;
    if (texels > kMaxTexels)
        return fail("too large");
    // A run of 127 equal bytes takes two bytes, in each of four channels.
    if (texels / 127 * 8 > text.size())
        return truncated();
    if (const Result<void> fits =
            memory.allow("the picture", texels * sizeof(glm::vec3) + image.width * sizeof(Rgbe));
        !fits)
        return tl::make_unexpected(fits.error());
    image.rgb.reserve(std::size_t(texels));
    std::vector<Rgbe> row(image.width);
    Bytes rest = file.last(text.size());
    for (std::uint32_t y = 0; y < image.height; ++y) {
        if (const Result<void> read = readRow(rest, row); !read)
            return tl::make_unexpected(read.error());
        if (columns.isReversed)
            std::ranges::reverse(row);
        for (const Rgbe& texel : row)
            image.rgb.emplace_back(glm::dvec3(colorOf(texel)) / correction.factor);
    }
    if (rows.isReversed)
        flipRows(image);
    return image;
}

} // namespace limn
