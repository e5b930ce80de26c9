// SPDX-License-Identifier: MIT
#include "engine/stages/stage_store.h"

#include "engine/core/descriptor.h"
#include "engine/core/hash.h"
#include "engine/core/memory_budget.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/core/user_folder.h"

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <list>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <zstd.h>

// File: "LIMNSTAG", u32 version, u32 0, u64 key, u64 bytes unpacked, u64 XXH3 of the packed bytes,
// packed bytes (zstd).

namespace limn {

namespace fs = std::filesystem;

namespace {

constexpr char kMagic[8] = {'L', 'I', 'M', 'N', 'S', 'T', 'A', 'G'};
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kHeader = sizeof kMagic + 2 * 4 + 3 * 8;
constexpr const char* kExtension = ".stage";

using Packed = std::shared_ptr<const std::string>; ///< a whole file

int hashBuildNote(dl_phdr_info* info, std::size_t, void* hash) {
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = info->dlpi_phdr[i];
        if (segment.p_type == PT_NOTE)
            *static_cast<std::uint64_t*>(hash) =
                hashBytes(reinterpret_cast<const void*>(info->dlpi_addr + segment.p_vaddr),
                          segment.p_memsz, *static_cast<std::uint64_t*>(hash));
    }
    return 1; // the first entry is the program itself
}

/// Hash of the running program's notes, which include the linker's hash of all its code.
std::uint64_t programHash() {
    std::uint64_t hash = kVersion;
    dl_iterate_phdr(hashBuildNote, &hash);
    return hash;
}

/// Compresses piece by piece, because a buffer for zstd's worst case would be as large as `bytes`
/// again.
std::string pack(std::uint64_t key, const std::string& bytes) {
    std::string file(kHeader, '\0'), piece(ZSTD_CStreamOutSize(), '\0');
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd(ZSTD_createCCtx(),
                                                                    &ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_compressionLevel, 1);
    ZSTD_CCtx_setPledgedSrcSize(zstd.get(), bytes.size());
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (std::size_t left = 1; left > 0 && !ZSTD_isError(left);) {
        ZSTD_outBuffer out{piece.data(), piece.size(), 0};
        left = ZSTD_compressStream2(zstd.get(), &out, &in, ZSTD_e_end);
        file.append(piece.data(), out.pos);
    }
    const std::size_t packed = file.size() - kHeader;
    const std::uint32_t words[2] = {kVersion, 0};
    const std::uint64_t longs[3] = {key, bytes.size(), hashBytes(file.data() + kHeader, packed)};
    std::memcpy(file.data(), kMagic, sizeof kMagic);
    std::memcpy(file.data() + 8, words, sizeof words);
    std::memcpy(file.data() + 16, longs, sizeof longs);
    return file;
}

std::optional<std::string> unpack(std::uint64_t key, const std::string& file) {
    std::uint32_t version;
    std::uint64_t longs[3];
    if (file.size() < kHeader || std::memcmp(file.data(), kMagic, sizeof kMagic) != 0)
        return {};
    std::memcpy(&version, file.data() + 8, sizeof version);
    std::memcpy(longs, file.data() + 16, sizeof longs);
    const char* packed = file.data() + kHeader;
    const std::size_t size = file.size() - kHeader;
    if (version != kVersion || longs[0] != key || hashBytes(packed, size) != longs[2] ||
        ZSTD_getFrameContentSize(packed, size) != longs[1] || longs[1] > halfOfMemory() / 2)
        return {};
    std::string bytes(std::size_t(longs[1]), '\0');
    const std::size_t n = ZSTD_decompress(bytes.data(), bytes.size(), packed, size);
    if (ZSTD_isError(n) || n != bytes.size())
        return {};
    return bytes;
}

/// Whether a file is a stage file, by its name and its first bytes.
bool isStage(const fs::path& path) {
    const std::string name = path.filename().string();
    const std::size_t digits = 16;
    if (name.size() != digits + std::strlen(kExtension) || !name.ends_with(kExtension) ||
        name.find_first_not_of("0123456789abcdef") != digits)
        return false;
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
    char magic[sizeof kMagic];
    return file && read(file.number(), magic, sizeof magic) == ssize_t(sizeof magic) &&
           std::memcmp(magic, kMagic, sizeof magic) == 0;
}

/// Removes the least recently used files until at most `maxBytes` bytes are left. Returns the bytes
/// left. Other processes may remove files meanwhile; other files in the folder are not touched.
std::uint64_t trim(const fs::path& folder, std::uint64_t maxBytes) {
    struct File {
        fs::file_time_type used;
        std::uint64_t size;
        fs::path path;
    };
    std::vector<File> files;
    std::uint64_t total = 0;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone;
        const File file{it->last_write_time(gone), it->file_size(gone), it->path()};
        if (gone)
            continue;
        if (!isStage(file.path))
            continue;
        total += file.size;
        files.push_back(file);
    }
    if (total <= maxBytes)
        return total;
    std::sort(files.begin(), files.end(),
              [](const File& a, const File& b) { return a.used < b.used; });
    for (const File& file : files) {
        if (total <= maxBytes)
            break;
        std::error_code gone;
        fs::remove(file.path, gone);
        total -= file.size;
    }
    return total;
}

} // namespace

struct StageStore::Impl {
    StageStoreOptions options;
    std::uint64_t program = programHash();

    std::mutex mutex;                                   ///< of all that follows
    std::list<std::pair<std::uint64_t, Packed>> recent; ///< latest first
    std::unordered_map<std::uint64_t, decltype(recent)::iterator> known;
    std::uint64_t memoryBytes = 0;
    Traffic traffic;

