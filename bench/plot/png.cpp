// SPDX-License-Identifier: Apache-2.0
#include "plot/png.h"

#include <fmt/format.h>

#include <memory>

#include "umbrix/io/image_file.h"

#if UMBRIX_HAS_RSVG
#include <cairo.h>
#include <librsvg/rsvg.h>
#endif

namespace umbrix::plot {

#if UMBRIX_HAS_RSVG

namespace {

struct Release {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

Status failed(const std::string& path, const char* why) {
  return {StatusCode::output_failed, fmt::format("{}: {}", path, why)};
}

}  // namespace

bool can_rasterise() { return true; }

Status write_png(const std::string& path, const std::string& svg, double scale) {
  const std::unique_ptr<RsvgHandle, Release> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), nullptr));
  double width = 0, height = 0;
  if (!handle || !rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
    return failed(path, "the chart cannot be read as SVG");
  const RsvgRectangle page = {0, 0, scale * width, scale * height};
  const std::unique_ptr<cairo_surface_t, Release> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page.width), static_cast<int>(page.height)));
  const std::unique_ptr<cairo_t, Release> context(cairo_create(surface.get()));
  if (!rsvg_handle_render_document(handle.get(), context.get(), &page, nullptr))
    return failed(path, "the chart cannot be drawn");
  std::string bytes;
  if (const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
      status != CAIRO_STATUS_SUCCESS) {
    return failed(path, cairo_status_to_string(status));
  }
  return io::write_text(path, bytes, true);
}

#else

bool can_rasterise() { return false; }

Status write_png(const std::string& path, const std::string& /*svg*/, double /*scale*/) {
  return {StatusCode::internal, fmt::format("{}: this build has no librsvg, which makes PNG of charts", path)};
}

#endif

}  // namespace umbrix::plot
