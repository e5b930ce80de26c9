// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace limn {

struct StageStoreOptions {
    std::string folder; ///< made where it is missing; empty: nothing is kept on disk
    std::uint64_t maxDiskBytes = std::uint64_t(4) << 30;
    std::uint64_t maxMemoryBytes = std::uint64_t(1) << 30;
};

/// Finished results of bake stages by the hash of what they were made from, in memory and in a
/// folder: one file each. What has lain unused longest goes first where there is too much. Files
/// are written beside the caller, each to a temporary one that is synced and renamed; a damaged,
/// truncated or foreign file counts as absent. Any thread may call, and several processes may share
/// a folder. Results of another build of the program are not used: it may compute them otherwise.
class StageStore {
public:
    explicit StageStore(StageStoreOptions options = {});
    /// Waits until everything is on disk.
    ~StageStore();
    StageStore(const StageStore&) = delete;
    StageStore& operator=(const StageStore&) = delete;

    /// The bytes last put under `key`, or nothing.
    std::optional<std::string> find(std::uint64_t key);

    /// Keeps a copy of `bytes`, packed by zstd; replaces what was there.
    void put(std::uint64_t key, const std::string& bytes);

    /// Waits until everything put so far is on disk.
    void flush();

    /// Why the folder cannot be written; empty: it can, or there is none. Memory serves meanwhile.
    std::string defect() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// $XDG_CACHE_HOME/limn/bake, else ~/.cache/limn/bake; empty where neither is set.
std::string defaultStageFolder();

} // namespace limn
