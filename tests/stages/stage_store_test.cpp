// SPDX-License-Identifier: MIT
#include "engine/stages/stage_store.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

namespace limn::stage_store_test {
namespace {

namespace fs = std::filesystem;

class Store : public testing::Test {
protected:
    void SetUp() override {
        m_folder = fs::temp_directory_path() / ("limn_store" + std::to_string(getpid()));
        fs::remove_all(m_folder);
    }
    void TearDown() override { fs::remove_all(m_folder); }
    StageStoreOptions onDisk() const { return {.folder = m_folder.string()}; }
    std::vector<fs::path> files() const {
        std::vector<fs::path> result;
        for (const auto& entry : fs::directory_iterator(m_folder))
            result.push_back(entry.path());
        return result;
    }
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const fs::path& file : files())
            sum += fs::file_size(file);
        return sum;
    }
    fs::path m_folder;
};

std::string noise(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::string s(size, '\0');
    for (char& c : s)
        c = char(random());
    return s;
}

TEST_F(Store, WhatOneStoreKeptAnotherFinds) {
    const std::string text = noise(100000, 1) + std::string(100000, 'x');
    {
        StageStore store(onDisk());
        EXPECT_FALSE(store.find(7));
        store.put(7, text);
        store.put(8, "");
        EXPECT_EQ(store.find(7), text);
        store.put(7, text + "!");
        EXPECT_EQ(store.find(7), text + "!");
    }
    StageStore store(onDisk());
    EXPECT_EQ(store.find(7), text + "!");
    EXPECT_EQ(store.find(8), "");
    EXPECT_FALSE(store.find(9));
    EXPECT_EQ(files().size(), 2U);
}

TEST_F(Store, DamagedAndTruncatedFilesAreAbsent) {
    { StageStore(onDisk()).put(1, noise(1000, 2)); }
    const fs::path file = files().at(0);
    std::string good;
    {
        std::ifstream in(file, std::ios::binary);
        good.assign(std::istreambuf_iterator<char>(in), {});
    }
    const auto found = [&](const std::string& content) {
        std::ofstream(file, std::ios::binary) << content;
        StageStore store(onDisk());
        return store.find(1).has_value();
    };
    for (std::size_t length = 0; length < good.size(); length += 7)
        EXPECT_FALSE(found(good.substr(0, length))) << length;
    for (std::size_t at = 0; at < good.size(); at += 5) {
        if (at >= 12 && at < 16)
            continue; // unused
        std::string bad = good;
        bad[at] = char(bad[at] ^ 4);
        EXPECT_FALSE(found(bad)) << at;
    }
    EXPECT_TRUE(found(good));
}

TEST_F(Store, WhatLayUnusedLongestGoesFirstWhenTheFolderIsFull) {
    StageStoreOptions options = onDisk();
    options.maxDiskBytes = 100000;
    options.maxMemoryBytes = 0;
    StageStore store(options);
    for (std::uint64_t key = 1; key <= 8; ++key) {
        store.put(key, noise(10000, unsigned(key)));
        store.flush();
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
    EXPECT_TRUE(store.find(1)); // used again
    for (std::uint64_t key = 9; key <= 12; ++key)
        store.put(key, noise(10000, unsigned(key)));
    store.flush();
    EXPECT_LE(bytes(), options.maxDiskBytes);
    EXPECT_TRUE(store.find(1));
    EXPECT_FALSE(store.find(2));
    EXPECT_TRUE(store.find(12));
}

// Nor does it count them.
TEST_F(Store, FilesOfOthersStay) {
    fs::create_directories(m_folder);
    const std::vector<std::string> others = {"notes.tmp", "play.stage", "0123456789abcdef.stage",
                                             "0123456789abcdef.stage.77.1.tmp"};
    for (const std::string& name : others) {
        std::ofstream(m_folder / name) << std::string(5000, 'x');
        fs::last_write_time(m_folder / name,
                            fs::file_time_type::clock::now() - std::chrono::hours(48));
    }
    fs::create_symlink("notes.tmp", m_folder / "fedcba9876543210.stage");
    StageStoreOptions small = onDisk();
    small.maxDiskBytes = 20000;
    for (unsigned i = 0; i < 5; ++i) {
        StageStore store(small);
        store.put(i, noise(8000, i));
    }
    for (const std::string& name : others)
        EXPECT_TRUE(fs::exists(m_folder / name)) << name;
    EXPECT_EQ(fs::file_size(m_folder / "notes.tmp"), 5000u);
}

// Someone else's link to a file must not become a way to write that file.
TEST_F(Store, ALinkInTheFolderIsReplacedNotFollowed) {
    { StageStore(onDisk()).put(3, noise(1000, 3)); }
    ASSERT_EQ(files().size(), 1u);
    const fs::path stage = files()[0], victim = m_folder.string() + ".victim";
    std::ofstream(victim) << "mine";
    fs::remove(stage);
    fs::create_symlink(victim, stage);
    {
        StageStore store(onDisk());
        EXPECT_FALSE(store.find(3));
        store.put(3, noise(1000, 3));
    }
    EXPECT_EQ(fs::file_size(victim), 4u);
    EXPECT_EQ(StageStore(onDisk()).find(3), noise(1000, 3));
    fs::remove(victim);
}

TEST_F(Store, APipeInTheFolderHangsNobody) {
    { StageStore(onDisk()).put(3, noise(1000, 3)); }
    const fs::path stage = files().at(0);
    fs::remove(stage);
    ASSERT_EQ(mkfifo(stage.c_str(), 0600), 0);
    StageStore store(onDisk());
    EXPECT_FALSE(store.find(3));
    store.put(3, noise(1000, 3));
    store.flush();
    EXPECT_EQ(store.find(3), noise(1000, 3));
    EXPECT_FALSE(store.defect().empty());
}

TEST_F(Store, MemoryAloneServesWithinItsSize) {
    StageStore store({.folder = {}, .maxMemoryBytes = 50000});
    for (std::uint64_t key = 1; key <= 8; ++key)
        store.put(key, noise(10000, unsigned(key)));
    EXPECT_FALSE(store.find(1));
    EXPECT_EQ(store.find(8), noise(10000, 8));
}

TEST_F(Store, ManyThreadsAndStoresMayShareAFolder) {
    StageStore a(onDisk()), b(onDisk());
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 4; ++t)
            threads.emplace_back([&, t] {
                for (unsigned k = 0; k < 20; ++k) {
                    (t % 2 ? a : b).put(k, noise(1000, k));
                    const auto found = (t % 2 ? b : a).find(k);
                    EXPECT_TRUE(!found || *found == noise(1000, k));
                }
            });
    }
    a.flush();
    b.flush();
    EXPECT_EQ(files().size(), 20U);
    EXPECT_EQ(a.defect() + b.defect(), "");
}

TEST_F(Store, AFolderThatCannotBeMadeIsSaidAndMemoryServes) {
    std::ofstream(m_folder.string()) << "a file";
    StageStore store({.folder = (m_folder / "inside").string()});
    store.put(1, "kept");
    store.flush();
    EXPECT_NE(store.defect().find("inside"), std::string::npos);
    EXPECT_EQ(store.find(1), "kept");
}

} // namespace
} // namespace limn::stage_store_test
