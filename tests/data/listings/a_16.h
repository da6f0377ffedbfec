#pragma once

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
