// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/bake_file.h"

#include "engine/core/archive.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/techniques/illuminance/format/bake_fields.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

namespace limn::bake_file_test {
namespace {

using namespace simple;

Scene room() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(box(glm::vec3(0), glm::vec3(2), true));
    b.add(box(glm::vec3(0.5f, 0, 0.5f), glm::vec3(1), false));
    Scene scene = b.build();
    scene.bake.surfels = 200;
    scene.bake.lightmapCaches = 150;
    scene.bake.rays = 64;
    scene.bake.links = 16;
    scene.bake.grid = {3, 2, 4};
    return scene;
}

class BakeFile : public testing::Test {
protected:
    Scene scene = room();
    TraceScene trace{scene};
    Bake baked = *bake(trace);
    std::string path = (std::filesystem::temp_directory_path() /
                        ("limn_bake_file_test_" + std::to_string(getpid()) + ".limnbake"))
                           .string();

    ~BakeFile() override { std::remove(path.c_str()); }
    std::string contents() const {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    void overwrite(const std::string& bytes) const {
        std::ofstream(path, std::ios::binary) << bytes;
    }
};

TEST_F(BakeFile, SaysWhetherAnOlderBakerMadeIt) {
    ASSERT_TRUE(writeBake(path, baked));
    const Result<Bake> current = readBake(path);
    ASSERT_TRUE(current);
    EXPECT_EQ(current->baker, kBakerVersion);
    EXPECT_TRUE(current->notes.empty());

    baked.baker = kBakerVersion - 1;
    ASSERT_TRUE(writeBake(path, baked));
    const Result<Bake> older = readBake(path);
    ASSERT_TRUE(older);
    ASSERT_EQ(older->notes.size(), 1);
    EXPECT_NE(older->notes[0].find("bake again"), std::string::npos);
    EXPECT_EQ(older->hash(), current->hash());
}

// Files of Limn 0.1 have no such chunk.
TEST_F(BakeFile, OfABakerThatKeptNoVersionIsReadAsTheOldest) {
    ASSERT_TRUE(writeBake(path, baked));
    std::string bytes = contents();
    const std::size_t name = bytes.find("BAKER   ");
    ASSERT_NE(name, std::string::npos);
    std::uint64_t packed = 0;
    std::memcpy(&packed, bytes.data() + name + 16, 8);
    bytes.erase(name, 32 + packed);
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 12, 4);
    --count;
    std::memcpy(bytes.data() + 12, &count, 4);
    overwrite(bytes);
    const Result<Bake> read = readBake(path);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->baker, 0);
    EXPECT_EQ(read->notes.size(), 1);
}

TEST_F(BakeFile, LoadsBackToIdenticalResults) {
    ASSERT_TRUE(writeBake(path, baked));
    const Result<Bake> loaded = readBake(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->hash(), baked.hash());
    EXPECT_EQ(loaded->settings, baked.settings);
    EXPECT_EQ(loaded->lightmap, baked.lightmap);
    EXPECT_EQ(loaded->surfels, baked.surfels);
    EXPECT_EQ(loaded->tree, baked.tree);
    EXPECT_EQ(loaded->caches, baked.caches);
    EXPECT_EQ(loaded->counts, baked.counts);
    EXPECT_EQ(loaded->seconds, baked.seconds);
    Relighter first(std::make_shared<const Bake>(baked)),
        second(std::make_shared<const Bake>(*loaded));
    first.relight(scene, trace, 8);
    second.relight(scene, trace, 8);
    EXPECT_EQ(first.field(), second.field());
}

TEST_F(BakeFile, IgnoresTheRelightSettingsThatOlderFilesHold) {
    ByteWriter written;
    settingsFields(written, baked);
    // 1000 bounces and a switch that is on, before the hash of the scene.
    const std::string usual("\xe8\x03\0\0\x01", 5), other("\x03\0\0\0\0", 5);
    const std::size_t at = written.bytes.find(usual);
    ASSERT_NE(at, std::string::npos);
    written.bytes.replace(at, usual.size(), other);
    ByteReader reader(written.bytes);
    Bake loaded;
    settingsFields(reader, loaded);
    EXPECT_TRUE(reader.ok && reader.atEnd());
    EXPECT_EQ(loaded.settings, baked.settings);
    EXPECT_EQ(loaded.sceneHash, baked.sceneHash);
}

