// SPDX-License-Identifier: Apache-2.0
#include "io/hash_state.h"

#include <fmt/format.h>

// The whole of xxHash is compiled in here, so that users of a static library need not link it.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace umbrix::io::detail {

// Aligned as the state asks to be.
struct HashState::Implementation {
  XXH3_state_t state;
};

HashState::HashState() : implementation_(new Implementation) { XXH3_128bits_reset(&implementation_->state); }

HashState::~HashState() = default;

void HashState::add(const void* bytes, std::size_t size) noexcept {
  XXH3_128bits_update(&implementation_->state, bytes, size);
}

void HashState::add_text(std::string_view text) noexcept {
  const std::uint64_t size = text.size();
  add(&size, sizeof size);
  add(text.data(), text.size());
}

std::string HashState::digits() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&implementation_->state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace umbrix::io::detail
