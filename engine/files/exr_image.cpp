// SPDX-License-Identifier: MIT
#include "engine/files/exr_image.h"

#include "engine/files/exr_color.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

namespace {

using Imath::Box2i;
using Bytes = std::span<const std::uint8_t>;
using Channels = std::array<std::string, 3>; ///< the names of red, green and blue

/// A file in memory.
class Input final : public Imf::IStream {
public:
    explicit Input(Bytes file) : IStream("OpenEXR"), m_file(file) {}

    bool read(char out[], int count) override {
        const auto size = std::size_t(std::max(count, 0));
        if (m_position > m_file.size() || size > m_file.size() - m_position)
            throw std::runtime_error("the file ends too soon");
        std::memcpy(out, m_file.data() + m_position, size);
        m_position += size;
        return m_position < m_file.size();
    }
    std::uint64_t tellg() override { return m_position; }
    void seekg(std::uint64_t position) override { m_position = position; }

private:
    Bytes m_file;
    std::uint64_t m_position = 0;
};

class Output final : public Imf::OStream {
public:
    Output() : OStream("OpenEXR") {}

    void write(const char bytes[], int count) override {
        const auto size = std::size_t(count);
        file.resize(std::max(file.size(), m_position + size));
        std::memcpy(&file[m_position], bytes, size);
        m_position += size;
    }
    std::uint64_t tellp() override { return m_position; }
    void seekp(std::uint64_t position) override { m_position = position; }

    std::string file;

private:
    std::uint64_t m_position = 0;
};

struct Size {
    std::uint64_t width = 0, height = 0; ///< [pixels]

    explicit Size(const Box2i& window)
        : width(std::uint64_t(std::int64_t(window.max.x) - window.min.x + 1)),
          height(std::uint64_t(std::int64_t(window.max.y) - window.min.y + 1)) {}
    std::uint64_t pixels() const { return width * height; }
};

/// The most bytes of pixels that a byte of the file can hold.
std::uint64_t mostExpansion(Imf::Compression compression) {
    constexpr std::uint64_t kZip = 1032, kRuns = 64; // deflate; two bytes for a run of 128
    switch (compression) {
    case Imf::NO_COMPRESSION:
        return 1;
    case Imf::RLE_COMPRESSION:
        return kRuns;
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
        return 11; // three bytes for 16 halfs
    case Imf::PIZ_COMPRESSION:
        return 512; // a code of one bit, and eight for a run of 255 halfs
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
        return kZip;
    default:
        return kRuns * kZip; // DWA: runs, deflated
    }
}

Result<Channels> colorChannels(const Imf::ChannelList& list) {
    Channels names = {"R", "G", "B"};
    if (!list.findChannel("R") && !list.findChannel("G") && !list.findChannel("B") &&
        list.findChannel("Y") && !list.findChannel("RY") && !list.findChannel("BY"))
        names = {"Y", "Y", "Y"};
    for (const std::string& name : names) {
        const Imf::Channel* channel = list.findChannel(name);
        if (!channel) {
            std::vector<std::string> present;
            for (auto c = list.begin(); c != list.end() && present.size() < 8; ++c)
                present.emplace_back(c.name());
            return fail(
                fmt::format("channels: there is no {}, only {}", name, fmt::join(present, ", ")));
        }
        if (channel->type == Imf::UINT)
            return fail(fmt::format("channels: {} holds integers", name));
        if (channel->xSampling != 1 || channel->ySampling != 1)
            return fail(fmt::format("channels: {} is subsampled, which is not supported", name));
    }
    return names;
}

std::uint64_t bytesPerPixel(const Imf::ChannelList& list) {
    std::uint64_t bytes = 0;
    for (auto c = list.begin(); c != list.end(); ++c)
        bytes += c.channel().type == Imf::HALF ? 2 : 4;
    return bytes;
}

/// What decoding takes: the image, that of the data window where it is another, and the library's
/// blocks.
Result<void> fits(const Imf::Header& header, std::size_t fileBytes, const MemoryBudget& memory) {
    const Size data(header.dataWindow()), display(header.displayWindow());
    const std::uint64_t pixel = bytesPerPixel(header.channels());
    constexpr std::uint64_t kMostLines = 256; // of a block, which DWAB has
    const std::uint64_t lines =
        header.hasTileDescription() ? header.tileDescription().ySize : kMostLines;
    std::uint64_t needed = 2 * data.width * std::min(lines, data.height) * pixel;
    if (header.hasTileDescription())
        needed += std::uint64_t(header.tileDescription().xSize) * lines * pixel;
    needed += data.pixels() * sizeof(glm::vec3);
    if (header.dataWindow() != header.displayWindow())
        needed += display.pixels() * sizeof(glm::vec3);
    if (const Result<void> allowed = memory.allow("the picture", needed); !allowed)
        return allowed;
    if (data.pixels() * pixel / mostExpansion(header.compression()) > fileBytes)
        return fail(fmt::format("dataWindow: {} x {} pixels cannot be packed into {} bytes",
                                data.width, data.height, fileBytes));
    return {};
}

/// The part of `data` that lies in the display window, and black around it.
ImageF inDisplayWindow(const ImageF& data, const Box2i& dataWindow, const Box2i& displayWindow) {
    const Size size(displayWindow);
    ImageF out{std::uint32_t(size.width), std::uint32_t(size.height), {}};
    out.rgb.resize(size.pixels());
    const std::int64_t left = std::max(dataWindow.min.x, displayWindow.min.x),
                       right = std::min(dataWindow.max.x, displayWindow.max.x) + std::int64_t(1);
    for (std::int64_t y = std::max(dataWindow.min.y, displayWindow.min.y);
         y <= std::min(dataWindow.max.y, displayWindow.max.y) && left < right; ++y) {
        const auto from =
            data.rgb.begin() + (y - dataWindow.min.y) * data.width + (left - dataWindow.min.x);
        std::copy(from, from + (right - left),
                  out.rgb.begin() + (y - displayWindow.min.y) * out.width +
                      (left - displayWindow.min.x));
    }
    return out;
}

Result<ImageF> readPart(Imf::MultiPartInputFile& file, int index, const Channels& names,
                        std::size_t fileBytes, const MemoryBudget& memory) {
    const Imf::Header& header = file.header(index);
    if (const Result<void> allowed = fits(header, fileBytes, memory); !allowed)
        return tl::make_unexpected(allowed.error());
    const Box2i window = header.dataWindow();
    const Size size(window);
    ImageF image{std::uint32_t(size.width), std::uint32_t(size.height), {}};
    image.rgb.resize(size.pixels());

    Imf::FrameBuffer pixels;
    for (std::size_t c = 0; c < (names[0] == "Y" ? 1 : 3); ++c)
        pixels.insert(names[c],
                      Imf::Slice::Make(Imf::FLOAT, &image.rgb[0][int(c)], window, sizeof(glm::vec3),
                                       sizeof(glm::vec3) * image.width));
    Imf::InputPart part(file, index);
    part.setFrameBuffer(pixels);
    part.readPixels(window.min.y, window.max.y);

    if (names[0] == "Y")
        for (glm::vec3& rgb : image.rgb)
            rgb = glm::vec3(rgb.x);
    else if (Imf::hasChromaticities(header))
        if (const Result<void> converted = toRec709(image, Imf::chromaticities(header)); !converted)
            return tl::make_unexpected(converted.error());
    if (window != header.displayWindow())
        return inDisplayWindow(image, window, header.displayWindow());
    return image;
}

} // namespace

