// SPDX-License-Identifier: MIT
#include "engine/runtime/transport_view.h"

#include "engine/runtime/xxhash64.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

namespace limn::runtime {

namespace {

constexpr char kMagic[8] = {'L', 'I', 'M', 'N', 'R', 'T', '\r', '\n'};
constexpr std::size_t kHeader = 64, kAlignment = 64;
constexpr std::uint32_t kMaxSections = 1024;

struct Header {
    char magic[8];
    std::uint32_t major, minor, sections, reserved;
    std::uint64_t bytes, tableHash;
    std::uint64_t zero[3];
};
static_assert(sizeof(Header) == kHeader);

/// An opened table of sections.
struct Table {
    const unsigned char* bytes;
    const SectionEntry* entries;
    std::uint32_t count;
    ErrorText error;

    bool fail(const char* tag, const char* what) const {
        if (error.size > 0)
            std::snprintf(error.text, error.size, "section %.4s: %s", tag, what);
        return false;
    }
    const SectionEntry* find(const char* tag) const {
        for (std::uint32_t k = 0; k < count; ++k)
            if (std::memcmp(entries[k].tag, tag, 4) == 0)
                return &entries[k];
        return nullptr;
    }
    /// Sets `out` to a section of `n` elements.
    template <class T>
    bool take(const char* tag, std::uint64_t elementSize, std::uint64_t n, const T*& out) const {
        const SectionEntry* entry = find(tag);
        if (!entry)
            return fail(tag, "missing");
        if (entry->elementSize != elementSize)
            return fail(tag, "another element size");
        if (entry->bytes / elementSize != n || entry->bytes % elementSize != 0)
            return fail(tag, "another length than DIMS has");
        out = reinterpret_cast<const T*>(bytes + entry->offset);
        return true;
    }
    /// Sets `out` to a section of bytes, however many.
    template <class Byte>
    bool takeBytes(const char* tag, const Byte*& out, std::size_t& size) const {
        static_assert(sizeof(Byte) == 1);
        const SectionEntry* entry = find(tag);
        if (!entry)
            return fail(tag, "missing");
        size = std::size_t(entry->bytes);
        out = reinterpret_cast<const Byte*>(bytes + entry->offset);
        return true;
    }
};

bool failWith(ErrorText error, const char* what) {
    if (error.size > 0)
        std::snprintf(error.text, error.size, "%s", what);
    return false;
}

bool isZstd(const void* bytes, std::size_t size) {
    return size >= 4 && std::memcmp(bytes, "\x28\xb5\x2f\xfd", 4) == 0;
}
bool isGzip(const void* bytes, std::size_t size) {
    return size >= 2 && std::memcmp(bytes, "\x1f\x8b", 2) == 0;
}

const char* headerDefect(const void* bytes, std::size_t size) {
    if (std::endian::native != std::endian::little)
        return "the file is little-endian and this machine is not";
    if (reinterpret_cast<std::uintptr_t>(bytes) % 16 != 0)
        return "the bytes are not aligned to 16";
    if (isZstd(bytes, size) || isGzip(bytes, size))
        return "the file is compressed: decompress it first";
    if (size < kHeader || std::memcmp(bytes, kMagic, sizeof kMagic) != 0)
        return "not a transport file of Limn";
    const auto& header = *static_cast<const Header*>(bytes);
    if (header.major != kMajor)
        return header.major > kMajor ? "a newer version, which this reader cannot read"
                                     : "an unknown version";
    if (header.bytes != size)
        return header.bytes > size ? "truncated" : "bytes follow the end of the file";
    if (header.sections > kMaxSections || (size - kHeader) / sizeof(SectionEntry) < header.sections)
        return "truncated in its table of sections";
    return nullptr;
}

bool openTable(const void* bytes, std::size_t size, bool skipHashes, Table& table) {
    if (const char* defect = headerDefect(bytes, size))
        return failWith(table.error, defect);
    const auto& header = *static_cast<const Header*>(bytes);
    table.bytes = static_cast<const unsigned char*>(bytes);
    table.entries = reinterpret_cast<const SectionEntry*>(table.bytes + kHeader);
    table.count = header.sections;
    if (!skipHashes &&
        xxhash64(table.entries, header.sections * sizeof(SectionEntry)) != header.tableHash)
        return failWith(table.error, "the table of sections is damaged");
    std::uint64_t end = kHeader + header.sections * sizeof(SectionEntry);
    for (std::uint32_t k = 0; k < table.count; ++k) {
        const SectionEntry& entry = table.entries[k];
        if (entry.offset % kAlignment != 0 || entry.offset < end || entry.offset > size ||
            entry.bytes > size - entry.offset)
            return table.fail(entry.tag, "lies outside of its place");
        end = entry.offset + entry.bytes;
        if (table.find(entry.tag) != &entry)
            return table.fail(entry.tag, "there are two");
        if (!skipHashes &&
            xxhash64(table.bytes + entry.offset, std::size_t(entry.bytes)) != entry.hash)
            return table.fail(entry.tag, "damaged: its hash does not match");
    }
    return true;
}

/// The numbers from which the lengths of all sections follow.
const char* dimsDefect(const Dims& d) {
    constexpr std::uint64_t kMost = 0xfffffff0;
    if (d.surfels == 0 || d.nodes() > kMost || d.caches > kMost)
        return "too many nodes or caches, or no surfel";
    if (d.innerNodes + std::uint64_t(1) != d.leaves())
        return "the tree has not one inner node less than leaves";
    if (d.lightmapCaches > d.caches)
        return "more lightmap caches than caches";
    if (d.bands < 2 || d.bands > kMaxBands || d.chromaBands < 1 || d.chromaBands > d.bands)
        return "bands out of range";
    if (d.lightmapWidth > 1 << 16 || d.lightmapHeight > 1 << 16)
        return "a lightmap that is too large";
    std::uint64_t cells = 1;
    for (const std::uint32_t side : d.grid) {
        if (side > 1 << 10)
            return "a grid that is too large";
        cells *= side;
    }
    if (cells != d.cells())
        return "the grid has not as many cells as caches";
    if (d.lightPoints > kMaxLightPoints)
        return "too many light points per surfel";
    if ((d.boxes == 0) != (d.triangles == 0))
        return "triangles without boxes, or boxes without triangles";
    return nullptr;
}

bool takeSenders(const Table& t, TransportView& v) {
    const Dims& d = v.dims;
    return t.take("SPOS", 12, d.surfels, v.surfelPosition) &&
           t.take("SNRM", 12, d.surfels, v.surfelNormal) &&
           t.take("SALB", 12, d.surfels, v.surfelAlbedo) &&
           t.take("SEMI", 12, d.surfels, v.surfelEmission) &&
           t.take("SARE", 4, d.surfels, v.surfelArea) &&
           t.take("SMAT", 4, d.surfels, v.surfelMaterial) &&
           t.take("SINS", 4, d.surfels, v.surfelInstance) &&
           t.take("SCAC", 16, d.surfels, v.surfelCache) &&
           t.take("SCWT", 16, d.surfels, v.surfelCacheWeight) &&
           t.take("TCHI", 8, d.innerNodes, v.child) &&
           t.take("TWGT", 4, d.innerNodes, v.leftWeight) &&
           t.take("SKYD", 12, d.skyCells, v.skyDirection) &&
           t.take("SKYL", 12, d.skyCells, v.skyRadiance);
}

/// Files of minor version 0 have no light points, and no section for them. Those of minor version 1
/// have no normals of light points.
bool takeLightPoints(const Table& t, TransportView& v) {
    const Dims& d = v.dims;
    v.lightPoint = v.surfelPosition;
    v.lightPointsEach = std::max(d.lightPoints, 1U);
    v.lightNormal = nullptr;
    if (d.lightPoints == 0 && !t.find("SLPT"))
        return true;
    const float* points = nullptr;
    if (!t.take("SLPT", 12, d.surfels * std::uint64_t(d.lightPoints), points))
        return false;
    const float* normals = nullptr;
    if (t.find("SLNM") && !t.take("SLNM", 12, d.surfels * std::uint64_t(d.lightPoints), normals))
        return false;
    if (d.lightPoints > 0) {
        v.lightPoint = points;
        v.lightNormal = normals;
    }
    return true;
}

bool takeReceivers(const Table& t, TransportView& v) {
    const Dims& d = v.dims;
    return t.take("CPOS", 12, d.caches, v.cachePosition) &&
           t.take("CNRM", 12, d.caches, v.cacheNormal) &&
           t.take("LBEG", 4, d.caches + std::uint64_t(1), v.linkBegin) &&
           t.take("LEXP", 1, d.caches, v.linkExponent) && t.take("LINK", 12, d.links, v.links) &&
           t.take("FBEG", 4, d.caches + std::uint64_t(1), v.fillBegin) &&
           t.take("FSRC", 4, d.fills, v.fillSource) && t.take("FWGT", 4, d.fills, v.fillWeight) &&
           t.take("LMBG", 4, d.texels() + 1, v.partBegin) &&
           t.take("LMSR", 4, d.lightmapParts, v.partCache) &&
           t.take("LMWT", 2, d.lightmapParts, v.partWeight) &&
           t.take("GDEP", 2 * kDepthTexels, d.cells(), v.gridDepth);
}

} // namespace

bool viewTransport(const void* bytes, std::size_t size, bool skipHashes, TransportView& view,
                   ErrorText error) {
    Table table{nullptr, nullptr, 0, error};
    const Dims* dims = nullptr;
    if (!openTable(bytes, size, skipHashes, table))
        return false;
    const SectionEntry* entry = table.find("DIMS");
    if (!entry || entry->elementSize != 4 || entry->bytes != sizeof(Dims))
        return table.fail("DIMS", "missing, or of another length");
    dims = reinterpret_cast<const Dims*>(table.bytes + entry->offset);
    if (const char* defect = dimsDefect(*dims))
        return table.fail("DIMS", defect);
    view.sections = table.entries;
    view.sectionCount = table.count;
    view.minor = static_cast<const Header*>(bytes)->minor;
    view.dims = *dims;
    return takeSenders(table, view) && takeLightPoints(table, view) && takeReceivers(table, view) &&
           table.take("SPAC", sizeof(Space), 1, view.space) &&
           table.take("OBOX", sizeof(Box), dims->boxes, view.boxes) &&
           table.take("OTRI", 36, dims->triangles, view.triangles) &&
           table.take("OCUT", 4, dims->triangles, view.cutout) &&
           table.take("CTRI", sizeof(Cutout), dims->cutouts, view.cutouts) &&
           table.take("CMSK", sizeof(Mask), dims->masks, view.masks) &&
           table.takeBytes("CTEX", view.maskTexels, view.maskTexelCount) &&
           table.take("LGHT", sizeof(limnrt_light), dims->lights, view.lights) &&
           table.takeBytes("MNAM", view.names, view.nameBytes) &&
           table.takeBytes("META", view.meta, view.metaBytes) && checkContents(view, error);
}

} // namespace limn::runtime
