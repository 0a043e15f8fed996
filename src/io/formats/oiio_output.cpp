// SPDX-License-Identifier: Apache-2.0
#include "io/formats/oiio_output.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/exr_header.h"
#include "umbrix/version.h"

namespace umbrix::io::detail {

namespace {

// Where the encoders' bytes go. They do not all tell of a failed write (OpenEXR's table of offsets is written in a
// destructor), so the first failure is kept here.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit FileProxy(AtomicFile& file) : IOProxy("", Write), file_(file) {
    start_.reserve(kStartBytes);  // encoders do not expect a write to throw
  }

  const char* proxytype() const override { return "umbrix"; }
  std::size_t size() const override { return static_cast<std::size_t>(size_); }

  std::size_t write(const void* data, std::size_t size) override {
    const std::size_t done = pwrite(data, size, m_pos);
    m_pos += static_cast<std::int64_t>(done);
    return done;
  }

  std::size_t pwrite(const void* data, std::size_t size, std::int64_t offset) override {
    if (error_ == 0) error_ = file_.write(data, size, static_cast<std::uint64_t>(offset));
    if (error_ != 0) return 0;
    keep_start(static_cast<const unsigned char*>(data), size, static_cast<std::size_t>(offset));
    size_ = std::max(size_, offset + static_cast<std::int64_t>(size));
    return size;
  }

  int error() const { return error_; }  ///< errno, or 0

  /// The first bytes of the file, as they stand.
  const std::vector<unsigned char>& start() const { return start_; }

 private:
  static constexpr std::size_t kStartBytes = 1u << 20;

  void keep_start(const unsigned char* data, std::size_t size, std::size_t offset) {
    if (offset >= kStartBytes) return;
    const std::size_t end = std::min(offset + size, kStartBytes);
    if (start_.size() < end) start_.resize(end);
    std::copy(data, data + (end - offset), start_.begin() + static_cast<std::ptrdiff_t>(offset));
  }

  AtomicFile& file_;
  std::vector<unsigned char> start_;
  std::int64_t size_ = 0;
  int error_ = 0;
};

}  // namespace

Status write_with_oiio(const char* format, AtomicFile& file, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                       const void* pixels) {
  FileProxy proxy(file);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->set_ioproxy(&proxy))
    return {StatusCode::output_failed, "OpenImageIO cannot write this format: " + OIIO::geterror()};
  const bool encoded = output->open("", spec) && output->write_image(type, pixels) && output->close();
  if (proxy.error() != 0) return {StatusCode::output_failed, std::generic_category().message(proxy.error())};
  if (encoded && std::string_view(format) == "openexr" && !has_all_exr_rows(proxy.start(), proxy.size()))
    return Status::out_of_memory("OpenEXR left rows out: out of memory");
  if (encoded) return {};
  const std::string reason = output->geterror();
  return {StatusCode::output_failed, reason.empty() ? "cannot be written" : reason};
}

void set_common_attributes(OIIO::ImageSpec& spec, const Image& image) {
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  spec.attribute("Software", std::string("Umbrix ") + version_string());
  for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
}

}  // namespace umbrix::io::detail