bool isExr(Bytes file) {
    constexpr std::array<std::uint8_t, 4> kMagic = {0x76, 0x2f, 0x31, 0x01};
    return file.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), file.begin());
}

Result<ImageF> decodeExr(Bytes bytes, const MemoryBudget& memory) {
    try {
        Input input(bytes);
        Imf::MultiPartInputFile file(input, 0, false);
        std::optional<Error> problem;
        for (int i = 0; i < file.parts(); ++i) {
            if (file.header(i).hasType() && Imf::isDeepData(file.header(i).type()))
                continue;
            const Result<Channels> names = colorChannels(file.header(i).channels());
            if (names)
                return readPart(file, i, *names, bytes.size(), memory);
            if (!problem)
                problem = names.error();
        }
        return problem ? tl::make_unexpected(*problem)
                       : fail("type: deep pixels are not supported");
    } catch (const std::exception& e) {
        return fail(fmt::format("damaged EXR: {}", e.what()));
    }
}

Result<std::string> encodeExr(const ImageF& image) {
    if (image.width == 0 || image.height == 0)
        return fail("the image is empty");
    try {
        Imf::Header header(int(image.width), int(image.height));
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::FrameBuffer pixels;
        const Box2i window = header.dataWindow();
        for (int c = 0; c < 3; ++c) {
            const std::string name(1, "RGB"[c]);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            pixels.insert(name,
                          Imf::Slice::Make(Imf::FLOAT, &image.rgb[0][c], window, sizeof(glm::vec3),
                                           sizeof(glm::vec3) * image.width));
        }
        Output out;
        {
            Imf::OutputFile file(out, header, 0); // writes where chunks are when it is closed
            file.setFrameBuffer(pixels);
            file.writePixels(int(image.height));
        }
        return std::move(out.file);
    } catch (const std::exception& e) {
        return fail(fmt::format("cannot encode EXR: {}", e.what()));
    }
}

} // namespace limn
