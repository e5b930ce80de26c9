// SPDX-License-Identifier: MIT
#include "engine/scene/light/ies_file.h"

#include "engine/core/read_file.h"
#include "engine/scene/light/light.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint64_t kMaxFile = std::uint64_t(16) << 20;
constexpr std::size_t kMaxValues = 1 << 20;

/// Angles are compared in thousandths of a degree.
constexpr double kUnitsPerDegree = 1000;

/// Takes the next line, without its end, off the text.
std::string_view takeLine(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
        line.remove_suffix(1);
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t'))
        line.remove_prefix(1);
    return line;
}

/// Reads numbers between blanks, commas and line ends.
struct Numbers {
    std::string_view text;

    Result<double> next(std::string_view what) {
        const std::size_t begin =
            std::min(text.find_first_not_of(" \t\r\n,\x1a"), text.size()); // some end with ^Z
        text.remove_prefix(begin);
        if (text.empty())
            return fail(fmt::format("{}: the file ends before it", what));
        const std::size_t length = std::min(text.find_first_of(" \t\r\n,\x1a"), text.size());
        std::string_view word = text.substr(0, length);
        text.remove_prefix(length);
        const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
        double value = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            return fail(fmt::format("{}: '{}' is not a number", what, word.substr(0, 40)));
        return value;
    }
};

/// The numbers between the tilt and the angles.
struct Head {
    double lamps = 1, flux = 0, multiplier = 1, verticals = 0, horizontals = 0, type = 1, units = 2,
           width = 0, length = 0, height = 0, ballast = 1, ballastLamp = 1, watts = 0;
};

Result<Head> readHead(Numbers& numbers) {
    Head head;
    const std::pair<double*, std::string_view> fields[] = {
        {&head.lamps, "number of lamps"},
        {&head.flux, "lumens per lamp"},
        {&head.multiplier, "candela multiplier"},
        {&head.verticals, "number of vertical angles"},
        {&head.horizontals, "number of horizontal angles"},
        {&head.type, "photometric type"},
        {&head.units, "units type"},
        {&head.width, "width"},
        {&head.length, "length"},
        {&head.height, "height"},
        {&head.ballast, "ballast factor"},
        {&head.ballastLamp, "ballast-lamp photometric factor"},
        {&head.watts, "input watts"}};
    for (const auto& [value, what] : fields) {
        const Result<double> number = numbers.next(what);
        if (!number)
            return tl::make_unexpected(number.error());
        *value = *number;
    }
    if (head.type != 1)
        return fail(fmt::format("photometric type: {} is not read, only type C (1) is",
                                head.type == 2   ? "type B (2)"
                                : head.type == 3 ? "type A (3)"
                                                 : fmt::format("{}", head.type)));
    for (const auto& [count, what] : {std::pair(head.verticals, "number of vertical angles"),
                                      std::pair(head.horizontals, "number of horizontal angles")})
        if (!(count >= 1) || count != std::floor(count) || count > double(kMaxValues))
            return fail(fmt::format("{}: {} is no such number", what, count));
    if (head.verticals < 2)
        return fail("number of vertical angles: 1, which leaves nothing to interpolate");
    if (head.verticals * head.horizontals > double(kMaxValues))
        return fail(
            fmt::format("more than {} intensities, which no photometer measures", kMaxValues));
    return head;
}

Result<std::vector<double>> readAngles(Numbers& numbers, std::size_t count, std::string_view what) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < count; ++i) {
        const Result<double> angle = numbers.next(what);
        if (!angle)
            return tl::make_unexpected(angle.error());
        if (*angle < 0 || *angle > 360)
            return fail(fmt::format("{}: {} is not 0 to 360 degrees", what, *angle));
        const double rounded = std::round(*angle * kUnitsPerDegree) / kUnitsPerDegree;
        if (!angles.empty() && !(rounded > angles.back()))
            return fail(fmt::format("{}: {} follows {}", what, *angle, angles.back()));
        angles.push_back(rounded);
    }
    return angles;
}

