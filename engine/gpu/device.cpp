// SPDX-License-Identifier: MIT
#include "engine/gpu/device.h"

#include "engine/core/log.h"
#include "engine/gpu/device_select.h"
#include "engine/gpu/vulkan_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <deque>
#include <mutex>

#include <fmt/format.h>

namespace limn::gpu {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

struct Device::Impl {
    struct Recorder {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer cmd = VK_NULL_HANDLE;
        std::uint64_t submission = 0; ///< it may be reused once this is complete
        bool recording = false;
    };
    struct Retired {
        std::uint64_t submission;
        std::function<void()> destroy;
    };

    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr;
    VkSemaphore timeline = VK_NULL_HANDLE;
    std::vector<Recorder> recorders;
    std::uint32_t recording = 0; ///< recorders between begin() and submit()
    std::deque<Retired> retired;
    mutable std::mutex messageMutex;
    std::vector<std::string> messages;
    std::function<void(const char*)> collectMessage; ///< the messenger holds its address
};

static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                VkDebugUtilsMessageTypeFlagsEXT,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                void* user) {
    const auto& collect = *static_cast<const std::function<void(const char*)>*>(user);
    collect(data->pMessage);
    return VK_FALSE;
}

namespace {

/// What createDevice() sets up before there is a Device to own it.
struct InstanceSetup {
    VkInstance instance = VK_NULL_HANDLE;
    bool validating = false;
    bool debugUtils = false;
};

} // namespace

static bool hasInstanceExtension(const char* layer, const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, all.data());
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& p) {
        return std::strcmp(p.extensionName, name) == 0;
    });
}

static bool hasValidationLayer() {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> all(count);
    vkEnumerateInstanceLayerProperties(&count, all.data());
    return std::any_of(all.begin(), all.end(), [](const VkLayerProperties& p) {
        return std::strcmp(p.layerName, kValidationLayer) == 0;
    });
}

static Result<InstanceSetup> createInstance(const DeviceDesc& desc) {
    InstanceSetup setup;
    setup.validating = desc.validation && hasValidationLayer();
    if (desc.validation && !setup.validating)
        logWarning("Vulkan validation was asked for, but VK_LAYER_KHRONOS_validation is missing");
    std::vector<const char*> extensions;
    for (const std::string& name : desc.instanceExtensions)
        extensions.push_back(name.c_str());
    setup.debugUtils =
        setup.validating || hasInstanceExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (setup.debugUtils)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (setup.validating)
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);

    const VkValidationFeatureEnableEXT sync =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = nullptr,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &sync,
                                           .disabledValidationFeatureCount = 0,
                                           .pDisabledValidationFeatures = nullptr};
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pNext = nullptr,
                                        .pApplicationName = "Limn",
                                        .applicationVersion = 0,
                                        .pEngineName = "Limn",
                                        .engineVersion = 0,
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = setup.validating ? &features : nullptr,
                                    .flags = 0,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = setup.validating ? 1u : 0u,
                                    .ppEnabledLayerNames = &kValidationLayer,
                                    .enabledExtensionCount = std::uint32_t(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    const VkResult result = vkCreateInstance(&info, nullptr, &setup.instance);
    if (result < 0)
        return fail("no Vulkan: " + resultName(result));
    return setup;
}

/// A feature that is used where the device has it.
struct OptionalFeature {
    VkBool32 VkPhysicalDeviceFeatures::*member;
    const char* what;
};
static constexpr std::array<OptionalFeature, 6> kOptional = {{
    {&VkPhysicalDeviceFeatures::samplerAnisotropy, "anisotropic filters"},
    {&VkPhysicalDeviceFeatures::fillModeNonSolid, "wireframes"},
    {&VkPhysicalDeviceFeatures::shaderSampledImageArrayDynamicIndexing,
     "dynamic indices of textures"},
    {&VkPhysicalDeviceFeatures::shaderStorageImageExtendedFormats, "storage images of 8 bits"},
    {&VkPhysicalDeviceFeatures::fragmentStoresAndAtomics, "stores by fragment shaders"},
    {&VkPhysicalDeviceFeatures::textureCompressionBC, "textures of BC blocks"},
}};

/// Those of kOptional that the device has; lists the others in Device::lacking.
static VkPhysicalDeviceFeatures optionalFeatures(Device& d) {
    VkPhysicalDeviceFeatures available, wanted{};
    vkGetPhysicalDeviceFeatures(d.physicalDevice, &available);
    for (const OptionalFeature& feature : kOptional) {
        wanted.*feature.member = available.*feature.member;
        if (!(available.*feature.member))
            d.lacking.emplace_back(feature.what);
    }
    return wanted;
}

