// SPDX-License-Identifier: MIT
#include "readings.h"

#include <pybind11/stl.h>

#include <array>

#include "arrays.h"

namespace ardee::python {
namespace {

using namespace devices;
using namespace pybind11::literals;
using Owner = std::shared_ptr<const void>;

// In the order of the Reading variant.
constexpr std::array kClasses = {"LidarReading",
                                 "OdometryReading",
                                 "TransformReading",
                                 "JointStateReading",
                                 "ImuReading",
                                 "FixReading",
                                 "VectorReading",
                                 "MagneticFieldReading",
                                 "EncoderReading",
                                 "BatteryReading",
                                 "BatteryStateReading",
                                 "RangeReading",
                                 "PointCloudReading",
                                 "LegacyCloudReading",
                                 "ImageReading",
                                 "CameraInfoReading",
                                 "GpsQualityReading",
                                 "RegionsReading",
                                 "TwistReading",
                                 "JointControllerReading",
                                 "TrajectoryControllerReading",
                                 "FourWheelSteeringReading",
                                 "ContactsReading",
                                 "WrenchReading"};
static_assert(kClasses.size() == std::variant_size_v<Reading>);

py::array_t<double> vector_of(const Eigen::Vector3d& v) {
  return hold(std::vector<double>{v.x(), v.y(), v.z()});
}
py::array_t<double> quaternion_of(const Eigen::Quaterniond& q) {
  return hold(std::vector<double>{q.x(), q.y(), q.z(), q.w()});
}
template <std::size_t kSize>
py::array_t<double> array_of(const std::array<double, kSize>& values) {
  return hold(std::vector<double>(values.begin(), values.end()));
}

void add(py::dict& made, const Pose& pose) {
  made["xyz_m"] = vector_of(pose.p);
  made["quat_xyzw"] = quaternion_of(pose.q);
}
void add(py::dict& made, const Twist& twist) {
  made["v_m_s"] = vector_of(twist.linear);
  made["w_rad_s"] = vector_of(twist.angular);
}

void fields(py::dict& made, const LidarReading& r, const Owner& owner) {
  made["angle_min_rad"] = r.angle_min_rad;
  made["angle_max_rad"] = r.angle_max_rad;
  made["angle_increment_rad"] = r.angle_increment_rad;
  made["time_increment_s"] = r.time_increment_s;
  made["scan_time_s"] = r.scan_time_s;
  made["range_min_m"] = r.range_min_m;
  made["range_max_m"] = r.range_max_m;
  const auto beams = static_cast<py::ssize_t>(r.ranges_m.size());
  made["ranges_m"] = view(r.ranges_m.data(), {beams}, owner);
  made["intensities"] = view(r.intensities.data(), {beams}, owner);
}

void fields(py::dict& made, const OdometryReading& r, const Owner&) {
  made["child_frame_id"] = r.child_frame_id;
  add(made, r.pose);
  add(made, r.twist);
  made["pose_covariance"] = array_of(r.pose_covariance);
  made["twist_covariance"] = array_of(r.twist_covariance);
}

void fields(py::dict& made, const TransformReading& r, const Owner&) {
  made["child_frame_id"] = r.child_frame_id;
  add(made, r.pose);
}

void fields(py::dict& made, const JointStateReading& r, const Owner&) {
  made["names"] = py::tuple(py::cast(r.names));
  made["positions"] = hold(r.positions);
  made["velocities"] = hold(r.velocities);
  made["efforts"] = hold(r.efforts);
}

void fields(py::dict& made, const ImuReading& r, const Owner&) {
  made["quat_xyzw"] = quaternion_of(r.orientation);
  made["w_rad_s"] = vector_of(r.angular_velocity);
  made["a_m_s2"] = vector_of(r.linear_acceleration);
  made["orientation_covariance"] = array_of(r.orientation_covariance);
  made["w_covariance"] = array_of(r.angular_velocity_covariance);
  made["a_covariance"] = array_of(r.linear_acceleration_covariance);
}

void fields(py::dict& made, const FixReading& r, const Owner&) {
  made["status"] = r.status;
  made["service"] = r.service;
  made["latitude_deg"] = r.latitude_deg;
  made["longitude_deg"] = r.longitude_deg;
  made["altitude_m"] = r.altitude_m;
  made["covariance_m2"] = array_of(r.covariance);
}

void fields(py::dict& made, const VectorReading& r, const Owner&) {
  made["vector"] = vector_of(r.vector);
}

void fields(py::dict& made, const MagneticFieldReading& r, const Owner&) {
  made["field_t"] = vector_of(r.field_T);
}

void fields(py::dict& made, const EncoderReading& r, const Owner&) {
  made["id"] = r.id;
  made["position_rad"] = r.position_rad;
  made["speed_m_s"] = r.speed_m_per_s;
  made["pulses_per_s"] = r.pulses_per_s;
}

void fields(py::dict& made, const BatteryReading& r, const Owner&) {
  made["voltage_v"] = r.voltage_V;
  made["voltage_max_v"] = r.voltage_max_V;
  made["voltage_min_v"] = r.voltage_min_V;
}

void fields(py::dict& made, const BatteryStateReading& r, const Owner&) {
  made["voltage_v"] = r.voltage_V;
  made["current_a"] = r.current_A;
  made["charge_a_h"] = r.charge_Ah;
  made["capacity_a_h"] = r.capacity_Ah;
  made["design_capacity_a_h"] = r.design_capacity_Ah;
  made["percentage"] = r.percentage;
  made["location"] = r.location;
}

void fields(py::dict& made, const RangeReading& r, const Owner&) {
  made["radiation"] =
      r.radiation == RangeReading::Radiation::kUltrasound ? "ultrasound" : "infrared";
  made["field_of_view_rad"] = r.field_of_view_rad;
  made["range_min_m"] = r.range_min_m;
  made["range_max_m"] = r.range_max_m;
  made["range_m"] = r.range_m;
}

const char* type_code(PointCloudReading::Type type) {
  switch (type) {
    case PointCloudReading::Type::kUint8:
      return "u1";
    case PointCloudReading::Type::kUint16:
      return "<u2";
    case PointCloudReading::Type::kUint32:
      return "<u4";
    case PointCloudReading::Type::kFloat32:
      return "<f4";
  }
  throw std::logic_error("found a type of point fields without a code");
}

void fields(py::dict& made, const PointCloudReading& r, const Owner& owner) {
  py::list names, formats, offsets;
  for (const PointCloudReading::Field& field : r.fields) {
    names.append(field.name);
    formats.append(type_code(field.type));
    offsets.append(field.offset);
  }
  const py::dict layout("names"_a = names, "formats"_a = formats, "offsets"_a = offsets,
                        "itemsize"_a = r.point_step);
  const auto bytes = static_cast<py::ssize_t>(r.data.size());
  made["height"] = r.height;
  made["width"] = r.width;
  made["points"] = view(r.data.data(), {bytes}, owner).attr("view")(py::dtype::from_args(layout));
  made["is_dense"] = r.is_dense;
}

void fields(py::dict& made, const LegacyCloudReading& r, const Owner& owner) {
  const auto count = static_cast<py::ssize_t>(r.points.size());
  const float* first = r.points.empty() ? nullptr : r.points.front().data();
  made["points_m"] = view(first, {count, 3}, owner);
  made["channel_name"] = r.channel_name;
  made["channel"] = view(r.channel.data(), {static_cast<py::ssize_t>(r.channel.size())}, owner);
}

/// Type code and channels of an encoding of sensor_msgs/image_encodings.
std::pair<const char*, int> layout_of(const std::string& encoding) {
  if (encoding == "rgb8" || encoding == "bgr8") return {"u1", 3};
  if (encoding == "32FC1") return {"<f4", 1};
  if (encoding == "32SC1") return {"<i4", 1};
  if (encoding == "16UC1" || encoding == "mono16") return {"<u2", 1};
  return {"u1", 1};  // mono8, Bayer patterns
}

void fields(py::dict& made, const ImageReading& r, const Owner& owner) {
  const auto [code, channels] = layout_of(r.encoding);
  py::array pixels =
      view(r.data.data(), {static_cast<py::ssize_t>(r.data.size())}, owner).attr("view")(code);
  const auto height = static_cast<py::ssize_t>(r.height), width = static_cast<py::ssize_t>(r.width);
  made["encoding"] = r.encoding;
  made["pixels"] = channels == 1 ? pixels.attr("reshape")(height, width)
                                 : pixels.attr("reshape")(height, width, channels);
}

void fields(py::dict& made, const CameraInfoReading& r, const Owner&) {
  made["height_px"] = r.height;
  made["width_px"] = r.width;
  made["distortion"] = array_of(r.D);
  made["camera_matrix"] = array_of(r.K).attr("reshape")(3, 3);
  made["rectification"] = array_of(r.R).attr("reshape")(3, 3);
  made["projection"] = array_of(r.P).attr("reshape")(3, 4);
}

void fields(py::dict& made, const GpsQualityReading& r, const Owner&) {
  made["region"] = r.region;
  made["position_std_m"] = r.position_std_m;
  made["has_fix"] = r.has_fix;
  made["error_m"] = vector_of(r.error_m);
}

void fields(py::dict& made, const RegionsReading& r, const Owner&) {
  py::list regions;
  for (const RegionsReading::Region& region : r.regions) {
    py::dict each("name"_a = region.name, "size_m"_a = vector_of(region.size_m));
    add(each, region.pose);
    each["rgba"] = hold(std::vector<float>(region.rgba.begin(), region.rgba.end()));
    regions.append(each);
  }
  made["regions"] = py::tuple(regions);
}

void fields(py::dict& made, const TwistReading& r, const Owner&) { add(made, r.twist); }

void fields(py::dict& made, const JointControllerReading& r, const Owner&) {
  made["set_point"] = r.set_point;
  made["process_value"] = r.process_value;
  made["process_value_dot"] = r.process_value_dot;
  made["error"] = r.error;
  made["time_step_s"] = r.time_step_s;
  made["command"] = r.command;
  made["p"] = r.p;
  made["i"] = r.i;
  made["d"] = r.d;
  made["i_clamp"] = r.i_clamp;
  made["antiwindup"] = r.antiwindup;
}

py::dict point_of(const JointTrajectoryPoint& point) {
  return py::dict("positions"_a = hold(point.positions), "velocities"_a = hold(point.velocities),
                  "accelerations"_a = hold(point.accelerations), "efforts"_a = hold(point.efforts),
                  "time_from_start_s"_a = point.time_from_start_s);
}

void fields(py::dict& made, const TrajectoryControllerReading& r, const Owner&) {
  made["names"] = py::tuple(py::cast(r.names));
  made["desired"] = point_of(r.desired);
  made["actual"] = point_of(r.actual);
  made["error"] = point_of(r.error);
}

void fields(py::dict& made, const FourWheelSteeringReading& r, const Owner&) {
  made["front_angle_rad"] = r.front_angle_rad;
  made["rear_angle_rad"] = r.rear_angle_rad;
  made["front_rate_rad_s"] = r.front_rate_rad_per_s;
  made["rear_rate_rad_s"] = r.rear_rate_rad_per_s;
  made["speed_m_s"] = r.speed_m_per_s;
  made["acceleration_m_s2"] = r.acceleration_m_per_s2;
  made["jerk_m_s3"] = r.jerk_m_per_s3;
}

void fields(py::dict& made, const ContactsReading& r, const Owner&) {
  py::list touches;
  for (const ContactsReading::Touch& touch : r.touches) {
    py::list points;
    for (const physics::Contact& point : touch.points) points.append(contact_fields(point));
    touches.append(py::dict("time_ns"_a = touch.time_ns, "collision1"_a = touch.collision1,
                            "collision2"_a = touch.collision2, "points"_a = py::tuple(points)));
  }
  made["touches"] = py::tuple(touches);
}

void fields(py::dict& made, const WrenchReading& r, const Owner&) {
  made["force_n"] = vector_of(r.wrench.force);
  made["torque_n_m"] = vector_of(r.wrench.torque);
}

}  // namespace

const char* reading_class(std::size_t kind) { return kClasses.at(kind); }

py::dict contact_fields(const physics::Contact& contact) {
  return py::dict("collision1"_a = contact.collision1, "collision2"_a = contact.collision2,
                  "xyz_m"_a = vector_of(contact.position), "normal"_a = vector_of(contact.normal),
                  "depth_m"_a = contact.depth_m, "force_n"_a = vector_of(contact.on1.force));
}

py::dict reading_fields(const std::shared_ptr<const Reading>& reading) {
  const auto fields_of = [&](const auto& each) {
    py::dict made("stamp_ns"_a = each.header.stamp_ns, "frame_id"_a = each.header.frame_id);
    fields(made, each, reading);
    return made;
  };
  return std::visit(fields_of, *reading);
}

}  // namespace ardee::python
