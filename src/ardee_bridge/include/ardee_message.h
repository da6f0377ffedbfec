/* SPDX-License-Identifier: MIT */
/* ARDEE messages over UDP, for C11 and C++17. A message is two datagrams: an Ardee_Msg_Data_Header,
 * then its data. All numbers are little-endian. docs/wire_format.md says what the fields mean and
 * which header goes with which data. */
#pragma once

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "these structs are the wire format only on little-endian machines"
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef void ArdeeMessage;

typedef struct Ardee_Msg_Data_Header {
  union {
    int32_t component_id;
    int32_t header;
  };
  int32_t msg_type;
  int32_t data_type;
  int32_t measurement_type;
  int32_t measurement_length;
} Ardee_Msg_Data_Header;

/* 9 is two messages: told apart by the data type. From 16 on: extensions. */
typedef enum ArdeeMessageType {
  ARDEE_MESSAGE_SET_PORT = 0,
  ARDEE_MESSAGE_CONTROL = 1,
  ARDEE_MESSAGE_DATA_GPS = 2,
  ARDEE_MESSAGE_DATA_GYRO = 3,
  ARDEE_MESSAGE_DATA_ACCELERATION = 4,
  ARDEE_MESSAGE_DATA_RCCOMMANDS = 5,
  ARDEE_MESSAGE_DATA_LIDAR = 6,
  ARDEE_MESSAGE_DATA_ORIENTATION = 7,
  ARDEE_MESSAGE_DATA_ENCODER = 8,
  ARDEE_MESSAGE_DATA_FRONT_CAM = 9,
  ARDEE_MESSAGE_DATA_IMU = 9,
  ARDEE_MESSAGE_DATA_BATTERY = 10,
  ARDEE_MESSAGE_DATA_TIME = 16,
  ARDEE_MESSAGE_DATA_IMAGE = 17,
  ARDEE_MESSAGE_DATA_POINT_CLOUD = 18,
  ARDEE_MESSAGE_ACK = 19,
} ArdeeMessageType;

typedef enum ArdeeDataType {
  ARDEE_DATA_NONE = 0,
  ARDEE_DATA_ALL = 1,
  ARDEE_DATA_GPS = 2,
  ARDEE_DATA_GYRO = 3,
  ARDEE_DATA_ACCELERATION = 4,
  ARDEE_DATA_LIDAR = 5,
  ARDEE_DATA_ORIENTATION = 6,
  ARDEE_DATA_ENCODER = 7,
  ARDEE_DATA_FRONT_CAM = 8,
  ARDEE_DATA_IMU = 9,
  ARDEE_DATA_BATTERY = 10,
  num_ArdeeDataTypes = 11,
  ARDEE_DATA_TIME = 16,
  ARDEE_DATA_IMAGE = 17,
  ARDEE_DATA_POINT_CLOUD = 18,
} ArdeeDataType;

typedef enum ArdeeMeasurementType {
  ARDEE_MEASUREMENT_SINGLE = 0,
  ARDEE_MEASUREMENT_MULTIPLE = 1,
} ArdeeMeasurementType;

typedef enum ArdeeControlCode {
  ARDEE_CONTROL_STOP = 0,
  ARDEE_CONTROL_START = 1,
  ARDEE_CONTROL_PAUSE = 2,
  ARDEE_CONTROL_RESUME = 3,
} ArdeeControlCode;

/* Basic data */

typedef struct XYZ_INT {
  int32_t x;
  int32_t y;
  int32_t z;
} XYZ_BASE_INT;
typedef struct XYZ_INT XYZ_INT;

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

/* Intermediate data */

typedef struct MOTION_DATA_INT {
  int32_t x;
  int32_t y;
  int32_t z;
  XYZ_INT covariance;
  XYZ_INT bias;
  XYZ_INT offset;
} XYZ_DATA_INT;
typedef struct MOTION_DATA_INT MOTION_DATA_INT;

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

/* Sensor data */

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

#define ARDEE_LIDAR_SLOTS 1081
#define ARDEE_RANGE_TOO_FAR (-1000)
#define ARDEE_RANGE_TOO_NEAR (-2000)

