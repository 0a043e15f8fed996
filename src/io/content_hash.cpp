// SPDX-License-Identifier: Apache-2.0
#include "umbrix/io/content_hash.h"

#include <exception>
#include <new>
#include <vector>

#include "io/hash_state.h"
#include "io/input_file.h"
#include "io/load_error.h"

namespace umbrix::io {
namespace {

// Runs what reads a file; what it throws becomes a status that names the file.
template <class Read>
Status guarded(const std::string& path, Read read) {
  try {
    read();
    return {};
  } catch (const detail::LoadError& e) {
    return {e.code, detail::printable(path) + ": " + e.what};
  } catch (const std::bad_alloc&) {
    return detail::out_of_memory(path);
  } catch (const std::exception& e) {
    return {StatusCode::bad_input, detail::printable(path) + ": " + detail::one_line(e.what())};
  }
}

}  // namespace

std::string content_hash(std::string_view bytes) {
  detail::HashState hash;
  hash.add(bytes.data(), bytes.size());
  return hash.digits();
}

Status hash_file(const std::string& path, std::string& out) {
  out.clear();
  return guarded(path, [&] {
    detail::HashState hash;
    detail::read_in_pieces(path, [&](const unsigned char* bytes, std::size_t size) { hash.add(bytes, size); });
    out = hash.digits();
  });
}

Status read_text(const std::string& path, std::uint64_t limit, std::string& out) {
  out.clear();
  return guarded(path, [&] {
    const std::vector<unsigned char> bytes = detail::read_file(path, limit);
    out.assign(bytes.begin(), bytes.end());
  });
}

}  // namespace umbrix::io
