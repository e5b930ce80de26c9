// SPDX-License-Identifier: MIT
// A bake file. An input that begins as one is given to the reader with its checksums put right;
// any other is a list of changes to a valid bake, which is then written, read again and lit.
#include "engine/core/hash.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/techniques/illuminance/format/bake_fields.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "tests/core/source_path.h"
#include "tests/fuzz/changes.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/small_room.h"

#include <cstring>

using namespace limn;

namespace {

/// The valid bakes that changes start from: links of both kinds, a scene of both sides.
struct Starts {
    Scene scene = smallRoom();
    Bake rtp = start("cones"), sh = start("harmonics");

    Bake start(const std::string& name) const {
        Result<Bake> read = readBake(sourcePath("tests/corpus/starts/" + name + ".bake"));
        require(read.has_value(), "a start is a bake of this version; fuzz_seeds writes one");
        require(bakeDefect(*read, &scene).empty(), "a start is a bake of the small room");
        return std::move(*read);
    }
};

/// The hash of each chunk's packed bytes, as the file's comment has them.
std::string withChecksums(std::string file) {
    constexpr std::size_t kHeader = 16, kChunkHeader = 32;
    for (std::size_t at = kHeader; at + kChunkHeader <= file.size();) {
        std::uint64_t packed;
        std::memcpy(&packed, &file[at + 16], sizeof packed);
        at += kChunkHeader;
        if (packed > file.size() - at)
            break;
        const std::uint64_t hash = hashBytes(&file[at], std::size_t(packed));
        std::memcpy(&file[at - 8], &hash, sizeof hash);
        at += std::size_t(packed);
    }
    return file;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    static const Starts starts;
    const std::string_view input = textOf(data, size);
    std::string path;
    if (input.starts_with("LIMNBAKE")) {
        path = scratchFile("raw.bake", withChecksums(std::string(input)));
    } else {
        Changes changes(input);
        Bake changed = changes.number<std::uint8_t>() % 2 ? starts.sh : starts.rtp;
        while (const std::optional<Change> change = changes.next()) {
            ChangingArchive archive{*change};
            forBakeChunks(nullptr, [&](const char*, auto fields) { fields(archive, changed); });
        }
        path = scratchFile("changed.bake", "");
        require(writeBake(path, changed).has_value(), "any bake can be written");
    }
    Result<Bake> read = readBake(path, kFuzzMemory);
    if (!read) {
        require(read.error().message.starts_with(path), "a message names the file");
        return 0;
    }
    Scene scene = starts.scene;
    scene.bake = read->settings; // as limn render does
    if (bakeDefect(*read, &scene).empty())
        light(scene, *read);
    return 0;
}
