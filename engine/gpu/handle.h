// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/device.h"

#include <utility>

namespace limn::gpu {

/// Owns one handle that `Destroy(VkDevice, T, nullptr)` destroys. Move-only; empty after a move.
/// The destructor retires the handle, because frames in flight may still use it.
template <class T, auto Destroy>
class Handle {
public:
    Handle() = default;
    Handle(Device& device, T owned) : handle(owned), m_device(&device) {}
    ~Handle() {
        if (handle)
            m_device->retire(
                [device = m_device->device, h = handle] { Destroy(device, h, nullptr); });
    }
    Handle(Handle&& other) noexcept { swap(other); }
    Handle& operator=(Handle other) noexcept {
        swap(other);
        return *this;
    }
    explicit operator bool() const { return handle != VK_NULL_HANDLE; }

    T handle = VK_NULL_HANDLE;

private:
    void swap(Handle& other) noexcept {
        std::swap(handle, other.handle);
        std::swap(m_device, other.m_device);
    }

    Device* m_device = nullptr;
};

using DescriptorPool = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using DescriptorSetLayout = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using ImageView = Handle<VkImageView, vkDestroyImageView>;
using Pipeline = Handle<VkPipeline, vkDestroyPipeline>;
using PipelineLayout = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using QueryPool = Handle<VkQueryPool, vkDestroyQueryPool>;
using Sampler = Handle<VkSampler, vkDestroySampler>;
using Semaphore = Handle<VkSemaphore, vkDestroySemaphore>;

} // namespace limn::gpu
