// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"
#include "engine/gallery/random_stream.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "engine/techniques/illuminance/stress/oracle.h"

#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameBits(const RelitState& a, const RelitState& b) {
    return sameBits(a.radiosity, b.radiosity) && sameBits(a.sh, b.sh) &&
           sameBits(a.field.lightmap, b.field.lightmap) && sameBits(a.field.grid, b.field.grid);
}

/// Value 0 where bake and light have the same bits as the subject's, 1 where the light differs, 2
/// where the bake differs.
Judgement judgeSame(const Subject& subject, const Bake& bake, const RelitState& light) {
    if (bake.hash() != subject.base.bake->hash() || bake.counts != subject.base.bake->counts)
        return judged(2, 0);
    return judged(sameBits(light, subject.base.light) ? 0 : 1, 0);
}

/// "Same document, same bytes, at any number of threads."
Judgement judgeThreads(const Subject& subject) {
    const ThreadLimit alone(1);
    const Result<LitScene> other = bakeAndLight(subject.base.scene, subject.progress);
    return other ? judgeSame(subject, *other->bake, other->light) : broken();
}

Judgement judgeFile(const Subject& subject) {
    const LitScene& s = subject.base;
    const std::string path = subject.folder + "/case.limnbake";
    if (!writeBake(path, *s.bake))
        return broken();
    Result<Bake> read = readBake(path);
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    if (!read)
        return broken();
    const auto bake = std::make_shared<const Bake>(std::move(*read));
    return judgeSame(
        subject, *bake,
        lightOf(bake, s.scene, *s.trace, s.scene.relight.maxBounces, subject.progress));
}

/// A bake that reuses the stages of a scene with one object at another place must equal a full
/// bake.
Judgement judgeRebake(const Subject& subject) {
    const LitScene& s = subject.base;
    if (s.scene.instances.empty())
        return notJudged();
    RandomStream random(subject.seed + 8);
    Scene moved = s.scene;
    Instance& instance = moved.instances[random.bits() % moved.instances.size()];
    instance.toWorld[3] += glm::vec4(s.scene.bounds.size() * float(random.between(-0.2, 0.2)), 0);
    StageStore store;
    if (!bake(TraceScene(moved), subject.progress, &store))
        return notJudged();
    const Result<Bake> again = bake(*s.trace, subject.progress, &store);
    return again ? judged(again->hash() == s.bake->hash() ? 0 : 2, 0) : broken();
}

} // namespace

void addRepeatOracles(std::vector<Oracle>& to) {
    to.push_back({"threads", "One thread makes the same bits as all.", judgeThreads});
    to.push_back({"file", "A bake that was written and read is the same.", judgeFile});
    to.push_back({"rebake", "Known stages change no bake.", judgeRebake});
}

std::vector<Oracle> engineOracles() {
    std::vector<Oracle> oracles;
    addLightOracles(oracles);
    addSumOracles(oracles);
    addChangeOracles(oracles);
    addRepeatOracles(oracles);
    return oracles;
}

} // namespace limn
