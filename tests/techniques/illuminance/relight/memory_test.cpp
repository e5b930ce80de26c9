// SPDX-License-Identifier: MIT
// Relighting writes to memory that it has: counted by operator new.
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include <malloc.h>

static std::atomic<std::uint64_t> allocations = 0;
static std::atomic<std::int64_t> allocated = 0; ///< and not yet freed [bytes]

// Not inline, or GCC sees free() of what came from new.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    void* memory = std::malloc(size);
    allocated += std::int64_t(malloc_usable_size(memory));
    return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    allocated -= std::int64_t(malloc_usable_size(memory));
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    operator delete(memory);
}

namespace limn::memory_test {
namespace {

void expectNoneAnew(LinkStorage storage) {
    Scene scene = *litRoom(2000, 2000);
    scene.lights.resize(20, scene.lights[0]);
    scene.bake.storage = storage;
    scene.instances[1].dynamic = true; // lit from the grid, whose links are the last of all
    const TraceScene trace{scene};
    const auto made = std::make_shared<const Bake>(*bake(trace));
    Relighter relighter(made);
    CacheFlags seen(made->caches.lightmapCount, 0);
    for (std::size_t c = 0; c < seen.size(); c += 3)
        seen[c] = 1;
    const auto relight = [&](float x, const CacheFlags* only) {
        scene.lights[3].position.x = x;
        const std::uint64_t before = allocations;
        relighter.relight(scene, trace, 2, {}, only);
        return allocations - before;
    };
    EXPECT_GT(relight(1.5f, nullptr), 0U) << "the first call makes room";
    EXPECT_EQ(relighter.field().gridSize, glm::uvec3(2));
    relight(1.6f, &seen);
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(relight(1.7f + 0.1f * float(k), k % 2 == 0 ? nullptr : &seen), 0U) << k;
}

TEST(RelightMemory, MovedLightsTakeNoneAnew) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        expectNoneAnew(storage);
}

// What the statistics and benchmarks call its memory is what it takes from the heap, but for what
// the allocator rounds up and small things such as names of materials.
TEST(RelightMemory, IsAllThatItReports) {
    Scene scene = *litRoom(8000, 8000);
    scene.lights.resize(3, scene.lights[0]);
    scene.lights[1].position.x = 1;
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        scene.bake.storage = storage;
        const TraceScene trace{scene};
        const auto made = std::make_shared<const Bake>(*bake(trace));
        Relighter(made).relight(scene, trace, 1); // what is allocated once for all
        const std::int64_t before = allocated;
        Relighter relighter(made);
        const RelightStats stats = relighter.relight(scene, trace, 2);
        const double taken = double(allocated - before);
        EXPECT_NEAR(double(stats.bytes), taken, taken * 0.02) << int(storage);
        EXPECT_GT(stats.bytes, std::uint64_t(1) << 21);
    }
}

} // namespace
} // namespace limn::memory_test
