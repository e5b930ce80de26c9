// SPDX-License-Identifier: MIT
#include "engine/files/exr_check.h"
#include "engine/files/image_file.h"

#include "tests/gltf/gltf_builder.h"

#include <gtest/gtest.h>

namespace limn::exr_check_test {
namespace {

/// An EXR 4 texels wide, of three chunks if it has 40 lines, to be harmed.
struct ExrBytes {
    std::string bytes;
    std::size_t table = 0; ///< where the chunks' offsets are

    ExrBytes() : ExrBytes(40) {}
    explicit ExrBytes(std::uint32_t lines) {
        const TemporaryFolder folder;
        EXPECT_TRUE(writeExr(folder.file("i.exr"),
                             {4, lines, std::vector<glm::vec3>(4UL * lines, {1, 2, 3})}));
        bytes = fileBytes(folder.file("i.exr"));
        // The first chunk follows the table of offsets.
        const std::size_t chunks = (lines + 15) / 16;
        while (table + 8 < bytes.size() && get<std::uint64_t>(table) != table + 8 * chunks)
            ++table;
    }
    template <class T>
    T get(std::size_t at) const {
        T value;
        std::memcpy(&value, &bytes[at], sizeof value);
        return value;
    }
    template <class T>
    void put(std::size_t at, T value) {
        std::memcpy(&bytes[at], &value, sizeof value);
    }
    /// Where the value of an attribute begins.
    std::size_t value(const std::string& name, const std::string& type) const {
        const std::string key = name + '\0' + type + '\0';
        return bytes.find(key) + key.size() + 4;
    }
    std::size_t chunk(std::size_t i) const {
        return std::size_t(get<std::uint64_t>(table + 8 * i));
    }
    std::string problem() const {
        const Result<ExrSize> result =
            checkExr({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        return result ? "" : result.error().message;
    }
};

TEST(ExrCheck, AcceptsWhatIsWritten) {
    EXPECT_EQ(ExrBytes().problem(), "");
}

TEST(ExrCheck, ChunksMustLieInTheFile) {
    ExrBytes exr;
    exr.put<std::uint64_t>(exr.table + 8, ~std::uint64_t(3)); // plus 8 it wraps round to the header
    EXPECT_EQ(exr.problem(), "chunk 1: lies outside the file");
    exr = {};
    exr.put<std::uint64_t>(exr.table, exr.bytes.size() - 7);
    EXPECT_EQ(exr.problem(), "chunk 0: lies outside the file");
    for (const std::int32_t size : {0, -1, 1 << 30}) {
        exr = {};
        exr.put<std::int32_t>(exr.chunk(2) + 4, size);
        EXPECT_EQ(exr.problem(), "chunk 2: lies outside the file") << size;
    }
    exr = {};
    exr.bytes.pop_back();
    EXPECT_EQ(exr.problem(), "chunk 2: lies outside the file");
}

// A file of 19 kB whose chunks all reached to its end took 77 s to unpack.
TEST(ExrCheck, ChunksMustNotShareTheirBytes) {
    ExrBytes exr(1600);
    EXPECT_EQ(exr.problem(), "");
    for (std::size_t i = 0; i < 100; ++i)
        exr.put(exr.chunk(i) + 4, std::int32_t(exr.bytes.size() - exr.chunk(i) - 8));
    EXPECT_NE(exr.problem().find("shares bytes with others"), std::string::npos) << exr.problem();
}

TEST(ExrCheck, ChunksMustNotBeShorterThanTheirLinesCanBePacked) {
    ExrBytes exr;
    const std::size_t window = exr.value("dataWindow", "box2i");
    exr.put<std::int32_t>(window + 8, 100000 - 1); // 100 000 texels wide
    EXPECT_EQ(exr.problem(), "chunk 0: too short for its lines");
}

TEST(ExrCheck, TablesOfPizMustLieInTheirChunk) {
    ExrBytes exr;
    exr.put<std::uint8_t>(exr.value("compression", "compression"), 4); // chunks of 32 lines
    exr.put<std::int32_t>(exr.chunk(1), 32);
    const std::size_t first = exr.chunk(0) + 8;
    exr.put<std::uint16_t>(first, 0);
    exr.put<std::uint16_t>(first + 2, 8191); // a bitmap of 8 192 bytes, which is not there
    EXPECT_EQ(exr.problem(), "chunk 0: codes: exceed the chunk");
    exr.put<std::uint16_t>(first + 2, 8192);
    EXPECT_EQ(exr.problem(), "chunk 0: values: out of range");
    exr.put<std::uint16_t>(first, 1);
    exr.put<std::uint16_t>(first + 2, 0); // no bitmap
    exr.put<std::int32_t>(first + 4, 20);
    exr.put<std::uint32_t>(first + 8, 70000); // no such code
    EXPECT_EQ(exr.problem(), "chunk 0: codes: malformed");
}

TEST(ExrCheck, ChunksMustBeTheWindowsBlocksOfLines) {
    for (const std::int32_t line : {-16, 8, 48, 16}) { // the last is chunk 1's
        ExrBytes exr;
        exr.put<std::int32_t>(exr.chunk(2), line);
        EXPECT_EQ(exr.problem(), "chunk 2: wrong line") << line;
    }
}

TEST(ExrCheck, WindowsCompressionAndChannelsMustBeUsable) {
    ExrBytes exr;
    const std::size_t window = exr.value("dataWindow", "box2i");
    exr.put<std::int32_t>(window + 8, -1);
    EXPECT_EQ(exr.problem().find("dataWindow: 0 x 40"), 0u) << exr.problem();
    exr.put<std::int32_t>(window + 8, 1 << 30);
    EXPECT_EQ(exr.problem().find("dataWindow"), 0u);
    exr = {};
    exr.bytes[exr.value("compression", "compression")] = 9;
    EXPECT_EQ(exr.problem().find("compression"), 0u);
    exr = {};
    exr.put<std::int32_t>(exr.value("channels", "chlist") + 2 + 8, 2); // B's horizontal sampling
    EXPECT_EQ(exr.problem(), "channels: subsampled channels are not supported");
    exr = {};
    exr.put<std::int32_t>(exr.value("channels", "chlist") + 2, 3);
    EXPECT_EQ(exr.problem(), "channels: malformed");
    exr = {};
    exr.put<std::int32_t>(exr.value("channels", "chlist") - 4, 1 << 30);
    EXPECT_EQ(exr.problem(), "channels: exceeds the file");
}

TEST(ExrCheck, OnlySinglePartScanLinesAreTaken) {
    for (const std::uint32_t flag : {0x200u, 0x800u, 0x1000u, 0x80000u}) {
        ExrBytes exr;
        exr.put<std::uint32_t>(4, 2 | flag);
        EXPECT_EQ(exr.problem(), "tiled, deep and multipart EXR are not supported");
    }
    ExrBytes exr;
    exr.put<std::uint32_t>(4, 3);
    EXPECT_EQ(exr.problem(), "EXR version 3 is not supported");
    exr.bytes.clear();
    EXPECT_EQ(exr.problem(), "no EXR file");
}

} // namespace
} // namespace limn::exr_check_test
