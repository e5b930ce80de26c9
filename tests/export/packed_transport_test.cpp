// SPDX-License-Identifier: MIT
#include "engine/export/packed_transport.h"

#include "engine/techniques/illuminance/transport/transport_sections.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include <zlib.h>

namespace limn::packed_transport_test {
namespace {

std::string gunzip(const std::string& bytes, std::size_t size) {
    std::string out(size, '\0');
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 16 + 15), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = uInt(size);
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(size - stream.avail_out);
    inflateEnd(&stream);
    return out;
}

template <class T>
T numberAt(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// A reader written from docs/transport-format.md alone.
std::string unpacked(const std::string& packed, std::size_t enough) {
    const std::string body = gunzip(packed, enough);
    EXPECT_EQ(body.substr(0, 8), "LIMNPK\r\n");
    EXPECT_EQ(numberAt<std::uint32_t>(body, 8), 1U);
    const auto sections = numberAt<std::uint32_t>(body, 12);
    const auto size = numberAt<std::uint64_t>(body, 16);
    std::string file(size, '\0');
    const std::size_t table = 64 + 32 * std::size_t(sections);
    file.replace(0, table, body, 24, table);
    std::size_t from = 24 + table + 16 * std::size_t(sections);
    for (std::size_t k = 0; k < sections; ++k) {
        const auto offset = numberAt<std::uint64_t>(file, 64 + 32 * k + 8);
        const auto bytes = numberAt<std::uint64_t>(file, 64 + 32 * k + 16);
        const std::string words = body.substr(24 + table + 16 * k, 16);
        std::size_t element = 0;
        for (const char word : words)
            element += std::size_t(word & 0x7f);
        const std::size_t count = bytes / element;
        std::size_t first = offset;
        for (const char word : words) {
            const auto width = std::size_t(word & 0x7f);
            std::uint32_t sum = 0;
            for (std::size_t i = 0; i < count; ++i) {
                std::uint32_t value = 0;
                for (std::size_t b = 0; b < width; ++b)
                    value |= std::uint32_t(std::uint8_t(body[from + b * count + i])) << (8 * b);
                sum = (word & 0x80) != 0 ? sum + value : value;
                for (std::size_t b = 0; b < width; ++b)
                    file[first + i * element + b] = char(sum >> (8 * b));
            }
            from += width * count;
            first += width;
        }
    }
    EXPECT_EQ(from, body.size());
    return file;
}

/// Sections of every width: numbers that grow, noise, and none at all.
std::string someFile() {
    std::mt19937 random(3);
    std::vector<std::uint32_t> growing;
    std::vector<std::uint16_t> noise;
    std::vector<std::array<std::uint8_t, 12>> links(5000);
    for (std::uint32_t k = 0; k < 20000; ++k) {
        growing.push_back(1000 * k + std::uint32_t(random() % 7));
        noise.push_back(std::uint16_t(random()));
    }
    for (auto& link : links)
        for (std::uint8_t& byte : link)
            byte = std::uint8_t(random() % 16);
    TransportSections sections;
    sections.addBytes("META", 1, "{}!");
    sections.add("LBEG", growing);
    sections.add("LMWT", noise);
    sections.add("LINK", links);
    sections.addBytes("LGHT", 80, std::string(160, 'x'));
    sections.addBytes("GDEP", 512, std::string(1024, 'y'));
    sections.addBytes("CTEX", 1, "");
    return sections.file();
}

TEST(PackedTransport, UnpacksToTheSameBytes) {
    const std::string file = someFile();
    const Result<std::string> packed = packTransport(file);
    ASSERT_TRUE(packed) << packed.error().message;
    EXPECT_EQ(unpacked(*packed, 2 * file.size()), file);
}

TEST(PackedTransport, IsSmallerThanWhatServersMakeOfTheFile) {
    const std::string file = someFile();
    const Result<std::string> packed = packTransport(file), plain = gzip(file);
    ASSERT_TRUE(packed && plain);
    EXPECT_LT(packed->size(), 0.8 * double(plain->size()));
}

TEST(PackedTransport, GzipExpandsToTheSameBytes) {
    for (const std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(3) << 20}) {
        std::string bytes(size, 'a');
        std::mt19937 random(1);
        for (char& byte : bytes)
            byte = char(random());
        const Result<std::string> packed = gzip(bytes);
        ASSERT_TRUE(packed);
        EXPECT_EQ(gunzip(*packed, size + 1), bytes);
    }
}

} // namespace
} // namespace limn::packed_transport_test
