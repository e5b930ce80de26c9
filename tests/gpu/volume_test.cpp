// SPDX-License-Identifier: MIT
#include "tests/gpu/test_device.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/image.h"
#include "engine/gpu/pipeline.h"
#include "shaders/tests/volume_shift.comp.h"

#include <array>
#include <numeric>

namespace limn::volume_test {
namespace {

using gpu::Image;
using gpu::ImageDesc;

constexpr glm::uvec3 kSize{5, 4, 3};
constexpr std::size_t kTexels = std::size_t(kSize.x) * kSize.y * kSize.z;

class GpuVolume : public DeviceTest {
protected:
    Image uploaded(const ImageDesc& desc, std::span<const float> texels) {
        Image image(*device, desc);
        device->immediate("upload", [&](VkCommandBuffer cmd) {
            gpu::uploadImage(*device, cmd, image, std::as_bytes(texels));
        });
        return image;
    }
    std::vector<float> read(const Image& image, VkImageLayout layout) {
        std::vector<float> texels(std::size_t(image.width) * image.height * image.depth);
        gpu::readImage(*device, image, layout, image.width, image.height,
                       std::as_writable_bytes(std::span(texels)));
        return texels;
    }
};

TEST_F(GpuVolume, IsUploadedWithItsMipsAndReadBackSliceAfterSlice) {
    const ImageDesc desc = ImageDesc::volume(kSize, VK_FORMAT_R32_SFLOAT,
                                             gpu::mipCount(kSize.x, kSize.y, kSize.z), "volume");
    ASSERT_EQ(desc.mips, 3U);
    EXPECT_EQ(gpu::mipCount(1, 1, 9), 4U);
    std::vector<float> texels(kTexels + 2 * 2 * 1 + 1); // 5 x 4 x 3, 2 x 2 x 1 and 1
    std::iota(texels.begin(), texels.end(), 7.f);
    const Image image = uploaded(desc, texels);
    EXPECT_EQ(image.depth, kSize.z);
    texels.resize(kTexels);
    EXPECT_EQ(read(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL), texels);
}

TEST_F(GpuVolume, IsSampledLinearlyAlongZAndWrittenByShaders) {
    const ImageDesc desc = ImageDesc::volume(kSize, VK_FORMAT_R32_SFLOAT, 1, "volume");
    std::vector<float> texels(kTexels);
    std::iota(texels.begin(), texels.end(), 0.f);
    const Image source = uploaded(desc, texels), target(*device, desc);

    constexpr std::array kTypes = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                   VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    const gpu::Sampler sampler = gpu::createSampler(*device, {});
    const gpu::DescriptorSetLayout setLayout = gpu::createSetLayout(*device, kTypes);
    const gpu::DescriptorPool pool = gpu::createDescriptorPool(*device, 1, kTypes);
    const VkDescriptorSet set = gpu::allocateSet(*device, pool, setLayout);
    gpu::writeTexture(*device, set, 0, source.view, sampler.handle);
    gpu::writeStorageImage(*device, set, 1, target.view);
    const gpu::PipelineLayout layout =
        gpu::createPipelineLayout(*device, {&setLayout.handle, 1}, 0, "shift");
    const gpu::Pipeline pipeline =
        gpu::createComputePipeline(*device, kVolumeShiftComp, layout.handle, {}, "shift");
    device->immediate("shift", [&](VkCommandBuffer cmd) {
        gpu::imageBarrier(cmd, target.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kUndefined,
                          gpu::kComputeWrite);
        vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout.handle, 0, 1, &set, 0,
                                nullptr);
        vkCmdDispatch(cmd, gpu::groups(kSize.x, 4), gpu::groups(kSize.y, 4),
                      gpu::groups(kSize.z, 4));
    });
    const std::vector<float> shifted = read(target, VK_IMAGE_LAYOUT_GENERAL);
    constexpr std::size_t kSlice = std::size_t(kSize.x) * kSize.y;
    for (std::size_t i = 0; i < kTexels; ++i) // the last slice is continued
        EXPECT_NEAR(shifted[i], texels[i] + (i + kSlice < kTexels ? 0.5f * float(kSlice) : 0),
                    1e-3f)
            << i;
}

} // namespace
} // namespace limn::volume_test
