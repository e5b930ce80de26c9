// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/gpu_propagation.h"

#include "engine/field/field_packing.h"
#include "engine/techniques/lpv/lpv_overlay.h"
#include "tests/gpu/test_device.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

namespace limn::gpu_propagation_test {
namespace {

class GpuPropagationTest : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (!device)
            return;
        auto made = GpuPropagation::create(*device);
        ASSERT_TRUE(made) << made.error().message;
        gpu = std::move(*made);
    }
    void TearDown() override {
        gpu.reset();
        DeviceTest::TearDown();
    }
    bool light(const std::vector<InjectedInstance>& parts, std::uint32_t rounds,
               const Progress& progress = {}) {
        const GpuLobes lobes = gpu->upload(parts);
        const GpuSource source{&lobes, glm::vec3(1)};
        return gpu->light(std::span(&source, 1), rounds, {1, -1}, progress, cost);
    }

    std::unique_ptr<GpuPropagation> gpu;
    GpuPropagationCost cost;
};

double totalFlux(const std::vector<Lobe>& cells) {
    double sum = 0;
    for (const Lobe& lobe : cells)
        sum += double(fluxOf(lobe).x);
    return sum;
}

/// Lobes in some cells and blockers on all faces, at random.
struct Cluttered {
    Lattice lattice{.lower = glm::vec3(-1, 2, 0), .cell = 0.25f, .size = {11, 7, 9}};
    std::vector<InjectedInstance> parts = {{.instance = 0, .cells = {}},
                                           {.instance = 1, .cells = {}}};
    FaceBlockers blockers{lattice.size};

    Cluttered() {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> share(-0.5f, 1);
        for (std::uint32_t cell = 0; cell < lattice.cells(); cell += 2) {
            CellLobe lobe{.cell = cell};
            for (glm::vec3& harmonic : lobe.lobe)
                harmonic = {share(random), share(random), share(random)};
            lobe.lobe[0] += 1.f;
            parts[cell % 3 > 0].cells.push_back(lobe);
            if (cell % 5 == 0)
                parts[cell % 3 == 0].cells.push_back(lobe);
        }
        for (auto& axis : blockers.axis)
            for (std::vector<float>& harmonic : axis)
                for (std::size_t k = 0; k < blockers.cells.count(); ++k)
                    harmonic[k] = share(random);
    }
    CellLight injected() const {
        CellLight cells(lattice.size);
        addInjected(parts, glm::vec3(1), lattice, {}, cells);
        return cells;
    }
};

TEST_F(GpuPropagationTest, KeepsTheFluxOfACellInTheOpen) {
    const Lattice lattice{.lower = glm::vec3(0), .cell = 1, .size = {5, 5, 5}};
    gpu->setLattice(lattice, FaceBlockers(lattice.size));
    const std::vector<InjectedInstance> parts = {
        {0, {{.cell = lattice.index({2, 2, 2}), .lobe = {glm::vec3(3), {}, {}, {}}}}}};
    ASSERT_TRUE(light(parts, 1));
    const double injected = double(fluxOf(parts[0].cells[0].lobe).x);
    EXPECT_NEAR(totalFlux(gpu->readSum()) / injected, 2, 2e-6)
        << "what was injected, and as much after a round";
}

TEST_F(GpuPropagationTest, PropagatesAsTheCpuDoes) {
    const Cluttered c;
    gpu->setLattice(c.lattice, c.blockers);
    for (const std::uint32_t rounds : {1U, 2U, 3U, 16U}) {
        ASSERT_TRUE(light(c.parts, rounds));
        const CellLight expected = propagate(c.injected(), &c.blockers, rounds);
        const std::vector<Lobe> sum = gpu->readSum();
        double largest = 0, most = 0, squares = 0;
        for (std::uint32_t cell = 0; cell < sum.size(); ++cell) {
            const Lobe lobe = expected.lobe(glm::ivec3(c.lattice.place(cell)));
            for (std::size_t i = 0; i < lobe.size(); ++i)
                for (int k = 0; k < 3; ++k) {
                    const double difference =
                        std::abs(double(sum[cell][i][k]) - double(lobe[i][k]));
                    largest = std::max(largest, std::abs(double(lobe[i][k])));
                    most = std::max(most, difference);
                    squares += difference * difference;
                }
        }
        const double rms = std::sqrt(squares / double(12 * sum.size()));
        std::printf("%u rounds: max %.1e rms %.1e of the largest\n", rounds, most / largest,
                    rms / largest);
        // Sums of 30 faces, each rounded by 2^-24 of the sum, in every round.
        EXPECT_LT(most / largest, 30 * 0x1p-24 * rounds);
        EXPECT_EQ(cost.dispatches, 1 + rounds + 2) << "injection, rounds, brightest value, field";
    }
}

