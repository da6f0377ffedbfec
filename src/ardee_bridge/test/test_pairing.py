# SPDX-License-Identifier: MIT
"""Tests the pairing rule under loss, doubling, reordering and garbage; chunks likewise."""
import random

import pytest

from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.pairing import MAX_SENDERS, WINDOW_S, Pairer


def random_bytes(rng, count):
    """Returns this many random bytes."""
    return bytes(rng.choices(range(256), k=count))


def motion(speed):
    return codec.encode_motion(speed, 0.0)


def speeds(messages):
    found = [codec.MotionCommands.unpack(m.data).normalized_speed for m in messages if m]
    return [count / codec.DEFAULT_MULTIPLIER for count in found]


def feed_all(pairer, datagrams, step_s=0.001, sender="a"):
    return [pairer.feed(sender, data, i * step_s) for i, data in enumerate(datagrams)]


def test_in_order():
    pairer = Pairer()
    assert speeds(feed_all(pairer, motion(0.1) + motion(0.2))) == [0.1, 0.2]
    assert not pairer.dropped


def test_loss_costs_only_its_own_message():
    (h1, d1), (h2, d2) = motion(0.1), motion(0.2)
    for kept, dropped in (
        ([h1, h2, d2], "header without data"),
        ([d1, h2, d2], "data without header"),
    ):
        pairer = Pairer()
        assert speeds(feed_all(pairer, kept)) == [0.2]
        assert pairer.dropped == {dropped: 1}


def test_doubles_cost_nothing():
    header, data = motion(0.1)
    pairer = Pairer()
    assert speeds(feed_all(pairer, [header, header, data, data])) == [0.1]
    assert pairer.dropped == {"header without data": 1, "data without header": 1}


def test_data_before_its_header_is_dropped():
    (h1, d1), (h2, d2) = motion(0.1), motion(0.2)
    assert speeds(feed_all(Pairer(), [d1, h1, h2, d2])) == [0.2]


def test_data_of_another_size_does_not_take_the_header():
    header, data = motion(0.1)
    pairer = Pairer()
    assert speeds(feed_all(pairer, [header, b"\0" * 16, b"", b"\0" * 65000, data])) == [0.1]
    assert pairer.dropped == {"data of the wrong size": 3}


def test_a_drop_says_who_and_what():
    pairer = Pairer()
    feed_all(pairer, [motion(0.1)[0], b"\0" * 16], sender=("10.0.0.2", 5000))
    told = "10.0.0.2:5000: found 16 bytes, expected 12 after a header of type 5"
    assert list(pairer.take_drops()) == [("data of the wrong size", 1, told)]
    assert list(pairer.take_drops()) == []


def test_old_headers_are_not_used():
    header, data = motion(0.1)
    pairer = Pairer()
    assert speeds(feed_all(pairer, [header, data], step_s=WINDOW_S * 1.01)) == []
    assert pairer.dropped == {"data too late": 1}


def test_an_invalid_header_takes_the_one_before_with_it():
    header, data = motion(0.1)
    unknown = codec.Header(msg_type=77).pack()
    pairer = Pairer()
    assert speeds(feed_all(pairer, [header, unknown, data])) == []
    reasons = ("header without data", "unknown or invalid header", "data without header")
    assert pairer.dropped == {reason: 1 for reason in reasons}


def test_senders_do_not_mix_and_are_bounded():
    header, data = motion(0.1)
    pairer = Pairer()
    assert pairer.feed("a", header, 0.0) is None
    assert pairer.feed("b", data, 0.0) is None
    assert pairer.feed("a", data, 0.0) is not None
    for sender in range(10 * MAX_SENDERS):
        pairer.feed(sender, header, 0.0)
    assert pairer.dropped["too many senders"] == 9 * MAX_SENDERS
    assert pairer.feed(0, data, 0.0) is None
    assert pairer.feed(10 * MAX_SENDERS - 1, data, 0.0) is not None


def test_random_bytes_never_raise_and_are_all_counted():
    rng = random.Random(1)
    pairer, made = Pairer(), 0
    for number in range(20_000):
        size = rng.choice((0, 1, 4, 12, 19, 20, 20, 20, 21, 48, 140, 1400))
        fields = [rng.choice((-1, 0, 1, 2, 5, 9, 17, rng.getrandbits(31))) for _ in range(5)]
        names = [leaf.path for leaf in codec.Header.leaves]
        is_header_like = size == 20 and rng.random() < 0.7
        data = (
            codec.Header(**dict(zip(names, fields))).pack()
            if is_header_like
            else random_bytes(rng, size)
        )
        message = pairer.feed(rng.randrange(3), data, number * 1e-3)
        if message:
            made += 1
            assert len(message.data) == codec.data_size(message.header)
    waiting = 20_000 - sum(pairer.dropped.values()) - 2 * made
    assert 0 <= waiting <= 3 and made > 0


def frame(payload, chunk_bytes, sequence=0):
    head = codec.ImageChunk(chunk=codec.Chunk(sec=3, sequence=sequence), width=7, height=9)
    pairs = chunks.split(codec.DataType.IMAGE, 2, head, payload, chunk_bytes)
    return [(codec.Header.unpack(header), data) for header, data in pairs]


def test_chunks_in_any_order_and_doubled():
    rng = random.Random(2)
    payload = random_bytes(rng, 10_001)
    for chunk_bytes in (256, 10_000, 10_001, 60_000):
        messages = frame(payload, chunk_bytes) * 2
        rng.shuffle(messages)
        assembler = chunks.Assembler()
        wholes = [whole for whole in (assembler.feed(*m) for m in messages) if whole]
        assert [whole.payload for whole in wholes] == [payload]
        assert (wholes[0].component_id, wholes[0].head.width) == (2, 7)
        assert assembler.lost_frames == assembler.bad_chunks == 0