TEST_F(BakeFile, LoadsBackLinksInShStorage) {
    scene.bake.storage = LinkStorage::Sh;
    scene.bake.chromaBands = 2;
    baked = *bake(TraceScene(scene));
    ASSERT_FALSE(baked.caches.shNode.empty());
    ASSERT_TRUE(writeBake(path, baked));
    const Result<Bake> loaded = readBake(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->settings, baked.settings);
    EXPECT_EQ(loaded->caches, baked.caches);
    EXPECT_EQ(loaded->hash(), baked.hash());

    const auto refusal = [&](auto damage) {
        Bake broken = baked;
        damage(broken);
        EXPECT_TRUE(writeBake(path, broken));
        const Result<Bake> read = readBake(path);
        return read ? "nothing" : read.error().message;
    };
    EXPECT_NE(refusal([](Bake& b) {
                  b.caches.shNode[3] = 1U << 30;
              }).find("CACHES: shNode: out of range"),
              std::string::npos);
    for (const std::string& message :
         {refusal([](Bake& b) { b.caches.shCoefficients.pop_back(); }),
          refusal([](Bake& b) { b.settings.bands = 4; }),
          refusal([](Bake& b) { b.settings.storage = LinkStorage::Rtp; }),
          refusal([](Bake& b) { b.caches.linkExponent.pop_back(); })})
        EXPECT_NE(message.find("CACHES: "), std::string::npos) << message;
}

TEST_F(BakeFile, EveryTruncationIsAnErrorThatNamesTheFile) {
    ASSERT_TRUE(writeBake(path, baked));
    const std::string whole = contents();
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
        overwrite(whole.substr(0, length));
        const Result<Bake> refused = readBake(path);
        ASSERT_FALSE(refused) << length;
        EXPECT_NE(refused.error().message.find(path), std::string::npos);
    }
    overwrite(whole + "x");
    EXPECT_FALSE(readBake(path));
}

TEST_F(BakeFile, DamageIsRefusedWhereverItIs) {
    ASSERT_TRUE(writeBake(path, baked));
    const std::string whole = contents();
    std::mt19937 rng(1);
    for (int i = 0; i < 300; ++i) {
        std::string damaged = whole;
        const std::size_t at = rng() % damaged.size();
        damaged[at] = char(damaged[at] ^ char(1 << (rng() % 8)));
        overwrite(damaged);
        EXPECT_FALSE(readBake(path)) << "byte " << at;
    }
}

TEST_F(BakeFile, IndicesOutOfRangeAreRefusedEvenWithRightChecksums) {
    Bake broken = baked;
    broken.caches.links[5].node = 1U << 30;
    ASSERT_TRUE(writeBake(path, broken));
    const Result<Bake> refused = readBake(path);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("CACHES: links: node out of range"), std::string::npos);
    broken = baked;
    broken.surfels.cache[0].x = 1U << 30;
    ASSERT_TRUE(writeBake(path, broken));
    EXPECT_FALSE(readBake(path));
    broken = baked;
    broken.tree.left[3] = broken.tree.size();
    ASSERT_TRUE(writeBake(path, broken));
    EXPECT_FALSE(readBake(path));
}

TEST_F(BakeFile, WhatIsNoNumberOrBringsLightFromNowhereIsRefusedEvenWithRightChecksums) {
    const float inf = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN();
    const auto refuses = [&](const Bake& good, const char* chunk, const auto& breakIt) {
        Bake broken = good;
        breakIt(broken);
        ASSERT_TRUE(writeBake(path, broken));
        const Result<Bake> refused = readBake(path);
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find(chunk), std::string::npos);
    };
    refuses(baked, "SURFELS", [&](Bake& b) { b.surfels.position[7].y = inf; });
    refuses(baked, "SURFELS", [&](Bake& b) { b.surfels.area[0] = nan; });
    refuses(baked, "SURFELS", [&](Bake& b) { b.surfels.cacheWeight[3].w = nan; });
    refuses(baked, "CLUSTERS", [&](Bake& b) { b.tree.leftWeight[3] = nan; });
    refuses(baked, "CLUSTERS", [&](Bake& b) { b.tree.leftWeight[3] = 1.5f; });
    refuses(baked, "CACHES", [&](Bake& b) { b.caches.normal[3].x = nan; });
    const auto firstLink = [](Bake& b) -> Link& { return b.caches.links[b.caches.linkBegin[2]]; };
    refuses(baked, "CACHES", [&](Bake& b) { firstLink(b).u = 0x7e00; });
    refuses(baked, "CACHES", [&](Bake& b) { firstLink(b).transport = 0x7c00; });
    refuses(baked, "CACHES", [&](Bake& b) { b.caches.linkExponent[2] = -128; });
    refuses(baked, "CACHES", [&](Bake& b) { b.caches.linkExponent[2] = 3; });
    scene.bake.storage = LinkStorage::Sh;
    const Bake harmonics = *bake(TraceScene(scene));
    refuses(harmonics, "CACHES", [&](Bake& b) { b.caches.shCoefficients[40] = 0xfc00; });
    refuses(harmonics, "CACHES", [&](Bake& b) { b.caches.linkExponent[2] = 3; });
}

