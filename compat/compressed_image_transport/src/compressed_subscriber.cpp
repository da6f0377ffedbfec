// SPDX-License-Identifier: MIT
#include "compressed_subscriber.h"

#include <ros/console.h>

#include <boost/make_shared.hpp>

#include "codec.h"

namespace compressed_image_transport {
namespace {

constexpr double kComplaintPeriod_s = 10.0;

}  // namespace

/// At once, and then not again for a while: damaged images come many a second.
void CompressedSubscriber::complain(const std::string& what) {
  const ros::WallTime now = ros::WallTime::now();
  if (!last_complaint_.isZero() && (now - last_complaint_).toSec() < kComplaintPeriod_s) return;
  last_complaint_ = now;
  ROS_ERROR_STREAM(getTopic() << ": " << what);
}

void CompressedSubscriber::internalCallback(const sensor_msgs::CompressedImage::ConstPtr& message,
                                            const Callback& user_callback) {
  sensor_msgs::ImagePtr image;
  try {
    image = boost::make_shared<sensor_msgs::Image>(decompress(*message));
  } catch (const CodecError& error) {
    complain(error.what());
    return;
  }
  user_callback(image);
}

}  // namespace compressed_image_transport
