// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace limn {

struct StageStoreOptions {
    std::string folder; ///< created if missing; empty: nothing is stored on disk
    std::uint64_t maxDiskBytes = std::uint64_t(4) << 30;
    std::uint64_t maxMemoryBytes = std::uint64_t(1) << 30;
};

/// Cache of finished results of bake stages, keyed by the hash of their inputs, in memory and in a
/// folder with one file each. The least recently used results are evicted first. Files are written
/// in the background, each to a temporary file that is synced and renamed; a damaged, truncated or
/// foreign file counts as absent. Thread-safe, and several processes may share a folder. Results of
/// another build of the program are not used, because it may compute them differently.
class StageStore {
public:
    explicit StageStore(StageStoreOptions options = {});
    /// Waits until everything has been written to disk.
    ~StageStore();
    StageStore(const StageStore&) = delete;
    StageStore& operator=(const StageStore&) = delete;

    /// The bytes last put under `key`; std::nullopt if there are none.
    std::optional<std::string> find(std::uint64_t key);

    /// Stores a copy of `bytes`, compressed by zstd, replacing previous content.
    void put(std::uint64_t key, const std::string& bytes);

    /// Waits until everything put so far has been written to disk.
    void flush();

    /// Number of results that find() returned and that put() stored so far.
    struct Traffic {
        std::uint64_t found = 0, stored = 0;
    };
    Traffic traffic() const;

    /// Why the folder cannot be written; empty if it can or if there is no folder. Results are then
    /// kept in memory only.
    std::string defect() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/// $XDG_CACHE_HOME/limn/bake, else ~/.cache/limn/bake; empty where neither is set.
std::string defaultStageFolder();

} // namespace limn