TEST_F(BakeFile, SnapsOfLookupsLoadBackAndAreRefusedWhereTheyLeadNowhere) {
    Scene hall = partedHall(0, 150);
    hall.bake.surfels = 200;
    hall.bake.rays = 32;
    hall.bake.links = 8;
    const Bake parted = *bake(TraceScene(hall));
    const std::size_t texels = std::size_t(parted.lightmap.width) * parted.lightmap.height;
    ASSERT_GT(parted.lightmap.snaps.size(), texels);
    ASSERT_TRUE(writeBake(path, parted));
    const Result<Bake> loaded = readBake(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->lightmap, parted.lightmap);
    EXPECT_EQ(loaded->hash(), parted.hash());

    const auto refusal = [&](auto damage) {
        Bake broken = parted;
        damage(broken.lightmap.snaps);
        EXPECT_TRUE(writeBake(path, broken));
        const Result<Bake> read = readBake(path);
        return read ? "nothing" : read.error().message;
    };
    using Snaps = std::vector<std::uint32_t>;
    const auto expectRefused = [&](const char* message, auto damage) {
        const std::string said = refusal(damage);
        EXPECT_NE(said.find(std::string("LIGHTMAP: snaps: ") + message), std::string::npos) << said;
        EXPECT_NE(said.find(path), std::string::npos) << said;
    };
    EXPECT_EQ(refusal([&](Snaps& s) { s[0] = std::uint32_t(texels); }), "nothing");
    EXPECT_EQ(refusal([&](Snaps& s) { s[0] = std::uint32_t(s.size()) - kSnapCells; }), "nothing");
    expectRefused("out of range", [&](Snaps& s) { s[0] = std::uint32_t(texels) - 1; });
    expectRefused("out of range", [](Snaps& s) { s[0] = std::uint32_t(s.size()) - 7; });
    expectRefused("out of range", [](Snaps& s) { s[0] = ~0U; });
    const auto block = [&](std::uint32_t fromRight, std::uint32_t fromBottom) {
        return kFineLookup | ((parted.lightmap.height - fromBottom) * parted.lightmap.width +
                              parted.lightmap.width - fromRight);
    };
    EXPECT_EQ(refusal([&](Snaps& s) { s[0] = block(kFineCells + 1, kFineCells + 1); }), "nothing");
    expectRefused("out of range", [&](Snaps& s) { s[0] = block(kFineCells, kFineCells + 1); });
    expectRefused("out of range", [&](Snaps& s) { s[0] = block(kFineCells + 1, kFineCells); });
    expectRefused("do not cover the texels", [&](Snaps& s) { s.resize(texels - 1); });
    expectRefused("unknown snap", [&](Snaps& s) { s[texels] = kSnaps; });
    expectRefused("unknown snap", [](Snaps& s) { s.back() = 0xf0000000; });
}

TEST_F(BakeFile, SnapsOfFewerTexelsThanARowHasAreRefusedToo) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(quad(glm::vec3(0), {1, 0, 0}, {0, 1, 0}));
    Scene small = b.build();
    small.bake.surfels = 64;
    small.bake.lightmapCaches = 1;
    small.bake.rays = 16;
    Bake broken = *bake(TraceScene(small));
    const std::size_t texels = std::size_t(broken.lightmap.width) * broken.lightmap.height;
    broken.lightmap.snaps.assign(texels, 0);
    ASSERT_TRUE(writeBake(path, broken));
    EXPECT_TRUE(readBake(path));
    broken.lightmap.snaps[0] = std::uint32_t(texels);
    ASSERT_TRUE(writeBake(path, broken));
    EXPECT_FALSE(readBake(path)) << texels;
}

