// SPDX-License-Identifier: Apache-2.0
#include "error/embree_contestant.h"

#include <fmt/format.h>

#include <utility>

namespace umbrix::bench {
namespace {

/// Remembers nothing from frame to frame, and needs nothing but its tree.
class EmbreeContestant : public Contestant {
 public:
  EmbreeContestant(const embree::EmbreeScene& scene, embree::Mode mode, std::string name)
      : scene_(scene), mode_(mode), name_(std::move(name)) {}
  const std::string& name() const override { return name_; }

  Status run(Scene& /*scene*/, const Frames& frames, const Training& /*lights*/, bool /*count*/,
             FrameResult& out) override {
    out = FrameResult();
    const workload::TiledRays& last = frames.back();
    out.seconds = trace_tiles(last, out.answers, [&](std::size_t tile, std::uint8_t* answers) {
      scene_.occluded(tile_rays(last, tile), mode_, answers);
    });
    return {};
  }

 private:
  const embree::EmbreeScene& scene_;
  embree::Mode mode_;
  std::string name_;
};

}  // namespace

std::vector<std::unique_ptr<Contestant>> embree_contestants(const embree::EmbreeScene& scene,
                                                            const std::string& suffix) {
  std::vector<std::unique_ptr<Contestant>> all;
  for (const embree::Mode mode : embree::modes()) {
    all.push_back(
        std::make_unique<EmbreeContestant>(scene, mode, fmt::format("embree:{}:{}", embree::mode_name(mode), suffix)));
  }
  return all;
}

}  // namespace umbrix::bench
