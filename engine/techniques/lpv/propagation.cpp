// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/propagation.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numbers>
#include <utility>

namespace limn {

namespace {

constexpr std::size_t kLanes = PaddedCells::kLanes;
/// Values of kLanes consecutive cells along x.
typedef float Floats __attribute__((vector_size(4 * kLanes)));

constexpr float kY0 = 0.28209479f, kY1 = 0.48860251f;        ///< Y_00; Y_1m of a coordinate of 1
constexpr float kAhead = 0.89442719f, kAcross = 0.44721360f; ///< 2 and 1 over sqrt(5)
constexpr std::size_t kOfAxis[] = {3, 1, 2};                 ///< the harmonic that is x, y or z
constexpr float kInversePi = std::numbers::inv_pi_v<float>;

Floats load(const std::vector<float>& plane, std::size_t index) {
    Floats v;
    std::memcpy(&v, plane.data() + index, sizeof v);
    return v;
}

Floats notBelow0(Floats v) {
    return v > 0 ? v : Floats{};
}

/// The way from a neighbour to a cell: along an axis, up or down it. The faces at the sides are
/// those of the second axis and of the third.
struct Step {
    int axis;
    bool up;
    float sign() const { return up ? 1.f : -1.f; }
    std::size_t ahead() const { return kOfAxis[axis]; }
    std::size_t second() const { return kOfAxis[(axis + 1) % 3]; }
    std::size_t third() const { return kOfAxis[(axis + 2) % 3]; }
};

/// A function of two bands in the directions to the five far faces: ahead, then up and down the
/// second axis, then the third.
using Faces = std::array<Floats, 5>;

/// `turn` -1: in the opposite directions.
Faces towardsFaces(const Step& step, float turn, Floats mean, Floats ahead, Floats second,
                   Floats third) {
    const Floats along = ahead * (step.sign() * turn * kY1);
    const Floats b = second * (turn * kAcross * kY1), c = third * (turn * kAcross * kY1);
    mean *= kY0;
    const Floats side = mean + along * kAhead;
    return {mean + along, side + b, side - b, side + c, side - c};
}

/// Share of the light that passes on its way to the five faces.
Faces passing(const FaceBlockers& blockers, const Step& step, std::size_t cell) {
    const auto& face = blockers.axis[std::size_t(step.axis)];
    const std::size_t index = step.up ? cell : cell + blockers.cells.stride(step.axis);
    Faces share = towardsFaces(step, -1, load(face[0], index), load(face[step.ahead()], index),
                               load(face[step.second()], index), load(face[step.third()], index));
    for (Floats& s : share)
        s = notBelow0(1 - notBelow0(s));
    return share;
}

void propagateRow(const CellLight& from, const FaceBlockers* blockers, glm::uvec3 first,
                  CellLight& to) {
    const PaddedCells& cells = from.cells;
    for (std::uint32_t x = 0; x < cells.size.x; x += kLanes) {
        const std::size_t cell = cells.at({x, first.y, first.z});
        std::array<Floats, 12> sum{};
        for (const Step step : {Step{0, true}, Step{0, false}, Step{1, true}, Step{1, false},
                                Step{2, true}, Step{2, false}}) {
            const std::size_t stride = cells.stride(step.axis);
            const std::size_t neighbour = step.up ? cell - stride : cell + stride;
            Faces share;
            share.fill(Floats{} + 1);
            if (blockers)
                share = passing(*blockers, step, cell);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto harmonic = [&](std::size_t i) {
                    return load(from.plane[3 * i + c], neighbour);
                };
                Faces flux = towardsFaces(step, 1, harmonic(0), harmonic(step.ahead()),
                                          harmonic(step.second()), harmonic(step.third()));
                for (std::size_t f = 0; f < flux.size(); ++f)
                    flux[f] = notBelow0(flux[f]) * share[f] *
                              ((f == 0 ? kFrontSolidAngle : kSideSolidAngle) * kInversePi);
                sum[c] += (flux[0] + ((flux[1] + flux[2]) + (flux[3] + flux[4]))) * kCosineMean;
                sum[3 * step.ahead() + c] += flux[0] * (step.sign() * kCosineSlope);
                sum[3 * step.second() + c] += (flux[1] - flux[2]) * kCosineSlope;
                sum[3 * step.third() + c] += (flux[3] - flux[4]) * kCosineSlope;
            }
        }
        const std::size_t count = std::min(kLanes, std::size_t(cells.size.x - x));
        for (std::size_t p = 0; p < sum.size(); ++p)
            std::memcpy(to.plane[p].data() + cell, &sum[p], count * sizeof(float));
    }
}

} // namespace

CellLight::CellLight(glm::uvec3 size) : cells{size} {
    for (std::vector<float>& values : plane)
        values.assign(cells.count() + PaddedCells::kLanes, 0); // the last vector ends beyond it
}

Lobe CellLight::lobe(glm::ivec3 c) const {
    Lobe lobe;
    for (std::size_t i = 0; i < lobe.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            lobe[i][int(k)] = plane[3 * i + k][cells.at(c)];
    return lobe;
}

void CellLight::add(glm::ivec3 c, const Lobe& lobe) {
    for (std::size_t i = 0; i < lobe.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            plane[3 * i + k][cells.at(c)] += lobe[i][int(k)];
}

FaceBlockers::FaceBlockers(glm::uvec3 size) : cells{size} {
    for (auto& harmonics : axis)
        for (std::vector<float>& values : harmonics)
            values.assign(cells.count() + PaddedCells::kLanes, 0);
}

void propagateOnce(const CellLight& from, const FaceBlockers* blockers, CellLight& to) {
    const glm::uvec3 size = from.cells.size;
    parallelRanges(std::size_t(size.y) * size.z, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            propagateRow(from, blockers, {0, row % size.y, row / size.y}, to);
    });
}

CellLight propagate(const CellLight& injected, const FaceBlockers* blockers, std::uint32_t rounds,
                    const Progress& progress) {
    CellLight from = injected, to(injected.cells.size), sum = injected;
    for (std::uint32_t round = 0; round < rounds && !progress.cancelled(); ++round) {
        progress.at("propagation", float(round) / float(rounds));
        propagateOnce(from, round == 0 ? nullptr : blockers, to);
        for (std::size_t p = 0; p < sum.plane.size(); ++p)
            std::ranges::transform(sum.plane[p], to.plane[p], sum.plane[p].begin(), std::plus<>());
        std::swap(from, to);
    }
    return sum;
}

} // namespace limn
