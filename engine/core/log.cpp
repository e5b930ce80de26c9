// SPDX-License-Identifier: MIT
#include "engine/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace limn {

namespace {

spdlog::logger& logger() {
    static const auto instance = [] {
        auto l = spdlog::stderr_color_mt("limn");
        l->set_pattern("%^%l%$: %v");
        return l;
    }();
    return *instance;
}

} // namespace

void logInfo(std::string_view message) {
    logger().info("{}", message);
}
void logWarning(std::string_view message) {
    logger().warn("{}", message);
}
void logError(std::string_view message) {
    logger().error("{}", message);
}

} // namespace limn
