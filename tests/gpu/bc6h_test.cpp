// SPDX-License-Identifier: MIT
// Blocks as another decoder reads them: the device's.
#include "tests/gpu/test_device.h"

#include "engine/files/bc6h.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/image.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include <glm/vec4.hpp>

namespace limn::bc6h_device_test {
namespace {

constexpr std::array<std::uint32_t, 14> kCodes = {0, 1, 2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15};

class Bc6hOnDevice : public DeviceTest {
protected:
    /// Texels of blocks that lie side by side, row by row.
    std::vector<glm::vec4> decoded(const std::vector<Bc6hBlock>& blocks, VkFormat format) {
        const auto width = std::uint32_t(4 * blocks.size());
        gpu::ImageDesc desc = gpu::ImageDesc::texture(width, 4, format, 1, "blocks");
        desc.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        const gpu::Image image(*device, desc);
        const gpu::Buffer staging(*device, {.size = blocks.size() * sizeof(Bc6hBlock),
                                            .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                            .memory = gpu::MemoryKind::Upload,
                                            .name = "blocks"});
        std::memcpy(staging.mapped, blocks.data(), blocks.size() * sizeof(Bc6hBlock));
        constexpr VkImageAspectFlags kColor = VK_IMAGE_ASPECT_COLOR_BIT;
        device->immediate("upload", [&](VkCommandBuffer cmd) {
            gpu::imageBarrier(cmd, image.handle, kColor, gpu::kUndefined, gpu::kTransferWrite);
            VkBufferImageCopy region{};
            region.imageSubresource = {kColor, 0, 0, 1};
            region.imageExtent = {width, 4, 1};
            vkCmdCopyBufferToImage(cmd, staging.handle, image.handle,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
            gpu::imageBarrier(cmd, image.handle, kColor, gpu::kTransferWrite, gpu::kFragmentRead);
        });
        gpu::ImageDesc floats =
            gpu::ImageDesc::renderTarget(width, 4, VK_FORMAT_R32G32B32A32_SFLOAT, "decoded blocks");
        floats.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        const gpu::Image target(*device, floats);
        constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        gpu::sampleImage(*device, image, width, 4, target, kLayout);
        std::vector<glm::vec4> texels(std::size_t(width) * 4);
        gpu::readImage(*device, target, kLayout, width, 4,
                       std::as_writable_bytes(std::span(texels)));
        return texels;
    }
};

TEST_F(Bc6hOnDevice, AreDecodedToTheSameBitsInAllModes) {
    if (std::ranges::count(device->lacking, "textures of BC blocks") > 0)
        GTEST_SKIP() << "the device does not know the format";
    std::mt19937 random(9);
    for (const auto& [sign, format] : {std::pair{Bc6hSign::Unsigned, VK_FORMAT_BC6H_UFLOAT_BLOCK},
                                       std::pair{Bc6hSign::Signed, VK_FORMAT_BC6H_SFLOAT_BLOCK}}) {
        std::vector<Bc6hBlock> blocks(64 * kCodes.size());
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            for (std::uint8_t& byte : blocks[k])
                byte = std::uint8_t(random());
            const std::uint32_t code = kCodes[k % kCodes.size()], mask = code < 2 ? 3 : 31;
            blocks[k][0] = std::uint8_t((blocks[k][0] & ~mask) | code);
        }
        const std::vector<glm::vec4> drawn = decoded(blocks, format);
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            const Bc6hTexels texels = decodeBc6h(blocks[k], sign);
            for (std::size_t i = 0; i < texels.size(); ++i)
                ASSERT_EQ(glm::vec3(drawn[i / 4 * 4 * blocks.size() + 4 * k + i % 4]), texels[i])
                    << "mode " << kCodes[k % kCodes.size()] << ", texel " << i;
        }
    }
}

} // namespace
} // namespace limn::bc6h_device_test
