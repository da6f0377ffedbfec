// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "gps_rig.h"
#include "rover.h"

namespace ardee {
using namespace physics;
using namespace devices;

/// Returns a plugin of the model; its name is the library's.
inline std::string model_device(const std::string& library, const std::string& keys) {
  return "<gazebo><plugin name='" + library + "' filename='lib" + library + ".so'>" + keys +
         "</plugin></gazebo>";
}

/// Returns a sensor on the mast; its name is the library's.
inline std::string mast_sensor(const std::string& library, const std::string& type,
                               const std::string& block, const std::string& keys) {
  return "<gazebo reference='mast'><sensor name='" + library + "' type='" + type +
         "'><update_rate>20</update_rate>" + block + "<plugin name='" + library +
         "' filename='lib" + library + ".so'>" + keys + "</plugin></sensor></gazebo>";
}

inline std::string noisy_rays() {
  return "<ray><scan><horizontal><samples>9</samples><min_angle>-1</min_angle>"
         "<max_angle>1</max_angle></horizontal><vertical><samples>3</samples>"
         "<min_angle>-0.1</min_angle><max_angle>0.1</max_angle></vertical></scan><range>"
         "<min>0.1</min><max>30</max></range><noise><type>gaussian</type><mean>0</mean>"
         "<stddev>0.02</stddev></noise></ray>";
}

inline std::string noisy_eye(const std::string& name = "eye") {
  return "<camera name='" + name +
         "'><horizontal_fov>1.2</horizontal_fov><image><width>16</width><height>12</height>"
         "<format>R8G8B8</format></image><clip><near>0.05</near><far>50</far></clip><noise>"
         "<type>gaussian</type><mean>0</mean><stddev>0.02</stddev></noise></camera>";
}

inline std::vector<std::string> drive_devices() {
  const std::string wheels =
      "<leftFrontJoint>fl_joint</leftFrontJoint><rightFrontJoint>fr_joint</rightFrontJoint>"
      "<leftRearJoint>rl_joint</leftRearJoint><rightRearJoint>rr_joint</rightRearJoint>"
      "<wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter><torque>10</torque>"
      "<broadcastTF>true</broadcastTF>";
  return {
      model_device("ardee_ros_skid_steer_drive", wheels +
                                                     "<odometryTopic>odom_ardee</odometryTopic>"
                                                     "<odometrySource>encoder</odometrySource>"),
      model_device("gazebo_ros_skid_steer_drive", wheels),
      model_device("gazebo_ros_diff_drive",
                   "<leftJoint>fl_joint</leftJoint><rightJoint>fr_joint</rightJoint>"
                   "<wheelAcceleration>1</wheelAcceleration><odometryTopic>odom_diff"
                   "</odometryTopic><publishWheelTF>true</publishWheelTF>"
                   "<publishWheelJointState>true</publishWheelJointState>"),
      model_device("gazebo_ros_planar_move", "<odometryTopic>odom_planar</odometryTopic>"),
      model_device("ardee_ros_joint_position", "<joint>arm_joint</joint>"),
      model_device("TorsionalSpringPlugin",
                   "<joint_handle>flag_joint</joint_handle><spring_stiffness>0.1"
                   "</spring_stiffness><spring_damping>0.001</spring_damping>"
                   "<referenceTopic>flag</referenceTopic>"),
      model_device("gazebo_ros_control", ""),
      model_device("gazebo_mimic_joint_plugin",
                   "<joint>arm_joint</joint><mimicJoint>flag_joint</mimicJoint>"),
      model_device("roboticsgroup_gazebo_mimic_joint_plugin",
                   "<joint>arm_joint</joint><mimicJoint>flag_joint</mimicJoint>"),
      model_device("gazebo_ros_joint_state_publisher", "<jointName>fl_joint arm_joint</jointName>"),
      model_device("gazebo_ros_tricycle_drive",
                   "<steeringJoint>arm_joint</steeringJoint><actuatedWheelJoint>fl_joint"
                   "</actuatedWheelJoint><encoderWheelLeftJoint>rl_joint</encoderWheelLeftJoint>"
                   "<encoderWheelRightJoint>rr_joint</encoderWheelRightJoint><odometryTopic>"
                   "odom_tricycle</odometryTopic><odometrySource>encoder</odometrySource>"
                   "<publishWheelTF>true</publishWheelTF>"),
      model_device("gazebo_ros_force", "<bodyName>base</bodyName><topicName>push</topicName>"),
      model_device("ardee_ros_encoder", "<joint>rr_joint</joint>"),
      model_device("ardee_ros_battery",
                   "<constantCoef>12</constantCoef><currentPerSpeed>3</currentPerSpeed>"),
  };
}

inline std::vector<std::string> motion_devices() {
  const auto errors = [](const std::string& prefix) {
    const auto key = [&prefix](std::string name, const std::string& value) {
      if (!prefix.empty()) name[0] = static_cast<char>(std::toupper(name[0]));
      return "<" + prefix + name + ">" + value + "</" + prefix + name + ">";
    };
    return key("offset", "0.1 0.2 0.3") + key("drift", "0.2") + key("driftFrequency", "0.1") +
           key("gaussianNoise", "0.05");
  };
  return {
      model_device("gazebo_ros_imu", "<bodyName>mast</bodyName><gaussianNoise>0.1</gaussianNoise>"),
      model_device("gazebo_ros_p3d",
                   "<bodyName>mast</bodyName><topicName>truth</topicName>"
                   "<gaussianNoise>0.1</gaussianNoise>"),
      model_device("hector_gazebo_ros_gps",
                   "<topicName>hector/fix</topicName><velocityTopicName>hector/velocity"
                   "</velocityTopicName>" +
                       errors("") + errors("velocity")),
      model_device("gazebo_ros_gps_with_dropout",
                   "<topicName>gps/fix</topicName><updateRate>20</updateRate>" + errors("") +
                       kBands + plot("1", 0.0, 1.5)),
      model_device("hector_gazebo_ros_imu",
                   "<updateRate>50</updateRate><vibrationStdAccel>1 2 3</vibrationStdAccel>" +
                       errors("accel") + errors("rate") + errors("yaw")),
      model_device("hector_gazebo_ros_magnetic", errors("")),
      mast_sensor("gazebo_ros_imu_sensor", "imu", "",
                  "<frameName>mast</frameName><updateRateHZ>20</updateRateHZ>"
                  "<gaussianNoise>0.1</gaussianNoise>"),
  };
}

inline std::vector<std::string> force_devices() {
  return {
      model_device("gazebo_ros_f3d", "<bodyName>fl</bodyName><topicName>wheel_load</topicName>"),
      model_device("gazebo_ros_ft_sensor",
                   "<jointName>fl_joint</jointName><topicName>axle_load</topicName>"
                   "<gaussianNoise>0.1</gaussianNoise>"),
      mast_sensor("gazebo_ros_bumper", "contact",
                  "<contact><collision>fl_collision</collision></contact>",
                  "<bumperTopicName>wheel_touches</bumperTopicName>"),
  };
}

inline std::vector<std::string> ray_devices() {
  const std::string sonar =
      "<offset>0.1</offset><drift>0.2</drift><gaussianNoise>0.05</gaussianNoise>";
  const auto topic = [](const std::string& name) { return "<topicName>" + name + "</topicName>"; };
  return {
      mast_sensor("gazebo_ros_laser", "ray", noisy_rays(), topic("scan")),
      mast_sensor("gazebo_ros_gpu_laser", "gpu_ray", noisy_rays(), topic("scan_gpu")),
      mast_sensor("gazebo_ros_block_laser", "ray", noisy_rays(), topic("block")),
      mast_sensor("gazebo_ros_range", "ray", noisy_rays(), topic("range")),
      mast_sensor("hector_gazebo_ros_sonar", "ray", noisy_rays(), topic("sonar") + sonar),
      mast_sensor("gazebo_ros_velodyne_laser", "ray", noisy_rays(),
                  topic("points") + "<motionDistortion>true</motionDistortion>"),
      mast_sensor("gazebo_ros_velodyne_gpu_laser", "gpu_ray", noisy_rays(), topic("points_gpu")),
  };
}

inline std::vector<std::string> camera_devices() {
  const auto name = [](const std::string& text) { return "<cameraName>" + text + "</cameraName>"; };
  const std::string two_eyes = noisy_eye("left") + noisy_eye("right");
  return {
      mast_sensor("gazebo_ros_camera", "camera", noisy_eye(),
                  name("plain") + "<segmentation>true</segmentation>"),
      mast_sensor("gazebo_ros_depth_camera", "depth", noisy_eye(), name("depth")),
      mast_sensor("gazebo_ros_openni_kinect", "depth", noisy_eye(),
                  name("kinect") + "<depthNoiseLinear>0.01</depthNoiseLinear>"),
      mast_sensor("gazebo_ros_multicamera", "multicamera", two_eyes, name("two")),
      mast_sensor("gazebo_ros_triggered_camera", "camera", noisy_eye(), name("shutter")),
      mast_sensor("gazebo_ros_triggered_multicamera", "multicamera", two_eyes, name("shutters")),
  };
}

/// Returns one of each known plugin, as elements of a robot.
inline std::vector<std::string> all_devices() {
  std::vector<std::string> all;
  for (const auto& some :
       {drive_devices(), motion_devices(), force_devices(), ray_devices(), camera_devices()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Returns the rover without its own drive, with a mast, a driven arm, a sprung flag and these
/// elements.
inline std::string rover_with(const std::vector<std::string>& devices) {
  const auto light_link = [](const std::string& name, const std::string& joint,
                             const std::string& rest) {
    return "<link name='" + name +
           "'><inertial><mass value='0.1'/><inertia ixx='1e-4' ixy='0' ixz='0' iyy='1e-4' iyz='0' "
           "izz='1e-4'/></inertial></link><joint name='" +
           name + "_joint' type='" + joint + "'><parent link='base'/><child link='" + name +
           "'/><axis xyz='0 0 1'/>" + rest + "</joint>";
  };
  std::string xml = rover();
  const std::size_t drive = xml.find("<gazebo><plugin");
  xml.resize(drive);
  xml += light_link("mast", "fixed", "<origin xyz='0 0 0.3'/>");
  xml += light_link("arm", "revolute",
                    "<limit lower='-1' upper='1' effort='5' velocity='1'/><origin xyz='0 0 0.1'/>");
  xml += light_link("flag", "continuous", "<origin xyz='-0.1 0 0.1'/>");
  xml +=
      "<transmission name='hand'><type>simple</type><joint name='flag_joint'>"
      "<hardwareInterface>EffortJointInterface</hardwareInterface></joint>"
      "<actuator name='hand'/></transmission>";
  for (const std::string& device : devices) xml += device;
  return xml + "</robot>";
}

/// Sends one command to each topic of a robot.
inline void command_all(Entity& robot) {
  for (const auto& device : robot.devices) {
    for (const Input& input : device->ports().all<Input>()) {
      if (input.kind == command_kind<Twist>()) input.on_command(Twist{{0.4, 0, 0}, {0, 0, 0.3}});
      if (input.kind == command_kind<double>()) {
        input.on_command(std::clamp(0.7, input.low, input.high));
      }
      if (input.kind == command_kind<ForceTorque>()) {
        input.on_command(ForceTorque{{2, 1, 0}, {0, 0, 0.1}});
      }
      if (input.kind == command_kind<Trigger>()) input.on_command(Trigger{});
    }
  }
}

}  // namespace ardee
