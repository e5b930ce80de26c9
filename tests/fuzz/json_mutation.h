// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace limn {

/// All values of a tree, itself first.
inline void listValues(nlohmann::json& json, std::vector<nlohmann::json*>& out) {
    out.push_back(&json);
    for (nlohmann::json& inner : json)
        if (json.is_structured())
            listValues(inner, out);
}

/// Changes one to three values to other ones of their kind, to those of other places, or to none.
/// Bytes changed at random rarely get past a parser of JSON; this does. False: it is no JSON.
inline bool mutateJson(std::string& text, unsigned seed) {
    static const double kNumbers[] = {
        0,    1,   2,     3,          4,   -1,    255,   5120, 5121,         5123, 5125,  5126,
        1e-9, 0.5, 65536, 2147483647, 1e9, 1e300, 1e-45, -0.0, 4294967295.0, 1e12, -1e12, 34963};
    nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded())
        return false;
    std::minstd_rand random(seed);
    const std::size_t changes = 1 + random() % 3;
    for (std::size_t i = 0; i < changes; ++i) {
        std::vector<nlohmann::json*> values;
        listValues(json, values);
        nlohmann::json& value = *values[random() % values.size()];
        const std::size_t what = random() % 8;
        if (value.is_number() && what < 3) {
            value = kNumbers[random() % std::size(kNumbers)];
            if (const double number = value.get<double>();
                std::abs(number) < 1e15 && number == std::floor(number) && random() % 4)
                value = std::int64_t(number);
        } else if (value.is_number() && what < 5) {
            value =
                value.is_number_integer()
                    ? nlohmann::json(value.get<std::int64_t>() + 1 - 2 * std::int64_t(random() % 2))
                    : nlohmann::json(value.get<double>() * -1.5);
        } else if (value.is_string() && what < 3) {
            auto bytes = value.get<std::string>();
            const std::size_t size = bytes.size();
            bytes.resize(size + 16);
            bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size,
                                          bytes.size()));
            value = bytes;
        } else if (value.is_array() && what < 4 && !value.empty()) {
            if (random() % 2)
                value.push_back(nlohmann::json(value[random() % value.size()]));
            else
                value.erase(random() % value.size());
        } else if (value.is_object() && what < 4 && !value.empty()) {
            const auto at = std::next(value.begin(), std::ptrdiff_t(random() % value.size()));
            value.erase(at);
        } else {
            value = nlohmann::json(*values[random() % values.size()]);
        }
    }
    text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return true;
}

/// Puts `text` into the fuzzer's buffer; returns its size, 0 where it does not fit.
inline std::size_t putText(const std::string& text, std::uint8_t* data, std::size_t most) {
    if (text.size() > most)
        return 0;
    std::copy(text.begin(), text.end(), data);
    return text.size();
}

} // namespace limn
