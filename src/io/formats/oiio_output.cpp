// SPDX-License-Identifier: Apache-2.0
#include "io/formats/oiio_output.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <system_error>

#include "umbrix/version.h"

namespace umbrix::io::detail {

namespace {

// Where the encoders' bytes go. They do not all tell of a failed write (OpenEXR's table of offsets is written in a
// destructor), so the first failure is kept here.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit FileProxy(AtomicFile& file) : IOProxy("", Write), file_(file) {}

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
    size_ = std::max(size_, offset + static_cast<std::int64_t>(size));
    return size;
  }

  int error() const { return error_; }  ///< errno, or 0

 private:
  AtomicFile& file_;
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