    std::deque<std::pair<std::uint64_t, Packed>> queue; ///< the front one is being written
    std::condition_variable changed;
    bool stopping = false;
    std::string defect;
    std::uint64_t diskBytes = 0, writtenSinceTrim = 0; ///< of the writer alone
    std::thread writer;

    fs::path pathOf(std::uint64_t key) const {
        return fs::path(options.folder) / (hexHash(hashValue(key, program)) + kExtension);
    }
    void remember(std::uint64_t key, Packed file);
    Packed recall(std::uint64_t key);
    std::optional<std::string> find(std::uint64_t key);
    void write();
    void writeFile(std::uint64_t key, const std::string& file);
};

/// Precondition: the mutex is held.
void StageStore::Impl::remember(std::uint64_t key, Packed file) {
    if (const auto it = known.find(key); it != known.end()) {
        memoryBytes -= it->second->second->size();
        recent.erase(it->second);
    }
    memoryBytes += file->size();
    recent.emplace_front(key, std::move(file));
    known[key] = recent.begin();
    while (memoryBytes > options.maxMemoryBytes && !recent.empty()) {
        memoryBytes -= recent.back().second->size();
        known.erase(recent.back().first);
        recent.pop_back();
    }
}

Packed StageStore::Impl::recall(std::uint64_t key) {
    const std::lock_guard lock(mutex);
    if (const auto it = known.find(key); it != known.end()) {
        recent.splice(recent.begin(), recent, it->second);
        return it->second->second;
    }
    const auto waiting = std::find_if(queue.rbegin(), queue.rend(),
                                      [&](const auto& entry) { return entry.first == key; });
    return waiting != queue.rend() ? waiting->second : nullptr;
}

void StageStore::Impl::writeFile(std::uint64_t key, const std::string& file) {
    const Result<void> written = replaceFile(pathOf(key).string(), file, AtLink::Replace);
    if (!written) {
        const std::lock_guard lock(mutex);
        defect = written.error().message;
        return;
    }
    diskBytes += file.size();
    writtenSinceTrim += file.size();
    // Other processes write as well, so the folder is checked from time to time.
    if (diskBytes > options.maxDiskBytes || writtenSinceTrim > options.maxDiskBytes / 8) {
        diskBytes = trim(options.folder, options.maxDiskBytes / 10 * 9);
        writtenSinceTrim = 0;
    }
}

void StageStore::Impl::write() {
    std::unique_lock lock(mutex);
    for (;;) {
        changed.wait(lock, [&] { return stopping || !queue.empty(); });
        if (queue.empty())
            return;
        const auto [key, file] = queue.front();
        lock.unlock();
        writeFile(key, *file);
        lock.lock();
        queue.pop_front();
        changed.notify_all();
    }
}

StageStore::StageStore(StageStoreOptions options) : m_impl(std::make_unique<Impl>()) {
    m_impl->options = std::move(options);
    const std::string& folder = m_impl->options.folder;
    if (folder.empty())
        return;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        m_impl->defect = folder + ": cannot create: " + error.message();
    m_impl->diskBytes = trim(folder, m_impl->options.maxDiskBytes);
    m_impl->writer = std::thread([impl = m_impl.get()] { impl->write(); });
}

StageStore::~StageStore() {
    if (!m_impl->writer.joinable())
        return;
    {
        const std::lock_guard lock(m_impl->mutex);
        m_impl->stopping = true;
    }
    m_impl->changed.notify_all();
    m_impl->writer.join();
}

std::optional<std::string> StageStore::Impl::find(std::uint64_t key) {
    if (const Packed packed = recall(key))
        return unpack(key, *packed);
    if (options.folder.empty())
        return {};
    const fs::path path = pathOf(key);
    Result<std::string> read = readFile(path.string());
    std::optional<std::string> bytes = read ? unpack(key, *read) : std::nullopt;
    if (!bytes)
        return {};
    auto file = std::make_shared<const std::string>(std::move(*read));
    std::error_code gone;
    fs::last_write_time(path, fs::file_time_type::clock::now(), gone); // used just now
    const std::lock_guard lock(mutex);
    remember(key, std::move(file));
    return bytes;
}

std::optional<std::string> StageStore::find(std::uint64_t key) {
    std::optional<std::string> bytes = m_impl->find(key);
    const std::lock_guard lock(m_impl->mutex);
    m_impl->traffic.found += bytes.has_value();
    return bytes;
}

void StageStore::put(std::uint64_t key, const std::string& bytes) {
    auto file = std::make_shared<const std::string>(pack(key, bytes));
    std::unique_lock lock(m_impl->mutex);
    ++m_impl->traffic.stored;
    m_impl->remember(key, file);
    if (m_impl->options.folder.empty())
        return;
    // If the disk is slower than the baker, the baker waits, so that memory does not fill up.
    constexpr std::size_t kMaxWaiting = 64;
    m_impl->changed.wait(lock, [&] { return m_impl->queue.size() < kMaxWaiting; });
    m_impl->queue.emplace_back(key, std::move(file));
    m_impl->changed.notify_all();
}

void StageStore::flush() {
    std::unique_lock lock(m_impl->mutex);
    m_impl->changed.wait(lock, [&] { return m_impl->queue.empty(); });
}

StageStore::Traffic StageStore::traffic() const {
    const std::lock_guard lock(m_impl->mutex);
    return m_impl->traffic;
}

std::string StageStore::defect() const {
    const std::lock_guard lock(m_impl->mutex);
    return m_impl->defect;
}

std::string defaultStageFolder() {
    const std::string cache = userFolder(UserFolder::Cache);
    return cache.empty() ? std::string() : cache + "/bake";
}

} // namespace limn
