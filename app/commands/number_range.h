// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <fmt/format.h>

namespace limn {

/// Accepts only numbers in [least, most]. CLI::Range would accept "nan".
inline CLI::Validator numberWithin(double least, double most) {
    return CLI::Validator(
        [=](std::string& text) {
            double value = 0;
            const bool ok =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return ok ? std::string()
                      : fmt::format("Value {} not in range [{:g} - {:g}]", text, least, most);
        },
        fmt::format("NUMBER in [{:g} - {:g}]", least, most));
}

} // namespace limn
