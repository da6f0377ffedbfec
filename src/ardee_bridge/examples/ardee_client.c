/* SPDX-License-Identifier: MIT */
/* A target computer's side of the bridge, without ROS: receives every sensor, prints what came,
 * drives the robot.
 *
 *   cc -std=c11 -O2 -I../include -o ardee_client ardee_client.c
 *   ./ardee_client --help
 */
#define _GNU_SOURCE /* POSIX, struct ip_mreq and getopt_long */
#include <arpa/inet.h>
#include <getopt.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "ardee_message.h"

enum { MAX_DATAGRAM = 65535, COMMAND_HZ = 20, LEASE_S = 5, MAX_SEEN = 64 };

typedef struct Options {
  const char *simulator, *group;
  int port, server_port, controls_port;
  double speed, yaw_rate, seconds;
  int drives;
} Options;

/* What came of one sensor. */
typedef struct Seen {
  int32_t data_type, component_id;
  long count;
  char last[160];
} Seen;

static double now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static struct sockaddr_in address_of(const char *host, int port) {
  struct sockaddr_in address;
  memset(&address, 0, sizeof address);
  address.sin_family = AF_INET;
  address.sin_port = htons((uint16_t)port);
  if (inet_pton(AF_INET, host, &address.sin_addr) != 1) {
    fprintf(stderr, "ardee_client: found %s, expected an IPv4 address\n", host);
    exit(2);
  }
  return address;
}

/* A message is two datagrams: header, then data. */
static void send_message(int fd, const struct sockaddr_in *to, const Ardee_Msg_Data_Header *header,
                         const void *data, size_t size) {
  if (sendto(fd, header, sizeof *header, 0, (const struct sockaddr *)to, sizeof *to) < 0 ||
      sendto(fd, data, size, 0, (const struct sockaddr *)to, sizeof *to) < 0)
    perror("ardee_client: send");
}

static void send_motion(int fd, const struct sockaddr_in *to, double speed, double yaw_rate) {
  Ardee_Msg_Data_Header header;
  Ardee_Msg_MotionCommands commands;
  if (ardee_encode_motion(speed, yaw_rate, &header, &commands))
    send_message(fd, to, &header, &commands, sizeof commands);
}

static void ask_for_everything(int fd, const struct sockaddr_in *to) {
  const Ardee_Ext_SetPort request = {0, 1 << ARDEE_DATA_ALL | 1 << ARDEE_DATA_TIME,
                                     ARDEE_ALL_COMPONENTS};
  const Ardee_Msg_Data_Header header = {
      {0}, ARDEE_MESSAGE_SET_PORT, ARDEE_DATA_NONE, ARDEE_MEASUREMENT_SINGLE, 1};
  send_message(fd, to, &header, &request, sizeof request);
}

/* Size of the data datagram that a header asks for, 0 for a message this client does not know. */
static size_t data_size(const Ardee_Msg_Data_Header *h) {
  const size_t payload = h->measurement_length > 0 ? (size_t)h->measurement_length : 0;
  if (h->msg_type == ARDEE_MESSAGE_ACK) return sizeof(Ardee_Msg_Ack);
  switch (h->data_type) { /* message type 9 is IMU and FRONT_CAM, so the data type decides */
    case ARDEE_DATA_GPS:
      return sizeof(Ardee_Msg_GPSData);
    case ARDEE_DATA_GYRO:
      return sizeof(Ardee_Msg_GyroData);
    case ARDEE_DATA_ACCELERATION:
      return sizeof(Ardee_Msg_AccelerationData);
    case ARDEE_DATA_LIDAR:
      return h->measurement_length <= ARDEE_LIDAR_SLOTS ? sizeof(Ardee_Msg_LidarData) : 0;
    case ARDEE_DATA_ORIENTATION:
      return sizeof(Ardee_Msg_OrientationData);
    case ARDEE_DATA_ENCODER:
      return sizeof(Ardee_Msg_EncoderData);
    case ARDEE_DATA_IMU:
      return sizeof(Ardee_Msg_IMUData);
    case ARDEE_DATA_BATTERY:
      return sizeof(Ardee_Msg_BatteryData);
    case ARDEE_DATA_TIME:
      return sizeof(Ardee_Ext_Time);
    case ARDEE_DATA_IMAGE:
      return sizeof(Ardee_Ext_ImageChunk) + payload;
    case ARDEE_DATA_POINT_CLOUD:
      return sizeof(Ardee_Ext_PointCloudChunk) + payload;
    default:
      return 0;
  }
}

