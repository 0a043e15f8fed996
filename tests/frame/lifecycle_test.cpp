// SPDX-License-Identifier: Apache-2.0
//
// When a tracer starts to know, forgets, and refuses.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "frame_test.h"

namespace umbrix::frame_tests {
namespace {

std::uint64_t predicted(const FrameStats& stats) {
  const Confusion& c = stats.confusion;
  return c.predicted_occluded[0] + c.predicted_occluded[1] + c.predicted_unoccluded[0] + c.predicted_unoccluded[1];
}

std::uint64_t not_predicted(const FrameStats& stats) {
  return stats.confusion.not_predicted[0] + stats.confusion.not_predicted[1];
}

/// Knows the places of most rays: where as many were occluded as not, nothing is predicted.
bool knows(const FrameStats& stats) { return not_predicted(stats) < stats.rays / 4; }

FrameOptions with_key(PredictorKey key, FrameMethod method = FrameMethod::cached) {
  FrameOptions options;
  options.key = key;
  options.method = method;
  return options;
}

class FrameLife : public testing::Test {
 protected:
  FrameView view(std::int64_t frame) const {
    FrameView v = numbered(frame);
    v.width = v.height = Hall::kWidth;
    v.forward[2] = -2;
    return v;
  }

  /// One frame of the hall's rays to some lights; the answers are always checked.
  FrameStats run(FrameTracer& tracer, const FrameView& seen, std::uint32_t lights = 1, std::uint32_t first_light = 0) {
    EXPECT_TRUE(tracer.begin_frame(seen).ok());
    for (std::uint32_t light = first_light; light < first_light + lights; ++light) {
      Handover how;
      how.light = light;
      how.pixels = hall_.pixels.data();
      EXPECT_EQ(trace(tracer, rays_, how), truth_);
    }
    return tracer.end_frame();
  }

  const Hall hall_;
  const std::vector<Ray> rays_ = hall_.rays();
  const std::vector<std::uint8_t> truth_ = brute(hall_.scene, rays_);
};

TEST_F(FrameLife, FirstFrameKnowsNothing) {
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    FrameTracer tracer;
    for (int start = 0; start < 2; ++start) {
      ASSERT_TRUE(tracer.start(hall_.scene, with_key(key)).ok());
      const FrameStats first = run(tracer, view(5));
      EXPECT_EQ(first.frame, 5);
      EXPECT_TRUE(first.first);
      EXPECT_FALSE(first.cut);
      EXPECT_EQ(predicted(first), 0u);
      EXPECT_EQ(not_predicted(first), rays_.size());
      EXPECT_GT(first.bytes, 0u);
      const FrameStats second = run(tracer, view(6));
      EXPECT_EQ(second.frame, 6);
      EXPECT_FALSE(second.first);
      EXPECT_FALSE(second.cut);
      EXPECT_TRUE(knows(second));
    }
  }
}

/// What changes from a frame to the next, and whether the screen's memory may outlive it.
struct Change {
  const char* name;
  bool is_cut;
  void (*apply)(FrameView& view);
};

constexpr Change kChanges[] = {
    {"nothing", false, [](FrameView&) {}},
    {"a small step", false, [](FrameView& v) { v.eye[0] += 0.05f; }},
    {"a small turn", false, [](FrameView& v) { v.forward[0] += 0.3f; }},
    {"another length of the direction", false, [](FrameView& v) { v.forward[2] *= 9; }},
    {"an unknown direction", false, [](FrameView& v) { v.forward[2] = 0; }},
    {"a jump", true, [](FrameView& v) { v.eye[1] += 0.3f; }},
    {"a turn", true, [](FrameView& v) { v.forward[0] += 2; }},
    {"a turn round", true, [](FrameView& v) { v.forward[2] = 1; }},
    {"a wider image", true, [](FrameView& v) { v.width += 1; }},
    {"a lower image", true, [](FrameView& v) { v.height -= 1; }},
    {"a frame left out", true, [](FrameView& v) { v.frame += 1; }},
    {"the same number again", true, [](FrameView& v) { v.frame -= 1; }},
    {"a step back", true, [](FrameView& v) { v.frame -= 5; }},
};

TEST_F(FrameLife, CutsDropTheMemoryOfTheScreen) {
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    for (const FrameMethod method : {FrameMethod::cached, FrameMethod::paper}) {
      for (const Change& change : kChanges) {
        SCOPED_TRACE(testing::Message() << describe(with_key(key, method)) << ": " << change.name);
        FrameTracer tracer;
        ASSERT_TRUE(tracer.start(hall_.scene, with_key(key, method)).ok());
        run(tracer, view(10));
        FrameView next = view(11);
        change.apply(next);
        const FrameStats stats = run(tracer, next);
        const bool is_cut = change.is_cut && key == PredictorKey::screen;
        EXPECT_EQ(stats.cut, is_cut);
        EXPECT_FALSE(stats.first);
        if (is_cut) {
          EXPECT_EQ(not_predicted(stats), rays_.size());
        } else {
          EXPECT_TRUE(knows(stats));
        }
        // What was seen since the cut is known.
        next.frame += 1;
        EXPECT_TRUE(knows(run(tracer, next)));
      }
    }
  }
}

