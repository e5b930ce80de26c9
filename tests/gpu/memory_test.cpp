// SPDX-License-Identifier: MIT
#include "tests/gpu/test_device.h"

#include <map>
#include <random>

namespace limn::memory_test {

using gpu::Allocation;
using gpu::MemoryBlocks;
using gpu::MemoryKind;

class GpuMemory : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (device)
            blocks.init(device->physicalDevice, device->device);
    }
    void TearDown() override {
        blocks.destroy();
        DeviceTest::TearDown();
    }
    Allocation allocate(VkDeviceSize size, VkDeviceSize alignment = 16) {
        return blocks.allocate({size, alignment, ~0u}, MemoryKind::Gpu, false);
    }

    MemoryBlocks blocks;
};

TEST_F(GpuMemory, NeverHandsOutOverlappingRanges) {
    std::mt19937 random(1);
    std::vector<Allocation> live;
    for (int step = 0; step < 4000; ++step) {
        if (live.empty() || random() % 5 < 3) {
            const VkDeviceSize alignment = 1ull << (random() % 12);
            const Allocation a = allocate(1 + random() % 300'000, alignment);
            EXPECT_EQ(a.offset % alignment, 0u);
            live.push_back(a);
        } else {
            const std::size_t i = random() % live.size();
            blocks.free(live[i]);
            live.erase(live.begin() + std::ptrdiff_t(i));
        }
    }
    std::map<std::pair<VkDeviceMemory, VkDeviceSize>, VkDeviceSize> ends;
    std::uint64_t sum = 0;
    for (const Allocation& a : live) {
        ends[{a.memory, a.offset}] = a.offset + a.size;
        sum += a.size;
    }
    EXPECT_EQ(ends.size(), live.size());
    EXPECT_EQ(sum, blocks.bytesInUse);
    for (auto it = ends.begin(), next = std::next(it); next != ends.end(); ++it, ++next) {
        if (it->first.first == next->first.first) {
            EXPECT_LE(it->second, next->first.second);
        }
    }
}

TEST_F(GpuMemory, FreedNeighboursMergeSoThatABlockIsWholeAgain) {
    const VkDeviceSize quarter = MemoryBlocks::kBlockSize / 4;
    const Allocation a = allocate(quarter), b = allocate(quarter), c = allocate(quarter);
    blocks.free(a);
    blocks.free(c);
    blocks.free(b);
    const Allocation whole = allocate(MemoryBlocks::kBlockSize);
    EXPECT_EQ(whole.memory, a.memory);
    EXPECT_EQ(whole.offset, 0u);
    EXPECT_EQ(blocks.bytesReserved, MemoryBlocks::kBlockSize);
}

TEST_F(GpuMemory, ALargeRequestGetsABlockOfItsOwnAndGivesItBack) {
    const Allocation large = allocate(MemoryBlocks::kBlockSize + 1);
    EXPECT_EQ(blocks.bytesReserved, MemoryBlocks::kBlockSize + 1);
    blocks.free(large);
    EXPECT_EQ(blocks.bytesReserved, 0u);
    EXPECT_EQ(blocks.bytesInUse, 0u);
}

TEST_F(GpuMemory, ImagesAndBuffersDoNotShareABlock) {
    const Allocation buffer = allocate(256);
    const Allocation image = blocks.allocate({256, 16, ~0u}, MemoryKind::Gpu, true);
    EXPECT_NE(buffer.memory, image.memory);
}

TEST_F(GpuMemory, UploadAndReadbackAreMapped) {
    EXPECT_NE(blocks.allocate({256, 16, ~0u}, MemoryKind::Upload, false).mapped, nullptr);
    EXPECT_NE(blocks.allocate({256, 16, ~0u}, MemoryKind::Readback, false).mapped, nullptr);
    EXPECT_EQ(allocate(256).mapped, nullptr);
}

} // namespace limn::memory_test
