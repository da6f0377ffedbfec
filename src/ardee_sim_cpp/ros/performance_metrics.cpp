// SPDX-License-Identifier: MIT
#include "ros/performance_metrics.h"

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr double kLongestSilence_s = 5.0;  // of wall time
constexpr std::uint32_t kQueue = 10;

PerformanceCounter::Moment moment(TimeNs now_ns) {
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {now_ns, std::chrono::duration<double>(wall).count()};
}

double per_second(double count, double duration_s) {
  return duration_s > 0.0 ? count / duration_s : 0.0;
}

}  // namespace

void PerformanceCounter::on_measured(const std::string& name, bool is_camera, const Moment& now) {
  const auto [found, is_new] = sensors_.try_emplace(name);
  Sensor& sensor = found->second;
  if (is_new || now.simulated_ns < sensor.last.simulated_ns) {  // the clock may be set back
    sensor = {is_camera, 0, now, now};
  } else if (now.simulated_ns > sensor.last.simulated_ns) {
    ++sensor.count;
    sensor.last = now;
  }
}

gazebo_msgs::PerformanceMetrics PerformanceCounter::report(const Moment& now) {
  gazebo_msgs::PerformanceMetrics message;
  if (now.simulated_ns >= reported_.simulated_ns) {
    message.real_time_factor = per_second(seconds(now.simulated_ns - reported_.simulated_ns),
                                          now.wall_s - reported_.wall_s);
  }
  reported_ = now;
  for (auto each = sensors_.begin(); each != sensors_.end();) {
    Sensor& sensor = each->second;
    if (now.wall_s - sensor.last.wall_s > kLongestSilence_s) {
      each = sensors_.erase(each);
      continue;
    }
    if (sensor.count > 0) {
      const auto count = static_cast<double>(sensor.count);
      sensor.simulated_hz =
          per_second(count, seconds(sensor.last.simulated_ns - sensor.from.simulated_ns));
      sensor.wall_hz = per_second(count, sensor.last.wall_s - sensor.from.wall_s);
      sensor.from = sensor.last;
      sensor.count = 0;
    }
    if (sensor.simulated_hz > 0.0) {
      gazebo_msgs::SensorPerformanceMetric& told = message.sensors.emplace_back();
      told.name = each->first;
      told.sim_update_rate = sensor.simulated_hz;
      told.real_update_rate = sensor.wall_hz;
      told.fps = sensor.is_camera ? sensor.wall_hz : -1.0;
    }
    ++each;
  }
  return message;
}

PerformanceMetrics::PerformanceMetrics(ros::NodeHandle& private_node)
    : publisher_(
          private_node.advertise<gazebo_msgs::PerformanceMetrics>("performance_metrics", kQueue)) {}

void PerformanceMetrics::on_measured(const std::string& sensor, bool is_camera, TimeNs now_ns) {
  counter_.on_measured(sensor, is_camera, moment(now_ns));
}

void PerformanceMetrics::publish(TimeNs now_ns) {
  gazebo_msgs::PerformanceMetrics message = counter_.report(moment(now_ns));
  if (!has_listeners()) return;
  message.header.stamp = to_ros(now_ns);
  publisher_.publish(message);
}

}  // namespace ardee::node
