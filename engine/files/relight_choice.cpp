// SPDX-License-Identifier: MIT
#include "engine/files/relight_choice.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/json/json.h"
#include "engine/stages/stage_store.h"

#include <cmath>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

namespace {

constexpr int kVersion = 1;

/// {"version": 1, "times": {KEY: {"cpu_ms", "gpu_ms"}, …}}; without times where the file is
/// unusable.
Json readTimes(const std::string& file) {
    const Result<std::string> text = readFile(file);
    const Json json = text ? parseJson(*text).value_or(Json()) : Json();
    const bool known = json["version"] == kVersion && json["times"].isObject();
    return known ? json : Json{{"version", kVersion}, {"times", Json::object()}};
}

double msOf(const Json& times, const char* key) {
    const Json& time = times[key];
    const double ms = time.isNumber() ? time.get<double>() : 0;
    return std::isfinite(ms) ? ms : 0;
}

} // namespace

RelightOn chooseRelight(RelightOn wanted, bool gpuCan, const std::optional<RelightTimes>& times) {
    if (wanted == RelightOn::Cpu || !gpuCan)
        return RelightOn::Cpu;
    if (wanted == RelightOn::Gpu)
        return RelightOn::Gpu;
    return times && times->gpuMs < times->cpuMs ? RelightOn::Gpu : RelightOn::Cpu;
}

std::string relightTimesKey(const std::string& device, std::uint32_t driverVersion,
                            std::string_view sizeClass) {
    return fmt::format("{}, driver {}, {} threads, {}", device, driverVersion,
                       std::thread::hardware_concurrency(), sizeClass);
}

std::optional<RelightTimes> rememberedRelightTimes(const std::string& file,
                                                   const std::string& key) {
    const Json all = readTimes(file);
    const Json& known = all["times"][key];
    const RelightTimes times{msOf(known, "cpu_ms"), msOf(known, "gpu_ms")};
    if (!(times.cpuMs > 0) || !(times.gpuMs > 0))
        return {};
    return times;
}

Result<void> rememberRelightTimes(const std::string& file, const std::string& key,
                                  const RelightTimes& times) {
    Json json = readTimes(file);
    json["times"][key] = {{"cpu_ms", times.cpuMs}, {"gpu_ms", times.gpuMs}};
    std::error_code error; // replaceFile() reports the error
    fs::create_directories(fs::path(file).parent_path(), error);
    return replaceFile(file, json.dump(1) + '\n');
}

std::string defaultRelightTimesFile() {
    const std::string stages = defaultStageFolder();
    return stages.empty() ? stages : (fs::path(stages).parent_path() / "relight.json").string();
}

} // namespace limn
