// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/device.h"

#include <cstdio>
#include <memory>

#include <gtest/gtest.h>

namespace limn {

/// A test with a validated device. Any validation message fails the test, also one that comes while
/// the device dies.
class DeviceTest : public testing::Test {
protected:
    void SetUp() override {
        auto created = gpu::createDevice({.validation = true});
        if (!created)
            GTEST_SKIP() << "no Vulkan device: " << created.error().message;
        device = std::move(*created);
        if (!device->validating)
            std::puts("VK_LAYER_KHRONOS_validation is missing: validation is not checked");
    }
    void TearDown() override {
        if (device) {
            const auto messages = device->validationMessages();
            EXPECT_TRUE(messages.empty()) << messages[0];
        }
    }

    std::unique_ptr<gpu::Device> device;
};

} // namespace limn