static VkResult createLogicalDevice(Device& d, bool presents) {
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .queueFamilyIndex = d.queueFamily,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkPhysicalDeviceFeatures optional = optionalFeatures(d);
    d.anisotropy = optional.samplerAnisotropy;
    d.wireframe = optional.fillModeNonSolid;
    d.smallTexels = optional.shaderStorageImageExtendedFormats;
    d.fragmentStores = optional.fragmentStoresAndAtomics;
    VkPhysicalDeviceVulkan13Features v13{};
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v13.dynamicRendering = VK_TRUE;
    v13.synchronization2 = VK_TRUE;
    v13.maintenance4 = VK_TRUE; // group sizes as specialisation constants
    VkPhysicalDeviceVulkan12Features v12{};
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12.pNext = &v13;
    v12.timelineSemaphore = VK_TRUE;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &v12;
    features.features = optional;
    const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features,
                                  .flags = 0,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledLayerCount = 0,
                                  .ppEnabledLayerNames = nullptr,
                                  .enabledExtensionCount = presents ? 1u : 0u,
                                  .ppEnabledExtensionNames = &swapchain,
                                  .pEnabledFeatures = nullptr};
    return vkCreateDevice(d.physicalDevice, &info, nullptr, &d.device);
}

static VkSemaphore createTimeline(VkDevice device) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .pNext = nullptr,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
                                         .initialValue = 0};
    const VkSemaphoreCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type, .flags = 0};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    VK_CHECK(vkCreateSemaphore(device, &info, nullptr, &semaphore));
    return semaphore;
}

// The leak checker distinguishes drivers' leaks from ours by the library they come from, which must
// still be loaded when the process ends. Under AddressSanitizer the first instance with each set of
// layers is therefore kept.
static void destroyInstance(VkInstance instance, [[maybe_unused]] bool validating) {
#ifdef __SANITIZE_ADDRESS__
    static std::array<VkInstance, 2> kept{};
    if (!kept[validating]) {
        kept[validating] = instance;
        return;
    }
#endif
    vkDestroyInstance(instance, nullptr);
}

Device::Device() : m_impl(std::make_unique<Impl>()) {}

Result<std::unique_ptr<Device>> createDevice(const DeviceDesc& desc) {
    auto setup = createInstance(desc);
    if (!setup)
        return tl::make_unexpected(setup.error());
    std::unique_ptr<Device> d(new Device());
    d->instance = setup->instance;
    d->validating = setup->validating;
    if (d->validating)
        d->watchValidation();
    const auto selected = selectDevice(d->instance, desc);
    if (!selected)
        return tl::make_unexpected(selected.error());
    d->physicalDevice = selected->physicalDevice;
    d->queueFamily = selected->queueFamily;
    vkGetPhysicalDeviceProperties(d->physicalDevice, &d->properties);
    d->softwareRasteriser = d->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const VkResult result = createLogicalDevice(*d, !desc.instanceExtensions.empty());
    if (result < 0)
        return fail(std::string(d->properties.deviceName) + ": " + resultName(result));
    vkGetDeviceQueue(d->device, d->queueFamily, 0, &d->queue);
    if (setup->debugUtils)
        d->m_impl->setObjectName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(d->instance, "vkSetDebugUtilsObjectNameEXT"));
    d->memory.init(d->physicalDevice, d->device);
    d->m_impl->timeline = createTimeline(d->device);
    return d;
}

Result<void> Device::checkStorageBuffers(std::uint32_t needed) const {
    const std::uint32_t maxBuffers = maxStorageBuffers(properties.limits);
    return maxBuffers < needed
               ? fail(fmt::format("{}: {} storage buffers can be bound at once, {} are "
                                  "needed",
                                  properties.deviceName, maxBuffers, needed))
               : Result<void>();
}

void Device::watchValidation() {
    m_impl->collectMessage = [impl = m_impl.get()](const char* text) {
        const std::lock_guard lock(impl->messageMutex);
        impl->messages.emplace_back(text);
        logError(text);
    };
    const VkDebugUtilsMessengerCreateInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .pNext = nullptr,
        .flags = 0,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = onMessage,
        .pUserData = &m_impl->collectMessage};
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    VK_CHECK(create(instance, &info, nullptr, &m_impl->messenger));
}

Device::~Device() {
    if (device) {
        vkDeviceWaitIdle(device);
        // Destroying a retired owner may retire further resources.
        while (!m_impl->retired.empty()) {
            const auto destroy = std::move(m_impl->retired.front().destroy);
            m_impl->retired.pop_front();
            destroy();
        }
        for (const Impl::Recorder& r : m_impl->recorders)
            vkDestroyCommandPool(device, r.pool, nullptr);
        vkDestroySemaphore(device, m_impl->timeline, nullptr);
        memory.destroy();
        vkDestroyDevice(device, nullptr);
    }
    if (m_impl->messenger)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
            instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, m_impl->messenger, nullptr);
    destroyInstance(instance, validating);
}

