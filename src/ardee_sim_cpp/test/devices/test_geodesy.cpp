// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "ardee_sim/devices/geodesy.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr auto kFlat = LocalFrame::Projection::kFlat;
constexpr auto kTangent = LocalFrame::Projection::kTangent;

TEST(LocalFrame, there_and_back_is_exact_to_a_millimetre_over_a_kilometre) {
  for (const auto projection : {kFlat, kTangent}) {
    for (const double heading_deg : {0.0, 90.0, 217.0}) {
      for (const GeoPoint& origin : {GeoPoint{40.1021496545, -88.2267974168, -32.6},
                                     GeoPoint{-33.9, 179.999, 500.0}, GeoPoint{78.2, 15.6, 0.0}}) {
        const LocalFrame frame(origin, heading_deg * kDegree, projection);
        for (const Vector3d& point : {Vector3d(1000, 0, 0), Vector3d(0, -1000, 5),
                                      Vector3d(-700, 700, -3), Vector3d(0, 0, 0)}) {
          const GeoPoint geodetic = frame.to_geodetic(point);
          EXPECT_LE(std::abs(geodetic.longitude_deg), 180.0);
          EXPECT_LE((frame.to_local(geodetic) - point).norm(), 1e-3);
        }
      }
    }
  }
}

TEST(LocalFrame, tangent_is_the_earth_centred_frame_turned_and_moved) {
  const GeoPoint origin{40.1021496545, -88.2267974168, 220.0};
  const LocalFrame frame(origin, 90.0 * kDegree, kTangent);
  // The point's Earth-centred coordinates follow from the east, north and up vectors.
  const double lat = origin.latitude_deg * kDegree, lon = origin.longitude_deg * kDegree;
  const Vector3d east(-std::sin(lon), std::cos(lon), 0);
  const Vector3d up(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  const Vector3d north = up.cross(east);
  const Vector3d expected = ecef_from_geodetic(origin) + 600 * east + 800 * north - 10 * up;
  const Vector3d found = ecef_from_geodetic(frame.to_geodetic({600, 800, -10}));
  EXPECT_LE((found - expected).norm(), 1e-6);
}

TEST(LocalFrame, ellipsoid_has_its_axes) {
  EXPECT_LE((ecef_from_geodetic({0, 0, 0}) - Vector3d(6378137.0, 0, 0)).norm(), 1e-6);
  EXPECT_LE((ecef_from_geodetic({0, 90, 10}) - Vector3d(0, 6378147.0, 0)).norm(), 1e-6);
  EXPECT_NEAR(ecef_from_geodetic({90, 0, 0}).z(), 6356752.3142, 1e-3);  // TR8350.2: b
  const GeoPoint pole = geodetic_from_ecef({0, 0, 6356752.3142 + 7.0});
  EXPECT_NEAR(pole.latitude_deg, 90.0, 1e-9);
  EXPECT_NEAR(pole.altitude_m, 7.0, 1e-3);
}

TEST(LocalFrame, flat_is_hectors_formula_and_near_the_tangent_one) {
  const double latitude_deg = 49.9, latitude = latitude_deg * kDegree;
  const LocalFrame flat({latitude_deg, 8.9, 0}, 0.0, kFlat);
  const double e2 = 2.0 / 298.257223563 - 1.0 / (298.257223563 * 298.257223563);
  const double temp = 1.0 / (1.0 - e2 * std::sin(latitude) * std::sin(latitude));
  const double prime = 6378137.0 * std::sqrt(temp);
  const GeoPoint point = flat.to_geodetic({300, -400, 2});
  EXPECT_NEAR(point.latitude_deg, 49.9 + 300 / (prime * (1 - e2) * temp) / kDegree, 1e-13);
  EXPECT_NEAR(point.longitude_deg, 8.9 + 400 / (prime * std::cos(latitude)) / kDegree, 1e-13);
  EXPECT_EQ(point.altitude_m, 2.0);
  const LocalFrame tangent({latitude_deg, 8.9, 0}, 0.0, kTangent);
  const Vector3d seen = tangent.to_local(flat.to_geodetic({700, -700, 0}));
  EXPECT_LE((seen - Vector3d(700, -700, 0)).norm(), 0.3);
  EXPECT_GE((seen - Vector3d(700, -700, 0)).norm(), 0.01);  // they differ
}

TEST(LocalFrame, heading_turns_x_from_north_clockwise) {
  const GeoPoint origin{40.1, -88.2, 0};
  const Vector3d x(1, 0, 0), y(0, 1, 0);
  const LocalFrame north(origin, 0.0, kFlat), east(origin, 90.0 * kDegree, kFlat);
  EXPECT_TRUE(north.to_nwu(x).isApprox(Vector3d(1, 0, 0)));
  EXPECT_TRUE(north.to_nwu(y).isApprox(Vector3d(0, 1, 0)));  // west
  EXPECT_TRUE(east.to_nwu(x).isApprox(Vector3d(0, -1, 0)));  // east
  EXPECT_TRUE(east.to_nwu(y).isApprox(Vector3d(1, 0, 0)));   // north
  EXPECT_TRUE(east.to_enu(x + 2 * y).isApprox(Vector3d(1, 2, 0)));
  EXPECT_GT(east.to_geodetic(100 * x).longitude_deg, origin.longitude_deg);
  EXPECT_GT(north.to_geodetic(100 * x).latitude_deg, origin.latitude_deg);
}

}  // namespace
}  // namespace ardee
