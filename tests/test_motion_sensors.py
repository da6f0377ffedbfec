# SPDX-License-Identifier: MIT
"""Tests GPS, IMU, magnetometer and ground truth over ROS: topics, rates, services, dynamic_reconfigure, geofences."""
import math
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Any, Dict, Iterator, List

import probes
import pytest
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3

from ardee_common.ros_graph import RosGraph, wait_until
from geographic_msgs.msg import GeoPoint, GeoPose

SCRIPTS = pathlib.Path(__file__).resolve().parents[1] / "scripts"
G_M_S2, LATITUDE_DEG, LONGITUDE_DEG = 9.81, 40.1, -88.2
GPS = """
  <plugin name="gps" filename="libhector_gazebo_ros_gps.so">
    <updateRate>10</updateRate><topicName>gps</topicName><velocityTopicName>gps/velocity</velocityTopicName>
    <referenceLatitude>40.1</referenceLatitude><referenceLongitude>-88.2</referenceLongitude>
    <referenceHeading>90</referenceHeading><frameId>mast</frameId></plugin>
"""
IMU = """
  <plugin name="imu" filename="libhector_gazebo_ros_imu.so"><topicName>imu</topicName><updateRate>50</updateRate>
    <rateDriftFrequency>0</rateDriftFrequency></plugin>
  <plugin name="stock" filename="libgazebo_ros_imu.so"><bodyName>mast</bodyName><topicName>stock</topicName>
    <serviceName>stock/calibrate</serviceName></plugin>
  <plugin name="field" filename="libhector_gazebo_ros_magnetic.so"><updateRate>20</updateRate></plugin>
  <plugin name="truth" filename="libgazebo_ros_p3d.so"><bodyName>mast</bodyName><topicName>truth</topicName>
    <updateRate>25</updateRate></plugin>
"""
DROPOUT = """
  <plugin name="dropout" filename="libgazebo_ros_gps_with_dropout.so"><topicName>{topic}/fix</topicName>
    <velocityTopicName>{topic}/fix_velocity</velocityTopicName><updateRate>10</updateRate>{keys}</plugin>
"""
PLOT = """
  <field_gps_noise_characteristics><biomass_height_noise_coefficient><r1>1</r1><r2>-1</r2><mean>1</mean>
    <variance>1</variance><correlated_std>2.5</correlated_std></biomass_height_noise_coefficient>
  </field_gps_noise_characteristics>
  <plot><plot_id>4</plot_id><x>0</x><y>0</y><z>0</z><rotation>0</rotation><row_count>4</row_count>
    <row_width>1</row_width><row_length>9</row_length><average_height>2</average_height></plot>
"""
SENSOR = """
  <sensor name="board" type="imu"><update_rate>100</update_rate>
    <plugin name="board" filename="libgazebo_ros_imu_sensor.so"><topicName>board</topicName><frameName>mast</frameName>
      <updateRateHZ>40</updateRateHZ></plugin></sensor>
"""
POST = """<model name="{name}"><static>true</static><pose>{x} {y} {z} 0 0 0</pose>
  <link name="mast">{sensor}</link>{plugins}</model>"""
WORLD = """<sdf version="1.6"><world name="default"><gravity>0 0 -9.81</gravity>
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>{}</world></sdf>"""
TOPICS = {  # type and rate, Hz of simulated time
    "/gps": ("sensor_msgs/NavSatFix", 10.0),
    "/gps/velocity": ("geometry_msgs/Vector3Stamped", 10.0),
    "/imu": ("sensor_msgs/Imu", 50.0),
    "/imu/bias": ("sensor_msgs/Imu", 50.0),
    "/stock": ("sensor_msgs/Imu", 200.0),
    "/board": ("sensor_msgs/Imu", 40.0),
    "/magnetic": ("geometry_msgs/Vector3Stamped", 20.0),
    "/truth": ("nav_msgs/Odometry", 25.0),
    "/crop/fix": ("sensor_msgs/NavSatFix", 10.0),
    "/crop/fix_velocity": ("geometry_msgs/Vector3Stamped", 10.0),
    "/crop/data": ("ardee_msgs/GpsQuality", 10.0),
}


