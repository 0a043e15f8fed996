// SPDX-License-Identifier: Apache-2.0
#include "umbrix/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <system_error>

#include "io/atomic_file.h"
#include "io/image_formats.h"
#include "io/image_input.h"
#include "io/load_error.h"

namespace umbrix::io {
namespace {

struct Format {
  const char* extension;
  Status (*write)(detail::AtomicFile& file, const Image& image, const WriteOptions& options);
};

#define UMBRIX_FORMAT_ROW(name, extension) {extension, &detail::write_##name},
constexpr Format kFormats[] = {UMBRIX_IMAGE_FORMATS(UMBRIX_FORMAT_ROW)};
#undef UMBRIX_FORMAT_ROW

Status failed(const std::string& path, const std::string& reason) {
  return {StatusCode::output_failed, detail::printable(path) + ": " + detail::one_line(reason)};
}

Status find_format(const std::string& path, const Format*& out) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const Format& format : kFormats) {
    if (extension == format.extension) {
      out = &format;
      return {};
    }
    known += std::string(known.empty() ? "" : ", ") + format.extension;
  }
  return failed(path, "unknown image format; the name must end in one of " + known);
}

// Do the fields agree with each other?
const char* fault_of(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return "the image is empty";
  if (image.channels.empty()) return "the image has no channels";
  const auto count = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (image.pixels.size() % image.channels.size() != 0 || image.pixels.size() / image.channels.size() != count) {
    return "the image's pixels do not match its size";
  }
  if (image.frame_width < 0 || image.frame_height < 0 || (image.frame_width > 0) != (image.frame_height > 0)) {
    return "the image's frame is empty";
  }
  for (const auto& matrix : image.matrices) {
    if (matrix.second.size() != 16) return "a matrix of the image has not 16 values";
  }
  return nullptr;
}

// Runs a step of writing; exceptions of libraries end here.
template <class Step>
Status guarded(const std::string& path, Step step) {
  try {
    return step();
  } catch (const std::bad_alloc&) {
    return detail::out_of_memory(path);
  } catch (const std::exception& e) {
    return failed(path, e.what());
  }
}

std::string reason_of(int error) { return std::generic_category().message(error); }

Status write_standard_output(const std::string& text) {
  // What others printed before comes first.
  const char* next = text.data();
  int error = std::fflush(stdout) == 0 ? 0 : errno;
  for (std::size_t left = text.size(); left > 0 && error == 0;) {
    const ssize_t done = ::write(STDOUT_FILENO, next, left);
    if (done < 0 && errno != EINTR) error = errno;
    if (done <= 0) continue;
    next += done;
    left -= static_cast<std::size_t>(done);
  }
  if (error == EPIPE) return {StatusCode::cancelled, "standard output: nobody reads it any more"};
  return error == 0 ? Status() : failed("standard output", reason_of(error));
}

int place_in_frame(int begin, int frame_begin) {
  const std::int64_t place = std::int64_t{begin} - frame_begin;
  if (place < INT_MIN || place > INT_MAX) detail::bad_input("the data window is too far from the display window");
  return static_cast<int>(place);
}

void read_checked(const std::string& path, Image& out) {
  const auto input = detail::open_image(path);
  const OIIO::ImageSpec& spec = input->spec();
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.x = place_in_frame(spec.x, spec.full_x);
  image.y = place_in_frame(spec.y, spec.full_y);
  image.frame_width = spec.full_width;
  image.frame_height = spec.full_height;
  image.channels = spec.channelnames;
  const bool half = spec.format == OIIO::TypeDesc::HALF ||
                    std::any_of(spec.channelformats.begin(), spec.channelformats.end(),
                                [](const OIIO::TypeDesc& type) { return type == OIIO::TypeDesc::HALF; });
  image.pixel_type = half ? PixelType::half : PixelType::single;
  image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    detail::bad_input("{}", detail::one_line(input->geterror()));
  }
  for (const auto& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeDesc::TypeMatrix) {
      const auto* values = static_cast<const float*>(attribute.data());
      image.matrices.emplace_back(attribute.name().string(), std::vector<float>(values, values + 16));
    } else if (attribute.type() == OIIO::TypeDesc::STRING) {
      image.metadata.emplace_back(attribute.name().string(), attribute.get_string());
    }
  }
  out = std::move(image);
}

}  // namespace

Status check_output(const std::string& path, const WriteOptions& options) {
  return guarded(path, [&]() -> Status {
    const Format* format = nullptr;
    if (Status status = find_format(path, format); !status) return status;
    return detail::AtomicFile::check(path, options.overwrite);
  });
}

Status write_image(const std::string& path, const Image& image, const WriteOptions& options) {
  return guarded(path, [&]() -> Status {
    const Format* format = nullptr;
    if (Status status = find_format(path, format); !status) return status;
    if (const char* fault = fault_of(image)) {
      return {StatusCode::invalid_argument, detail::printable(path) + ": " + fault};
    }
    detail::AtomicFile file;
    if (Status status = file.begin(path, options.overwrite); !status) return status;
    if (Status status = format->write(file, image, options); !status) {
      return {status.code(), detail::printable(path) + ": " + detail::one_line(status.message())};
    }
    return file.commit();
  });
}

Status read_image(const std::string& path, Image& out) {
  out = {};
  const auto refused = [&](StatusCode code, const std::string& what) {
    return Status(code, detail::printable(path) + ": " + what);
  };
  try {
    read_checked(path, out);
    return {};
  } catch (const detail::LoadError& e) {
    return refused(e.code, e.what);
  } catch (const std::bad_alloc&) {
    return refused(StatusCode::resource_limit, "not enough memory");
  } catch (const std::exception& e) {
    return refused(StatusCode::bad_input, detail::one_line(e.what()));
  }
}

Status write_text(const std::string& path, const std::string& text, bool overwrite) {
  return guarded(path, [&]() -> Status {
    if (path == "-") return write_standard_output(text);
    detail::AtomicFile file;
    if (Status status = file.begin(path, overwrite); !status) return status;
    if (const int error = file.write(text.data(), text.size(), 0)) return failed(path, reason_of(error));
    return file.commit();
  });
}

}  // namespace umbrix::io
