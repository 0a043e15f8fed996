// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <algorithm>

#include "render/aovs/aov.h"

namespace umbrix::render {

TileFilm::TileFilm(const std::vector<const Aov*>& aovs, const PixelRect& tile)
    : aovs_(aovs),
      tile_(tile),
      channels_(channel_names(aovs).size()),
      sums_(tile.size() * channels_),
      weights_(tile.size() * aovs.size()) {}

void TileFilm::add(std::size_t pixel, const CameraSample& sample) {
  double* sums = &sums_[pixel * channels_];
  double* weight = &weights_[pixel * aovs_.size()];
  for (const Aov* aov : aovs_) {
    double values[kMaxAovChannels];
    const double contribution = aov->contribute(sample, values);
    if (contribution > 0) {
      for (std::size_t c = 0; c < aov->channels.size(); ++c) {
        if (aov->reduction == Reduction::mean) sums[c] += contribution * values[c];
        if (aov->reduction == Reduction::minimum) sums[c] = *weight > 0 ? std::min(sums[c], values[c]) : values[c];
      }
      *weight += contribution;
    }
    sums += aov->channels.size();
    ++weight;
  }
}

void TileFilm::write(const PixelRect& window, io::Image& image) const {
  const double* sums = sums_.data();
  const double* weight = weights_.data();
  for (int y = 0; y < tile_.height; ++y) {
    const auto row = static_cast<std::size_t>(tile_.y - window.y + y) * static_cast<std::size_t>(window.width);
    float* out = &image.pixels[(row + static_cast<std::size_t>(tile_.x - window.x)) * channels_];
    for (int x = 0; x < tile_.width; ++x) {
      for (const Aov* aov : aovs_) {
        for (std::size_t c = 0; c < aov->channels.size(); ++c, ++sums, ++out) {
          const double divisor = aov->reduction == Reduction::mean ? *weight : 1;
          *out = static_cast<float>(*weight > 0 ? *sums / divisor : aov->background);
        }
        ++weight;
      }
    }
  }
}

}  // namespace umbrix::render