@pytest.fixture(scope="module")
def post(tmp_path_factory: pytest.TempPathFactory, shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields a simulator with one post that carries every motion sensor."""
    plugins = GPS + IMU + DROPOUT.format(topic="crop", keys=PLOT)
    world = shared_graph.folder / "post.world"
    robot = POST.format(name="post", x=1, y=0.5, z=1, sensor=SENSOR, plugins=plugins)
    world.write_text(WORLD.format(robot))
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(world))
    shared_graph.call(probes.clock_at_least, 0.1)
    yield shared_graph


def listen(topics: Dict[str, str], count: int) -> Dict[str, List[Any]]:
    """Returns, as a probe, the next messages of several topics, `count` of each."""
    import rospy

    probes._start()
    found = {topic: [] for topic in topics}  # type: Dict[str, List[Any]]
    for topic, kind in topics.items():
        rospy.Subscriber(topic, probes._type(kind), found[topic].append, queue_size=1000)
    wait_until(lambda: min(map(len, found.values())) >= count, f"{count} of each of {topics}")
    return found


def reconfigure(server: str, change: Dict[str, Any]) -> Dict[str, Any]:
    """Returns, as a probe, the answer to a dynamic_reconfigure client after a change, with its settable values."""
    from dynamic_reconfigure.client import Client

    probes._start()
    client = Client(server, timeout=20)
    kinds = {each["name"]: each["type"] for each in client.get_parameter_descriptions()}
    told = dict(client.update_configuration(change))
    client.close()
    told.pop("groups", None)
    return {name: (kinds[name], value) for name, value in told.items()}


def one(graph: RosGraph, topic: str) -> Any:
    """Returns a message of a topic after the next few, which are older."""
    return graph.call(probes.collect, topic, TOPICS[topic][0], 5)[-1]


def test_every_topic_has_its_type_and_rate(post: RosGraph) -> None:
    types = post.call(probes.topics)
    expected = {topic: kind for topic, (kind, _) in TOPICS.items()}
    assert {topic: types.get(topic) for topic in expected} == expected
    messages = post.call(listen, expected, 12)
    for topic, (_, rate_hz) in TOPICS.items():
        stamps_ns = [message.header.stamp.to_nsec() for message in messages[topic]]
        steps_ns = {after - before for before, after in zip(stamps_ns, stamps_ns[1:])}
        assert steps_ns == {round(1e9 / rate_hz)}, topic


def test_values_at_rest(post: RosGraph) -> None:
    messages = post.call(listen, {topic: kind for topic, (kind, _) in TOPICS.items()}, 1)
    imu, stock, board = (messages[topic][0] for topic in ("/imu", "/stock", "/board"))
    assert imu.linear_acceleration.z == pytest.approx(G_M_S2, abs=1e-9)
    assert board.linear_acceleration.z == pytest.approx(G_M_S2, abs=1e-9)
    assert stock.linear_acceleration.z == pytest.approx(0.0, abs=1e-9)
    fix = messages["/gps"][0]
    assert fix.status.status == 0 and fix.header.frame_id == "mast"
    metres_a_degree = 6378137.0 * math.pi / 180.0
    assert (fix.latitude - LATITUDE_DEG) * metres_a_degree == pytest.approx(0.5, rel=0.01)
    east_m = (fix.longitude - LONGITUDE_DEG) * metres_a_degree * math.cos(math.radians(40.1))
    assert east_m == pytest.approx(1.0, rel=0.01)
    field = messages["/magnetic"][0].vector
    assert (field.x, field.z) == pytest.approx((0.5, -math.sqrt(0.75)))
    assert messages["/truth"][0].pose.pose.position.x == pytest.approx(1.0)
    quality = messages["/crop/data"][0]
    assert quality.region == "plot 4" and quality.position_std == pytest.approx(2.5)


def test_bias_services_and_calibrate(post: RosGraph) -> None:
    bias = {"bias": Vector3(0.1, 0.0, -0.2)}
    kind = "hector_gazebo_plugins/SetBias"
    post.call(probes.call_service, "/imu/set_rate_bias", kind, bias)
    rate = one(post, "/imu").angular_velocity
    assert (rate.x, rate.z) == pytest.approx((0.1, -0.2))
    assert one(post, "/imu/bias").angular_velocity.x == pytest.approx(0.1)
    post.call(probes.call_service, "/imu/calibrate", "std_srvs/Empty", {})
    assert one(post, "/imu").angular_velocity.x == pytest.approx(0.0)
    post.call(probes.call_service, "/stock/calibrate", "std_srvs/Empty", {})


def test_dynamic_reconfigure_of_noise_and_status(post: RosGraph) -> None:
    told = post.call(reconfigure, "/imu/accel", {"offset": 0.5})
    names = {"gaussian_noise", "offset", "drift", "drift_frequency", "scale_error"}
    assert set(told) == names and told["offset"] == ("double", 0.5)
    assert one(post, "/imu").linear_acceleration.z == pytest.approx(G_M_S2 + 0.5)
    told = post.call(reconfigure, "/gps/status", {"STATUS_FIX": False, "SERVICE_GPS": True})
    assert told["STATUS_FIX"] == ("bool", False) and told["SERVICE_GPS"] == ("bool", True)
    fix = one(post, "/gps")
    assert (fix.status.status, fix.status.service) == (-1, 1)
    assert post.call(reconfigure, "/gps/position", {"offset": 50.0})["offset"][1] == 10.0
    assert set(post.call(reconfigure, "/gps/velocity", {})) == names
    assert set(post.call(reconfigure, "/magnetic", {})) == names
    post.call(reconfigure, "/gps/status", {"STATUS_FIX": True})


def test_reference_geopose_is_set(post: RosGraph) -> None:
    pose = GeoPose(GeoPoint(52.0, 6.0, 3.0), Quaternion(0, 0, 0, 1))
    kind = "hector_gazebo_plugins/SetReferenceGeoPose"
    post.call(probes.call_service, "/gps/set_reference_geopose", kind, {"geo_pose": pose})
    fix = one(post, "/gps")
    assert fix.latitude == pytest.approx(52.0, abs=1e-3)
    assert fix.longitude == pytest.approx(6.0, abs=1e-3)


def test_regions_are_shown_to_who_comes_late(post: RosGraph) -> None:
    markers = post.call(probes.collect, "/crop/regions", "visualization_msgs/MarkerArray", 1)[0]
    boxes = [each for each in markers.markers if each.ns == "regions"]
    assert len(boxes) == 1 and boxes[0].header.frame_id == "world"
    assert (boxes[0].scale.x, boxes[0].scale.y) == pytest.approx((9.0, 4.0))


def test_a_geofence_reaches_the_robot_from_run_custom_world(graph: RosGraph) -> None:
    fence = graph.folder / "mine.geofence"
    fence.write_text(
        "<robot><field_gps_noise_characteristics><biomass_height_noise_coefficient><r1>0</r1><r2>-1</r2>"
        "<mean>1</mean><variance>1</variance><correlated_std>3.21</correlated_std>"
        "</biomass_height_noise_coefficient></field_gps_noise_characteristics></robot>"
    )
    kept = graph.folder / "kept"
    field, terrain = "ardee_world/urdf/corn_plot.urdf.xacro", "ardee_models/heightmap_ground"
    script = str(SCRIPTS / "run_custom_world")
    graph.spawn(
        script, "-y", "-o", str(kept), field, terrain, str(fence), "use_rviz:=false", "rtf:=1"
    )
    graph.call(probes.wait_for_topics, ["/odom"], [])
    plots = ElementTree.parse(kept / "models" / "custom_field" / "plots.xacro").getroot()
    plot = plots.find("plot")
    x, y, z = (float(plot.find(key).text) for key in "xyz")
    answers = graph.call(
        probes.call_services,
        [
            spawn("inside", x, y, z + 0.2),
            spawn("outside", x + 500.0, y, z + 0.2),
        ],
    )
    assert [each.success for each in answers] == [True, True]
    kind = "ardee_msgs/GpsQuality"
    inside = graph.call(probes.collect, "/inside/data", kind, 2)[-1]
    assert inside.region == f"plot {plot.find('plot_id').text}"
    assert inside.position_std == pytest.approx(3.21)
    outside = graph.call(probes.collect, "/outside/data", kind, 2)[-1]
    assert (outside.region, outside.position_std) == ("", 0.0)


def spawn(name: str, x: float, y: float, z: float) -> Any:
    """Returns the call that spawns a post with a variable-accuracy GPS."""
    model = POST.format(
        name=name, x=0, y=0, z=0, sensor="", plugins=DROPOUT.format(topic=name, keys="")
    )
    fields = {
        "model_name": name,
        "model_xml": f"<sdf version='1.6'>{model}</sdf>",
        "initial_pose": Pose(Point(x, y, z), Quaternion(0, 0, 0, 1)),
        "reference_frame": "world",
    }
    return ("/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel", fields)