static const char *name_of(int32_t data_type) {
  static const char *names[] = {
      [ARDEE_DATA_NONE] = "ack",        [ARDEE_DATA_GPS] = "gps",
      [ARDEE_DATA_GYRO] = "gyro",       [ARDEE_DATA_ACCELERATION] = "acceleration",
      [ARDEE_DATA_LIDAR] = "lidar",     [ARDEE_DATA_ORIENTATION] = "orientation",
      [ARDEE_DATA_ENCODER] = "encoder", [ARDEE_DATA_IMU] = "imu",
      [ARDEE_DATA_BATTERY] = "battery", [ARDEE_DATA_TIME] = "time",
      [ARDEE_DATA_IMAGE] = "image",     [ARDEE_DATA_POINT_CLOUD] = "point_cloud",
  };
  const int32_t count = sizeof names / sizeof *names;
  return data_type >= 0 && data_type < count && names[data_type] ? names[data_type] : "";
}

/* The shortest valid range, as readers use it: 65533 mm beyond the maximum, 0 below the minimum. */
static int32_t nearest_mm(const Ardee_Msg_LidarData *scan, int32_t beams) {
  int32_t nearest = 65533;
  for (int32_t i = 0; i < beams; ++i) {
    const int32_t range = scan->ranges[i];
    const int32_t read = range == ARDEE_RANGE_TOO_FAR    ? 65533
                         : range == ARDEE_RANGE_TOO_NEAR ? 0
                                                         : range;
    if (read < nearest) nearest = read;
  }
  return nearest;
}

static void describe_gps(const Ardee_Msg_GPSData *gps, char *text, size_t size) {
  if (gps->status < 0) {
    snprintf(text, size, "no fix");
    return;
  }
  snprintf(text, size,
           "latitude %.7f deg longitude %.7f deg altitude %.3f m north %.3f west %.3f m/s",
           (double)gps->latitude / ARDEE_SCALE_GPS_LATITUDE,
           (double)gps->longitude / ARDEE_SCALE_GPS_LONGITUDE,
           (double)gps->altitude / ARDEE_SCALE_GPS_ALTITUDE,
           (double)gps->velocity.x / ARDEE_SCALE_GPS_VELOCITY,
           (double)gps->velocity.y / ARDEE_SCALE_GPS_VELOCITY);
}

static void describe(const Ardee_Msg_Data_Header *h, const unsigned char *bytes, char *text,
                     size_t size) {
  union {
    Ardee_Msg_GPSData gps;
    Ardee_Msg_IMUData imu;
    Ardee_Msg_LidarData lidar;
    Ardee_Msg_EncoderData encoder;
    Ardee_Msg_BatteryData battery;
    Ardee_Ext_Time time;
    Ardee_Ext_ImageChunk image;
    Ardee_Ext_PointCloudChunk cloud;
  } data;
  const size_t length = data_size(h);
  memset(&data, 0, sizeof data); /* an answer's data is shorter than any sensor's */
  memcpy(&data, bytes, length < sizeof data ? length : sizeof data);
  switch (h->data_type) {
    case ARDEE_DATA_GPS:
      describe_gps(&data.gps, text, size);
      break;
    case ARDEE_DATA_IMU:
      snprintf(text, size, "accel_z %.3f m/s2 gyro_z %.4f rad/s",
               (double)data.imu.accel.z / ARDEE_SCALE_IMU_ACCEL,
               (double)data.imu.gyro.z / ARDEE_SCALE_IMU_GYRO);
      break;
    case ARDEE_DATA_LIDAR:
      snprintf(text, size, "beams %d nearest %d mm", (int)h->measurement_length,
               (int)nearest_mm(&data.lidar, h->measurement_length));
      break;
    case ARDEE_DATA_ENCODER:
      snprintf(text, size, "position %.4f rad speed %.3f m/s",
               (double)data.encoder.position / ARDEE_SCALE_ENCODER_POSITION,
               (double)data.encoder.speed / ARDEE_SCALE_ENCODER_SPEED);
      break;
    case ARDEE_DATA_BATTERY:
      snprintf(text, size, "voltage %.3f V", (double)data.battery.voltage / ARDEE_SCALE_BATTERY);
      break;
    case ARDEE_DATA_TIME:
      snprintf(text, size, "time %d.%09d s", (int)data.time.sec, (int)data.time.nsec);
      break;
    case ARDEE_DATA_IMAGE:
      snprintf(text, size, "width %d height %d bytes %d", (int)data.image.width,
               (int)data.image.height, (int)data.image.chunk.total);
      break;
    case ARDEE_DATA_POINT_CLOUD:
      snprintf(text, size, "points %d", (int)data.cloud.chunk.total / (int)sizeof(Ardee_Ext_Point));
      break;
    default:
      text[0] = '\0';
  }
}

