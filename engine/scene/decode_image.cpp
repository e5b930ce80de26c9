// SPDX-License-Identifier: MIT
#include "engine/scene/decode_image.h"

#include "engine/scene/ktx2_image.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <spng.h>
#include <turbojpeg.h>
#include <webp/decode.h>

namespace limn {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};

/// Upper limit for any image: deflate packs 1032 bytes into one, each with eight black or white
/// texels.
constexpr std::uint64_t kMaxTexelsPerByte = 8 * 1032;

bool startsWith(Bytes bytes, Bytes signature) {
    return bytes.size() >= signature.size() &&
           std::ranges::equal(bytes.first(signature.size()), signature);
}

bool isWebp(Bytes bytes) {
    static constexpr std::array<std::uint8_t, 4> kRiff = {'R', 'I', 'F', 'F'},
                                                 kWebp = {'W', 'E', 'B', 'P'};
    return bytes.size() >= 12 && startsWith(bytes, kRiff) && startsWith(bytes.subspan(8), kWebp);
}

/// One PNG in memory. Wrong checksums are accepted, and the file's colour metadata is ignored, as
/// glTF requires.
class PngReader {
public:
    explicit PngReader(Bytes bytes) : m_png(spng_ctx_new(SPNG_CTX_IGNORE_ADLER32)) {
        constexpr std::size_t kMaxText = std::size_t(1) << 26; // and profiles, unpacked
        spng_set_crc_action(m_png.get(), SPNG_CRC_USE, SPNG_CRC_USE);
        spng_set_chunk_limits(m_png.get(), kMaxText, kMaxText);
        spng_set_png_buffer(m_png.get(), bytes.data(), bytes.size());
    }

    std::optional<ImageSize> size() const {
        spng_ihdr header;
        if (spng_get_ihdr(m_png.get(), &header) != 0)
            return {};
        return ImageSize{header.width, header.height};
    }
    /// Reads the texels; `rgba` must have the image's size.
    bool read(std::vector<std::uint8_t>& rgba) {
        return spng_decode_image(m_png.get(), rgba.data(), rgba.size(), SPNG_FMT_RGBA8,
                                 SPNG_DECODE_TRNS) == 0;
    }

private:
    struct Free {
        void operator()(spng_ctx* png) const { spng_ctx_free(png); }
    };
    std::unique_ptr<spng_ctx, Free> m_png;
};

/// One JPEG in memory.
class JpegReader {
public:
    explicit JpegReader(Bytes bytes) : m_bytes(bytes), m_jpeg(tjInitDecompress()) {}

    std::optional<ImageSize> size() const {
        const std::optional<Header> header = readHeader();
        if (!header)
            return {};
        return ImageSize{std::uint32_t(header->width), std::uint32_t(header->height)};
    }
    /// Reads the texels; `rgba` must have the image's size. Parts missing at the end of a truncated
    /// file are grey. Four inks become the colour that they leave of white.
    bool read(std::vector<std::uint8_t>& rgba) {
        constexpr int kAsInFile = 0; // width, bytes of a row, height
        const bool hasInks = isOfInks();
        if (tjDecompress2(m_jpeg.get(), m_bytes.data(), m_bytes.size(), rgba.data(), kAsInFile,
                          kAsInFile, kAsInFile, hasInks ? TJPF_CMYK : TJPF_RGBA,
                          TJFLAG_LIMITSCANS) != 0 &&
            tjGetErrorCode(m_jpeg.get()) != TJERR_WARNING)
            return false;
        if (hasInks)
            colorsOfInks(rgba);
        return true;
    }

private:
    struct Header {
        int width = 0, height = 0, sampling = 0, colors = 0;
    };
    std::optional<Header> readHeader() const {
        Header h;
        if (tjDecompressHeader3(m_jpeg.get(), m_bytes.data(), m_bytes.size(), &h.width, &h.height,
                                &h.sampling, &h.colors) != 0)
            return {};
        return h;
    }
    bool isOfInks() const {
        const std::optional<Header> header = readHeader();
        return header && (header->colors == TJCS_CMYK || header->colors == TJCS_YCCK);
    }
    /// Adobe's programs, whose marker their files have, store the paper that inks leave.
    void colorsOfInks(std::vector<std::uint8_t>& inks) const {
        static constexpr std::array<std::uint8_t, 5> kAdobe = {'A', 'd', 'o', 'b', 'e'};
        const Bytes header = m_bytes.first(std::min<std::size_t>(m_bytes.size(), 1 << 16));
        const std::uint32_t flip = std::ranges::search(header, kAdobe).empty() ? 255 : 0;
        for (std::size_t k = 0; k + 3 < inks.size(); k += 4) {
            const std::uint32_t black = inks[k + 3] ^ flip;
            for (std::size_t c = 0; c < 3; ++c)
                inks[k + c] = std::uint8_t(((inks[k + c] ^ flip) * black + 127) / 255);
            inks[k + 3] = 255;
        }
    }
    struct Free {
        void operator()(void* jpeg) const { tjDestroy(jpeg); }
    };
    Bytes m_bytes;
    std::unique_ptr<void, Free> m_jpeg;
};

