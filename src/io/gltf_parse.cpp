// SPDX-License-Identifier: Apache-2.0
// tinygltf, fed by our own hands: it opens no file itself. The external buffers are found and checked here first, and
// handed over one after the other in the order of the file, which is the order in which tinygltf asks; when it comes
// to the images, nothing is left to give.

#include "io/gltf_parse.h"

#include <cctype>
#include <deque>
#include <optional>

#include "io/gltf_compression.h"
#include "io/input_file.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

struct ExternalBuffer {
  std::string file;
  std::string label;  // for messages
  std::uint64_t bytes = 0;
  bool placeholder = false;  // stands for one that has no content
};

// What tinygltf's callbacks share.
struct BufferSource {
  std::deque<ExternalBuffer> waiting;
  std::uint64_t bytes_left = 0;
  std::optional<LoadError> error;
};

int hex_value(char c) {
  const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower >= '0' && lower <= '9') return lower - '0';
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// RFC 3986, section 2.1.
std::string percent_decoded(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
    out += escape ? static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return out;
}

bool starts_with(std::string_view text, std::string_view prefix) { return text.substr(0, prefix.size()) == prefix; }

// "http://...", "file:...", "C:\..."
bool has_scheme(std::string_view uri) {
  const auto colon = uri.find(':');
  return colon != std::string_view::npos && colon < uri.find('/');
}

// Lists the buffers kept in files, and refuses what tinygltf would misunderstand.
BufferSource list_external_buffers(const std::string& scene_path, const GltfDocument& document, const json& root,
                                   const LoadLimits& limits) {
  BufferSource source;
  source.bytes_left = limits.file_bytes;
  if (!root.contains("buffers")) return source;
  std::size_t number = 0;
  for (const json& buffer : root.at("buffers")) {
    const std::string label = fmt::format("buffers[{}]", number);
    const auto bytes = buffer.at("byteLength").get<std::uint64_t>();
    const std::string uri = buffer.value("uri", std::string());
    if (is_placeholder(buffer)) {
      source.waiting.push_back({{}, label, 1, true});
      ++number;
      continue;
    }
    if (bytes == 0) bad_input("{}: byteLength is 0", label);
    if (uri.empty()) {
      if (!document.binary || number != 0) bad_input("{}: 'uri' is missing", label);
    } else if (starts_with(uri, "data:")) {
      if (!starts_with(uri, "data:application/octet-stream;base64,") &&
          !starts_with(uri, "data:application/gltf-buffer;base64,")) {
        bad_input("{}: the data URI '{}...' is of an unknown type", label, printable(uri.substr(0, 40), 40));
      }
    } else {
      source.waiting.push_back({uri_path(scene_path, uri, label, limits), label, bytes});
    }
    ++number;
  }
  return source;
}

// The next buffer's file, which may be longer than the buffer (glTF 2.0, section 5.10.2).
bool read_next(BufferSource& source, std::vector<unsigned char>& out) {
  if (source.error || source.waiting.empty()) return false;
  const ExternalBuffer buffer = std::move(source.waiting.front());
  source.waiting.pop_front();
  if (buffer.placeholder) {
    out.assign(buffer.bytes, 0);
    return true;
  }
  try {
    out = read_file(buffer.file, source.bytes_left);
    if (out.size() < buffer.bytes) bad_input("has {} bytes, the buffer needs {}", out.size(), buffer.bytes);
    source.bytes_left -= out.size();
    out.resize(buffer.bytes);
    return true;
  } catch (const LoadError& e) {
    source.error = LoadError{e.code, fmt::format("{}: {}: {}", buffer.label, printable(buffer.file), e.what)};
    return false;
  }
}

// tinygltf 2.9 also asks for the size of a file; 2.7 has no such member.
template <class Callbacks>
auto set_size_callback(Callbacks& callbacks, int) -> decltype(void(callbacks.GetFileSizeInBytes)) {
  callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void* user) {
    const auto& waiting = static_cast<BufferSource*>(user)->waiting;
    *size = waiting.empty() ? 0 : static_cast<std::size_t>(waiting.front().bytes);
    return !waiting.empty();
  };
}
template <class Callbacks>
void set_size_callback(Callbacks&, long) {}

tinygltf::FsCallbacks callbacks_for(BufferSource& source) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void* user) {
    return !static_cast<BufferSource*>(user)->waiting.empty();
  };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string&, void* user) {
    return read_next(*static_cast<BufferSource*>(user), *out);
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  set_size_callback(callbacks, 0);
  callbacks.user_data = &source;
  return callbacks;
}

// Images stay encoded until something samples them. Those of data URIs come here alone, the others stay where they are.
bool leave_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

}  // namespace

std::string uri_path(const std::string& scene_path, const std::string& uri, const std::string& label,
                     const LoadLimits& limits) {
  const std::string name = percent_decoded(uri);
  if (has_scheme(uri)) {
    bad_input("{}: '{}' is not a relative path; only local files are read", label, printable(name, 128));
  }
  return path_beside(scene_path, name, !limits.allow_paths_outside, label, "scene file");
}

tinygltf::Model parse_gltf(const std::string& path, const GltfDocument& document, const nlohmann::json& root,
                           const LoadLimits& limits) {
  BufferSource source = list_external_buffers(path, document, root, limits);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks(callbacks_for(source));
  parser.SetImageLoader(&leave_image, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  // Any non-empty folder does: names are not looked at.
  const auto size = static_cast<unsigned int>(document.binary ? document.bytes.size() : document.json.size());
  const bool parsed = document.binary
                          ? parser.LoadBinaryFromMemory(&model, &error, &warning, document.bytes.data(), size, ".")
                          : parser.LoadASCIIFromString(&model, &error, &warning, document.json.data(), size, ".");
  if (source.error) throw *source.error;
  if (!parsed) bad_input("{}", error.empty() ? "cannot be parsed" : one_line(error));
  return model;
}

}  // namespace umbrix::io::detail