def test_chunks_say_their_place():
    payload = b"a" * 300 + b"b" * 300 + b"c" * 7
    head = codec.PointCloudChunk(chunk=codec.Chunk(sec=3, nsec=4, sequence=5))
    pairs = list(chunks.split(codec.DataType.POINT_CLOUD, 0, head, payload, 300))
    found = [codec.PointCloudChunk.unpack(data[:28]).chunk for _, data in pairs]
    places = [(0, 0), (1, 300), (2, 600)]
    assert found == [
        codec.Chunk(sec=3, nsec=4, sequence=5, index=i, count=3, offset=at, total=607)
        for i, at in places
    ]
    assert [data[28:] for _, data in pairs] == [b"a" * 300, b"b" * 300, b"c" * 7]
    lengths = [codec.Header.unpack(header).measurement_length for header, _ in pairs]
    assert lengths == [300, 300, 7]


def test_a_lost_chunk_loses_its_frame_alone():
    first, second = frame(b"a" * 1000, 300, 0), frame(b"b" * 1000, 300, 1)
    assembler = chunks.Assembler()
    wholes = [assembler.feed(*m) for m in first[1:] + second]
    assert [whole.payload for whole in wholes if whole] == [b"b" * 1000]
    assert assembler.lost_frames == 1


def test_a_late_chunk_of_the_frame_before_loses_no_other():
    first, second = frame(b"a" * 900, 300, 0), frame(b"b" * 900, 300, 1)
    assembler = chunks.Assembler()
    order = [first[0], first[1], second[0], first[2], second[1], second[2]]
    assert [whole.payload for whole in map(lambda m: assembler.feed(*m), order) if whole] == [
        b"b" * 900
    ]
    assert assembler.lost_frames == 1


def test_an_empty_cloud_is_a_frame():
    head = codec.PointCloudChunk()
    ((header, data),) = chunks.split(codec.DataType.POINT_CLOUD, 0, head, b"", 1600)
    whole = chunks.Assembler().feed(codec.Header.unpack(header), data)
    assert whole is not None and chunks.points_si(whole.payload) == []


def feed_at(offsets, total):
    """Feeds an assembler chunks of 100 bytes, a, b and so on, at these offsets; returns it and what it made."""
    assembler, count = chunks.Assembler(), len(offsets)
    header, wholes = codec.Header(msg_type=17, data_type=17), []
    for index, offset in enumerate(offsets):
        chunk = codec.Chunk(index=index, count=count, offset=offset, total=total)
        head = codec.ImageChunk(chunk=chunk, width=7, height=9)
        wholes.append(assembler.feed(header, head.pack() + b"abc"[index : index + 1] * 100))
    return assembler, [whole.payload for whole in wholes if whole]


def test_chunks_are_joined_by_their_offsets():
    assembler, wholes = feed_at((100, 0, 200), 300)
    assert wholes == [b"b" * 100 + b"a" * 100 + b"c" * 100] and assembler.bad_chunks == 0


@pytest.mark.parametrize(
    "offsets, total", [((0, 50, 200), 300), ((0, 0, 200), 300), ((0, 200), 300)]
)
def test_chunks_that_overlap_or_leave_a_hole_are_counted(offsets, total):
    assembler, wholes = feed_at(offsets, total)
    assert wholes == [] and (assembler.bad_chunks, assembler.lost_frames) == (1, 1)


@pytest.mark.parametrize(
    "fields, is_sound",
    [
        (dict(encoding=0, width=5, height=4), True),
        (dict(encoding=2, width=5, height=4, step=15), True),
        (dict(encoding=1, width=15, height=4, step=15), True),
        (dict(encoding=0, width=5, height=4, step=15), False),
        (dict(encoding=2, width=6, height=4, step=15), False),
        (dict(encoding=2, width=5, height=5, step=15), False),
        (dict(encoding=99, width=5, height=4, step=15), False),
        (dict(encoding=0, width=-3, height=4), False),
        (dict(encoding=99, width=-3, height=2**31 - 1, step=-3), False),
        (dict(encoding=1, width=-60, height=-1, step=-60), False),
    ],
)
def test_an_image_whose_head_does_not_fit_it_is_counted(fields, is_sound):
    head = codec.ImageChunk(**fields)
    ((header, data),) = chunks.split(codec.DataType.IMAGE, 0, head, bytes(60), 100)
    assembler = chunks.Assembler()
    whole = assembler.feed(codec.Header.unpack(header), data)
    assert (whole is not None, assembler.bad_chunks) == (is_sound, not is_sound)


def test_a_cloud_of_half_a_point_is_counted():
    ((header, data),) = chunks.split(
        codec.DataType.POINT_CLOUD, 0, codec.PointCloudChunk(), bytes(24), 100
    )
    assembler = chunks.Assembler()
    assert assembler.feed(codec.Header.unpack(header), data) is None
    assert assembler.bad_chunks == 1


def test_unsound_chunks_are_counted_and_bounded():
    rng = random.Random(3)
    assembler = chunks.Assembler()
    good = codec.ImageChunk.leaves
    for _ in range(5000):
        values = [rng.choice((-1, 0, 1, 5, 1000, 2**31 - 1, -(2**31))) for _ in good]
        head = codec.ImageChunk._from_values(iter(values))
        header = codec.Header(data_type=17, msg_type=17, component_id=rng.randrange(100))
        assembler.feed(header, head.pack() + b"x" * rng.choice((0, 1, 100)))
    assert assembler.bad_chunks > 1000
    assert len(assembler._frames) <= 16