/// Every number of the light at the surfaces and in the air is finite.
bool isFinite(const IndirectField& field) {
    const auto finite = [](glm::vec4 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return std::ranges::all_of(field.lightmap, finite) && std::ranges::all_of(field.grid, finite);
}

// Eight bytes at a time, of every chunk: what is not refused can be lit.
TEST_F(BakeFile, NoFieldLeadsRelightingAstray) {
    scene.bake.rays = 16;
    scene.bake.lightmapCaches = 40;
    baked = *bake(TraceScene(scene));
    std::size_t tried = 0, refused = 0;
    forBakeChunks(nullptr, [&](const std::string& name, auto fields) {
        ByteWriter whole;
        fields(whole, std::as_const(baked));
        for (const std::uint64_t value :
             {std::uint64_t(0x7f7f7f7f7f7f7f7f), std::uint64_t(0), std::uint64_t(0x100000001)})
            for (std::size_t k = 0; k < 60; ++k) {
                const std::size_t at = (whole.bytes.size() - 8) * k / 60 / 4 * 4;
                std::string bytes = whole.bytes;
                std::memcpy(bytes.data() + at, &value, 8);
                Bake broken = baked;
                ByteReader reader(bytes);
                fields(reader, broken);
                ++tried;
                if (!reader.ok || !reader.atEnd() || !bakeDefect(broken, &scene).empty()) {
                    ++refused;
                    continue;
                }
                Relighter relighter(std::make_shared<const Bake>(broken));
                relighter.relight(scene, trace, 3);
                EXPECT_TRUE(isFinite(relighter.field())) << name << " at " << at << ": " << value;
            }
    });
    EXPECT_GT(refused, tried / 4);
}

TEST_F(BakeFile, OnlyItsSceneTellsWhetherIndicesAreThoseOfAScene) {
    const auto defectOf = [&](auto damage) {
        Bake broken = baked;
        damage(broken);
        EXPECT_EQ(bakeDefect(broken, nullptr), "");
        return bakeDefect(broken, &scene);
    };
    EXPECT_EQ(defectOf([](Bake&) {}), "");
    EXPECT_EQ(defectOf([](Bake& b) { b.surfels.triangle[3] = 1000; }),
              "SURFELS: triangle: out of range");
    EXPECT_EQ(defectOf([](Bake& b) { b.lightmap.meshes[0].sourceVertex[0] = 1000; }),
              "LIGHTMAP: sourceVertex: out of range");
    EXPECT_EQ(defectOf([](Bake& b) { b.lightmap.instances.emplace_back(); }),
              "LIGHTMAP: instances: not those of the scene");
    EXPECT_EQ(defectOf([](Bake& b) { b.lightmap.instances[0].uv.pop_back(); }),
              "LIGHTMAP: uv: of another length");
}

// Also where a chunk only claims to be a terabyte.
TEST_F(BakeFile, WhatWouldNeedMoreMemoryThanAllowedIsRefused) {
    ASSERT_TRUE(writeBake(path, baked));
    const Result<Bake> refused = readBake(path, {.maxBytes = 1000});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("--memory"), std::string::npos)
        << refused.error().message;
    std::string bomb = contents();
    const std::uint64_t terabyte = std::uint64_t(1) << 40;
    std::memcpy(bomb.data() + 24, &terabyte, 8); // the first chunk's size unpacked
    overwrite(bomb);
    EXPECT_NE(readBake(path).error().message.find("--memory"), std::string::npos);
}

TEST_F(BakeFile, ANewerVersionSaysSo) {
    ASSERT_TRUE(writeBake(path, baked));
    std::string newer = contents();
    newer[8] = 9;
    overwrite(newer);
    const Result<Bake> refused = readBake(path);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("version 9"), std::string::npos);
}

TEST_F(BakeFile, AnUnwritablePlaceIsAnError) {
    const Result<void> refused = writeBake("/nonexistent/folder/x.limnbake", baked);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("/nonexistent/folder/x.limnbake"), std::string::npos);
}

} // namespace
} // namespace limn::bake_file_test