VkCommandBuffer Device::begin(const char* name) {
    const std::uint64_t done = completed();
    auto& all = m_impl->recorders;
    auto free = std::find_if(all.begin(), all.end(), [&](const Impl::Recorder& r) {
        return !r.recording && r.submission <= done;
    });
    if (free == all.end()) {
        Impl::Recorder r;
        const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .pNext = nullptr,
                                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                           .queueFamilyIndex = queueFamily};
        VK_CHECK(vkCreateCommandPool(device, &pool, nullptr, &r.pool));
        const VkCommandBufferAllocateInfo info{.sType =
                                                   VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .pNext = nullptr,
                                               .commandPool = r.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        VK_CHECK(vkAllocateCommandBuffers(device, &info, &r.cmd));
        free = all.insert(all.end(), r);
    }
    VK_CHECK(vkResetCommandPool(device, free->pool, 0));
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .pNext = nullptr,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                        .pInheritanceInfo = nullptr};
    VK_CHECK(vkBeginCommandBuffer(free->cmd, &info));
    free->recording = true;
    ++m_impl->recording;
    setName(VK_OBJECT_TYPE_COMMAND_BUFFER, std::uint64_t(free->cmd), name);
    return free->cmd;
}

static VkSemaphoreSubmitInfo semaphoreInfo(VkSemaphore semaphore, std::uint64_t value,
                                           VkPipelineStageFlags2 stage) {
    return {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
            .pNext = nullptr,
            .semaphore = semaphore,
            .value = value,
            .stageMask = stage,
            .deviceIndex = 0};
}

std::uint64_t Device::submit(VkCommandBuffer cmd, const SubmitDesc& desc) {
    auto& all = m_impl->recorders;
    const auto recorder =
        std::find_if(all.begin(), all.end(), [&](const Impl::Recorder& r) { return r.cmd == cmd; });
    assert(recorder != all.end() && recorder->recording);
    VK_CHECK(vkEndCommandBuffer(cmd));
    recorder->recording = false;
    --m_impl->recording;
    recorder->submission = ++m_submitted;

    const VkCommandBufferSubmitInfo command{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                            .pNext = nullptr,
                                            .commandBuffer = cmd,
                                            .deviceMask = 0};
    const auto wait = semaphoreInfo(desc.wait, 0, desc.waitStage);
    const std::array signals = {
        semaphoreInfo(m_impl->timeline, m_submitted, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT),
        semaphoreInfo(desc.signal, 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .pNext = nullptr,
                             .flags = 0,
                             .waitSemaphoreInfoCount = desc.wait ? 1u : 0u,
                             .pWaitSemaphoreInfos = &wait,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &command,
                             .signalSemaphoreInfoCount = desc.signal ? 2u : 1u,
                             .pSignalSemaphoreInfos = signals.data()};
    VK_CHECK(vkQueueSubmit2(queue, 1, &info, VK_NULL_HANDLE));
    collect();
    return m_submitted;
}

void Device::immediate(const char* name, const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBuffer cmd = begin(name);
    record(cmd);
    wait(submit(cmd));
}

std::uint64_t Device::completed() const {
    std::uint64_t value = 0;
    VK_CHECK(vkGetSemaphoreCounterValue(device, m_impl->timeline, &value));
    return value;
}

void Device::wait(std::uint64_t submission) {
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .pNext = nullptr,
                                   .flags = 0,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &m_impl->timeline,
                                   .pValues = &submission};
    VK_CHECK(vkWaitSemaphores(device, &info, UINT64_MAX));
    collect();
}

void Device::retire(std::function<void()> destroy) {
    // A command buffer still open may use the resource; it will be submitted within the next
    // `recording` numbers.
    m_impl->retired.push_back({m_submitted + m_impl->recording, std::move(destroy)});
}

void Device::collect() {
    if (m_impl->retired.empty())
        return;
    const std::uint64_t done = completed();
    auto& retired = m_impl->retired;
    for (std::size_t i = 0; i < retired.size();) {
        if (retired[i].submission > done) {
            ++i;
            continue;
        }
        const auto destroy = std::move(retired[i].destroy);
        retired.erase(retired.begin() + std::ptrdiff_t(i));
        destroy();
    }
}

void Device::setName(VkObjectType type, std::uint64_t objectHandle, const char* name) {
    if (!m_impl->setObjectName || !name || !*name)
        return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType =
                                                 VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .pNext = nullptr,
                                             .objectType = type,
                                             .objectHandle = objectHandle,
                                             .pObjectName = name};
    VK_CHECK(m_impl->setObjectName(device, &info));
}

std::vector<std::string> Device::validationMessages() const {
    const std::lock_guard lock(m_impl->messageMutex);
    return m_impl->messages;
}

std::vector<std::string> deviceNames() {
    const auto setup = createInstance({});
    if (!setup)
        return {};
    std::vector<std::string> names;
    for (VkPhysicalDevice device : rankedDevices(setup->instance)) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(device, &properties);
        names.emplace_back(properties.deviceName);
    }
    destroyInstance(setup->instance, setup->validating);
    return names;
}

} // namespace limn::gpu