/// The widest even spacing [degrees] that has all these angles, counted from `from`, and `to` in
/// it.
double commonStep(const std::vector<double>& angles, double from, double to) {
    std::int64_t step = std::llround((to - from) * kUnitsPerDegree);
    for (const double angle : angles)
        step = std::gcd(step, std::llround((angle - from) * kUnitsPerDegree));
    return double(step) / kUnitsPerDegree;
}

/// Index of the last angle that is not above x, and how far x lies towards the next, [0, 1].
std::pair<std::size_t, double> locate(const std::vector<double>& angles, double x) {
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, x);
    const auto i = std::size_t(above - angles.begin()) - 1;
    return {i, std::clamp((x - angles[i]) / (angles[i + 1] - angles[i]), 0.0, 1.0)};
}

/// The measured horizontal angle [degrees] whose intensities are those of another one. Angles up to
/// 90 or 180 degrees, or from 90 to 270, say that the luminaire is symmetric about two planes or
/// one.
double folded(double horizontal, double first, double last) {
    double h = std::fmod(horizontal, 360.0);
    if (first == 90 && last == 270) {
        if (h < 90)
            return 180 - h;
        return h > 270 ? 540 - h : h;
    }
    if (last <= 180 && h > 180)
        h = 360 - h;
    if (last == 90 && h > 90)
        h = 180 - h;
    return h;
}

/// Names the luminaire from the lines of keywords; empty if they do not.
void noteKeyword(std::string_view line, std::string& luminaire, std::string& maker) {
    const auto value = [&](std::string_view key) -> std::string_view {
        return line.starts_with(key) ? line.substr(std::min(key.size() + 1, line.size())) : "";
    };
    const auto take = [](std::string_view text, std::string& out) {
        if (out.empty() && !text.empty())
            for (const char c : text.substr(0, 100))
                out += c >= ' ' && c <= '~' ? c : '?'; // files have the code page of their maker
    };
    take(value("[LUMINAIRE]"), luminaire);
    take(value("[LUMCAT]"), luminaire);
    take(value("[MANUFAC]"), maker);
}

} // namespace

