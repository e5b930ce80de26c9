// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <unistd.h>

namespace limn {

/// An open file descriptor, closed on destruction. Negative: no file.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : m_number(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        close();
        m_number = std::exchange(other.m_number, -1);
        return *this;
    }

    explicit operator bool() const { return m_number >= 0; }
    int number() const { return m_number; }

    /// Returns false, with errno set, if a delayed write has failed.
    bool close() {
        const int number = std::exchange(m_number, -1);
        return number < 0 || ::close(number) == 0;
    }

private:
    int m_number;
};

} // namespace limn
