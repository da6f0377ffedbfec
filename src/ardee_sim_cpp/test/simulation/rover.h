// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

namespace ardee {

constexpr double kRoverRadius_m = 0.1;
constexpr double kRoverSeparation_m = 0.4;

/// Returns a box of 6 kg on four driven wheels; `keys` goes into the skid-steer block, `more` into
/// the robot.
inline std::string rover(const std::string& keys = "", const std::string& more = "") {
  std::string xml =
      "<robot name='rover'><link name='base'><inertial><mass value='4'/><origin xyz='0 0 0'/>"
      "<inertia ixx='0.05' ixy='0' ixz='0' iyy='0.08' iyz='0' izz='0.1'/></inertial></link>";
  for (const auto& [name, xyz] :
       {std::make_pair("fl", "0.15 0.2 -0.05"), std::make_pair("fr", "0.15 -0.2 -0.05"),
        std::make_pair("rl", "-0.15 0.2 -0.05"), std::make_pair("rr", "-0.15 -0.2 -0.05")}) {
    const std::string wheel = name;
    xml += "<link name='" + wheel +
           "'><inertial><mass value='0.5'/>"
           "<inertia ixx='0.0015' ixy='0' ixz='0' iyy='0.0025' iyz='0' izz='0.0015'/></inertial>"
           "<collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.1' "
           "length='0.04'/>"
           "</geometry></collision></link><joint name='" +
           wheel +
           "_joint' type='continuous'>"
           "<parent link='base'/><child link='" +
           wheel + "'/><origin xyz='" + xyz +
           "'/>"
           "<axis xyz='0 1 0'/></joint><gazebo reference='" +
           wheel +
           "'><mu1>1</mu1><mu2>1</mu2>"
           "<kp>1e6</kp><kd>100</kd></gazebo>";
  }
  return xml +
         "<gazebo><plugin name='drive' filename='libgazebo_ros_skid_steer_drive.so'>"
         "<leftFrontJoint>fl_joint</leftFrontJoint><rightFrontJoint>fr_joint</rightFrontJoint>"
         "<leftRearJoint>rl_joint</leftRearJoint><rightRearJoint>rr_joint</rightRearJoint>"
         "<wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter><torque>10</"
         "torque>"
         "<updateRate>50</updateRate><robotBaseFrame>base</robotBaseFrame>" +
         keys + "</plugin></gazebo>" + more + "</robot>";
}

}  // namespace ardee