static Seen *find_seen(Seen *seen, int *count, const Ardee_Msg_Data_Header *h) {
  for (int i = 0; i < *count; ++i)
    if (seen[i].data_type == h->data_type && seen[i].component_id == h->component_id)
      return &seen[i];
  if (*count == MAX_SEEN) return NULL;
  memset(&seen[*count], 0, sizeof *seen);
  seen[*count].data_type = h->data_type;
  seen[*count].component_id = h->component_id;
  return &seen[(*count)++];
}

/* An image or a cloud is one message in several datagrams: it counts once, as its last one comes.
 */
static int ends_message(const Ardee_Msg_Data_Header *h, const unsigned char *bytes) {
  Ardee_Ext_Chunk chunk;
  if (h->data_type != ARDEE_DATA_IMAGE && h->data_type != ARDEE_DATA_POINT_CLOUD) return 1;
  memcpy(&chunk, bytes, sizeof chunk);
  return chunk.index == chunk.count - 1;
}

/* Read one datagram. No data datagram is as long as a header, so the length tells them apart. */
static void receive(int fd, Ardee_Msg_Data_Header *header, int *has_header, Seen *seen,
                    int *count) {
  static unsigned char datagram[MAX_DATAGRAM];
  const ssize_t size = recv(fd, datagram, sizeof datagram, 0);
  if (size < 0) return;
  if ((size_t)size == sizeof *header) {
    memcpy(header, datagram, sizeof *header);
    *has_header = 1;
    return;
  }
  if (!*has_header || (size_t)size != data_size(header)) return;
  *has_header = 0;
  Seen *sensor = find_seen(seen, count, header);
  if (!sensor) return;
  sensor->count += ends_message(header, datagram);
  describe(header, datagram, sensor->last, sizeof sensor->last);
}

/* Reads a number within limits, which `expected` says in words. */
static double number_in(const char *text, double low, double high, const char *expected) {
  char *rest;
  const double value = strtod(text, &rest);
  if (rest == text || *rest || !(value >= low && value <= high)) {
    fprintf(stderr, "ardee_client: found %s, expected %s\n", text, expected);
    exit(2);
  }
  return value;
}

static double share_of_limit(const char *text) {
  return number_in(text, -1.0, 1.0, "a share of the limit, -1 to 1");
}

static int port_number(const char *text) {
  return (int)number_in(text, 0.0, 65535.0, "a port, 0 to 65535");
}

static void print_usage(void) {
  puts(
      "usage: ardee_client [--simulator ADDRESS] [--port PORT] [--ask PORT] [--controls PORT]\n"
      "                    [--group ADDRESS] [--speed SHARE] [--yaw-rate SHARE] [--duration-s S] "
      "[-h]\n"
      "Receives every sensor of the bridge, prints what came, and drives the robot.\n"
      "  -i, --simulator ADDRESS  address of the simulator's computer (default 127.0.0.1)\n"
      "  -p, --port PORT          UDP port to listen at (default 30000); 0: any free port, needs "
      "--ask\n"
      "  -a, --ask PORT           ask the sensor server at this port, usually 30001, for every "
      "sensor\n"
      "                           and for time stamps\n"
      "  -c, --controls PORT      UDP port of the controls client (default 35555)\n"
      "  -g, --group ADDRESS      multicast group to join, on the interface that leads to the "
      "simulator\n"
      "  -v, --speed SHARE        speed to drive at, -1...1 of the robot's limit\n"
      "  -w, --yaw-rate SHARE     rate to turn at, -1...1 of the robot's limit\n"
      "  -t, --duration-s S       time until it ends (default 5)\n"
      "  -h, --help               this text");
}

