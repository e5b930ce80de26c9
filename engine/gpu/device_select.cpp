// SPDX-License-Identifier: MIT
#include "engine/gpu/device_select.h"

#include "engine/gpu/vulkan_error.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>

namespace limn::gpu {

static std::string lower(std::string text) {
    for (char& c : text)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

static int rank(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_OTHER:
    case VK_PHYSICAL_DEVICE_TYPE_MAX_ENUM:
        break;
    }
    return 4;
}

std::vector<VkPhysicalDevice> rankedDevices(VkInstance instance) {
    std::uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) < 0)
        return {};
    std::vector<VkPhysicalDevice> devices(count);
    if (vkEnumeratePhysicalDevices(instance, &count, devices.data()) < 0)
        return {};
    devices.resize(count);
    std::stable_sort(devices.begin(), devices.end(),
                     [](VkPhysicalDevice a, VkPhysicalDevice b) { return rank(a) < rank(b); });
    return devices;
}

static std::optional<std::uint32_t> findQueueFamily(VkInstance instance, VkPhysicalDevice device,
                                                    const DeviceDesc& desc) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags kNeed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i)
        if ((families[i].queueFlags & kNeed) == kNeed &&
            (!desc.canPresent || desc.canPresent(instance, device, i)))
            return i;
    return std::nullopt;
}

std::uint32_t maxStorageBuffers(const VkPhysicalDeviceLimits& limits) {
    return std::min(limits.maxPerStageDescriptorStorageBuffers,
                    limits.maxDescriptorSetStorageBuffers);
}

// Required features that the device lacks; empty if it has them all.
static std::string whatIsMissing(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3)
        return "Vulkan 1.3";
    if (maxStorageBuffers(properties.limits) < kStorageBuffers)
        return fmt::format("{} storage buffers at once", kStorageBuffers);
    VkPhysicalDeviceVulkan13Features v13{};
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    VkPhysicalDeviceVulkan12Features v12{};
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12.pNext = &v13;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &v12;
    vkGetPhysicalDeviceFeatures2(device, &features);
    if (!v13.dynamicRendering)
        return "dynamic rendering";
    if (!v13.synchronization2)
        return "synchronization2";
    if (!v13.maintenance4)
        return "maintenance4";
    if (!v12.timelineSemaphore)
        return "timeline semaphores";
    VkFormatProperties format;
    vkGetPhysicalDeviceFormatProperties(device, VK_FORMAT_R32G32B32A32_SFLOAT, &format);
    constexpr VkFormatFeatureFlags kNeed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                           VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    if ((format.optimalTilingFeatures & kNeed) != kNeed)
        return "filtering and blending of 32-bit float images";
    return {};
}

Result<SelectedDevice> selectDevice(VkInstance instance, const DeviceDesc& desc) {
    const std::vector<VkPhysicalDevice> devices = rankedDevices(instance);
    if (devices.empty())
        return fail("no Vulkan device on this machine");
    std::string reasons;
    for (VkPhysicalDevice device : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(device, &properties);
        const std::string name = properties.deviceName;
        std::string reason;
        if (lower(name).find(lower(desc.name)) == std::string::npos)
            reason = "other name";
        else if (reason = whatIsMissing(device); !reason.empty())
            reason = "lacks " + reason;
        else if (const auto family = findQueueFamily(instance, device, desc))
            return SelectedDevice{device, *family};
        else
            reason = desc.canPresent ? "cannot draw into this window" : "lacks a graphics queue";
        reasons += fmt::format("{}{} ({})", reasons.empty() ? "" : ", ", name, reason);
    }
    return desc.name.empty() ? fail("no usable Vulkan device: " + reasons)
                             : fail(fmt::format("no Vulkan device \"{}\": {}", desc.name, reasons));
}

} // namespace limn::gpu
