// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/memory.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn::gpu {

/// Number of storage buffers that shaders of every device can bind at once.
inline constexpr std::uint32_t kStorageBuffers = 8;

struct DeviceDesc {
    /// Part of the device's name, case-insensitive ("llvmpipe"); empty selects the best kind.
    std::string name;
    /// Instance extensions for surfaces, as named by the window library. If not empty,
    /// VK_KHR_swapchain is enabled too.
    std::vector<std::string> instanceExtensions;
    /// Whether this queue family can present. Null: nothing is presented.
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queueFamily)> canPresent;
    /// Enables validation and synchronisation validation; without the layer it stays off (see
    /// Device::validating).
    bool validation = false;
};

/// What a submission waits for and signals besides the device's own timeline.
struct SubmitDesc {
    VkSemaphore wait = VK_NULL_HANDLE;
    VkPipelineStageFlags2 waitStage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    VkSemaphore signal = VK_NULL_HANDLE;
};

/// A Vulkan 1.3 device with one queue for graphics, compute and transfer. It is used by one thread.
/// Submissions are numbered 1, 2, …; a dropped resource is destroyed once every submission that may
/// read it has completed. The device must outlive everything created from it.
class Device {
public:
    ~Device(); ///< Waits for the GPU.
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    VkPhysicalDeviceProperties properties{};
    bool softwareRasteriser = false; ///< the "GPU" is the CPU
    bool anisotropy = false;         ///< samplerAnisotropy is enabled
    bool wireframe = false;          ///< fillModeNonSolid is enabled
    bool smallTexels = false;        ///< shaderStorageImageExtendedFormats is enabled, for R8
    bool fragmentStores = false;     ///< fragmentStoresAndAtomics is enabled
    /// Optional features that the device lacks, in words; the editor logs them.
    std::vector<std::string> lacking;
    bool validating = false;
    MemoryBlocks memory;

    /// Returns a command buffer in the recording state, which must be submitted. `name` is shown by
    /// captures.
    VkCommandBuffer begin(const char* name);
    /// Ends and submits. Returns the submission's number.
    std::uint64_t submit(VkCommandBuffer cmd, const SubmitDesc& desc = {});
    /// Records, submits and waits.
    void immediate(const char* name, const std::function<void(VkCommandBuffer)>& record);

    /// Fails, with a message for people, where shaders cannot bind as many storage buffers at once.
    Result<void> checkStorageBuffers(std::uint32_t needed) const;

    std::uint64_t submitted() const { return m_submitted; } ///< number of the last submission
    std::uint64_t completed() const; ///< all submissions up to this number are done
    void wait(std::uint64_t submission);
    void waitIdle() { wait(m_submitted); }

    /// Calls `destroy` when no submission made so far, nor one being recorded, can still need it.
    void retire(std::function<void()> destroy);
    /// Destroys retired resources that are due. submit() does so too.
    void collect();

    /// Names a handle for validation messages and captures.
    void setName(VkObjectType type, std::uint64_t objectHandle, const char* name);

    /// Validation warnings and errors so far, oldest first. May be called from any thread.
    std::vector<std::string> validationMessages() const;

private:
    friend Result<std::unique_ptr<Device>> createDevice(const DeviceDesc& desc);
    struct Impl;
    Device();
    void watchValidation();
    std::unique_ptr<Impl> m_impl;
    std::uint64_t m_submitted = 0;
};

/// Fails if there is no driver, no device of that name, or none with the required features; the
/// error says which.
Result<std::unique_ptr<Device>> createDevice(const DeviceDesc& desc);

/// Names of all Vulkan devices, best first. Empty without a driver.
std::vector<std::string> deviceNames();

} // namespace limn::gpu
