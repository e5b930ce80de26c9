// SPDX-License-Identifier: MIT
#include "engine/scene/light/ies_file.h"

#include "engine/math/sampling.h"
#include "engine/scene/light/light.h"
#include "engine/scene/light/light_spec.h"
#include "engine/scene/light/photometry.h"

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace limn::ies_file_test {
namespace {

/// A file of type C whose intensities are candela(vertical, horizontal), both in degrees.
template <class Candela>
std::string iesText(const std::vector<double>& verticals, const std::vector<double>& horizontals,
                    const Candela& candela, const std::string& lamp = "1 -1 1",
                    const std::string& ballast = "1 1 50") {
    std::string text = "IESNA:LM-63-2002\r\n[TEST] none\r\n[MANUFAC] Nobody\r\n[LUMINAIRE] Hall "
                       "lamp\r\nTILT=NONE\r\n";
    text += fmt::format("{} {} {} 1 2 0 0 0\r\n{}\r\n", lamp, verticals.size(), horizontals.size(),
                        ballast);
    text += fmt::format("{}\r\n{}\r\n", fmt::join(verticals, " "), fmt::join(horizontals, " "));
    for (const double h : horizontals) {
        for (std::size_t v = 0; v < verticals.size(); ++v)
            text += fmt::format("{}{}", candela(verticals[v], h), v % 7 == 6 ? "\r\n" : " ");
        text += "\r\n";
    }
    return text;
}

std::vector<double> steps(double first, double last, double step) {
    std::vector<double> result;
    for (int i = 0; first + i * step <= last + 1e-9; ++i)
        result.push_back(first + i * step);
    return result;
}

/// A point light at the origin with the profile and intensity of a file.
Light lampOf(const std::string& text) {
    Light light;
    const Result<PhotometricFile> file = parseIes(text);
    EXPECT_TRUE(file) << file.error().message;
    if (!file)
        return light;
    EXPECT_EQ(profileDefect(file->profile), "");
    light.strength = file->profile.peak;
    light.profile = {std::make_shared<const LightProfile>(file->profile)};
    return light;
}

/// What a photometer reads 50 m away from a lamp that shines down and is not rolled [cd]. Its width
/// is +X; horizontal angles run counterclockwise for who looks down from above.
double measured(const Light& lamp, double vertical, double horizontal) {
    constexpr double kFar = 50;
    const double v = glm::radians(vertical), h = glm::radians(horizontal);
    const glm::dvec3 direction(std::sin(v) * std::cos(h), -std::cos(v), -std::sin(v) * std::sin(h));
    const LightSample s = sampleLight(lamp, glm::vec3(direction * kFar));
    return double(s.irradiance.x) * kFar * kFar;
}

double lobe(double vertical, double horizontal) {
    return 1000 * std::exp(-vertical / 40) * (1.5 + std::cos(glm::radians(horizontal)));
}

TEST(IesFile, ALampSendsWhatItsTableSays) {
    const std::vector<double> verticals = {0, 2.5, 5, 10, 15, 22.5, 30, 40, 50, 60, 70, 75, 80, 90};
    const Light even = lampOf(iesText(verticals, {0}, lobe));
    for (const double v : verticals)
        for (const double h : {0.0, 33.0, 180.0, 271.0})
            EXPECT_NEAR(measured(even, v, h), lobe(v, 0), 1e-3 * lobe(v, 0)) << v << " " << h;
    EXPECT_NEAR(measured(even, 35, 0), (lobe(30, 0) + lobe(40, 0)) / 2, 0.2);
    EXPECT_EQ(measured(even, 91, 0), 0);
    EXPECT_EQ(measured(even, 180, 0), 0);

    const std::vector<double> around = steps(0, 360, 22.5);
    const auto lopsided = [](double v, double h) {
        return lobe(v, 0) * (2 + std::sin(glm::radians(h)) + 0.5 * std::cos(glm::radians(2 * h)));
    };
    const Light full = lampOf(iesText(verticals, around, lopsided));
    for (const double v : verticals)
        for (const double h : around)
            EXPECT_NEAR(measured(full, std::max(v, 0.01), h), lopsided(v, h), 1e-3 * lopsided(v, h))
                << v << " " << h; // straight down, where its angle is none, it has several values
}

TEST(IesFile, HalvesAndQuartersAreMirrored) {
    const std::vector<double> verticals = steps(0, 180, 10);
    const auto ramp = [](double v, double h) { return 10 + v + h; };
    struct Case {
        std::vector<double> horizontals;
        double (*folded)(double);
    };
    const Case cases[] = {
        {steps(0, 90, 15),
         [](double h) {
             return h <= 90 ? h : h <= 180 ? 180 - h : h <= 270 ? h - 180 : 360 - h;
         }},
        {steps(0, 180, 15), [](double h) { return h <= 180 ? h : 360 - h; }},
        {steps(90, 270, 15), [](double h) { return h < 90     ? 180 - h
                                                   : h <= 270 ? h
                                                              : 540 - h; }},
        {steps(0, 345, 15), [](double h) { return h; }}};
    for (const Case& c : cases) {
        const Light lamp = lampOf(iesText(verticals, c.horizontals, ramp));
        for (const double h : steps(0, 345, 15))
            EXPECT_NEAR(measured(lamp, 60, h), ramp(60, c.folded(h)), 0.1)
                << c.horizontals.front() << " to " << c.horizontals.back() << " at " << h;
    }
}

TEST(IesFile, FactorsOfLampAndBallastAreApplied) {
    const auto flat = [](double, double) { return 200.0; };
    const Result<PhotometricFile> absolute = parseIes(iesText({0, 90}, {0}, flat));
    ASSERT_TRUE(absolute);
    EXPECT_FLOAT_EQ(absolute->profile.peak, 200);
    EXPECT_EQ(absolute->ratedFlux, 0);
    EXPECT_EQ(absolute->profile.name, "Hall lamp");
    const Result<PhotometricFile> relative =
        parseIes(iesText({0, 90}, {0}, flat, "2 1100 1.5", "0.9 1.1 50"));
    ASSERT_TRUE(relative);
    EXPECT_FLOAT_EQ(relative->profile.peak, 200 * 1.5f * 0.9f * 1.1f);
    EXPECT_FLOAT_EQ(relative->ratedFlux, 2200);
}

TEST(IesFile, TheFluxIsTheIntegralOfTheTable) {
    const auto cosine = [](double v, double) { return 100 * std::cos(glm::radians(v)); };
    const Light diffuse = lampOf(iesText(steps(0, 90, 2.5), {0}, cosine));
    EXPECT_NEAR(double(lumen(diffuse)), 100 * glm::pi<double>(), 0.05);
    const Light even = lampOf(iesText({0, 180}, {0}, [](double, double) { return 100.0; }));
    EXPECT_NEAR(double(lumen(even)), 400 * glm::pi<double>(), 1e-3);

    // Against directions spread evenly over the sphere.
    const Light full = lampOf(iesText(steps(0, 180, 5), steps(0, 360, 30), lobe));
    constexpr std::uint32_t kDirections = 1 << 16;
    const DirectionSet directions(kDirections, false, 0);
    double sum = 0;
    for (std::uint32_t i = 0; i < kDirections; ++i)
        sum += double(sampleLight(full, 2.f * directions[i]).irradiance.x) * 4;
    const double flux = sum / double(kDirections) * 4 * glm::pi<double>();
    EXPECT_NEAR(double(lumen(full)), flux, 2e-3 * flux);

    Light spot = full;
    spot.kind = LightKind::Spot;
    spot.innerAngle = 0.2f;
    spot.outerAngle = 0.8f;
    sum = 0;
    for (std::uint32_t i = 0; i < kDirections; ++i)
        sum += double(sampleLight(spot, 2.f * directions[i]).irradiance.x) * 4;
    const double inCone = sum / double(kDirections) * 4 * glm::pi<double>();
    EXPECT_NEAR(double(lumen(spot)), inCone, 3e-3 * inCone);
    EXPECT_LT(inCone, flux);

    const Light spread = withoutProfile(full);
    EXPECT_FALSE(spread.profile);
    EXPECT_NEAR(lumen(spread), lumen(full), 1e-5f * lumen(full));
}

TEST(IesFile, ALampTurnsWithItsDirectionAndRoll) {
    const auto half = [](double, double h) { return h == 0 ? 100.0 : 0.0; };
    Light lamp = lampOf(iesText({0, 90}, steps(0, 360, 90), half));
    const auto towards = [&](glm::vec3 d) { return sampleLight(lamp, 3.f * d).irradiance.x; };
    EXPECT_NEAR(towards({1, 0, 0}), 100.f / 9, 1e-3f);
    EXPECT_NEAR(towards({-1, 0, 0}), 0, 1e-3f);
    EXPECT_NEAR(towards({0, 0, 1}), 0, 1e-3f);
    lamp.roll = glm::half_pi<float>(); // from the width, +X, to the height, -Z
    EXPECT_NEAR(towards({0, 0, -1}), 100.f / 9, 1e-3f);
    EXPECT_NEAR(towards({1, 0, 0}), 0, 1e-3f);
    lamp.roll = 0;
    lamp.direction = {0, 0, -1}; // its width is horizontal: +X
    EXPECT_NEAR(towards({1, 0, 0}), 100.f / 9, 1e-3f);
    EXPECT_NEAR(towards({0, 1, 0}), 0, 1e-3f);
    EXPECT_EQ(towards({0, 0, 1}), 0);
}

TEST(IesFile, AProfileComesBackFromItsFile) {
    for (const std::uint32_t columns : {1U, 8U}) {
        LightProfile profile{.name = "Lamp", .peak = 320.5f, .lastVertical = 90, .rows = 11};
        profile.columns = columns;
        for (std::uint32_t i = 0; i < columns * profile.rows; ++i)
            profile.share.push_back(i == 5 ? 1.f : float(i % 9) / 9);
        const Result<PhotometricFile> again = parseIes(writeIes(profile));
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_FALSE(again->resampled);
        EXPECT_EQ(again->profile.name, "Lamp");
        EXPECT_FLOAT_EQ(again->profile.peak, profile.peak);
        EXPECT_EQ(again->profile.lastVertical, 90);
        ASSERT_EQ(again->profile.rows, profile.rows);
        ASSERT_EQ(again->profile.columns, columns);
        for (std::size_t i = 0; i < profile.share.size(); ++i)
            EXPECT_NEAR(again->profile.share[i], profile.share[i], 1e-6f);
    }
    // Lines end after at most 256 characters.
    LightProfile wide{.name = std::string(300, '\n'), .rows = 721};
    wide.columns = 1;
    wide.share.assign(721, 1);
    const std::string text = writeIes(wide);
    EXPECT_TRUE(parseIes(text));
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
        EXPECT_LE(text.find('\n', begin) - begin, 254U);
}

TEST(IesFile, AnglesThatLieTooCloseAreInterpolated) {
    std::vector<double> verticals = {0, 0.013, 0.05, 1, 90};
    const auto falling = [](double v, double) { return 100 - v; };
    const Result<PhotometricFile> file = parseIes(iesText(verticals, {0}, falling));
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->resampled);
    EXPECT_EQ(file->profile.rows, kMaxProfileRows);
    EXPECT_EQ(profileDefect(file->profile), "");
    EXPECT_NEAR(file->profile.share.back(), 0.1f, 1e-5f);
    EXPECT_FALSE(parseIes(iesText(steps(0, 180, 0.25), {0}, falling))->resampled);
}

TEST(IesFile, OlderFilesWithoutHeadAndWithCommasAreRead) {
    const std::string text = "A lamp of 1986\nTILT=NONE\n1,1000,1,2,1,1,1,0,0,0\n1 1 40\n0,90\n0\n"
                             "+1.5e2,0\n\x1a";
    const Result<PhotometricFile> file = parseIes(text);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_FLOAT_EQ(file->profile.peak, 150);
}

TEST(IesFile, SaysWhyItReadsNoFile) {
    const auto flat = [](double, double) { return 1.0; };
    const std::string good = iesText({0, 90}, {0}, flat);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t place = text.find(from);
        EXPECT_NE(place, std::string::npos) << from;
        return text.replace(place, from.size(), to);
    };
    const std::pair<std::string, const char*> cases[] = {
        {"", "TILT="},
        {"PNG\n", "TILT="},
        {with("TILT=NONE", "TILT=INCLUDE"), "'INCLUDE'"},
        {with("TILT=NONE", "TILT=lamp.tlt"), "'lamp.tlt'"},
        {with("TILT=NONE", "TILT="), "TILT: empty"},
        {with("2 1 1 2 0", "2 1 2 2 0"), "type B"},
        {with("2 1 1 2 0", "2 1 3 2 0"), "type A"},
        {with("2 1 1 2 0", "1 1 1 2 0"), "number of vertical angles"},
        {with("2 1 1 2 0", "0 1 1 2 0"), "number of vertical angles"},
        {with("2 1 1 2 0", "2.5 1 1 2 0"), "number of vertical angles"},
        {with("2 1 1 2 0", "2 -1 1 2 0"), "number of horizontal angles"},
        {with("2 1 1 2 0", "1000000 1000000 1 2 0"), "more than"},
        {with("2 1 1 2 0", "3 1 1 2 0"), "vertical angles"},
        {with("0 90", "90 0"), "vertical angles: 0 follows 90"},
        {with("0 90", "0 190"), "above 180"},
        {with("0 90", "-1 90"), "0 to 360"},
        {with("0 90", "0 nan"), "'nan'"},
        {with("\r\n0\r\n", "\r\n45\r\n") + " ", nullptr},
        {iesText({0, 90}, {0, 120}, flat), "horizontal angles: 0 to 120"},
        {iesText({0, 90}, {10, 360}, flat), "horizontal angles: 10 to 360"},
        {iesText({0, 90}, {0}, [](double, double) { return -1.0; }), "no light"},
        {iesText({0, 90}, {0}, flat, "1 -1 0"), "no light"},
        {iesText({0, 90}, {0}, flat, "1 -1 1e12"), "more than 1e+10"},
        {good.substr(0, good.size() - 6), "candela values: the file ends"}};
    for (const auto& [text, reason] : cases) {
        const Result<PhotometricFile> file = parseIes(text);
        EXPECT_EQ(bool(file), reason == nullptr) << text;
        if (!file && reason) {
            EXPECT_NE(file.error().message.find(reason), std::string::npos)
                << file.error().message << "\n"
                << text;
        }
    }
}

