// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/geodesy.h"

#include <cmath>

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

// WGS-84: NIMA TR8350.2, third edition.
constexpr double kEquator_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

/// Radius of curvature across the meridian.
double prime_vertical_m(double latitude_rad) {
  const double sine = std::sin(latitude_rad);
  return kEquator_m / std::sqrt(1.0 - kEccentricity2 * sine * sine);
}

double wrapped_deg(double longitude_deg) { return std::remainder(longitude_deg, 360.0); }

/// Columns: east, north, up at a place, in Earth-centred axes.
Eigen::Matrix3d enu_axes(double latitude_rad, double longitude_rad) {
  const double sin_lat = std::sin(latitude_rad), cos_lat = std::cos(latitude_rad);
  const double sin_lon = std::sin(longitude_rad), cos_lon = std::cos(longitude_rad);
  Eigen::Matrix3d axes;
  axes << -sin_lon, -sin_lat * cos_lon, cos_lat * cos_lon,  //
      cos_lon, -sin_lat * sin_lon, cos_lat * sin_lon,       //
      0.0, cos_lat, sin_lat;
  return axes;
}

}  // namespace

Vector3d ecef_from_geodetic(const GeoPoint& point) {
  const double latitude = point.latitude_deg * kDegree, longitude = point.longitude_deg * kDegree;
  const double normal = prime_vertical_m(latitude);
  const double out = (normal + point.altitude_m) * std::cos(latitude);
  return {out * std::cos(longitude), out * std::sin(longitude),
          (normal * (1.0 - kEccentricity2) + point.altitude_m) * std::sin(latitude)};
}

GeoPoint geodetic_from_ecef(const Vector3d& ecef_m) {
  const double out = std::hypot(ecef_m.x(), ecef_m.y());
  // A fixed point of the latitude's own equation; each turn gains a factor of the eccentricity
  // squared (1/150), near the surface.
  constexpr int kTurns = 8;
  double latitude = std::atan2(ecef_m.z(), out * (1.0 - kEccentricity2));
  for (int i = 0; i < kTurns; ++i) {
    const double sine = std::sin(latitude);
    latitude = std::atan2(ecef_m.z() + kEccentricity2 * prime_vertical_m(latitude) * sine, out);
  }
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  // Along the normal: right at the poles and at the equator.
  const double altitude =
      out * cosine + ecef_m.z() * sine - kEquator_m * std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return {latitude / kDegree, std::atan2(ecef_m.y(), ecef_m.x()) / kDegree, altitude};
}

LocalFrame::LocalFrame(const GeoPoint& origin, double heading_rad, Projection projection)
    : origin_(origin), heading_rad_(heading_rad), projection_(projection) {
  const double latitude = origin.latitude_deg * kDegree;
  const double normal = prime_vertical_m(latitude);
  const double ratio = normal / kEquator_m;
  radius_north_m_ = normal * (1.0 - kEccentricity2) * ratio * ratio;
  radius_east_m_ = normal * std::cos(latitude);
  origin_ecef_m_ = ecef_from_geodetic(origin);
  ecef_from_enu_ = enu_axes(latitude, origin.longitude_deg * kDegree);
}

Vector3d LocalFrame::to_nwu(const Vector3d& local) const {
  const double sine = std::sin(heading_rad_), cosine = std::cos(heading_rad_);
  return {cosine * local.x() + sine * local.y(), -sine * local.x() + cosine * local.y(), local.z()};
}

Vector3d LocalFrame::to_enu(const Vector3d& local) const {
  const Vector3d nwu = to_nwu(local);
  return {-nwu.y(), nwu.x(), nwu.z()};
}

Vector3d LocalFrame::from_enu(const Vector3d& enu) const {
  const double sine = std::sin(heading_rad_), cosine = std::cos(heading_rad_);
  return {cosine * enu.y() + sine * enu.x(), sine * enu.y() - cosine * enu.x(), enu.z()};
}

GeoPoint LocalFrame::to_geodetic(const Vector3d& local_m) const {
  const Vector3d enu = to_enu(local_m);
  if (projection_ == Projection::kTangent) {
    return geodetic_from_ecef(origin_ecef_m_ + ecef_from_enu_ * enu);
  }
  return {origin_.latitude_deg + enu.y() / radius_north_m_ / kDegree,
          wrapped_deg(origin_.longitude_deg + enu.x() / radius_east_m_ / kDegree),
          origin_.altitude_m + enu.z()};
}

Vector3d LocalFrame::to_local(const GeoPoint& point) const {
  if (projection_ == Projection::kTangent) {
    return from_enu(ecef_from_enu_.transpose() * (ecef_from_geodetic(point) - origin_ecef_m_));
  }
  const double east_deg = wrapped_deg(point.longitude_deg - origin_.longitude_deg);
  return from_enu({east_deg * kDegree * radius_east_m_,
                   (point.latitude_deg - origin_.latitude_deg) * kDegree * radius_north_m_,
                   point.altitude_m - origin_.altitude_m});
}

}  // namespace ardee::devices