typedef struct Ardee_Msg_LidarData {
  int32_t angle_min;
  int32_t angle_max;
  int32_t dAngle;
  int32_t scan_time;
  int32_t dTime;
  int32_t range_min;
  int32_t range_max;
  int32_t ranges[ARDEE_LIDAR_SLOTS];
  int32_t intensities[ARDEE_LIDAR_SLOTS];
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

/* Extensions */

/* Data of a CONTROL message: an ArdeeControlCode. */
typedef struct Ardee_Ext_Control {
  int32_t code;
} Ardee_Ext_Control;

#define ARDEE_ALL_COMPONENTS (-1)

/* Data of a SET_PORT message. data_types is a sum of 1 << ArdeeDataType. */
typedef struct Ardee_Ext_SetPort {
  int32_t port;
  int32_t data_types;
  int32_t component_id;
} Ardee_Ext_SetPort;

/* Simulated time of the message that follows, and which that is. */
typedef struct Ardee_Ext_Time {
  int32_t sec;
  int32_t nsec;
  int32_t data_type;
  int32_t component_id;
} Ardee_Ext_Time;

/* Place of a datagram's payload in an image or cloud of `total` bytes. */
typedef struct Ardee_Ext_Chunk {
  int32_t sec;
  int32_t nsec;
  int32_t sequence;
  int32_t index;
  int32_t count;
  int32_t offset;
  int32_t total;
} Ardee_Ext_Chunk;

typedef enum ArdeeImageEncoding {
  ARDEE_IMAGE_JPEG = 0,
  ARDEE_IMAGE_MONO8 = 1,
  ARDEE_IMAGE_RGB8 = 2,
  ARDEE_IMAGE_BGR8 = 3,
  ARDEE_IMAGE_DEPTH_16U_MM = 4,
  ARDEE_IMAGE_DEPTH_32F_M = 5,
} ArdeeImageEncoding;

/* Before the payload of an image's datagram: header.measurement_length bytes of pixels. */
typedef struct Ardee_Ext_ImageChunk {
  Ardee_Ext_Chunk chunk;
  int32_t encoding;
  int32_t width;
  int32_t height;
  int32_t step;
} Ardee_Ext_ImageChunk;

/* Before the payload of a cloud's datagram: header.measurement_length bytes of Ardee_Ext_Point. */
typedef struct Ardee_Ext_PointCloudChunk {
  Ardee_Ext_Chunk chunk;
} Ardee_Ext_PointCloudChunk;

typedef struct Ardee_Ext_Point {
  int32_t x;
  int32_t y;
  int32_t z;
  int32_t intensity;
} Ardee_Ext_Point;

/* An int32 field of this value has no value. */
#define ARDEE_NO_VALUE INT32_MIN

#define ARDEE_MOTION_MULTIPLIER 1000000

/* Rounds a share of a limit, cut to -1...1, to whole millionths. */
static inline int32_t ardee_to_millionths_(double share) {
  const double cut = share < -1.0 ? -1.0 : share > 1.0 ? 1.0 : share;
  return (int32_t)(cut * ARDEE_MOTION_MULTIPLIER + (cut < 0.0 ? -0.5 : 0.5));
}

/* Fills in a motion command: speed and yaw rate as shares of the robot's limits, cut to -1...1.
 * Returns 1; returns 0 and leaves both structs as they are where a share is NaN or infinite. */
static inline int ardee_encode_motion(double speed, double yaw_rate, Ardee_Msg_Data_Header *header,
                                      Ardee_Msg_MotionCommands *commands) {
  const Ardee_Msg_Data_Header motion = {
      {0}, ARDEE_MESSAGE_DATA_RCCOMMANDS, ARDEE_DATA_NONE, ARDEE_MEASUREMENT_SINGLE, 1};
  if (!(speed - speed == 0.0 && yaw_rate - yaw_rate == 0.0)) return 0;
  *header = motion;
  commands->normalized_speed = ardee_to_millionths_(speed);
  commands->normalized_yaw_rate = ardee_to_millionths_(yaw_rate);
  commands->multiplier = ARDEE_MOTION_MULTIPLIER;
  return 1;
}

#define ARDEE_SIZE_(type, bytes) static_assert(sizeof(type) == (bytes), "size of " #type)
#define ARDEE_AT_(type, member, byte) \
  static_assert(offsetof(type, member) == (byte), "place of " #type "." #member)

/* clang-format off */
/* begin generated: rosrun ardee_bridge generate_wire_files */
/* Integer on the wire / scale = physical value */
#define ARDEE_SCALE_IMU_ACCEL 1000000 /* per m/s² */
#define ARDEE_SCALE_IMU_ACCEL_COVARIANCE 1000000 /* per (m/s²)² */
#define ARDEE_SCALE_IMU_GYRO 1000000 /* per rad/s */
#define ARDEE_SCALE_IMU_GYRO_COVARIANCE 1000000000 /* per (rad/s)² */
#define ARDEE_SCALE_IMU_ORIENTATION 1000000000 /* per 1 */
#define ARDEE_SCALE_IMU_ORIENTATION_COVARIANCE 1000000000 /* per rad² */
#define ARDEE_SCALE_ORIENTATION 1000000000 /* per 1 */
#define ARDEE_SCALE_ORIENTATION_COVARIANCE 1000000000 /* per rad² */
#define ARDEE_SCALE_GYRO 1000000 /* per rad/s */
#define ARDEE_SCALE_ACCELERATION 1000000 /* per m/s² */
#define ARDEE_SCALE_GPS_TIME 1000 /* per s */
#define ARDEE_SCALE_GPS_LATITUDE 10000000 /* per deg */
#define ARDEE_SCALE_GPS_LONGITUDE 10000000 /* per deg */
#define ARDEE_SCALE_GPS_ALTITUDE 1000 /* per m */
#define ARDEE_SCALE_GPS_VELOCITY 1000 /* per m/s */
#define ARDEE_SCALE_GPS_COVARIANCE 1000000 /* per m² */
#define ARDEE_SCALE_LIDAR_ANGLE 1000000 /* per rad */
#define ARDEE_SCALE_LIDAR_ANGLE_STEP 1000000000 /* per rad */
#define ARDEE_SCALE_LIDAR_SCAN_TIME 1000000 /* per s */
#define ARDEE_SCALE_LIDAR_TIME_STEP 1000000000 /* per s */
#define ARDEE_SCALE_LIDAR_RANGE 1000 /* per m */
#define ARDEE_SCALE_LIDAR_INTENSITY 1000 /* per 1 */
#define ARDEE_SCALE_ENCODER_POSITION 10000 /* per rad */
#define ARDEE_SCALE_ENCODER_SPEED 1000000 /* per m/s */
#define ARDEE_SCALE_ENCODER_QPPS 1000 /* per 1/s */
#define ARDEE_SCALE_BATTERY 1000 /* per V */
#define ARDEE_SCALE_POINT 1000 /* per m */
#define ARDEE_SCALE_POINT_INTENSITY 1000 /* per 1 */

ARDEE_SIZE_(Ardee_Msg_Data_Header, 20);
ARDEE_SIZE_(XYZ_INT, 12);
ARDEE_SIZE_(ORIENTATION_QUATERNION_BASE_INT, 16);
ARDEE_SIZE_(ORIENTATION_EULER_BASE_INT, 12);
ARDEE_SIZE_(MOTION_DATA_INT, 48);
ARDEE_AT_(MOTION_DATA_INT, x, 0);
ARDEE_AT_(MOTION_DATA_INT, y, 4);
ARDEE_AT_(MOTION_DATA_INT, z, 8);
ARDEE_AT_(MOTION_DATA_INT, covariance, 12);
ARDEE_AT_(MOTION_DATA_INT, bias, 24);
ARDEE_AT_(MOTION_DATA_INT, offset, 36);
ARDEE_SIZE_(Ardee_Msg_Ack, 4);
ARDEE_SIZE_(Ardee_Msg_OrientationData, 44);
ARDEE_AT_(Ardee_Msg_OrientationData, x, 0);
ARDEE_AT_(Ardee_Msg_OrientationData, y, 4);
ARDEE_AT_(Ardee_Msg_OrientationData, z, 8);
ARDEE_AT_(Ardee_Msg_OrientationData, w, 12);
ARDEE_AT_(Ardee_Msg_OrientationData, covariance, 16);
ARDEE_AT_(Ardee_Msg_OrientationData, bias, 28);
ARDEE_SIZE_(Ardee_Msg_IMUData, 140);
ARDEE_AT_(Ardee_Msg_IMUData, accel, 0);
ARDEE_AT_(Ardee_Msg_IMUData, gyro, 48);
ARDEE_AT_(Ardee_Msg_IMUData, orientation, 96);
ARDEE_SIZE_(Ardee_Msg_GPSData, 48);
ARDEE_AT_(Ardee_Msg_GPSData, time, 0);
ARDEE_AT_(Ardee_Msg_GPSData, latitude, 4);
ARDEE_AT_(Ardee_Msg_GPSData, longitude, 8);
ARDEE_AT_(Ardee_Msg_GPSData, altitude, 12);
ARDEE_AT_(Ardee_Msg_GPSData, velocity, 16);
ARDEE_AT_(Ardee_Msg_GPSData, covariance, 28);
ARDEE_AT_(Ardee_Msg_GPSData, covariance_type, 40);
ARDEE_AT_(Ardee_Msg_GPSData, service, 42);
ARDEE_AT_(Ardee_Msg_GPSData, status, 44);
ARDEE_SIZE_(Ardee_Msg_GyroData, 12);
ARDEE_SIZE_(Ardee_Msg_AccelerationData, 12);
ARDEE_SIZE_(Ardee_Msg_MotionCommands, 12);
ARDEE_SIZE_(Ardee_Msg_LidarData, 8676);
ARDEE_AT_(Ardee_Msg_LidarData, angle_min, 0);
ARDEE_AT_(Ardee_Msg_LidarData, angle_max, 4);
ARDEE_AT_(Ardee_Msg_LidarData, dAngle, 8);
ARDEE_AT_(Ardee_Msg_LidarData, scan_time, 12);
ARDEE_AT_(Ardee_Msg_LidarData, dTime, 16);
ARDEE_AT_(Ardee_Msg_LidarData, range_min, 20);
ARDEE_AT_(Ardee_Msg_LidarData, range_max, 24);
ARDEE_AT_(Ardee_Msg_LidarData, ranges, 28);
ARDEE_AT_(Ardee_Msg_LidarData, intensities, 4352);
ARDEE_SIZE_(Ardee_Msg_EncoderData, 16);
ARDEE_SIZE_(Ardee_Msg_BatteryData, 12);
ARDEE_SIZE_(Ardee_Ext_Control, 4);
ARDEE_SIZE_(Ardee_Ext_SetPort, 12);
ARDEE_SIZE_(Ardee_Ext_Time, 16);
ARDEE_SIZE_(Ardee_Ext_Chunk, 28);
ARDEE_SIZE_(Ardee_Ext_ImageChunk, 44);
ARDEE_AT_(Ardee_Ext_ImageChunk, chunk, 0);
ARDEE_AT_(Ardee_Ext_ImageChunk, encoding, 28);
ARDEE_AT_(Ardee_Ext_ImageChunk, width, 32);
ARDEE_AT_(Ardee_Ext_ImageChunk, height, 36);
ARDEE_AT_(Ardee_Ext_ImageChunk, step, 40);
ARDEE_SIZE_(Ardee_Ext_PointCloudChunk, 28);
ARDEE_AT_(Ardee_Ext_PointCloudChunk, chunk, 0);
ARDEE_SIZE_(Ardee_Ext_Point, 16);
/* end generated */
/* clang-format on */

#undef ARDEE_SIZE_
#undef ARDEE_AT_

#ifdef __cplusplus
}
#endif