TEST(IesFile, ALightMayNameItsFile) {
    const std::string path = testing::TempDir() + "hall lamp.ies";
    std::ofstream(path, std::ios::binary)
        << iesText(steps(0, 90, 10), {0}, [](double v, double) { return 300 - v; });
    const Result<Light> lamp =
        parseLight(fmt::format("point pos=0,2,0 ies=\"{}\" dir=0,0,-1 roll=30 kelvin=3000", path));
    ASSERT_TRUE(lamp) << lamp.error().message;
    ASSERT_TRUE(lamp->profile);
    EXPECT_FLOAT_EQ(lamp->strength, 300);
    EXPECT_EQ(lamp->direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(lamp->color, blackbodyColor(3000));
    const Result<Light> dimmed = parseLight(fmt::format("spot ies=\"{}\" lm=500", path));
    ASSERT_TRUE(dimmed) << dimmed.error().message;
    EXPECT_NEAR(lumen(*dimmed), 500, 0.1f);
    for (const char* spec : {"point ies=missing.ies", "sun ies=a.ies", "rect ies=a.ies"})
        EXPECT_FALSE(parseLight(spec)) << spec;
    EXPECT_NE(parseLight("point ies=missing.ies").error().message.find("missing.ies: no such file"),
              std::string::npos);
}

} // namespace
} // namespace limn::ies_file_test
