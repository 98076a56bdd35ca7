// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "slam6d/mapping/free_space.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

const Pose3 kStand{.translation_m = {0.0, -1.0, 1.0}};

TEST(FreeSpace3, KnowsAirSurfacesAndWhatIsBehindThem) {
  const RangeImage image(ScanRoom(kStand, 40'000, 0.005, 1));
  // The wall at x = -4 m, seen from the middle of the room.
  EXPECT_EQ(image.At({-2.0, 0.0, 0.0}), RangeImage::Sight::kFree);
  EXPECT_EQ(image.At({-4.0, 0.0, 0.0}), RangeImage::Sight::kSurface);
  EXPECT_EQ(image.At({-6.0, 0.0, 0.0}), RangeImage::Sight::kUnknown);
  EXPECT_EQ(image.At(Eigen::Vector3d::Zero()), RangeImage::Sight::kUnknown);
  EXPECT_EQ(RangeImage(PointCloud{}).At({1.0, 0.0, 0.0}), RangeImage::Sight::kUnknown);
}

TEST(FreeSpace3, ScansOfOneRoomAgreeWhereTheyWereTakenAndNowhereElse) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const Pose3 T_ref_cur{.rotation = RotationFromRollPitchYaw({0.0, 0.0, 0.4}),
                          .translation_m = {0.5, 0.3, 0.0}};
    // What stands in the room hides nothing in its scans: those of a convex room do not.
    const RangeImage ref(ScanRoom(kStand, 20'000, 0.005, 2 * seed));
    const RangeImage cur(ScanRoom(kStand * T_ref_cur, 20'000, 0.005, 2 * seed + 1));
    const RangeImageReference reference{.image = &ref, .T_map_ref = {}};
    const Agreement right = Compare(std::span(&reference, 1), cur, T_ref_cur);
    EXPECT_GT(right.Overlap(), 0.8);
    const Pose3 wrong{.rotation = T_ref_cur.rotation, .translation_m = {-1.5, 0.3, 0.0}};
    EXPECT_GT(Compare(std::span(&reference, 1), cur, wrong).Contradiction(),
              right.Contradiction() + 0.1);
  }
}

TEST(FreeSpace3, NothingIsToldOfScansThatDoNotMeet) {
  const RangeImage image(ScanRoom(kStand, 5000, 0.005, 7));
  const RangeImageReference reference{.image = &image, .T_map_ref = {}};
  const Pose3 far_away{.translation_m = {500.0, 0.0, 0.0}};
  const Agreement agreement = Compare(std::span(&reference, 1), image, far_away);
  EXPECT_EQ(agreement.Contradiction(), 0.0);
  EXPECT_EQ(agreement.Overlap(), 0.0);
}

}  // namespace
}  // namespace slam6d
