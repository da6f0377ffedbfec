// SPDX-License-Identifier: MIT
#pragma once

#include <image_transport/simple_subscriber_plugin.h>
#include <ros/time.h>
#include <sensor_msgs/CompressedImage.h>

#include <string>

namespace compressed_image_transport {

/// Reads `<base topic>/compressed` in the place of an image topic.
class CompressedSubscriber
    : public image_transport::SimpleSubscriberPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void internalCallback(const sensor_msgs::CompressedImage::ConstPtr& message,
                        const Callback& user_callback) override;

 private:
  void complain(const std::string& what);

  ros::WallTime last_complaint_;
};

}  // namespace compressed_image_transport