TEST_F(GpuPropagationTest, NoRoundsMakeABlackField) {
    const Cluttered c;
    gpu->setLattice(c.lattice, c.blockers);
    ASSERT_TRUE(light(c.parts, 4));
    EXPECT_NE(gpu->readField().grid[0], glm::vec4(0));
    ASSERT_TRUE(gpu->light({}, 0, {1, -1}, {}, cost));
    for (const glm::vec4& value : gpu->readField().grid)
        EXPECT_EQ(value, glm::vec4(0));
}

TEST_F(GpuPropagationTest, PacksTheFieldAsTheCpuDoes) {
    const Cluttered c;
    gpu->setLattice(c.lattice, c.blockers);
    for (const float unit : {1.f, 1e-30f, 1e-12f, 1e9f, 1e30f}) {
        const GpuLobes lobes = gpu->upload(c.parts);
        const GpuSource source{&lobes, glm::vec3(unit)};
        ASSERT_TRUE(gpu->light(std::span(&source, 1), 3, {2, -3}, {}, cost));
        const std::vector<Lobe> sum = gpu->readSum();
        std::vector<glm::vec4> values(4 * sum.size());
        for (std::size_t cell = 0; cell < sum.size(); ++cell)
            for (std::size_t i = 0; i < 4; ++i)
                values[i * sum.size() + cell] = glm::vec4(sum[cell][i] * (i > 0 ? -3.f : 2.f), 0);
        const float scale = fieldScale(brightestOf(values));
        EXPECT_EQ(gpu->field()->scale, scale);
        const std::vector<glm::vec4> expected =
            unpackField(packField(values, 2, 2, scale), 2, 2, scale);
        const std::vector<glm::vec4> grid = gpu->readField().grid;
        for (std::size_t k = 0; k < expected.size(); ++k)
            ASSERT_EQ(grid[k], expected[k]) << unit << ", value " << k;
    }
}

TEST_F(GpuPropagationTest, TurnsNotANumberIntoBlack) {
    const Lattice lattice{.lower = glm::vec3(0), .cell = 1, .size = {4, 4, 4}};
    gpu->setLattice(lattice, FaceBlockers(lattice.size));
    const float none = std::numeric_limits<float>::quiet_NaN();
    ASSERT_TRUE(light({{0,
                        {{.cell = 0, .lobe = {glm::vec3(none), {}, {}, {}}},
                         {.cell = 5, .lobe = {glm::vec3(1), {}, {}, {}}}}}},
                      4));
    for (const glm::vec4& value : gpu->readField().grid)
        for (int k = 0; k < 3; ++k)
            ASSERT_TRUE(std::isfinite(value[k]));
    EXPECT_GT(gpu->readField().grid[5].x, 0);
}

TEST_F(GpuPropagationTest, LeavesTheFieldWhenCancelledBetweenSubmissions) {
    const Cluttered c;
    gpu->setLattice(c.lattice, c.blockers);
    ASSERT_TRUE(light(c.parts, 4));
    const std::vector<glm::vec4> before = gpu->readField().grid;
    std::atomic<bool> cancel = false;
    std::uint32_t reports = 0;
    const Progress progress{.report = [&](const char*, float) { cancel = ++reports == 2; },
                            .cancel = &cancel};
    constexpr std::uint32_t kManyRounds = 20000; // of 693 cells: more than one submission
    EXPECT_FALSE(light(c.parts, kManyRounds, progress));
    EXPECT_EQ(reports, 2U);
    EXPECT_EQ(gpu->readField().grid, before);
}

} // namespace
} // namespace limn::gpu_propagation_test