static Options parse(int argc, char **argv) {
  static const struct option names[] = {{"simulator", required_argument, NULL, 'i'},
                                        {"port", required_argument, NULL, 'p'},
                                        {"ask", required_argument, NULL, 'a'},
                                        {"controls", required_argument, NULL, 'c'},
                                        {"group", required_argument, NULL, 'g'},
                                        {"speed", required_argument, NULL, 'v'},
                                        {"yaw-rate", required_argument, NULL, 'w'},
                                        {"duration-s", required_argument, NULL, 't'},
                                        {"help", no_argument, NULL, 'h'},
                                        {NULL, 0, NULL, 0}};
  Options options = {"127.0.0.1", NULL, 30000, 0, 35555, 0.0, 0.0, 5.0, 0};
  int letter;
  while ((letter = getopt_long(argc, argv, "i:p:a:c:g:v:w:t:h", names, NULL)) != -1) {
    switch (letter) {
      case 'i':
        options.simulator = optarg;
        break;
      case 'p':
        options.port = port_number(optarg);
        break;
      case 'a':
        options.server_port = port_number(optarg);
        break;
      case 'c':
        options.controls_port = port_number(optarg);
        break;
      case 'g':
        options.group = optarg;
        break;
      case 'v':
        options.speed = share_of_limit(optarg), options.drives = 1;
        break;
      case 'w':
        options.yaw_rate = share_of_limit(optarg), options.drives = 1;
        break;
      case 't':
        options.seconds = number_in(optarg, 0.0, 1e9, "a time in s, at least 0");
        break;
      case 'h':
        print_usage();
        exit(0);
      default: /* getopt_long has said what is wrong */
        exit(2);
    }
  }
  if (optind < argc) {
    fprintf(stderr, "ardee_client: found %s, expected an argument of --help\n", argv[optind]);
    exit(2);
  }
  if (!options.port && !options.server_port) {
    fprintf(stderr, "ardee_client: --port: found 0, expected a port, or --ask too\n");
    exit(2);
  }
  return options;
}

/* Let in what is sent to a multicast group. Without a default route the system cannot choose the
 * interface. */
static void join(int fd, const char *group, const struct sockaddr_in *simulator) {
  struct sockaddr_in interface;
  socklen_t size = sizeof interface;
  const int towards = socket(AF_INET, SOCK_DGRAM, 0); /* to connect it sends nothing */
  if (towards < 0 || connect(towards, (const struct sockaddr *)simulator, sizeof *simulator) < 0 ||
      getsockname(towards, (struct sockaddr *)&interface, &size) < 0) {
    perror("ardee_client: simulator");
    exit(2);
  }
  close(towards);
  const struct ip_mreq member = {address_of(group, 0).sin_addr, interface.sin_addr};
  if (setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &member, sizeof member) < 0) {
    perror("ardee_client: group");
    exit(2);
  }
}

static int open_socket(const Options *options) {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  const int is_local = strncmp(options->simulator, "127.", 4) == 0 && !options->group;
  const struct sockaddr_in here = address_of(is_local ? "127.0.0.1" : "0.0.0.0", options->port);
  const int buffer_bytes = 4 << 20;
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof buffer_bytes);
  if (fd < 0 || bind(fd, (const struct sockaddr *)&here, sizeof here) < 0) {
    perror("ardee_client: bind");
    exit(2);
  }
  return fd;
}

static volatile sig_atomic_t has_to_end = 0;

static void end(int number) {
  (void)number;
  has_to_end = 1;
}

int main(int argc, char **argv) {
  const Options options = parse(argc, argv);
  const struct sockaddr_in controls = address_of(options.simulator, options.controls_port);
  const struct sockaddr_in server = address_of(options.simulator, options.server_port);
  const int fd = open_socket(&options);
  if (options.group) join(fd, options.group, &controls);
  signal(SIGINT, end);
  Ardee_Msg_Data_Header header;
  memset(&header, 0, sizeof header);
  Seen seen[MAX_SEEN];
  int has_header = 0, count = 0;
  const double end_s = now_s() + options.seconds;
  double command_s = 0.0, ask_s = 0.0;
  for (double t = now_s(); t < end_s && !has_to_end; t = now_s()) {
    if (options.drives && t >= command_s) {
      send_motion(fd, &controls, options.speed, options.yaw_rate);
      command_s = t + 1.0 / COMMAND_HZ;
    }
    if (options.server_port && t >= ask_s) {
      ask_for_everything(fd, &server);
      ask_s = t + LEASE_S;
    }
    struct pollfd readable = {fd, POLLIN, 0};
    if (poll(&readable, 1, 10) > 0) receive(fd, &header, &has_header, seen, &count);
  }
  if (options.drives) send_motion(fd, &controls, 0.0, 0.0);
  for (int i = 0; i < count; ++i)
    printf("%s %d count %ld %s\n", name_of(seen[i].data_type), (int)seen[i].component_id,
           seen[i].count, seen[i].last);
  close(fd);
  return 0;
}
