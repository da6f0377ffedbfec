# SPDX-License-Identifier: MIT
"""Tests the codec: sizes and offsets by hand, bytes there and back, scales, out-of-range readings."""
import math
import random
import subprocess
import sys

import pytest

from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import INT32, NO_VALUE, Array
from ardee_bridge.wire.scales import SCALES


def random_raw(kind, rng):
    """Returns a struct with random integers in every leaf."""
    raw = kind.unpack(bytes(kind.size))
    values = []
    for leaf in kind.leaves:
        if isinstance(leaf.kind, Array):
            values.append(tuple(rng.randint(*INT32.limits) for _ in range(leaf.kind.length)))
        else:
            values.append(rng.randint(*leaf.kind.limits))
    return raw._from_values(iter(values))


def test_gps_layout_has_the_padding_of_c():
    offsets = {leaf.path: leaf.offset for leaf in codec.GPSData.leaves}
    assert (offsets["covariance_type"], offsets["service"], offsets["status"]) == (40, 42, 44)
    assert codec.GPSData.size == 48


@pytest.mark.parametrize("kind", codec.STRUCTS, ids=lambda kind: kind.__name__)
def test_bytes_there_and_back(kind):
    rng = random.Random(kind.__name__)
    for _ in range(20):
        raw = random_raw(kind, rng)
        packed = raw.pack()
        assert len(packed) == kind.size
        assert kind.unpack(packed) == raw


@pytest.mark.parametrize("kind", codec.STRUCTS, ids=lambda kind: kind.__name__)
def test_si_and_back_is_exact_on_counts(kind):
    rng = random.Random(kind.__name__)
    for _ in range(20):
        raw = random_raw(kind, rng)
        assert raw.to_si().to_raw() == raw


@pytest.mark.parametrize("kind", codec.STRUCTS, ids=lambda kind: kind.__name__)
def test_wrong_size_is_refused_with_both_sizes(kind):
    for size in (0, kind.size - 1, kind.size + 1):
        with pytest.raises(ValueError, match=f"{size} bytes, expected {kind.size}"):
            kind.unpack(bytes(size))


def test_a_known_header_in_bytes():
    header, _ = codec.encode(codec.DataType.IMU, 7, codec.IMUData().pack())
    assert header.hex() == "07000000" "09000000" "09000000" "00000000" "01000000"


def test_numbers_of_the_thesis():
    assert codec.MAX_YAW_RATE_RAD_S == pytest.approx(3.1496063, abs=1e-6)
    header, data = codec.encode_motion(0.5, -1.0, multiplier=100)
    assert codec.MotionCommands.unpack(data).as_dict() == {
        "normalized_speed": 50,
        "normalized_yaw_rate": -100,
        "multiplier": 100,
    }
    assert codec.data_size(codec.Header.unpack(header)) == 12


@pytest.mark.parametrize(
    "encode, values",
    [
        (codec.encode_motion, (1e10, -0.5)),
        (codec.encode_motion_si, (2.4, -codec.MAX_YAW_RATE_RAD_S / 2)),
    ],
)
def test_commands_are_cut_to_the_limits(encode, values):
    command = codec.MotionCommands.unpack(encode(*values)[1])
    assert command.normalized_speed == command.multiplier
    assert command.normalized_yaw_rate == -command.multiplier // 2


@pytest.mark.parametrize("bad", [0, -5, 2**31])
def test_a_multiplier_that_receivers_drop_is_refused(bad):
    with pytest.raises(ValueError, match=f"^multiplier: found {bad}, expected at least 1, at most"):
        codec.encode_motion(0.5, 0.0, multiplier=bad)


@pytest.mark.parametrize("encode", [codec.encode_motion, codec.encode_motion_si])
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_motion_that_is_not_finite_is_refused(encode, bad):
    for command in ((bad, 0.0), (0.0, bad)):
        with pytest.raises(ValueError, match=f"found {bad}, expected a finite number"):
            encode(*command)


def test_imu_and_front_camera_share_a_message_type_and_differ_in_data_type():
    assert codec.MessageType.DATA_IMU == codec.MessageType.DATA_FRONT_CAM == 9
    assert codec.data_struct(codec.Header(msg_type=9, data_type=9)) is codec.IMUData
    assert codec.data_struct(codec.Header(msg_type=9, data_type=8)) is None


