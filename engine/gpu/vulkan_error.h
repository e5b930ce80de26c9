// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include <vulkan/vulkan.h>

namespace limn::gpu {

/// Thrown for a broken environment: device lost, out of memory. Caught in main; never thrown for
/// wrong input.
class VulkanError : public std::runtime_error {
public:
    VulkanError(VkResult code, const char* call);

    VkResult result;
};

/// The enumerator's name without VK_, or its number.
std::string resultName(VkResult result);

/// Throws VulkanError unless `result` is a success code.
inline void check(VkResult result, const char* call) {
    if (result < 0)
        throw VulkanError(result, call);
}

} // namespace limn::gpu

#define VK_CHECK(call) ::limn::gpu::check(call, #call)
