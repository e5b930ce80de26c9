// SPDX-License-Identifier: MIT
// What a program that is linked without Vulkan has in place of its window and its device.
#include "app/bench/place_on_device.h"
#include "app/commands/command.h"
#include "app/commands/render_image.h"

namespace limn {

void addEditCommand(Command& /*program*/) {}

Result<LightPlace> placeOnDevice(const std::string& /*name*/) {
    return fail("this program was built without Vulkan");
}

Result<DrawPicture> drawingOnGpu(const std::string& /*device*/) {
    return fail("--device: this program was built without Vulkan; there is: cpu");
}

} // namespace limn