/// One WebP in memory, of which only still ones are read.
class WebpReader {
public:
    explicit WebpReader(Bytes bytes) : m_bytes(bytes) {}

    std::optional<ImageSize> size() const {
        WebPBitstreamFeatures features;
        if (WebPGetFeatures(m_bytes.data(), m_bytes.size(), &features) != VP8_STATUS_OK ||
            features.has_animation)
            return {};
        return ImageSize{std::uint32_t(features.width), std::uint32_t(features.height)};
    }
    bool read(std::vector<std::uint8_t>& rgba) {
        const std::optional<ImageSize> texels = size();
        return texels && WebPDecodeRGBAInto(m_bytes.data(), m_bytes.size(), rgba.data(),
                                            rgba.size(), int(4 * texels->width));
    }

private:
    Bytes m_bytes;
};

/// One KTX2 in memory whose header was read.
class Ktx2Reader {
public:
    explicit Ktx2Reader(const Ktx2Picture& picture) : m_picture(picture) {}

    std::optional<ImageSize> size() const { return m_picture.size; }
    bool read(std::vector<std::uint8_t>& rgba) { return decodeKtx2Picture(m_picture, rgba); }

private:
    Ktx2Picture m_picture;
};

template <class Reader>
Result<ImageSize> checkedSize(const Reader& reader, Bytes bytes) {
    const std::optional<ImageSize> size = reader.size();
    if (!size)
        return fail("is damaged");
    const std::uint64_t texels = std::uint64_t(size->width) * size->height;
    if (texels > kMaxTexels)
        return fail("is too large");
    if (texels / kMaxTexelsPerByte > bytes.size())
        return fail("is damaged"); // cut short: all of it would be filled in
    return *size;
}

template <class Reader>
Result<Image> decodeWith(Reader reader, Bytes bytes) {
    const Result<ImageSize> size = checkedSize(reader, bytes);
    if (!size)
        return tl::make_unexpected(size.error());
    Image image;
    image.width = size->width;
    image.height = size->height;
    image.rgba.resize(std::size_t(4) * size->width * size->height);
    if (!reader.read(image.rgba))
        return fail("is damaged");
    return image;
}

/// Calls use(reader) with the reader for the format identified by the first bytes.
template <class T, class Use>
Result<T> readBy(Bytes bytes, const Use& use) {
    if (bytes.empty())
        return fail("is missing");
    if (startsWith(bytes, kPng))
        return use(PngReader(bytes));
    if (startsWith(bytes, kJpeg))
        return use(JpegReader(bytes));
    if (isWebp(bytes))
        return use(WebpReader(bytes));
    if (isKtx2(bytes)) {
        const Result<Ktx2Picture> picture = readKtx2Picture(bytes);
        if (!picture)
            return tl::make_unexpected(picture.error());
        return use(Ktx2Reader(*picture));
    }
    return fail("is neither PNG, JPEG, WebP nor KTX2");
}

} // namespace

Result<ImageSize> imageSize(Bytes bytes) {
    return readBy<ImageSize>(bytes, [&](const auto& reader) { return checkedSize(reader, bytes); });
}

Result<Image> decodeImage(Bytes bytes) {
    return readBy<Image>(bytes, [&](auto reader) { return decodeWith(std::move(reader), bytes); });
}

} // namespace limn
