# SPDX-License-Identifier: MIT
"""The wire format: enums, header and data structs, byte for byte those of include/ardee_message.h.

Standard library only, so that a target computer can use it. A message is two datagrams, header then data:

    header, data = codec.encode_motion(speed=0.5, yaw_rate=0.0)
    codec.Header.unpack(datagram), codec.data_struct(header).unpack(datagram).to_si()
"""
import math
from typing import Dict, List, Optional, Sequence, Tuple, Type, Union

from ardee_bridge.wire.c_struct import INT8, INT32, UINT8, UINT16, Array, CStruct
from ardee_bridge.wire.enums import (  # noqa: F401
    ControlCode,
    DataType,
    ImageEncoding,
    MeasurementType,
    MessageType,
)
from ardee_bridge.wire.scales import scale_of

LIDAR_SLOTS = 1081
RANGE_TOO_FAR, RANGE_TOO_NEAR = -1000, -2000
# What readers put in the place of the two above [mm].
READER_TOO_FAR_MM, READER_TOO_NEAR_MM = 65533, 0
MAX_SPEED_M_S, MIN_TURN_RADIUS_M = 1.2, 0.381
MAX_YAW_RATE_RAD_S = MAX_SPEED_M_S / MIN_TURN_RADIUS_M
ALL_COMPONENTS = -1
DEFAULT_MULTIPLIER = 1_000_000


def _int32(names: str) -> Tuple[Tuple[str, object], ...]:
    return tuple((name, INT32) for name in names.split())


class Header(CStruct):
    """First datagram of a message."""

    C_NAME = "Ardee_Msg_Data_Header"
    FIELDS = _int32("component_id msg_type data_type measurement_type measurement_length")


class Xyz(CStruct):
    C_NAME = "XYZ_INT"
    FIELDS = _int32("x y z")


class Quaternion(CStruct):
    C_NAME = "ORIENTATION_QUATERNION_BASE_INT"
    FIELDS = _int32("x y z w")


class Euler(CStruct):
    C_NAME = "ORIENTATION_EULER_BASE_INT"
    FIELDS = _int32("roll pitch yaw")


class MotionData(CStruct):
    C_NAME = "MOTION_DATA_INT"
    FIELDS = _int32("x y z") + (("covariance", Xyz), ("bias", Xyz), ("offset", Xyz))


class Ack(CStruct):
    """Answer to a SET_PORT or CONTROL message: the component id of that message's header."""

    C_NAME = "Ardee_Msg_Ack"
    FIELDS = _int32("sequence")


class OrientationData(CStruct):
    C_NAME = "Ardee_Msg_OrientationData"
    FIELDS = _int32("x y z w") + (("covariance", Euler), ("bias", Quaternion))


class IMUData(CStruct):
    C_NAME = "Ardee_Msg_IMUData"
    FIELDS = (("accel", MotionData), ("gyro", MotionData), ("orientation", OrientationData))


class GPSData(CStruct):
    C_NAME = "Ardee_Msg_GPSData"
    FIELDS = _int32("time latitude longitude altitude") + (
        ("velocity", Xyz),
        ("covariance", Xyz),
        ("covariance_type", UINT8),
        ("service", UINT16),
        ("status", INT8),
    )


class GyroData(CStruct):
    C_NAME = "Ardee_Msg_GyroData"
    FIELDS = _int32("x y z")


class AccelerationData(CStruct):
    C_NAME = "Ardee_Msg_AccelerationData"
    FIELDS = _int32("x y z")


class MotionCommands(CStruct):
    """Speeds as fractions normalized / multiplier of the robot's limits."""

    C_NAME = "Ardee_Msg_MotionCommands"
    FIELDS = _int32("normalized_speed normalized_yaw_rate multiplier")


class LidarData(CStruct):
    """A scan; the header's measurement_length says how many of the slots are beams."""

    C_NAME = "Ardee_Msg_LidarData"
    FIELDS = _int32("angle_min angle_max dAngle scan_time dTime range_min range_max") + (
        ("ranges", Array(INT32, LIDAR_SLOTS)),
        ("intensities", Array(INT32, LIDAR_SLOTS)),
    )


class EncoderData(CStruct):
    C_NAME = "Ardee_Msg_EncoderData"
    FIELDS = _int32("id position speed qpps")


class BatteryData(CStruct):
    C_NAME = "Ardee_Msg_BatteryData"
    FIELDS = _int32("voltage vmax vmin")


class Control(CStruct):
    """Extension: data of a CONTROL message."""

    C_NAME = "Ardee_Ext_Control"
    FIELDS = _int32("code")


