// SPDX-License-Identifier: MIT
// Damaged and hostile transport files: refused with a message, or lit without reading out of
// bounds.
#include "engine/techniques/illuminance/transport/transport_sections.h"
#include "tests/runtime/open_file.h"
#include "tests/runtime/transport_bytes.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <functional>
#include <limits>
#include <random>

namespace limn::hostile_file_test {
namespace {

const std::string& roomFile() {
    static const std::string file = [] {
        const auto scene = litRoom(80, 60, true);
        return fileOf(*bakeOf(TraceScene(*scene)), *scene);
    }();
    return file;
}

/// Uses all that a scene offers, a little.
void light(limnrt_scene* scene) {
    limnrt_counts counts;
    limnrt_get_counts(scene, &counts);
    limnrt_step(scene);
    limnrt_step(scene);
    std::vector<float> rgba(std::size_t(4) * counts.bands * counts.bands *
                            std::max(counts.lightmap_width * counts.lightmap_height,
                                     counts.caches - counts.lightmap_caches));
    limnrt_lightmap_sh(scene, rgba.data());
    limnrt_lightmap_irradiance(scene, nullptr, rgba.data());
    limnrt_grid_sh(scene, rgba.data());
    const float position[3] = {1, 1, 1}, normal[3] = {0, 1, 0};
    limnrt_sample_grid(scene, position, normal, rgba.data());
}

/// Why a file with a section changed is refused; empty if it is not.
std::string refusal(const char* tag, const std::function<void(std::string&)>& change) {
    std::string bytes = roomFile();
    changeSection(bytes, tag, change);
    rehash(bytes);
    const OpenFile file(bytes);
    if (file)
        light(file);
    return file.message;
}

template <class T>
std::function<void(std::string&)> put(std::size_t at, T value) {
    return [=](std::string& section) { std::memcpy(&section.at(at), &value, sizeof value); };
}

TEST(HostileFile, TheRoomItselfIsAccepted) {
    const OpenFile file(roomFile());
    ASSERT_TRUE(file) << file.message;
    light(file);
}

TEST(HostileFile, IsRefusedWhereverItIsTruncated) {
    const std::string& whole = roomFile();
    std::vector<std::size_t> ends = {0, 1, 8, 63, 64, 65, whole.size() - 1};
    for (const SectionPlace& section : sectionsOf(whole))
        for (const std::size_t end : {section.entry, section.begin, section.end, section.end - 1})
            if (end < whole.size())
                ends.push_back(end);
    for (const std::size_t end : ends) {
        std::string bytes = whole.substr(0, end);
        EXPECT_FALSE(OpenFile(bytes)) << end;
        if (end >= 64) { // with a header that knows nothing of it
            const auto size = std::uint64_t(end);
            std::memcpy(&bytes[24], &size, sizeof size);
            EXPECT_FALSE(OpenFile(bytes)) << end;
        }
    }
    EXPECT_NE(OpenFile(whole + '\0').message.find("follow the end"), std::string::npos);
}

TEST(HostileFile, NoFlippedBitGoesUnnoticed) {
    std::mt19937 random(7);
    for (int k = 0; k < 400; ++k) {
        std::string bytes = roomFile();
        const std::size_t at = random() % bytes.size();
        bytes[at] = char(bytes[at] ^ char(1 << random() % 8));
        const OpenFile file(bytes);
        const bool unused = (at >= 12 && at < 64) || isPadding(roomFile(), at); // or the version
        EXPECT_TRUE(!file || unused) << at;
    }
}

TEST(HostileFile, FlippedBitsBehindGoodHashesLeadNowhereElse) {
    std::mt19937 random(11);
    const std::size_t table = sectionsOf(roomFile()).front().begin;
    for (int k = 0; k < 3000; ++k) {
        std::string bytes = roomFile();
        for (int n = 0; n < 1 + k % 3; ++n) {
            const std::size_t at = table + random() % (bytes.size() - table);
            bytes[at] = char(bytes[at] ^ char(1 << random() % 8));
        }
        rehash(bytes);
        const OpenFile file(bytes);
        if (file)
            light(file);
        else
            EXPECT_FALSE(file.message.empty());
    }
}

TEST(HostileFile, SaysWhatIsWrong) {
    std::string newer = roomFile(), packed = roomFile();
    newer[8] = 3;
    EXPECT_NE(OpenFile(newer).message.find("newer"), std::string::npos);
    packed.replace(0, 4, "\x28\xb5\x2f\xfd");
    EXPECT_NE(OpenFile(packed).message.find("compressed"), std::string::npos);
    EXPECT_NE(OpenFile(std::string(200, 'x')).message.find("not a transport file"),
              std::string::npos);
    std::string damaged = roomFile();
    damaged[sectionsOf(damaged).back().begin] ^= 1;
    EXPECT_NE(OpenFile(damaged).message.find("hash"), std::string::npos);
    limnrt_options skip{};
    skip.flags = LIMNRT_SKIP_HASHES;
    EXPECT_TRUE(OpenFile(damaged, &skip)) << "one corner of a triangle has moved";
}

TEST(HostileFile, HugeCountsAreRefused) {
    for (std::size_t k = 0; k < 24; ++k)
        for (const std::uint32_t count : {0U, 1U, 0x7fffffffU, 0xffffffffU}) {
            std::uint32_t own;
            const SectionPlace dims = sectionOf(roomFile(), "DIMS");
            std::memcpy(&own, &roomFile()[dims.begin + 4 * k], sizeof own);
            const bool fine = k > 21 || own == count || (k == 8 && count == 1); // one in colour
            EXPECT_TRUE(fine || !refusal("DIMS", put(4 * k, count)).empty()) << k << " " << count;
        }
}

/// The room's file with `each` light points per surfel, all at one place.
std::string withLightPoints(std::uint32_t each) {
    TransportSections out;
    const std::vector<SectionPlace> sections = sectionsOf(roomFile());
    for (const SectionPlace& section : sections) {
        std::uint32_t elementSize;
        std::memcpy(&elementSize, &roomFile()[section.entry + 4], sizeof elementSize);
        std::string bytes = roomFile().substr(section.begin, section.end - section.begin);
        if (section.tag == "DIMS")
            put(std::size_t(4) * 21, each)(bytes);
        if (section.tag == "SLPT")
            bytes.assign(bytes.size() / kLightPoints * each, '\0');
        if (section.tag == "SLNM" && each > kLightPoints)
            continue; // the surfels' normals serve for all
        if (section.tag == "SLNM")
            bytes.resize(bytes.size() / kLightPoints * each);
        out.addBytes(section.tag.c_str(), elementSize, bytes);
    }
    return out.file();
}

TEST(HostileFile, ASurfelHasUpTo16LightPoints) {
    for (const std::uint32_t each : {0U, 1U, 5U, 16U}) {
        const OpenFile file(withLightPoints(each));
        ASSERT_TRUE(file) << file.message;
        light(file);
    }
    EXPECT_NE(OpenFile(withLightPoints(17)).message.find("too many light points"),
              std::string::npos);
}

TEST(HostileFile, IndicesAndOrdersAreChecked) {
    EXPECT_NE(refusal("SCAC", put(0, 0x00ffffffU)), "");
    EXPECT_NE(refusal("SMAT", put(0, 99U)), "");
    EXPECT_NE(refusal("TCHI", put(0, 0xfffffffeU)), "") << "a child that does not exist";
    EXPECT_NE(refusal("TCHI", put(0, 80U + 256U + 100U)), "") << "a cycle";
    EXPECT_NE(refusal("LINK", put(0, 0x00ffffffU)), "");
    EXPECT_NE(refusal("LINK", put(8, std::uint16_t(0x7c00))), "") << "an infinite cone";
    EXPECT_NE(refusal("LINK", put(10, std::uint16_t(0xc000))), "") << "negative transport";
    EXPECT_NE(refusal("LEXP", put(0, std::int8_t(-128))), "") << "boundless transport";
    EXPECT_NE(refusal("LBEG", put(4, 0xffffffffU)), "");
    EXPECT_NE(refusal("FBEG", put(4, 0xffffffffU)), "");
    EXPECT_NE(refusal("LMBG", put(4, 0x7fffffffU)), "");
    EXPECT_NE(refusal("OBOX", put(12, 0U)), "") << "a box that is its own child";
    EXPECT_NE(refusal("OBOX", put(28, 0xffffffffU)), "");
    EXPECT_NE(refusal("OCUT", put(0, 2U)), "") << "the sheet has two triangles";
    EXPECT_NE(refusal("CTRI", put(36, 1U)), "") << "there is one mask";
    EXPECT_NE(refusal("CMSK", put(0, std::uint64_t(1))), "") << "texels behind the last";
    EXPECT_NE(refusal("CMSK", put(0, ~std::uint64_t(0))), "");
    EXPECT_NE(refusal("CMSK", put(8, 0U)), "") << "an image without texels";
    EXPECT_NE(refusal("CMSK", put(12, 2U)), "") << "rows that are not there";
    EXPECT_NE(refusal("CMSK", put(16, 3U)), "") << "an unknown wrap";
    EXPECT_NE(refusal("CMSK", put(24, 2U)), "") << "an unknown lookup";
    EXPECT_NE(refusal("MNAM", [](std::string& s) { s.back() = 'x'; }), "");
    EXPECT_NE(refusal("LGHT", put(0, 7U)), "");
}

TEST(HostileFile, NumbersAreFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    for (const char* tag : {"SPOS", "SNRM", "SALB", "SEMI", "SARE", "SCWT", "TWGT", "SKYL", "CPOS",
                            "CNRM", "SPAC", "SLPT", "SLNM", "OTRI", "OBOX", "CTRI"})
        for (const float value : {nan, infinity, -infinity})
            EXPECT_NE(refusal(tag, put(0, value)).find(tag), std::string::npos) << tag;
    EXPECT_NE(refusal("CMSK", put(28, nan)), "");
    EXPECT_NE(refusal("CTRI", put(8, -1.f)), "") << "a negative alpha";
    for (const std::size_t field : {8, 20, 32, 44, 48})
        EXPECT_NE(refusal("LGHT", put(field, nan)), "") << field;
}

} // namespace
} // namespace limn::hostile_file_test