def test_no_data_datagram_can_be_taken_for_a_header():
    for kind in set(codec.DATA_STRUCTS.values()):
        assert kind.size != codec.Header.size
    assert codec.ImageChunk.size > codec.Header.size
    assert codec.PointCloudChunk.size > codec.Header.size


def test_scaling_and_saturation():
    gps = codec.GPSData(latitude=40.1234567, longitude=-88.2, altitude=float("inf"))
    raw = gps.to_raw()
    assert (raw.latitude, raw.longitude) == (401234567, -882000000)
    assert raw.altitude == 2**31 - 1
    battery = codec.BatteryData(voltage=math.nan, vmax=-math.inf).to_raw()
    assert battery.voltage == NO_VALUE and battery.vmax == NO_VALUE + 1
    assert math.isnan(battery.to_si().voltage)
    intensities = codec.LidarData(intensities=[math.nan, 1.0]).to_raw().to_si().intensities
    assert math.isnan(intensities[0]) and intensities[1] == 1.0


def test_ranges_out_of_range():
    counts = codec.range_counts(
        [0.05, 0.06, 1.2344, 10.0, 10.1, math.inf, -math.inf, math.nan], 0.06, 10.0
    )
    assert counts == [-2000, 60, 1234, 10000, -1000, -1000, -2000, -1000]
    header = codec.Header(measurement_length=8)
    scan = codec.LidarData.unpack(codec.LidarData(ranges=counts).pack())
    assert codec.reader_ranges_mm(header, scan) == [0, 60, 1234, 10000, 65533, 65533, 0, 65533]
    assert codec.ranges_m(header, scan)[:4] == [-math.inf, 0.06, 1.234, 10.0]
    assert codec.range_counts([3e38], 0.0, math.inf) == [-1000]


def test_too_many_ranges_are_refused():
    with pytest.raises(ValueError, match="ranges: 1082 values, at most 1081"):
        codec.LidarData(ranges=[0] * 1082).pack()


@pytest.mark.parametrize(
    "header",
    [
        dict(msg_type=99),
        dict(msg_type=2, data_type=3),
        dict(msg_type=2, data_type=2, measurement_type=1),
        dict(msg_type=2, data_type=2, measurement_type=7),
        dict(msg_type=6, data_type=5, measurement_type=1, measurement_length=1082),
        dict(msg_type=6, data_type=5, measurement_type=1, measurement_length=-1),
        dict(msg_type=17, data_type=17, measurement_type=1, measurement_length=2**31 - 1),
        dict(msg_type=-1, data_type=-1),
    ],
)
def test_invalid_headers_have_no_data_size(header):
    assert codec.data_size(codec.Header(**header)) is None


@pytest.mark.parametrize("msg_type, size", [(0, 12), (1, 4), (5, 12), (19, 4)])
@pytest.mark.parametrize(
    "header",
    [
        dict(data_type=9, measurement_type=1, measurement_length=3),
        dict(data_type=-1, measurement_type=7, measurement_length=-5),
    ],
)
def test_sensor_fields_of_a_header_say_nothing_of_requests(header, msg_type, size):
    """Thesis 4.5.1 uses these fields for sensor data only; a client may leave any value in them."""
    assert codec.data_size(codec.Header(msg_type=msg_type, **header)) == size


def test_every_physical_field_of_the_messages_is_in_the_table():
    plain = {"id", "covariance_type", "service", "status"}
    motion = {"normalized_speed", "normalized_yaw_rate", "multiplier"}
    for kind in codec.STRUCTS[7:15]:
        for leaf in kind.leaves:
            has_unit = leaf.path not in plain | motion
            assert (leaf.scale.counts_per_unit is not None) == has_unit, (kind, leaf.path)


def test_every_row_of_the_table_is_used():
    used = {leaf.scale for kind in codec.STRUCTS for leaf in kind.leaves}
    assert set(SCALES) <= used


def test_rows_with_the_same_constant_agree():
    counts = {}
    for row in SCALES:
        assert counts.setdefault(row.constant, row.counts_per_unit) == row.counts_per_unit


def test_only_the_standard_library_is_imported(package):
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); "
        "import ardee_bridge.wire.codec, ardee_bridge.wire.pairing, ardee_bridge.wire.chunks; "
        "bad = {'rospy', 'numpy', 'genpy', 'PIL', 'yaml'} & set(sys.modules); "
        "sys.exit(str(bad) if bad else 0)"
    )
    subprocess.run([sys.executable, "-I", "-c", code, str(package / "src")], check=True)
