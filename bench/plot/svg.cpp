// SPDX-License-Identifier: Apache-2.0
#include "plot/svg.h"

#include <fmt/format.h>

namespace umbrix::plot {
namespace {

std::string list(const std::vector<Point>& points) {
  std::string out;
  for (const Point& p : points) out += fmt::format("{}{:.2f},{:.2f}", out.empty() ? "" : " ", p.x, p.y);
  return out;
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < ' ' ? '?' : c;  // XML has no control characters
    }
  }
  return out;
}

Svg::Svg(int width, int height)
    : body_(fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                        "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\">\n",
                        width, height)) {}

void Svg::rectangle(double x, double y, double width, double height, const std::string& fill) {
  body_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y,
                       width, height, fill);
}

void Svg::line(const Point& from, const Point& to, const std::string& stroke, double width) {
  add_line(from, to, stroke, width, "");
}

void Svg::dashed_line(const Point& from, const Point& to, const std::string& stroke, double width) {
  add_line(from, to, stroke, width, " stroke-dasharray=\"5 4\"");
}

void Svg::add_line(const Point& from, const Point& to, const std::string& stroke, double width,
                   const std::string& more) {
  body_ += fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", from.x,
      from.y, to.x, to.y, stroke, width, more);
}

void Svg::polyline(const std::vector<Point>& points, const std::string& stroke, double width) {
  body_ += fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>\n",
      list(points), stroke, width);
}

void Svg::polygon(const std::vector<Point>& points, const std::string& fill, double opacity) {
  const std::string veil = opacity == 1 ? "" : fmt::format(" fill-opacity=\"{}\"", opacity);
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"{}/>\n", list(points), fill, veil);
}

void Svg::circle(const Point& centre, double radius, const std::string& fill) {
  body_ +=
      fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>\n", centre.x, centre.y, radius, fill);
}

void Svg::ring(const Point& centre, double radius, const std::string& stroke, double width) {
  body_ +=
      fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                  centre.x, centre.y, radius, stroke, width);
}

void Svg::text(const Point& at, const std::string& text, Anchor anchor, double size, double degrees) {
  const char* const anchors[] = {"start", "middle", "end"};
  const std::string turn =
      degrees == 0 ? "" : fmt::format(" transform=\"rotate({} {:.2f} {:.2f})\"", degrees, at.x, at.y);
  body_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" font-size=\"{}\"{}>{}</text>\n", at.x, at.y,
                       anchors[static_cast<int>(anchor)], size, turn, xml_text(text));
}

}  // namespace umbrix::plot