TEST_F(FrameLife, LightsComeAndGo) {
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    FrameOptions options = with_key(key);
    options.slots = 1u << 18;
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(hall_.scene, options).ok());
    run(tracer, view(0), 2);
    // A place of the new light may share the slot of another's; few do.
    const std::uint64_t ties = not_predicted(run(tracer, view(1), 2));
    const std::uint64_t added = not_predicted(run(tracer, view(2), 3));
    EXPECT_GT(added, ties + rays_.size() * 9 / 10);
    EXPECT_LE(added, ties + rays_.size());
    EXPECT_TRUE(knows(run(tracer, view(3), 1))) << "two removed";
    EXPECT_FALSE(knows(run(tracer, view(4), 3))) << "they come back: only the last frame is remembered";
  }
}

TEST_F(FrameLife, TwoHundredLights) {
  for (const FrameMethod method : {FrameMethod::cached, FrameMethod::paper}) {
    for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
      const std::vector<Ray> rays(rays_.begin(), rays_.begin() + 512);
      const std::vector<std::uint8_t> truth(truth_.begin(), truth_.begin() + 512);
      const auto second_frame = [&](std::uint32_t lights) {
        FrameTracer tracer;
        EXPECT_TRUE(tracer.start(hall_.scene, with_key(key, method)).ok());
        FrameStats stats;
        for (std::int64_t frame = 0; frame < 2; ++frame) {
          EXPECT_TRUE(tracer.begin_frame(view(frame)).ok());
          for (std::uint32_t i = 0; i < lights; ++i) {
            Handover how;
            how.light = i < 100 ? i : 0xFFFFFFFFu - i;
            how.pixels = hall_.pixels.data();
            EXPECT_EQ(trace(tracer, rays, how), truth);
          }
          stats = tracer.end_frame();
          EXPECT_EQ(stats.rays, lights * rays.size());
        }
        return stats;
      };
      // Each is known as well as if it were alone, but for places that come to share a slot: up to 20,000 of 65,536.
      const std::uint64_t alone = not_predicted(second_frame(1));
      EXPECT_LT(alone, rays.size() / 2);
      EXPECT_LT(not_predicted(second_frame(200)), 200 * (alone + rays.size() / 8));
    }
  }
}

TEST_F(FrameLife, ScreenKeyWithoutPixelsPredictsNothing) {
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(hall_.scene, with_key(PredictorKey::screen)).ok());
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(tracer.begin_frame(view(frame)).ok());
    EXPECT_EQ(trace(tracer, rays_), truth_);
    EXPECT_EQ(predicted(tracer.end_frame()), 0u);
  }
}

TEST_F(FrameLife, MisuseIsRefused) {
  FrameTracer tracer;
  EXPECT_EQ(tracer.begin_frame().code(), StatusCode::invalid_argument);
  EXPECT_EQ(tracer.end_frame().rays, 0u);
  EXPECT_EQ(trace(tracer, rays_), std::vector<std::uint8_t>(rays_.size(), 0)) << "without a scene nothing blocks";

  ASSERT_TRUE(tracer.start(hall_.scene).ok());
  EXPECT_EQ(trace(tracer, rays_), truth_) << "before a frame";
  EXPECT_EQ(tracer.end_frame().rays, 0u);
  ASSERT_TRUE(tracer.begin_frame(view(1)).ok());
  EXPECT_EQ(trace(tracer, rays_), truth_);
  EXPECT_EQ(tracer.begin_frame(view(2)).code(), StatusCode::invalid_argument);
  EXPECT_EQ(trace(tracer, rays_), truth_) << "the frame goes on";
  const FrameStats stats = tracer.end_frame();
  EXPECT_EQ(stats.frame, 1);
  EXPECT_EQ(stats.rays, 2 * rays_.size());
  EXPECT_EQ(trace(tracer, rays_), truth_) << "between frames";
  EXPECT_EQ(tracer.end_frame().rays, 0u);

  FrameTracer other = std::move(tracer);
  EXPECT_EQ(tracer.begin_frame().code(), StatusCode::invalid_argument);
  EXPECT_TRUE(other.begin_frame(view(2)).ok());
  EXPECT_EQ(trace(other, rays_), truth_);
  EXPECT_EQ(other.end_frame().rays, rays_.size());
}

