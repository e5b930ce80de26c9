// SPDX-License-Identifier: MIT
#include "app/bench/front_claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>

namespace limn {

namespace {

/// The columns that are settings of a bake.
constexpr std::array<std::string_view, 15> kSettings = {"surfels",
                                                        "links",
                                                        "bands",
                                                        "rays",
                                                        "lightmap_caches",
                                                        "texels_per_metre",
                                                        "placement",
                                                        "linker",
                                                        "cut",
                                                        "storage",
                                                        "chroma_bands",
                                                        "clustering",
                                                        "cluster_normal_weight",
                                                        "cluster_balance_weight",
                                                        "grid"};

/// Whether two rows have the same settings but for those named.
bool differOnlyIn(const Json& a, const Json& b, std::initializer_list<std::string_view> names) {
    return std::ranges::all_of(kSettings, [&](std::string_view key) {
        return std::ranges::find(names, key) != names.end() || a[key] == b[key];
    });
}

double figure(const Json& row, std::string_view key) {
    const Json* value = row.find(key);
    return value && value->isNumber() ? value->get<double>() : 0;
}

/// Whether errors are those of different pictures. Bands that nothing shows change none.
bool differ(double error, double other) {
    return std::abs(error / other - 1) > 1e-6;
}

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Factors by which a halving of a setting multiplies the error, one for each pair of rows that
/// differ in it alone and have no row between them.
std::vector<double> halvings(const std::vector<Json>& rows, std::string_view key) {
    std::vector<double> factors;
    for (const Json& more : rows)
        for (const Json& less : rows) {
            const double n = figure(more, key), m = figure(less, key);
            if (m >= n || !differOnlyIn(more, less, {key}) || figure(more, "nrmse") <= 0 ||
                figure(less, "nrmse") <= 0)
                continue;
            const bool between = std::ranges::any_of(rows, [&](const Json& row) {
                return figure(row, key) > m && figure(row, key) < n &&
                       differOnlyIn(row, more, {key});
            });
            if (!between)
                factors.push_back(
                    std::pow(figure(less, "nrmse") / figure(more, "nrmse"), 1 / std::log2(n / m)));
        }
    return factors;
}

/// What compression changes: the row's figure over that of the row with all of its colour.
struct Compressed {
    double bands, time, error;
};

std::vector<Compressed> compressedRows(const std::vector<Json>& rows) {
    std::vector<Compressed> result;
    for (const Json& grey : rows) {
        const double bands = figure(grey, "bands_read");
        if (figure(grey, "chroma_bands") >= bands)
            continue;
        for (const Json& full : rows)
            if (figure(full, "chroma_bands") >= figure(full, "bands") &&
                differOnlyIn(grey, full, {"chroma_bands"}) && figure(full, "nrmse") > 0 &&
                differ(figure(grey, "nrmse"), figure(full, "nrmse")) &&
                figure(full, "update_ms") > 0)
                result.push_back({bands, figure(grey, "update_ms") / figure(full, "update_ms"),
                                  figure(grey, "nrmse") / figure(full, "nrmse")});
    }
    return result;
}

/// "1.03 times the time and 1.20 times the error with fewer than 6 bands (median of 3 pairs)", and
/// whether that pays.
struct Payment {
    bool pays = false;
    std::string text;
};

Payment paymentOf(const std::vector<Compressed>& pairs, const char* bands) {
    std::vector<double> times, errors, products;
    for (const Compressed& pair : pairs) {
        times.push_back(pair.time);
        errors.push_back(pair.error);
        products.push_back(pair.time * pair.error);
    }
    return {medianOf(products) < 1,
            fmt::format("with {}, {:.2f} times the time and {:.2f} times the error, medians of {} "
                        "pair{}",
                        bands, medianOf(times), medianOf(errors), pairs.size(),
                        pairs.size() == 1 ? "" : "s")};
}

} // namespace

PaperClaim surfelsAreSaferToReduce(const std::vector<Json>& rows) {
    PaperClaim claim{.sentence = "In general, reducing n_S is more stable than reducing n_L."};
    const std::vector<double> surfels = halvings(rows, "surfels"), links = halvings(rows, "links");
    if (surfels.empty() || links.empty()) {
        claim.reason = "There are no rows that differ in surfels alone, or none that differ in "
                       "links alone.";
        return claim;
    }
    const double s = medianOf(surfels), l = medianOf(links);
    claim.reason = fmt::format("Half the surfels multiply the error by {:.3f} (median of {} pairs, "
                               "at most {:.3f}), half the links by {:.3f} ({} pairs, at most "
                               "{:.3f}).",
                               s, surfels.size(), std::ranges::max(surfels), l, links.size(),
                               std::ranges::max(links));
    if (std::abs(s - l) > 0.01)
        claim.verdict = s < l ? PaperClaim::Verdict::Holds : PaperClaim::Verdict::Fails;
    return claim;
}

PaperClaim littleGainAboveSixBands(const std::vector<Json>& rows) {
    PaperClaim claim{.sentence =
                         "Compared to the necessary computation cost, the visual gain above "
                         "six bands is small."};
    constexpr double kSix = 6;
    std::vector<double> gains, times;
    double most = 0;
    for (const Json& six : rows) {
        most = std::max(most, figure(six, "bands_read"));
        if (figure(six, "bands_read") != kSix || figure(six, "bands") != kSix)
            continue;
        for (const Json& more : rows) {
            const double chroma = figure(six, "chroma_bands"); // all or the same number
            const bool colour = chroma >= kSix
                                    ? figure(more, "chroma_bands") >= figure(more, "bands")
                                    : figure(more, "chroma_bands") == chroma;
            if (figure(more, "bands_read") > kSix && colour && figure(six, "nrmse") > 0 &&
                differ(figure(more, "nrmse"), figure(six, "nrmse")) &&
                differOnlyIn(six, more, {"bands", "chroma_bands"})) {
                gains.push_back(1 - figure(more, "nrmse") / figure(six, "nrmse"));
                times.push_back(figure(more, "update_ms") / figure(six, "update_ms"));
            }
        }
    }
    if (gains.empty()) {
        claim.reason = fmt::format("The rows say nothing: the surfaces read at most {:g} bands, "
                                   "and rows with six and with "
                                   "more that are read would be needed.",
                                   most);
        return claim;
    }
    const double gain = medianOf(gains);
    claim.reason =
        fmt::format("More than six bands take {:.1f} % off the error of six, for {:.2f} "
                    "times the time (medians of {} pair{}).",
                    100 * gain, medianOf(times), gains.size(), gains.size() == 1 ? "" : "s");
    claim.verdict = gain < 0.05 ? PaperClaim::Verdict::Holds : PaperClaim::Verdict::Fails;
    return claim;
}

PaperClaim chrominancePaysFromSixBands(const std::vector<Json>& rows) {
    PaperClaim claim{.sentence = "Using the compression with our algorithm should only be "
                                 "considered for higher number of bands (6+)."};
    std::vector<Compressed> few, many;
    for (const Compressed& pair : compressedRows(rows))
        (pair.bands >= 6 ? many : few).push_back(pair);
    std::vector<Payment> payments;
    if (!few.empty())
        payments.push_back(paymentOf(few, "fewer than six bands"));
    if (!many.empty())
        payments.push_back(paymentOf(many, "six bands and more"));
    for (const Payment& payment : payments)
        claim.reason +=
            fmt::format("{}Compression gives, {}: it {}.", claim.reason.empty() ? "" : " ",
                        payment.text, payment.pays ? "pays" : "does not pay");
    if (few.empty() || many.empty())
        claim.reason += std::string(claim.reason.empty() ? "" : " ") +
                        "Rows with fewer chroma bands than the surfaces read would be needed " +
                        (few.empty() && many.empty() ? "on both sides of six bands."
                         : few.empty()               ? "below six bands, too."
                                                     : "with six bands and more, too.");
    else
        claim.verdict = !payments[0].pays && payments[1].pays ? PaperClaim::Verdict::Holds
                                                              : PaperClaim::Verdict::Fails;
    return claim;
}

std::vector<PaperClaim> paperClaims(const std::vector<Json>& rows) {
    return {surfelsAreSaferToReduce(rows), littleGainAboveSixBands(rows),
            chrominancePaysFromSixBands(rows)};
}

} // namespace limn
