// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/svg.h"

namespace umbrix::plot {

/// Finds room for names beside points: the first of some places around the point that covers nothing (after Imhof 1975,
/// "Positioning names on maps"); one that has no room is left out.
class LabelPlaces {
 public:
  static constexpr double kSize = 11;  ///< of the text

  LabelPlaces(double left, double top, double right, double bottom) : page_{left, top, right, bottom} {}

  /// What names must not cover.
  void occupy(double left, double top, double right, double bottom) { taken_.push_back({left, top, right, bottom}); }
  void occupy(const Point& centre, double radius) {
    occupy(centre.x - radius, centre.y - radius, centre.x + radius, centre.y + radius);
  }

  /// Where the text's line starts, if there is room; it is then occupied.
  std::optional<Point> place(const Point& point, const std::string& text);

 private:
  struct Box {
    double left, top, right, bottom;
  };

  bool is_free(const Box& box) const;

  Box page_;
  std::vector<Box> taken_;
};

}  // namespace umbrix::plot
