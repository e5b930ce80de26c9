// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

/// Whether the tests run with AddressSanitizer or ThreadSanitizer, with which they take several
/// times as long. Tests that measure an error over many bakes, pictures or seeds measure fewer of
/// them there: the others would run the same code again.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Printed where a whole test is skipped with the sanitizers.
inline constexpr const char* kSweepSkipped = "a measurement, whose code other tests run as well";

} // namespace limn