class SetPort(CStruct):
    """Extension: data of a SET_PORT message: where a client listens and what it wants.

    port 0: the port it sends from. data_types: sum of 1 << data type; 1 << ALL: every sensor; 0: nothing more.
    component_id: of one component alone, or ALL_COMPONENTS.
    """

    C_NAME = "Ardee_Ext_SetPort"
    FIELDS = _int32("port data_types component_id")


class TimeStamp(CStruct):
    """Extension: simulated time of the message that follows, and which that is."""

    C_NAME = "Ardee_Ext_Time"
    FIELDS = _int32("sec nsec data_type component_id")


class Chunk(CStruct):
    """Extension: place of a datagram's payload in an image or cloud of `total` bytes."""

    C_NAME = "Ardee_Ext_Chunk"
    FIELDS = _int32("sec nsec sequence index count offset total")


class ImageChunk(CStruct):
    """Extension: goes before the payload of an image's datagram; step: bytes a row, 0 for JPEG."""

    C_NAME = "Ardee_Ext_ImageChunk"
    FIELDS = (("chunk", Chunk),) + _int32("encoding width height step")


class PointCloudChunk(CStruct):
    """Extension: goes before the payload of a point cloud's datagram, whole Points."""

    C_NAME = "Ardee_Ext_PointCloudChunk"
    FIELDS = (("chunk", Chunk),)


class Point(CStruct):
    """Extension: a point of a cloud."""

    C_NAME = "Ardee_Ext_Point"
    FIELDS = _int32("x y z intensity")


# Everything that goes over the wire or into something that does, in the order of the C header.
STRUCTS: Tuple[Type[CStruct], ...] = tuple(CStruct.__subclasses__())

# (message type, data type) -> data struct, of all that has one.
_M, _D = MessageType, DataType
DATA_STRUCTS: Dict[Tuple[int, int], Type[CStruct]] = {
    (_M.SET_PORT, _D.NONE): SetPort,
    (_M.CONTROL, _D.NONE): Control,
    (_M.DATA_RCCOMMANDS, _D.NONE): MotionCommands,
    (_M.DATA_GPS, _D.GPS): GPSData,
    (_M.DATA_GYRO, _D.GYRO): GyroData,
    (_M.DATA_ACCELERATION, _D.ACCELERATION): AccelerationData,
    (_M.DATA_LIDAR, _D.LIDAR): LidarData,
    (_M.DATA_ORIENTATION, _D.ORIENTATION): OrientationData,
    (_M.DATA_ENCODER, _D.ENCODER): EncoderData,
    (_M.DATA_IMU, _D.IMU): IMUData,
    (_M.DATA_BATTERY, _D.BATTERY): BatteryData,
    (_M.DATA_TIME, _D.TIME): TimeStamp,
    (_M.DATA_IMAGE, _D.IMAGE): ImageChunk,
    (_M.DATA_POINT_CLOUD, _D.POINT_CLOUD): PointCloudChunk,
    (_M.ACK, _D.NONE): Ack,
}
MESSAGE_TYPE_OF = {data: message for message, data in DATA_STRUCTS if data != DataType.NONE}
# message type -> data struct, of what is no sensor's: the header's data and measurement fields say nothing there.
_REQUESTS = {message: kind for (message, data), kind in DATA_STRUCTS.items() if data == _D.NONE}
_CHUNKED = (ImageChunk, PointCloudChunk)

_RANGE_COUNTS_PER_M = scale_of(LidarData.C_NAME, "ranges").counts_per_unit or 1

Datagrams = Tuple[bytes, bytes]
Buffer = Union[bytes, bytearray, memoryview]


def data_struct(header: Header) -> Optional[Type[CStruct]]:
    """Returns the struct of the data datagram after this header; None for an undefined message."""
    request = _REQUESTS.get(header.msg_type)
    return request or DATA_STRUCTS.get((header.msg_type, header.data_type))


def data_size(header: Header) -> Optional[int]:
    """Size of the data datagram after this header [bytes], None where the header is not a valid one."""
    if header.msg_type in _REQUESTS:
        return _REQUESTS[header.msg_type].size
    kind, count = data_struct(header), header.measurement_length
    multiple = header.measurement_type == MeasurementType.MULTIPLE
    if kind is None or not multiple and header.measurement_type != MeasurementType.SINGLE:
        return None
    if kind in _CHUNKED:
        return kind.size + count if multiple and 0 <= count <= 65507 - kind.size else None
    if kind is LidarData:
        return kind.size if multiple and 0 <= count <= LIDAR_SLOTS else None
    return None if multiple else kind.size


