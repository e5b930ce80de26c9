// SPDX-License-Identifier: MIT
#include "tests/gpu/test_device.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "engine/gpu/timestamps.h"
#include "engine/gpu/vulkan_error.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

namespace limn::device_test {

using gpu::Buffer;
using gpu::Image;
using gpu::ImageDesc;

class GpuDevice : public DeviceTest {};

TEST_F(GpuDevice, SaysWhichQueueItSubmitsTo) {
    EXPECT_NE(device->queue, VkQueue(VK_NULL_HANDLE));
    EXPECT_GE(device->properties.apiVersion, VK_API_VERSION_1_3);
    const auto names = gpu::deviceNames();
    EXPECT_NE(std::find(names.begin(), names.end(), device->properties.deviceName), names.end());
}

TEST_F(GpuDevice, SaysWhichOptionalFeaturesItLacks) {
    const auto lacks = [&](const char* what) {
        return std::ranges::count(device->lacking, what) > 0;
    };
    EXPECT_EQ(lacks("anisotropic filters"), !device->anisotropy);
    EXPECT_EQ(lacks("wireframes"), !device->wireframe);
    EXPECT_EQ(lacks("storage images of 8 bits"), !device->smallTexels);
    EXPECT_EQ(lacks("stores by fragment shaders"), !device->fragmentStores);
    EXPECT_LE(device->lacking.size(), 6U);
}

TEST_F(GpuDevice, IsFoundByPartOfItsNameInAnyCase) {
    std::string name = device->properties.deviceName;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return char(std::toupper(c)); });
    const auto again = gpu::createDevice({.name = name.substr(1, 5)});
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_STREQ((*again)->properties.deviceName, device->properties.deviceName);
}

TEST(GpuDeviceChoice, AnUnknownNameIsAnErrorThatListsWhatThereIs) {
    const auto names = gpu::deviceNames();
    const auto none = gpu::createDevice({.name = "no such device"});
    ASSERT_FALSE(none);
    if (names.empty())
        GTEST_SKIP() << "no Vulkan device";
    EXPECT_NE(none.error().message.find(names[0]), std::string::npos) << none.error().message;
    EXPECT_NE(none.error().message.find("no such device"), std::string::npos);
}

TEST(GpuDeviceChoice, AWindowThatNoQueueCanPresentToIsAnError) {
    const auto none = gpu::createDevice(
        {.canPresent = [](VkInstance, VkPhysicalDevice, std::uint32_t) { return false; }});
    EXPECT_FALSE(none);
}

