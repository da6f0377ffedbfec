// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "ardee_sim/core/state_archive.h"

namespace ardee::devices {

constexpr double kDegree = M_PI / 180.0;  // rad

/// WGS-84: degrees, and metres above the ellipsoid.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
};

/// A level frame on the Earth: x points along `heading`, clockwise from north (90 degrees: x is
/// east and y north).
class LocalFrame {
 public:
  /// kFlat: metres to degrees by the radii of curvature at the origin, as hector_gazebo does; 1 km
  /// off it is within about 0.3 m at middle latitudes. kTangent: the plane that touches the
  /// ellipsoid at the origin, exact.
  enum class Projection { kFlat, kTangent };

  LocalFrame(const GeoPoint& origin, double heading_rad, Projection projection);

  GeoPoint to_geodetic(const Eigen::Vector3d& local_m) const;
  Eigen::Vector3d to_local(const GeoPoint& point) const;
  /// Components of a vector to north, west and up, and to east, north and up.
  Eigen::Vector3d to_nwu(const Eigen::Vector3d& local) const;
  Eigen::Vector3d to_enu(const Eigen::Vector3d& local) const;

  const GeoPoint& origin() const { return origin_; }
  double heading_rad() const { return heading_rad_; }
  Projection projection() const { return projection_; }
  void serialize(StateArchive& state) {
    state(origin_, heading_rad_, projection_, radius_north_m_, radius_east_m_, origin_ecef_m_,
          ecef_from_enu_);
  }

 private:
  Eigen::Vector3d from_enu(const Eigen::Vector3d& enu) const;

  GeoPoint origin_;
  double heading_rad_;
  Projection projection_;
  double radius_north_m_ = 0.0;  // of the meridian
  double radius_east_m_ = 0.0;   // of the circle of latitude
  Eigen::Vector3d origin_ecef_m_;
  Eigen::Matrix3d ecef_from_enu_;
};

/// Earth-centred, Earth-fixed coordinates in m, and back.
Eigen::Vector3d ecef_from_geodetic(const GeoPoint& point);
GeoPoint geodetic_from_ecef(const Eigen::Vector3d& ecef_m);

}  // namespace ardee::devices
