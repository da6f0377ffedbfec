#pragma once

/** SECTION:
    BASIC DATA
*/
typedef struct XYZ_INT {
  int32_t x;
  int32_t y;
  int32_t z;
} XYZ_BASE_INT;

typedef struct ORIENTATION_QUATERNION_BASE_INT {
  int32_t x;
  int32_t y;
  int32_t z;
  int32_t w;
} ORIENTATION_QUATERNION_BASE_INT;

typedef struct ORIENTATION_EULER_BASE_INT {
  int32_t roll;
  int32_t pitch;
  int32_t yaw;
} ORIENTATION_EULER_BASE_INT;

/** SECTION:
    INTERMEDIATE DATA
*/
typedef struct MOTION_DATA_INT {
  int32_t x;
  int32_t y;
  int32_t z;
  XYZ_INT covariance;
  XYZ_INT bias;
  XYZ_INT offset;
} XYZ_DATA_INT;

typedef struct Ardee_Msg_Ack {
  int32_t sequence;
} Ardee_Msg_Ack;

typedef struct Ardee_Msg_OrientationData {
  int32_t x;
  int32_t y;
  int32_t z;
  int32_t w;
  ORIENTATION_EULER_BASE_INT covariance;
  ORIENTATION_QUATERNION_BASE_INT bias;
} Ardee_Msg_OrientationData;

/** SECTION:
    SENSOR DATA TYPES
*/
typedef struct Ardee_Msg_IMUData {
  MOTION_DATA_INT accel;
  MOTION_DATA_INT gyro;
  Ardee_Msg_OrientationData orientation;
} Ardee_Msg_IMUData;

typedef struct Ardee_Msg_GPSData {
  int32_t time;
  int32_t latitude;
  int32_t longitude;
  int32_t altitude;
  XYZ_INT velocity;
  XYZ_INT covariance;
  uint8_t covariance_type;
  uint16_t service;
  int8_t status;
} Ardee_Msg_GPSData;

typedef struct Ardee_Msg_GyroData {
  int32_t x;
  int32_t y;
  int32_t z;
} Ardee_Msg_GyroData;

typedef struct Ardee_Msg_AccelerationData {
  int32_t x;
  int32_t y;
  int32_t z;
} Ardee_Msg_AccelerationData;

typedef struct Ardee_Msg_MotionCommands {
  int32_t normalized_speed;
  int32_t normalized_yaw_rate;
  int32_t multiplier;
} Ardee_Msg_MotionCommands;

typedef struct Ardee_Msg_LidarData {
  int32_t angle_min;
  int32_t angle_max;
  int32_t dAngle;
  int32_t scan_time;
  int32_t dTime;
  int32_t range_min;
  int32_t range_max;
  int32_t ranges[1081];
  int32_t intensities[1081];
} Ardee_Msg_LidarData;

typedef struct Ardee_Msg_EncoderData {
  int32_t id;
  int32_t position;
  int32_t speed;
  int32_t qpps;
} Ardee_Msg_EncoderData;

typedef struct Ardee_Msg_BatteryData {
  int32_t voltage;
  int32_t vmax;
  int32_t vmin;
} Ardee_Msg_BatteryData;