TEST_F(GpuDevice, ReadsBackTheBytesThatWereUploaded) {
    std::vector<std::uint32_t> sent(100'003), received(sent.size());
    std::iota(sent.begin(), sent.end(), 17u);
    Buffer buffer;
    device->immediate("upload", [&](VkCommandBuffer cmd) {
        buffer = gpu::uploadBuffer(*device, cmd, std::as_bytes(std::span(sent)),
                                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "numbers");
    });
    gpu::readBuffer(*device, buffer, std::as_writable_bytes(std::span(received)));
    EXPECT_EQ(sent, received);
}

TEST_F(GpuDevice, ReplacesOnlyTheBytesOfABufferThatItIsTold) {
    std::vector<std::uint32_t> sent(100, 1), received(sent.size());
    const std::array<std::uint32_t, 2> later = {7, 8};
    Buffer buffer;
    device->immediate("upload", [&](VkCommandBuffer cmd) {
        buffer = gpu::uploadBuffer(*device, cmd, std::as_bytes(std::span(sent)),
                                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "numbers");
    });
    device->immediate("update", [&](VkCommandBuffer cmd) {
        gpu::updateBuffer(*device, cmd, buffer, 40, std::as_bytes(std::span(later)));
    });
    gpu::readBuffer(*device, buffer, std::as_writable_bytes(std::span(received)));
    sent[10] = 7, sent[11] = 8;
    EXPECT_EQ(sent, received);
}

TEST_F(GpuDevice, ReadsBackTheLayersOfAnImageOneAfterTheOther) {
    std::vector<std::uint32_t> texels(2 * 3 * 4), received(texels.size());
    std::iota(texels.begin(), texels.end(), 5u);
    const Image image(*device,
                      {.width = 2,
                       .height = 3,
                       .layers = 4,
                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                       .array = true});
    device->immediate("upload", [&](VkCommandBuffer cmd) {
        gpu::uploadImage(*device, cmd, image, std::as_bytes(std::span(texels)));
    });
    gpu::readImage(*device, image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 2, 3,
                   std::as_writable_bytes(std::span(received)), 4);
    EXPECT_EQ(received, texels);
}

TEST_F(GpuDevice, TimesTheStepsOfACommandBufferWithinTheWallClock) {
    constexpr VkDeviceSize kLarge = 64 << 20;
    const Buffer buffer(*device, {.size = kLarge, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    gpu::Timestamps times(*device, 2);
    std::array<double, 2> best = {HUGE_VAL, HUGE_VAL}; // of many: a busy machine stops any of them
    for (int round = 0; round < 20; ++round) {
        const auto start = std::chrono::steady_clock::now();
        device->immediate("times", [&](VkCommandBuffer cmd) {
            times.begin(cmd);
            times.mark(cmd);
            vkCmdFillBuffer(cmd, buffer.handle, 0, kLarge, 1);
            times.mark(cmd);
        });
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now() - start;
        const std::span<const double> ms = times.steps();
        ASSERT_EQ(ms.size(), 2u);
        EXPECT_LE(ms[0] + ms[1], wall.count());
        for (std::size_t i = 0; i < 2; ++i)
            best[i] = std::min(best[i], ms[i]);
    }
    EXPECT_GT(best[1], best[0]) << "the second writes 64 MiB, the first nothing";
}

TEST_F(GpuDevice, ReadsBackTheTopMipOfAnUploadedImage) {
    constexpr std::uint32_t kWidth = 5, kHeight = 3;
    std::vector<std::uint32_t> texels(15 + 2 + 1);
    std::iota(texels.begin(), texels.end(), 1000u);
    ImageDesc desc = ImageDesc::texture(kWidth, kHeight, VK_FORMAT_R8G8B8A8_UNORM,
                                        gpu::mipCount(kWidth, kHeight), "image");
    ASSERT_EQ(desc.mips, 3u);
    desc.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    const Image image(*device, desc);
    device->immediate("upload", [&](VkCommandBuffer cmd) {
        gpu::uploadImage(*device, cmd, image, std::as_bytes(std::span(texels)));
    });
    std::vector<std::uint32_t> received(4 * 2);
    gpu::readImage(*device, image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 4, 2,
                   std::as_writable_bytes(std::span(received)));
    EXPECT_EQ(received,
              (std::vector<std::uint32_t>{1000, 1001, 1002, 1003, 1005, 1006, 1007, 1008}));
}

TEST_F(GpuDevice, NumbersItsSubmissionsAndKnowsWhenTheyAreDone) {
    const std::uint64_t first = device->submit(device->begin("first"));
    const std::uint64_t second = device->submit(device->begin("second"));
    EXPECT_EQ(second, first + 1);
    device->wait(second);
    EXPECT_GE(device->completed(), second);
}

TEST_F(GpuDevice, KeepsADroppedResourceUntilTheSubmissionThatUsesItIsDone) {
    bool destroyed = false;
    const VkCommandBuffer cmd = device->begin("frame");
    device->retire([&] { destroyed = true; });
    device->collect();
    EXPECT_FALSE(destroyed) << "its command buffer is still being recorded";
    const std::uint64_t frame = device->submit(cmd);
    device->wait(frame);
    EXPECT_TRUE(destroyed);
}

TEST_F(GpuDevice, ABufferDroppedWhileInFlightIsFreedLater) {
    const std::uint64_t before = device->memory.bytesInUse;
    const VkCommandBuffer cmd = device->begin("frame");
    {
        const Buffer buffer(*device, {.size = 1 << 20, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT});
        vkCmdFillBuffer(cmd, buffer.handle, 0, buffer.size, 7);
    }
    EXPECT_GT(device->memory.bytesInUse, before);
    device->wait(device->submit(cmd));
    EXPECT_EQ(device->memory.bytesInUse, before);
}

TEST_F(GpuDevice, AMovedFromBufferIsEmpty) {
    Buffer a(*device, {.size = 64, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    const VkBuffer handle = a.handle;
    const Buffer b = std::move(a);
    EXPECT_EQ(b.handle, handle);
    EXPECT_FALSE(a);
    EXPECT_EQ(b.size, 64u);
}

TEST_F(GpuDevice, ReusesCommandBuffersThatAreDone) {
    const VkCommandBuffer first = device->begin("first");
    device->wait(device->submit(first));
    const VkCommandBuffer second = device->begin("second");
    EXPECT_EQ(first, second);
    device->submit(second);
}

TEST(GpuValidation, ReportsAMisuseWhenItIsOn) {
    auto created = gpu::createDevice({.validation = true});
    if (!created)
        GTEST_SKIP() << created.error().message;
    gpu::Device& device = **created;
    if (!device.validating)
        GTEST_SKIP() << "VK_LAYER_KHRONOS_validation is missing";
    // Two copies into the same bytes without a barrier: only synchronisation validation sees it.
    const Buffer a(
        device,
        {.size = 64, .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    const Buffer b(device, {.size = 64, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    device.immediate("hazard", [&](VkCommandBuffer cmd) {
        const VkBufferCopy region{0, 0, 64};
        vkCmdCopyBuffer(cmd, a.handle, b.handle, 1, &region);
        vkCmdCopyBuffer(cmd, a.handle, b.handle, 1, &region);
    });
    EXPECT_FALSE(device.validationMessages().empty());
}

TEST(GpuErrors, NameTheFunctionAndTheReason) {
    try {
        gpu::check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2(queue, 1, &info, fence)");
        FAIL();
    } catch (const gpu::VulkanError& e) {
        EXPECT_STREQ(e.what(), "Vulkan: vkQueueSubmit2: device lost");
        EXPECT_EQ(e.result, VK_ERROR_DEVICE_LOST);
    }
}

} // namespace limn::device_test