Result<PhotometricFile> parseIes(std::string_view text) {
    PhotometricFile file;
    std::string maker, tilt;
    while (tilt.empty()) {
        if (text.empty())
            return fail("no photometric file: it has no line that begins with TILT=");
        const std::string_view line = takeLine(text);
        if (line.starts_with("TILT="))
            tilt = line.substr(5);
        else
            noteKeyword(line, file.profile.name, maker);
        if (line == "TILT=")
            return fail("TILT: empty; only NONE is read");
    }
    if (file.profile.name.empty())
        file.profile.name = maker;
    if (tilt != "NONE")
        return fail(fmt::format("TILT: '{}' is not read, only NONE is", tilt.substr(0, 40)));
    Numbers numbers{text};
    const Result<Head> head = readHead(numbers);
    if (!head)
        return tl::make_unexpected(head.error());
    const Result<std::vector<double>> verticals =
        readAngles(numbers, std::size_t(head->verticals), "vertical angles");
    if (!verticals)
        return tl::make_unexpected(verticals.error());
    if (verticals->back() > 180)
        return fail(fmt::format("vertical angles: {} is above 180", verticals->back()));
    Result<std::vector<double>> horizontals =
        readAngles(numbers, std::size_t(head->horizontals), "horizontal angles");
    if (!horizontals)
        return tl::make_unexpected(horizontals.error());
    const double first = horizontals->front(), last = horizontals->back();
    const bool even = horizontals->size() == 1, turn = first == 0 && last > 180 && last < 360;
    if (!even && !turn && !(first == 0 && (last == 90 || last == 180 || last == 360)) &&
        !(first == 90 && last == 270))
        return fail(fmt::format("horizontal angles: {} to {}, not 0 alone, nor 0 to 90, 180 or "
                                "360, nor 90 to 270 degrees",
                                first, last));

    const std::size_t height = verticals->size();
    std::vector<double> candela; // of a horizontal angle after the other
    double peak = 0;
    for (std::size_t i = 0; i < height * horizontals->size(); ++i) {
        const Result<double> value = numbers.next("candela values");
        if (!value)
            return tl::make_unexpected(value.error());
        candela.push_back(std::max(*value, 0.0));
        peak = std::max(peak, candela.back());
    }
    if (turn) { // the circle closes where it began
        horizontals->push_back(360);
        candela.insert(candela.end(), candela.begin(), candela.begin() + std::ptrdiff_t(height));
    }
    const double factor = head->multiplier * head->ballast * head->ballastLamp;
    if (!(peak > 0) || !(factor > 0))
        return fail("candela values: no light in any direction");
    if (!(peak * factor <= double(kMaxLight)))
        return fail(fmt::format("candela values: {:g} cd is more than {:g}", peak * factor,
                                double(kMaxLight)));
    LightProfile& p = file.profile;
    p.peak = float(peak * factor);
    if (head->flux > 0 && head->lamps > 0)
        file.ratedFlux = float(std::min(head->flux * head->lamps, double(kMaxLight)));

    const double from = verticals->front(), to = verticals->back();
    const double commonRow = commonStep(*verticals, from, to),
                 commonColumn = even ? 360 : commonStep(*horizontals, 0, 360);
    const double row = std::max(commonRow, (to - from) / double(kMaxProfileRows - 1)),
                 column = std::max(commonColumn, 360.0 / double(kMaxProfileColumns));
    file.resampled = row > commonRow || column > commonColumn;
    p.firstVertical = float(from);
    p.lastVertical = float(to);
    p.rows = std::uint32_t(std::lround((to - from) / row)) + 1;
    p.columns = std::uint32_t(std::lround(360 / column));
    p.share.resize(std::size_t(p.rows) * p.columns);
    for (std::uint32_t c = 0; c < p.columns; ++c) {
        const auto [h, across] =
            even ? std::pair<std::size_t, double>(0, 0)
                 : locate(*horizontals, folded(double(c) * column, first, turn ? 360 : last));
        for (std::uint32_t r = 0; r < p.rows; ++r) {
            const auto [v, along] = locate(*verticals, from + double(r) * row);
            const auto between = [&](std::size_t k) {
                const double* values = candela.data() + k * height;
                return values[v] + (values[v + 1] - values[v]) * along;
            };
            const double value =
                across > 0 ? between(h) + (between(h + 1) - between(h)) * across : between(h);
            p.share[std::size_t(c) * p.rows + r] = float(std::clamp(value / peak, 0.0, 1.0));
        }
    }
    return file;
}

std::string writeIes(const LightProfile& profile) {
    std::string name;
    noteKeyword("[LUMINAIRE] " + profile.name, name, name);
    std::string text =
        fmt::format("IESNA:LM-63-2002\n[MANUFAC] Limn\n[LUMINAIRE] {}\nTILT=NONE\n", name);
    const std::uint32_t columns = profile.columns == 1 ? 1 : profile.columns + 1; // 360 is 0 again
    text += fmt::format("1 -1 1 {} {} 1 2 0 0 0\n1 1 0", profile.rows, columns);
    const auto writeLines = [&](std::uint32_t count, const auto& value) {
        constexpr std::uint32_t kPerLine = 10;
        for (std::uint32_t i = 0; i < count; ++i)
            text += fmt::format("{}{:.7g}", i % kPerLine == 0 ? '\n' : ' ', value(i));
    };
    const double from = profile.firstVertical, to = profile.lastVertical;
    writeLines(profile.rows,
               [&](std::uint32_t r) { return from + (to - from) * r / (profile.rows - 1); });
    writeLines(columns, [&](std::uint32_t c) { return 360. * c / profile.columns; });
    for (std::uint32_t c = 0; c < columns; ++c)
        writeLines(profile.rows, [&](std::uint32_t r) {
            return double(profile.peak) *
                   profile.share[std::size_t(c % profile.columns) * profile.rows + r];
        });
    return text + '\n';
}

Result<PhotometricFile> readIes(const std::string& path) {
    const Result<std::string> text = readFile(path, kMaxFile);
    if (!text)
        return fail(fmt::format("{}: {}", path, text.error().message));
    Result<PhotometricFile> file = parseIes(*text);
    if (!file)
        return fail(fmt::format("{}: {}", path, file.error().message));
    if (file->profile.name.empty())
        file->profile.name = std::filesystem::path(path).stem().string();
    return file;
}

} // namespace limn
