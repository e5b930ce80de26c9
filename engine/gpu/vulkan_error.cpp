// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_error.h"

namespace limn::gpu {

std::string resultName(VkResult result) {
    switch (int(result)) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "initialisation failed";
    case VK_ERROR_DEVICE_LOST:
        return "device lost";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "layer not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "no Vulkan driver";
    case VK_ERROR_SURFACE_LOST_KHR:
        return "surface lost";
    case VK_ERROR_OUT_OF_DATE_KHR:
        return "surface out of date";
    }
    return "error " + std::to_string(int(result));
}

// Keeps only the function's name, because the arguments mean nothing to the reader of the message.
static std::string functionName(const char* call) {
    const std::string text = call;
    return text.substr(0, text.find('('));
}

VulkanError::VulkanError(VkResult code, const char* call)
    : std::runtime_error("Vulkan: " + functionName(call) + ": " + resultName(code)), result(code) {}

} // namespace limn::gpu
