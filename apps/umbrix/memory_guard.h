// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>

namespace umbrix::app {

/// From now on, no memory means one line on stderr, nothing half-written and exit code kResourceLimit, wherever it runs
/// out. Other libraries' threads and destructors do not all survive an exception.
void guard_memory() noexcept;

/// Is the error that no memory, or no thread, was to be had?
bool is_lack_of_memory(const std::exception& error) noexcept;

/// What the program is doing, for that line ("reading the scene"). `what` must last.
void set_phase(const char* what) noexcept;

/// Ends the program in the same way when it holds more than `bytes`: looks every few milliseconds. What can be foreseen
/// is refused before (memory_plan.h); this is for the rest. 0: no limit.
void limit_memory(std::uint64_t bytes) noexcept;

/// Memory held now, 0 if the system does not tell.
std::uint64_t resident_bytes() noexcept;

}  // namespace umbrix::app
