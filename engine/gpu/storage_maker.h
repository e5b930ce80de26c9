// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/uploader.h"

#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace limn::gpu {

/// Creates storage buffers, none larger than the device can bind. A buffer that would be is left
/// empty, and `error` names it and both sizes.
class StorageMaker {
public:
    /// `advice` ends the error's text: what a user may change to need less. The device must outlive
    /// the object.
    StorageMaker(Device& device, std::string advice)
        : m_device(device), m_uploader(device), m_advice(std::move(advice)) {}

    /// Creates a buffer with these values, or with one zero if there are none, because descriptors
    /// need a buffer. Copies from and to it are allowed.
    template <class T>
    Buffer filled(const std::vector<T>& values, const char* name) {
        const std::vector<T> one(1);
        return filledWith(std::as_bytes(std::span(values.empty() ? one : values)), name);
    }

    /// Creates a buffer for `count` elements, at least one, without filling it.
    Buffer empty(std::size_t count, std::size_t elementBytes, const char* name,
                 MemoryKind memory = MemoryKind::Gpu);

    std::string error; ///< empty if all fitted

private:
    bool fits(VkDeviceSize bytes, const char* name);
    Buffer filledWith(std::span<const std::byte> bytes, const char* name);

    Device& m_device;
    Uploader m_uploader;
    std::string m_advice;
};

/// Fills buffers (TRANSFER_DST) with 0. Work submitted before must no longer use them.
void clearBuffers(Device& device, std::initializer_list<VkBuffer> buffers);

} // namespace limn::gpu
