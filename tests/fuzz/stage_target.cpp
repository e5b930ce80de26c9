// SPDX-License-Identifier: MIT
// Finished stages of a bake that are damaged, or of another bake, under a right checksum: a list of
// changes to what a bake keeps, which a second bake then finds.
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/trace/trace_scene.h"
#include "tests/fuzz/changes.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/small_bake.h"
#include "tests/fuzz/small_room.h"

#include <cstring>
#include <map>

#include <zstd.h>

using namespace limn;

namespace {

struct Stage {
    std::uint64_t key;
    std::string bytes;
};

BakeSettings settingsOf(int variant) {
    BakeSettings settings = smallBake();
    settings.surfels += std::uint32_t(variant) * 20;
    settings.lightmapCaches += std::uint32_t(variant) * 8;
    return settings;
}

/// What a bake of the scene keeps, by key: read from the files of a folder, whose layout
/// stage_store.cpp describes.
std::vector<Stage> stagesOf(const TraceScene& trace, int variant) {
    constexpr std::size_t kKey = 16, kPlainSize = 24, kHeader = 40;
    const TemporaryFolder folder;
    {
        StageStore store({.folder = folder.path.string()});
        const BakeSettings settings = settingsOf(variant);
        require(bake(trace, {}, &store, &settings).has_value(), "the small room bakes");
    }
    std::map<std::uint64_t, std::string> stages;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path)) {
        const std::string file = fileBytes(entry.path().string());
        std::uint64_t key, size;
        std::memcpy(&key, &file.at(kKey), sizeof key);
        std::memcpy(&size, &file.at(kPlainSize), sizeof size);
        std::string plain(std::size_t(size), '\0');
        const std::size_t n = ZSTD_decompress(plain.data(), plain.size(), file.data() + kHeader,
                                              file.size() - kHeader);
        require(n == plain.size(), "a stage's file is as stage_store.cpp says");
        stages[key] = plain;
    }
    std::vector<Stage> list;
    for (auto& [key, bytes] : stages)
        list.push_back({key, std::move(bytes)});
    require(list.size() > 5, "a bake keeps its stages");
    return list;
}

struct Starts {
    Scene scene = smallRoom();
    TraceScene trace{scene};
    std::vector<Stage> stages = stagesOf(trace, 0), others = stagesOf(trace, 1);
};

void apply(const Change& change, const std::vector<Stage>& others, std::vector<Stage>& stages) {
    std::string& bytes = stages[change.field % stages.size()].bytes;
    const std::size_t at = bytes.empty() ? 0 : change.value[1] % bytes.size();
    if (change.kind == Change::Copy) // of a bake with other counts
        bytes = others[change.index % others.size()].bytes;
    else if (change.kind == Change::Resize)
        bytes.resize(change.index % 2 ? at : bytes.size() + change.index % 64,
                     char(change.value[0]));
    else if (change.kind == Change::Fill)
        std::memset(&bytes[at], int(change.value[0] & 255),
                    std::min<std::size_t>(change.index % 256, bytes.size() - at));
    else
        std::memcpy(&bytes[at], &change.value[0],
                    std::min<std::size_t>(change.index % 8 + 1, bytes.size() - at));
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    static const Starts starts;
    Changes changes(textOf(data, size));
    std::vector<Stage> stages = starts.stages;
    while (const std::optional<Change> change = changes.next())
        apply(*change, starts.others, stages);
    StageStore store;
    for (const Stage& stage : stages)
        store.put(stage.key, stage.bytes);
    const BakeSettings settings = settingsOf(0);
    if (const Result<Bake> made = bake(starts.trace, {}, &store, &settings, kFuzzMemory)) {
        require(bakeDefect(*made, &starts.scene).empty(), "a bake of damaged stages is sound");
        light(starts.scene, *made);
    }
    return 0;
}
