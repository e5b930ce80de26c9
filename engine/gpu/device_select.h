// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace limn::gpu {

/// A device with the required features, and the queue family to use.
struct SelectedDevice {
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
};

/// The best device of `instance` whose name contains `desc.name`. On failure the error says which
/// devices there are and what they lack.
/// Number of storage buffers that a shader can bind at once.
std::uint32_t maxStorageBuffers(const VkPhysicalDeviceLimits& limits);

Result<SelectedDevice> selectDevice(VkInstance instance, const DeviceDesc& desc);

/// All devices of `instance`, best kind first: discrete, integrated, virtual, CPU.
std::vector<VkPhysicalDevice> rankedDevices(VkInstance instance);

} // namespace limn::gpu
