// SPDX-License-Identifier: Apache-2.0
//
// What the proof in bench/cases/closed_meshes.cpp needs: that rays from inside a closed mesh are occluded is not asked
// of any oracle.
#include "cases/closed_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrix::cases {
namespace {

TEST(ClosedMeshes, AreClosedAndWindOnceRoundTheirInside) {
  for (const ClosedMeshKind& kind : closed_mesh_kinds(1)) {
    SCOPED_TRACE(kind.name);
    Random random(5);
    const ClosedMesh mesh = kind.make(random);
    EXPECT_TRUE(is_closed(mesh.triangles));
    EXPECT_NEAR(std::abs(winding_number(mesh.triangles, mesh.inside)), 1, 1e-6);
    EXPECT_GT(clearance(mesh.triangles, mesh.inside), 0);
    Triangles open = mesh.triangles;
    open.pop_back();
    EXPECT_FALSE(is_closed(open));
  }
}

TEST(ClosedMeshes, RaysStartInsideAndEndOutside) {
  for (const ClosedMeshKind& kind : closed_mesh_kinds(1e-4)) {
    SCOPED_TRACE(kind.name);
    for (const Aim aim : {Aim::interior, Aim::vertex, Aim::edge}) {
      const CaseData data = from_inside(kind, aim, 6, 200);
      Random random(6);
      const ClosedMesh mesh = kind.make(random);
      for (const Ray& ray : data.rays) {
        const Float3 origin = {ray.origin[0], ray.origin[1], ray.origin[2]};
        const Float3 away = subtract(origin, mesh.inside);
        ASSERT_LT(std::hypot(away[0], away[1], away[2]), clearance(mesh.triangles, mesh.inside));
        if (std::isinf(ray.tmax)) continue;
        const Float3 d = {ray.direction[0], ray.direction[1], ray.direction[2]};
        ASSERT_NEAR(winding_number(mesh.triangles, add(origin, scale(d, ray.tmax))), 0, 1e-6);
      }
    }
  }
}

TEST(ClosedMeshes, SolidAnglesTellInsideFromOutside) {
  Random random(7);
  const Triangles ball = icosphere(1, 1, 0, {0, 0, 0}, random).triangles;
  EXPECT_NEAR(std::abs(winding_number(ball, {0.5f, 0.2f, 0})), 1, 1e-9);
  EXPECT_NEAR(winding_number(ball, {1.5f, 0.2f, 0}), 0, 1e-9);
}

}  // namespace
}  // namespace umbrix::cases