def encode(
    data_type: DataType, component_id: int, data: bytes, count: Optional[int] = None
) -> Datagrams:
    """Header and data datagram of a sensor's message; `count` for measurements of several values."""
    kind = MeasurementType.SINGLE if count is None else MeasurementType.MULTIPLE
    header = Header(component_id=component_id, msg_type=MESSAGE_TYPE_OF[data_type])
    header.data_type, header.measurement_type = data_type, kind
    header.measurement_length = 1 if count is None else count
    return header.pack(), data


def _encode_request(msg_type: MessageType, component_id: int, data: CStruct) -> Datagrams:
    header = Header(component_id=component_id, msg_type=msg_type, measurement_length=1)
    return header.pack(), data.pack()


def _require_finite(**values: float) -> None:
    for name, value in values.items():
        if not math.isfinite(value):
            raise ValueError(f"{name}: found {value}, expected a finite number")


def encode_motion(
    speed: float, yaw_rate: float, multiplier: int = DEFAULT_MULTIPLIER, component_id: int = 0
) -> Datagrams:
    """A motion command: speed and yaw rate as fractions of the limits, cut to -1...1.

    ValueError unless both are finite and the multiplier at least 1.
    """
    _require_finite(speed=speed, yaw_rate=yaw_rate)  # min and max would make full speed of NaN
    if not 1 <= multiplier <= INT32.limits[1]:
        expected = f"expected at least 1, at most {INT32.limits[1]}"
        raise ValueError(f"multiplier: found {multiplier}, {expected}")
    commands = MotionCommands(
        normalized_speed=round(max(-1.0, min(1.0, speed)) * multiplier),
        normalized_yaw_rate=round(max(-1.0, min(1.0, yaw_rate)) * multiplier),
        multiplier=multiplier,
    )
    return _encode_request(MessageType.DATA_RCCOMMANDS, component_id, commands)


def encode_motion_si(speed_m_s: float, yaw_rate_rad_s: float) -> Datagrams:
    """A motion command in m/s and rad/s, for the limits of the TerraSentia; beyond them it is cut.

    ValueError unless both are finite.
    """
    _require_finite(speed_m_s=speed_m_s, yaw_rate_rad_s=yaw_rate_rad_s)
    return encode_motion(speed_m_s / MAX_SPEED_M_S, yaw_rate_rad_s / MAX_YAW_RATE_RAD_S)


def encode_control(code: ControlCode, request_id: int = 0) -> Datagrams:
    """A control message; its Ack carries `request_id`."""
    return _encode_request(MessageType.CONTROL, request_id, Control(code=code))


def encode_set_port(
    data_types: Sequence[DataType],
    port: int = 0,
    component_id: int = ALL_COMPONENTS,
    request_id: int = 0,
) -> Datagrams:
    """Asks a sensor server for these data types, or with none to send nothing more; see SetPort."""
    wanted = SetPort(port=port, data_types=type_mask(data_types), component_id=component_id)
    return _encode_request(MessageType.SET_PORT, request_id, wanted)


def type_mask(data_types: Sequence[DataType]) -> int:
    """SetPort.data_types of these types."""
    return sum(1 << data_type for data_type in set(data_types))


def encode_ack(request: Header) -> Datagrams:
    """The answer to a SET_PORT or CONTROL message."""
    answered = request.component_id
    return _encode_request(MessageType.ACK, answered, Ack(sequence=answered))


def range_counts(ranges_m: Sequence[float], min_m: float, max_m: float) -> List[int]:
    """LidarData.ranges from metres: RANGE_TOO_FAR beyond max_m and for NaN, RANGE_TOO_NEAR below min_m."""
    per_m = _RANGE_COUNTS_PER_M
    max_m = min(max_m, INT32.limits[1] // per_m)
    return [
        round(r * per_m) if min_m <= r <= max_m else RANGE_TOO_NEAR if r < min_m else RANGE_TOO_FAR
        for r in ranges_m
    ]


def reader_ranges_mm(header: Header, data: LidarData) -> List[int]:
    """The valid ranges of a raw scan as readers use them [mm]: 65533 too far, 0 too near."""
    replaced = {RANGE_TOO_FAR: READER_TOO_FAR_MM, RANGE_TOO_NEAR: READER_TOO_NEAR_MM}
    return [replaced.get(count, count) for count in data.ranges[: header.measurement_length]]


def ranges_m(header: Header, data: LidarData) -> List[float]:
    """The valid ranges of a raw scan [m], as REP 117 has them: +inf too far, -inf too near."""
    special = {RANGE_TOO_FAR: math.inf, RANGE_TOO_NEAR: -math.inf}
    counts = data.ranges[: header.measurement_length]
    return [special.get(count, count / _RANGE_COUNTS_PER_M) for count in counts]