TEST_F(FrameLife, BadOptionsAreRefused) {
  constexpr void (*kBad[])(FrameOptions&) = {
      [](FrameOptions& o) { o.slots = 1; },
      [](FrameOptions& o) { o.slots = 1000; },
      [](FrameOptions& o) { o.slots = 1u << 29; },
      [](FrameOptions& o) { o.cell = -1; },
      [](FrameOptions& o) { o.cell = std::numeric_limits<float>::quiet_NaN(); },
      [](FrameOptions& o) { o.region = 0; },
  };
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    for (const auto& spoil : kBad) {
      FrameOptions options = with_key(key);
      spoil(options);
      FrameTracer tracer;
      ASSERT_TRUE(tracer.start(hall_.scene).ok());
      const Status status = tracer.start(hall_.scene, options);
      EXPECT_EQ(status.code(), StatusCode::invalid_argument);
      EXPECT_NE(std::string(status.message()), "");
      EXPECT_EQ(tracer.begin_frame().code(), StatusCode::invalid_argument) << "it is not started any more";
    }
  }
  const Scene uncommitted;
  FrameTracer tracer;
  EXPECT_EQ(tracer.start(uncommitted).code(), StatusCode::invalid_argument);
}

TEST_F(FrameLife, ExtremeOptionsCostTimeOnly) {
  constexpr void (*kExtreme[])(FrameOptions&) = {
      [](FrameOptions& o) { o.slots = 8; },
      [](FrameOptions& o) { o.cell = std::numeric_limits<float>::denorm_min(); },
      [](FrameOptions& o) { o.cell = std::numeric_limits<float>::infinity(); },
      [](FrameOptions& o) { o.region = 1; },
      [](FrameOptions& o) { o.region = 0xFFFFFFFFu; },
  };
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    for (const auto& spoil : kExtreme) {
      for (const PredictorRule rule : {PredictorRule::counter, PredictorRule::sample}) {
        FrameOptions options = with_key(key);
        options.rule = rule;
        spoil(options);
        FrameTracer tracer;
        ASSERT_TRUE(tracer.start(hall_.scene, options).ok());
        for (std::int64_t frame = 0; frame < 3; ++frame) run(tracer, view(frame));
      }
    }
  }
}

TEST_F(FrameLife, SceneWithoutTrianglesBlocksNothing) {
  Scene empty;
  ASSERT_TRUE(empty.commit().ok());
  for (const FrameOptions& options : all_options()) {
    SCOPED_TRACE(describe(options));
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(empty, options).ok());
    for (std::int64_t frame = 0; frame < 3; ++frame) {
      ASSERT_TRUE(tracer.begin_frame(view(frame)).ok());
      Handover how;
      how.pixels = hall_.pixels.data();
      EXPECT_EQ(trace(tracer, rays_, how), std::vector<std::uint8_t>(rays_.size(), 0));
      const FrameStats stats = tracer.end_frame();
      EXPECT_EQ(stats.rays, rays_.size());
      EXPECT_EQ(stats.occluded, 0u);
    }
  }
}

TEST_F(FrameLife, ExecutorThatThrowsIsToldOf) {
  const Executor broken = {
      [](void*, std::size_t, void (*)(void*, std::size_t), void*) { throw std::runtime_error("no"); }, nullptr};
  FrameOptions options;
  options.method = FrameMethod::linked;
  options.links = LinkMode::full;
  options.executor = &broken;
  FrameTracer tracer;
  EXPECT_EQ(tracer.start(hall_.scene, options).code(), StatusCode::internal);
  EXPECT_EQ(tracer.begin_frame().code(), StatusCode::invalid_argument);

  options.method = FrameMethod::indexed;
  FrameOptions good;
  good.method = FrameMethod::linked;
  ASSERT_TRUE(tracer.start(hall_.scene, good).ok()) << "builds the tree, if no one has";
  ASSERT_TRUE(tracer.start(hall_.scene, options).ok());
  run(tracer, view(0));
  EXPECT_EQ(tracer.begin_frame(view(1)).code(), StatusCode::internal);
  EXPECT_EQ(trace(tracer, rays_), truth_) << "answers are right all the same";
}

}  // namespace
}  // namespace umbrix::frame_tests
