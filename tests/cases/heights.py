# SPDX-License-Identifier: MIT
"""Measures heights of a model of this folder by vertical rays."""
import pathlib
from typing import List, Sequence, Tuple

import probes
from gazebo_calls import call, pose, spawn

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"
ABOVE_M = 20.0
SENSOR = """<sensor name="ray_{k}" type="ray"><pose>{x} {y} 0 0 1.5707963267948966 0</pose>
<update_rate>20</update_rate><ray><scan><horizontal><samples>1</samples></horizontal></scan>
<range><min>0.1</min><max>30</max></range></ray><plugin name="ray_{k}" filename="libgazebo_ros_range.so">
<topicName>ray_{k}</topicName></plugin></sensor>"""


def heights_of(graph: RosGraph, model: str, places: Sequence[Tuple[float, float]]) -> List[float]:
    """Returns heights [m] of a model's collision shapes at places x, y [m], above or on level ground at 0."""
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    file = CASES / model
    sensors = "".join(SENSOR.format(k=k, x=x, y=y) for k, (x, y) in enumerate(places))
    mast = f"""<sdf version="1.6"><model name="mast"><static>true</static><pose>0 0 {ABOVE_M} 0 0 0</pose>
<link name="l">{sensors}</link></model></sdf>"""
    models = {"case": file.read_text().replace("DIR", str(file.parent)), "mast": mast}
    for answer in call(graph, *(spawn(*model, pose()) for model in models.items())):
        assert answer.success, answer.status_message
    topics = [f"/ray_{k}" for k in range(len(places))]
    ranges = [graph.call(probes.collect, topic, "sensor_msgs/Range", 1)[0] for topic in topics]
    return [ABOVE_M - message.range for message in ranges]
