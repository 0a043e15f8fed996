// SPDX-License-Identifier: Apache-2.0
#include "plot/label_places.h"

#include <algorithm>

#include "plot/chart_area.h"

namespace umbrix::plot {

bool LabelPlaces::is_free(const Box& box) const {
  if (box.left < page_.left || box.right > page_.right || box.top < page_.top || box.bottom > page_.bottom)
    return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
    return box.left < other.right && box.right > other.left && box.top < other.bottom && box.bottom > other.top;
  });
}

std::optional<Point> LabelPlaces::place(const Point& point, const std::string& text) {
  const double width = text_width(text, kSize), height = kSize, away = 8;
  // Right, above, below, left, then the corners; last a line higher or lower.
  const Point lower_left[] = {{point.x + away, point.y + 0.4 * height},
                              {point.x - width / 2, point.y - away},
                              {point.x - width / 2, point.y + away + 0.8 * height},
                              {point.x - away - width, point.y + 0.4 * height},
                              {point.x + 0.6 * away, point.y - 0.6 * away},
                              {point.x + 0.6 * away, point.y + away + 0.5 * height},
                              {point.x - 0.6 * away - width, point.y - 0.6 * away},
                              {point.x - 0.6 * away - width, point.y + away + 0.5 * height},
                              {point.x - width / 2, point.y - away - height},
                              {point.x - width / 2, point.y + away + 1.8 * height}};
  for (const Point& at : lower_left) {
    const Box box = {at.x, at.y - 0.8 * height, at.x + width, at.y + 0.2 * height};
    if (!is_free(box)) continue;
    taken_.push_back(box);
    return at;
  }
  return std::nullopt;
}

}  // namespace umbrix::plot
