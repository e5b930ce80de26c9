// SPDX-License-Identifier: MIT
#include "engine/export/packed_transport.h"

#include "engine/techniques/illuminance/transport/transport_sections.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include <zlib.h>

namespace limn {

namespace {

constexpr int kLevel = 7, kQuickLevel = 1; // of zlib

/// Words of a section's elements: their bytes, and whether each is stored as its difference to the
/// element before.
constexpr std::size_t kMaxWords = 16;
constexpr std::uint8_t kDifference = 0x80;
using Words = std::array<std::uint8_t, kMaxWords>; // ended by a 0 where there are fewer

struct PackedHeader {
    char magic[8] = {'L', 'I', 'M', 'N', 'P', 'K', '\r', '\n'};
    std::uint32_t version = 1, sections = 0;
    std::uint64_t bytes = 0; ///< of the unpacked file
};
static_assert(sizeof(PackedHeader) == 24);

Result<std::string> deflated(std::string_view bytes, int level) {
    constexpr int kGzip = 16, kWindow = 15, kMemory = 9;
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, kGzip + kWindow, kMemory, Z_DEFAULT_STRATEGY) !=
        Z_OK)
        return fail("out of memory");
    std::string out;
    std::vector<char> block(1 << 20);
    int state = Z_OK;
    while (state == Z_OK) {
        const std::size_t part = std::min(bytes.size(), std::size_t(1) << 30);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        stream.avail_in = uInt(part);
        const bool last = part == bytes.size();
        do {
            stream.next_out = reinterpret_cast<Bytef*>(block.data());
            stream.avail_out = uInt(block.size());
            state = deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
            out.append(block.data(), block.size() - stream.avail_out);
        } while (stream.avail_out == 0 && state == Z_OK);
        bytes.remove_prefix(part);
    }
    deflateEnd(&stream);
    return out;
}

/// The words of a section's elements, all without differences.
Words wordsOf(const TransportEntry& entry) {
    Words words{};
    if (std::string_view(entry.tag, sizeof entry.tag) == "LINK")
        return {4, 2, 2, 2, 2};
    const std::uint8_t word = std::uint8_t(entry.elementSize % 4 == 0 && entry.elementSize < 256 ? 4
                                           : entry.elementSize % 2 == 0                          ? 2
                                                                        : 1);
    const std::size_t count = entry.elementSize / word;
    std::fill_n(words.begin(), count <= kMaxWords ? count : 1, word); // else an array of words
    return words;
}

std::size_t elementBytes(const Words& words) {
    std::size_t sum = 0;
    for (const std::uint8_t word : words)
        sum += word & ~kDifference;
    return sum;
}

std::uint32_t wordAt(const char* bytes, std::size_t size) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, size);
    return word;
}

/// Appends the planes of a word that begins at `first` of every element: the lowest byte of all
/// elements, then the next one. `part`: elements.
void addPlanes(std::string& out, std::string_view section, std::size_t first, std::size_t element,
               std::uint8_t word, std::size_t part) {
    const std::size_t size = word & ~kDifference, begin = out.size();
    out.resize(begin + size * part);
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < part; ++k) {
        const std::uint32_t value = wordAt(section.data() + k * element + first, size);
        const std::uint32_t stored = (word & kDifference) != 0 ? value - before : value;
        before = value;
        for (std::size_t b = 0; b < size; ++b)
            out[begin + b * part + k] = char(stored >> (8 * b));
    }
}

/// Whether differences compress better, by the section's begin.
bool differencesPay(std::string_view section, std::size_t first, std::size_t element,
                    std::uint8_t word) {
    const std::size_t part = std::min(section.size() / element, std::size_t(1) << 17);
    std::string plain, differences;
    addPlanes(plain, section, first, element, word, part);
    addPlanes(differences, section, first, element, word | kDifference, part);
    const Result<std::string> a = deflated(plain, kQuickLevel),
                              b = deflated(differences, kQuickLevel);
    return a && b && b->size() < a->size();
}

} // namespace

Result<std::string> gzip(std::string_view bytes) {
    return deflated(bytes, kLevel);
}

Result<std::string> packTransport(std::string_view file) {
    const std::vector<TransportEntry> table = transportTable(file);
    PackedHeader header;
    header.sections = std::uint32_t(table.size());
    header.bytes = file.size();
    std::string head(reinterpret_cast<const char*>(&header), sizeof header), body;
    head += file.substr(0, kTransportHeaderBytes + table.size() * sizeof(TransportEntry));
    body.reserve(file.size());
    for (const TransportEntry& entry : table) {
        const std::string_view section =
            file.substr(std::size_t(entry.offset), std::size_t(entry.bytes));
        Words words = wordsOf(entry);
        const std::size_t element = elementBytes(words);
        std::size_t first = 0;
        for (std::size_t k = 0; k < kMaxWords && words[k] != 0; ++k) {
            const std::uint8_t size = words[k];
            if (differencesPay(section, first, element, size))
                words[k] |= kDifference;
            addPlanes(body, section, first, element, words[k], section.size() / element);
            first += size;
        }
        head.append(reinterpret_cast<const char*>(words.data()), words.size());
    }
    return gzip(head + body);
}

} // namespace limn
