// SPDX-License-Identifier: MIT
#include "app/bench/place_on_device.h"

#include "engine/gpu/device.h"
#include "engine/techniques/device/device_table.h"

#include <cstdint>
#include <utility>

namespace limn {

namespace {

/// Light on a device with a viewport that shows the scene of each update.
class ViewportLight : public Lighting {
public:
    ViewportLight(std::shared_ptr<gpu::Device> device, const Scene& scene,
                  std::shared_ptr<const LightmapLayout> layout)
        : m_device(std::move(device)), m_layout(std::move(layout)), m_viewport(*m_device) {
        m_viewport.setScene(scene, m_layout);
        m_viewport.shadowedLights();
    }

    Result<void> create(const Technique& technique, const Prepared& prepared) {
        const std::uint64_t before = bytesInUse();
        auto made = lightOnDevice(technique, *m_device, m_viewport, prepared);
        if (!made)
            return tl::make_unexpected(made.error());
        m_light = std::move(*made);
        m_bytes += bytesInUse() - before;
        return {};
    }

    LightingReport update(const LightingInput& input, const Progress& progress) override {
        m_viewport.setScene(input.scene, m_layout);
        const std::uint64_t before = bytesInUse();
        LightingReport report = m_light->update(input, progress);
        m_bytes += bytesInUse() - before; // wraps around where memory was freed, and back
        std::erase_if(report.counters,
                      [](const LightingCounter& c) { return c.unit == CounterUnit::Bytes; });
        report.counters.push_back({"device_bytes", "Memory",
                                   "Allocated on the device for the light", double(m_bytes),
                                   CounterUnit::Bytes});
        return report;
    }

    const IndirectField* field() const override { return m_light->field(); }
    bool isOfView() const override { return m_light->isOfView(); }
    IndirectField readField() const override { return m_light->readField(); }

private:
    /// Memory allocated on the device; buffers that await their release are released first.
    std::uint64_t bytesInUse() {
        m_device->waitIdle();
        m_device->collect();
        return m_device->memory.bytesInUse;
    }

    std::shared_ptr<gpu::Device> m_device;
    std::shared_ptr<const LightmapLayout> m_layout;
    Viewport m_viewport;
    std::unique_ptr<Lighting> m_light;
    std::uint64_t m_bytes = 0;
};

} // namespace

Result<LightPlace> placeOnDevice(const std::string& name) {
    auto made = gpu::createDevice({.name = name});
    if (!made)
        return tl::make_unexpected(made.error());
    LightPlace place{
        .device = (*made)->properties.deviceName, .onDevice = true, .lights = lightsOnDevice};
    place.light =
        [device = std::shared_ptr<gpu::Device>(std::move(*made))](
            const Technique& technique, const Prepared& prepared, const Scene& scene,
            std::shared_ptr<const LightmapLayout> layout) -> Result<std::unique_ptr<Lighting>> {
        auto light = std::make_unique<ViewportLight>(device, scene, std::move(layout));
        if (const Result<void> created = light->create(technique, prepared); !created)
            return tl::make_unexpected(created.error());
        return light;
    };
    return place;
}

} // namespace limn
