// SPDX-License-Identifier: Apache-2.0
#include "io/formats/oiio_output.h"

#include "umbrix/version.h"

namespace umbrix::io::detail {

Status write_with_oiio(const char* format, const std::string& path, const OIIO::ImageSpec& spec,
                       const OIIO::TypeDesc& type, const void* pixels) {
  // By format name: the temporary name has no extension that OpenImageIO could choose by.
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) return {StatusCode::output_failed, "OpenImageIO cannot write this format: " + OIIO::geterror()};
  if (!output->open(path, spec) || !output->write_image(type, pixels) || !output->close()) {
    std::string reason = output->geterror();
    return {StatusCode::output_failed, reason.empty() ? "cannot be written" : reason};
  }
  return {};
}

void set_common_attributes(OIIO::ImageSpec& spec, const Image& image) {
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  spec.attribute("Software", std::string("Umbrix ") + version_string());
  for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
}

}  // namespace umbrix::io::detail
