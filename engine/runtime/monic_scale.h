// SPDX-License-Identifier: MIT
#pragma once

namespace limn::runtime {

/// The constants that basis and cone factors omit, at l(l+1)+m: K_lm and the leading coefficients
/// of P_l^m and, for l > 0, of P_l' / (l(l+1)).
struct MonicScale {
    float factor[64];

    MonicScale() {
        double odd = 1, factorial = 1; // (2l-1)!!, l!
        for (int l = 0; l < 8; ++l) {
            if (l > 0)
                odd *= 2 * l - 1, factorial *= l;
            const double cone = l > 0 ? odd / (factorial * (l + 1)) : 1;
            double below = factorial, ratio = 1; // (l-m)!, (l-m)!/(l+m)!
            for (int m = 0; m <= l; ++m) {
                if (m > 0)
                    below /= l - m + 1, ratio /= double(l + m) * (l - m + 1);
                const double k =
                    __builtin_sqrt((2 * l + 1) / 12.566370614359172 * ratio * (m > 0 ? 2 : 1));
                factor[l * (l + 1) + m] = factor[l * (l + 1) - m] = float(k * cone * odd / below);
            }
        }
    }
};

} // namespace limn::runtime
