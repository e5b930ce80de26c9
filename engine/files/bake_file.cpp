// SPDX-License-Identifier: MIT
#include "engine/files/bake_file.h"

#include "engine/bake/grid_depth.h"
#include "engine/bake/stage_archive.h"
#include "engine/core/archive.h"
#include "engine/core/hash.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <fmt/format.h>
#include <zstd.h>

// File: "LIMNBAKE", u32 version, u32 chunk count, then per chunk:
//   char[8] name, u64 bytes unpacked, u64 bytes packed, u64 XXH3 of the packed bytes, packed bytes
//   (zstd).
// Little-endian; numbers and arrays as in memory: an array is a u64 count and its elements.

namespace limn {

namespace {

constexpr char kMagic[8] = {'L', 'I', 'M', 'N', 'B', 'A', 'K', 'E'};
constexpr std::uint32_t kVersion = 5;
constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 36; // per chunk, unpacked: more is damage

template <class A, class B>
void settingsFields(A& a, B& b) {
    auto& s = b.settings;
    a(s.surfels), a(s.links), a(s.bands), a(s.rays), a(s.lightmapCaches), a(s.texelsPerMetre);
    a(s.placement), a(s.linker), a(s.cut), a(s.storage), a(s.chromaBands);
    a(s.clustering), a(s.clusterNormalWeight), a(s.clusterBalanceWeight);
    a(s.grid), a(s.maxBounces), a(s.dimming), a(b.sceneHash), a(b.gridSize), a(b.gridBounds);
    auto& c = b.counts;
    a(c.triangles), a(c.surfels), a(c.clusters), a(c.caches), a(c.invalidCaches), a(c.links),
        a(c.rays);
}

template <class A, class B>
void timingFields(A& a, B& b) {
    a.each(b.seconds, [&](auto& stage) { a(stage.first), a(stage.second); });
}

template <class A, class B>
void lightmapFields(A& a, B& b) {
    auto& l = b.lightmap;
    a(l.width), a(l.height);
    a.each(l.meshes, [&](auto& m) { chartFields(a, m); });
    a.each(l.instances, [&](auto& i) { a(i.uv), a(i.backRows); });
    a(l.snaps);
}

template <class A, class B>
void surfelFields(A& a, B& b) {
    auto& s = b.surfels;
    a(s.position), a(s.normal), a(s.area), a(s.instance), a(s.triangle), a(s.barycentric),
        a(s.cache);
    a(s.cacheWeight);
}

template <class A, class B>
void treeFields(A& a, B& b) {
    auto& t = b.tree;
    a(t.surfels), a(t.skyCells), a(t.left), a(t.right), a(t.leftWeight), a(t.parent),
        a(t.skyDirection);
}

template <class A, class B>
void cacheFields(A& a, B& b) {
    auto& c = b.caches;
    a(c.lightmapCount), a(c.kind), a(c.position), a(c.normal), a(c.texel);
    a(c.linkBegin), a(c.linkExponent), a(c.links), a(c.shNode), a(c.shCoefficients);
    a(c.fillBegin), a(c.fillSource), a(c.fillWeight);
}

template <class A, class B>
void gridDepthFields(A& a, B& b) {
    a(b.gridDepth);
}

/// Calls visit(name, fields) for every chunk; `fields` takes an archive and a Bake, const where it
/// writes.
template <class F>
void forChunks(F visit) {
    visit("SETTINGS", [](auto& a, auto& b) { settingsFields(a, b); });
    visit("TIMINGS ", [](auto& a, auto& b) { timingFields(a, b); });
    visit("LIGHTMAP", [](auto& a, auto& b) { lightmapFields(a, b); });
    visit("SURFELS ", [](auto& a, auto& b) { surfelFields(a, b); });
    visit("CLUSTERS", [](auto& a, auto& b) { treeFields(a, b); });
    visit("CACHES  ", [](auto& a, auto& b) { cacheFields(a, b); });
    visit("GRIDDEEP", [](auto& a, auto& b) { gridDepthFields(a, b); });
}

std::string packChunk(const char* name, const std::string& plain) {
    std::string packed(ZSTD_compressBound(plain.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 3));
    ByteWriter out;
    out.bytes.append(name, 8);
    out(std::uint64_t(plain.size())), out(std::uint64_t(packed.size())),
        out(hashBytes(packed.data(), packed.size()));
    return out.bytes + packed;
}

/// The links are of the settings' storage, whole, and of nodes that there are.
std::string linkDefect(const Bake& b) {
    const Caches& c = b.caches;
    const bool rtp = b.settings.storage == LinkStorage::Rtp;
    const std::size_t coefficients = std::size_t(b.settings.bands) * b.settings.bands;
    if (c.linkExponent.size() != c.size() || !(rtp ? c.shNode.empty() : c.links.empty()) ||
        c.shCoefficients.size() != c.shNode.size() * coefficients)
        return "CACHES: links of another storage";
    if (c.linkBegin.front() != 0 || c.linkBegin.back() != c.linkCount())
        return "CACHES: offsets do not cover the links";
    for (const Link& l : c.links)
        if (l.node >= b.tree.size())
            return "CACHES: link out of range";
    for (const std::uint32_t node : c.shNode)
        if (node >= b.tree.size())
            return "CACHES: link out of range";
    return {};
}

/// Places lead to rows of snaps that there are, or to blocks of finer texels within the atlas.
std::string snapDefect(const LightmapLayout& layout) {
    const std::vector<std::uint32_t>& snaps = layout.snaps;
    const std::uint64_t texels = std::uint64_t(layout.width) * layout.height;
    const auto outside = [&](std::uint32_t lookup) {
        if (lookup == 0)
            return false;
        if (!(lookup & kFineLookup))
            return lookup < texels || std::uint64_t(lookup) + kSnapCells > snaps.size();
        const std::uint32_t first = lookup & ~kFineLookup;
        return std::uint64_t(first % layout.width) + kFineCells >= layout.width ||
               std::uint64_t(first / layout.width) + kFineCells >= layout.height;
    };
    if (snaps.empty())
        return {};
    if (snaps.size() < texels)
        return "LIGHTMAP: snaps do not cover the texels";
    for (std::uint64_t t = 0; t < texels; ++t)
        if (outside(snaps[t]))
            return "LIGHTMAP: snaps out of range";
    for (std::size_t row = texels; row < snaps.size(); ++row)
        for (std::uint32_t cell = 0; cell < kSnapCells; ++cell)
            if ((snaps[row] >> 4 * cell & 15) >= kSnaps)
                return "LIGHTMAP: unknown snap";
    return {};
}

/// Every index that relighting follows lies within its array.
std::string indexDefect(const Bake& b) {
    const Surfels& s = b.surfels;
    const ClusterTree& t = b.tree;
    const Caches& c = b.caches;
    const std::size_t n = s.size(), caches = c.size(), nodes = t.size();
    for (const std::size_t size :
         {s.normal.size(), s.area.size(), s.instance.size(), s.triangle.size(),
          s.barycentric.size(), s.cache.size(), s.cacheWeight.size()})
        if (size != n)
            return "SURFELS: arrays differ in length";
    for (const glm::uvec4& k : s.cache)
        for (int i = 0; i < 4; ++i)
            if (k[i] != ~0U && k[i] >= caches)
                return "SURFELS: cache out of range";
    if (b.settings.placement > SurfelPlacement::Random)
        return "SETTINGS: unknown placement";
    if (b.settings.linker > Linker::FormFactor)
        return "SETTINGS: unknown linker";
    if (b.settings.cut > CutCriterion::SolidAngle)
        return "SETTINGS: unknown cut";
    if (b.settings.storage > LinkStorage::Sh)
        return "SETTINGS: unknown storage";
    if (b.settings.bands < 2 || b.settings.bands > 8)
        return "SETTINGS: bands out of range";
    if (b.settings.clustering > Clustering::KdTree)
        return "SETTINGS: unknown clustering";
    if (t.surfels != n || t.skyDirection.size() != t.skyCells || t.right.size() != t.left.size() ||
        t.leftWeight.size() != t.left.size() || t.parent.size() != nodes || nodes == 0)
        return "CLUSTERS: arrays differ in length";
    for (std::size_t k = 0; k < t.left.size(); ++k)
        if (t.left[k] >= t.leaves() + k || t.right[k] >= t.leaves() + k)
            return "CLUSTERS: a child comes after its parent";
    if (c.kind.size() != caches || c.normal.size() != caches || c.texel.size() != caches ||
        c.linkBegin.size() != caches + 1 || c.fillBegin.size() != caches + 1 ||
        c.lightmapCount > caches || c.fillWeight.size() != c.fillSource.size())
        return "CACHES: arrays differ in length";
    const std::uint64_t texels = std::uint64_t(b.lightmap.width) * b.lightmap.height;
    const std::uint64_t cells = std::uint64_t(b.gridSize.x) * b.gridSize.y * b.gridSize.z;
    for (std::size_t i = 0; i < caches; ++i) {
        if (c.texel[i] >= (i < c.lightmapCount ? texels : cells))
            return "CACHES: texel out of range";
        if (c.linkBegin[i] > c.linkBegin[i + 1] || c.fillBegin[i] > c.fillBegin[i + 1])
            return "CACHES: offsets run backwards";
    }
    if (const std::string defect = snapDefect(b.lightmap); !defect.empty())
        return defect;
    if (b.gridDepth.size() != cells * kGridDepthTexels)
        return "GRIDDEEP: not one map per cell";
    if (c.fillBegin.front() != 0 || c.fillBegin.back() != c.fillSource.size())
        return "CACHES: offsets do not cover the sources";
    for (const std::uint32_t source : c.fillSource)
        if (source >= caches)
            return "CACHES: fill source out of range";
    return linkDefect(b);
}

bool isNumber(float v) {
    return std::isfinite(v);
}
template <glm::length_t N>
bool isNumber(const glm::vec<N, float>& v) {
    for (glm::length_t i = 0; i < N; ++i)
        if (!std::isfinite(v[i]))
            return false;
    return true;
}
template <class Values>
bool areNumbers(const Values& values) {
    return std::ranges::all_of(values, [](const auto& v) { return isNumber(v); });
}

/// What relighting multiplies and sums is finite, and so is what comes of it: links bring no more
/// than kMostTransport of what their cluster sends, some hundred times what there can be.
std::string numberDefect(const Bake& b) {
    constexpr float kMostTransport = 1024;
    const Surfels& s = b.surfels;
    const Caches& c = b.caches;
    if (!areNumbers(s.position) || !areNumbers(s.normal) || !areNumbers(s.area) ||
        !areNumbers(s.barycentric) || !areNumbers(s.cacheWeight))
        return "SURFELS: not a number";
    if (!areNumbers(b.tree.skyDirection) ||
        !std::ranges::all_of(b.tree.leftWeight, [](float w) { return w >= 0 && w <= 1; }))
        return "CLUSTERS: not a number, or no weight";
    if (!areNumbers(c.position) || !areNumbers(c.normal) || !areNumbers(c.fillWeight))
        return "CACHES: not a number";
    const std::size_t coefficients = std::size_t(b.settings.bands) * b.settings.bands;
    const auto magnitude = [](std::uint16_t half) { return half & 0x7fff; };
    constexpr int kLargest = 0x7bff; // half; beyond it are infinity and what is no number
    for (std::size_t cache = 0; cache < c.size(); ++cache) {
        const float scaled = std::ldexp(kMostTransport, c.linkExponent[cache]);
        const int most = scaled < 65504 ? floatToHalf(scaled) : kLargest;
        for (std::size_t k = c.linkBegin[cache]; k < c.linkBegin[cache + 1]; ++k) {
            const auto first = c.shCoefficients.begin() + std::ptrdiff_t(k * coefficients);
            const bool fits =
                c.shNode.empty()
                    ? magnitude(c.links[k].u) <= kLargest && magnitude(c.links[k].transport) <= most
                    : std::all_of(first, first + std::ptrdiff_t(coefficients),
                                  [&](std::uint16_t half) { return magnitude(half) <= most; });
            if (!fits)
                return "CACHES: a link brings more light than there is";
        }
    }
    return {};
}

std::string layoutDefect(const LightmapLayout& l) {
    for (const MeshCharts& m : l.meshes) {
        if (m.chartUv.size() != m.sourceVertex.size() ||
            m.chartOfTriangle.size() * 3 != m.indices.size())
            return "LIGHTMAP: arrays differ in length";
        for (const std::uint32_t i : m.indices)
            if (i >= m.sourceVertex.size())
                return "LIGHTMAP: index out of range";
        for (const std::uint32_t chart : m.chartOfTriangle)
            if (chart >= m.chartSize.size())
                return "LIGHTMAP: chart out of range";
    }
    return {};
}

struct Chunk {
    std::uint64_t plainSize, packedSize, hash;
    const char* packed;
};

Result<std::map<std::string, Chunk>> listChunks(const std::string& path, const std::string& bytes) {
    constexpr std::size_t kHeader = sizeof kMagic + 8, kChunkHeader = 8 + 3 * 8;
    if (bytes.size() < kHeader || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
        return fail(fmt::format("{}: not a bake file", path));
    std::uint32_t version, count;
    std::memcpy(&version, bytes.data() + 8, 4);
    std::memcpy(&count, bytes.data() + 12, 4);
    if (version != kVersion)
        return fail(fmt::format("{}: version {} is not {}: bake again", path, version, kVersion));
    std::map<std::string, Chunk> chunks;
    std::size_t at = kHeader;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (bytes.size() - at < kChunkHeader)
            return fail(fmt::format("{}: truncated after {} of {} chunks", path, i, count));
        const std::string name(bytes.data() + at, 8);
        Chunk chunk;
        std::memcpy(&chunk.plainSize, bytes.data() + at + 8, 8);
        std::memcpy(&chunk.packedSize, bytes.data() + at + 16, 8);
        std::memcpy(&chunk.hash, bytes.data() + at + 24, 8);
        at += kChunkHeader;
        if (chunk.packedSize > bytes.size() - at || chunk.plainSize > kMostBytes)
            return fail(fmt::format("{}: chunk {}: truncated or damaged", path, i));
        chunk.packed = bytes.data() + at;
        at += std::size_t(chunk.packedSize);
        chunks[name] = chunk;
    }
    if (at != bytes.size())
        return fail(fmt::format("{}: {} bytes after the last chunk", path, bytes.size() - at));
    return chunks;
}

Result<std::string> unpack(const std::string& path, const char* name, const Chunk& chunk) {
    const auto packedSize = std::size_t(chunk.packedSize);
    if (hashBytes(chunk.packed, packedSize) != chunk.hash)
        return fail(fmt::format("{}: chunk {}: checksum does not match", path, name));
    if (ZSTD_getFrameContentSize(chunk.packed, packedSize) != chunk.plainSize)
        return fail(fmt::format("{}: chunk {}: wrong length", path, name));
    std::string plain(std::size_t(chunk.plainSize), '\0');
    const std::size_t n = ZSTD_decompress(plain.data(), plain.size(), chunk.packed, packedSize);
    if (ZSTD_isError(n) || n != plain.size())
        return fail(fmt::format("{}: chunk {}: cannot be unpacked", path, name));
    return plain;
}

} // namespace

Result<void> writeBake(const std::string& path, const Bake& bake) {
    std::string chunks;
    std::uint32_t count = 0;
    forChunks([&](const char* name, auto fields) {
        ByteWriter archive;
        fields(archive, bake);
        chunks += packChunk(name, archive.bytes);
        ++count;
    });
    ByteWriter header;
    header.bytes.append(kMagic, sizeof kMagic);
    header(kVersion), header(count);
    return replaceFile(path, header.bytes + chunks);
}

Result<Bake> readBake(const std::string& path) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    const Result<std::map<std::string, Chunk>> chunks = listChunks(path, *bytes);
    if (!chunks)
        return tl::make_unexpected(chunks.error());
    Bake bake;
    std::string defect;
    forChunks([&](const char* name, auto fields) {
        if (!defect.empty())
            return;
        const auto it = chunks->find(name);
        if (it == chunks->end()) {
            defect = fmt::format("{}: chunk {}: missing", path, name);
            return;
        }
        const Result<std::string> plain = unpack(path, name, it->second);
        if (!plain) {
            defect = plain.error().message;
            return;
        }
        ByteReader archive(*plain);
        fields(archive, bake);
        if (!archive.ok || !archive.atEnd())
            defect = fmt::format("{}: chunk {}: wrong length", path, name);
    });
    if (!defect.empty())
        return fail(defect);
    std::string inside = layoutDefect(bake.lightmap) + indexDefect(bake);
    if (inside.empty()) // so that what is looked at is there
        inside = numberDefect(bake);
    if (!inside.empty())
        return fail(fmt::format("{}: {}", path, inside));
    return bake;
}

} // namespace limn
