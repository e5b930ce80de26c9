// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace limn {

/// A failure the caller is expected to handle. The message names the file and the field at fault.
struct Error {
    std::string message;
};

/// A value, or the reason why there is none. It must not be discarded.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
public:
    using tl::expected<T, Error>::expected;
};

/// `return fail("cannot open {}", path)` is written `return fail(fmt::format(...))`.
inline tl::unexpected<Error> fail(std::string message) {
    return tl::make_unexpected(Error{std::move(message)});
}

} // namespace limn
