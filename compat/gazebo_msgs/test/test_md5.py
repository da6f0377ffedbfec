# SPDX-License-Identifier: MIT
"""The md5 sums of the stand-in are those a node built against the original sends in its connection header.

Source of the sums: the generated headers of `gazebo_msgs` in gazebo_ros_pkgs (noetic). They were
written down from there, not computed from the files beside this test; a sum of which we are not
sure is not listed. A service is listed by the sums of its request and of its response, or by that
of both together.
"""
import pathlib
from typing import Tuple

import genmsg
import genmsg.gentools
import genmsg.msg_loader
import pytest
import rospkg

PACKAGE = pathlib.Path(__file__).resolve().parents[1]

MESSAGES = {
    "ContactState": "48c0ffb054b8c444f870cecea1ee50d9",
    "ContactsState": "acbcb1601a8e525bf72509f18e6f668d",
    "LinkState": "0818ebbf28ce3a08d48ab1eaa7309ebe",
    "LinkStates": "48c080191eb15c41858319b4d8a609c2",
    "ModelState": "9330fd35f2fcd82d457e54bd54e10593",
    "ModelStates": "48c080191eb15c41858319b4d8a609c2",
    "ODEJointProperties": "1b744c32a920af979f53afe2f9c3511f",
    "ODEPhysics": "667d56ddbd547918c32d1934503dc335",
    "PerformanceMetrics": "884f71fd5037b886ec5e126b83c4425a",
    "SensorPerformanceMetric": "01762ded18cfe9ebc7c8222667c99547",
    "WorldState": "de1a9de3ab7ba97ac0e9ec01a4eb481e",
}

NOTHING = "d41d8cd98f00b204e9800998ecf8427e"  # md5 of no text
OUTCOME = "2ec6f3eff0161f4257b808b12bc830c2"  # bool success, string status_message
LIGHT_NAME = "4fb676dfb4741fc866365702a859441c"
MODEL_NAME = "ea31c8eab6fc401383cf528a7c0984ba"
SERVICES = {
    "ApplyBodyWrench": ("e37e6adf97eba5095baa77dffb71e5bd", OUTCOME),
    "ApplyJointEffort": ("2c3396ab9af67a509ecd2167a8fe41a2", OUTCOME),
    "BodyRequest": ("5eade9afe7f232d78005bd0cafeab755", NOTHING),
    "DeleteLight": (LIGHT_NAME, OUTCOME),
    "DeleteModel": (MODEL_NAME, OUTCOME),
    "GetLightProperties": (LIGHT_NAME, "9a19ddd5aab4c13b7643d1722c709f1f"),
    "GetModelState": ("19d412713cefe4a67437e17a951e759e", "ccd51739bb00f0141629e87b792e92b9"),
    "GetPhysicsProperties": (NOTHING, "575a5e74786981b7df2e3afc567693a6"),
    "GetWorldProperties": (NOTHING, "36bb0f2eccf4d8be971410c22818ba3f"),
    "SetJointProperties": ("331fd8f35fd27e3c1421175590258e26", OUTCOME),
    "SetJointTrajectory": ("649dd2eba5ffd358069238825f9f85ab", OUTCOME),
    "SetLinkProperties": ("68ac74a4be01b165bc305b5ccdc45e91", OUTCOME),
    "SetLinkState": ("22a2c757d56911b6f27868159e9a872d", OUTCOME),
    "SetModelState": ("cb042b0e91880f4661b29ea5b6234350", OUTCOME),
    "SpawnModel": ("6d0eba5753761cd57e6263a056b79930", OUTCOME),
}
WHOLE_SERVICES = {
    "GetJointProperties": "7b30be900f50aa21efec4a0ec92d91c9",
    "GetModelProperties": "5717f7bd34ed990fa80e28b3015027a3",
    "SetPhysicsProperties": "97e2057080558ce4730434b5fae75c91",
}


def search_path() -> dict:
    """Where the .msg files of the packages that these messages use lie."""
    path = {"gazebo_msgs": [str(PACKAGE / "msg")]}
    for name in ("geometry_msgs", "std_msgs", "trajectory_msgs"):
        path[name] = [str(pathlib.Path(rospkg.RosPack().get_path(name)) / "msg")]
    return path


def service_md5(name: str) -> Tuple[str, str, str]:
    """The md5 sums of a service: whole, request, response."""
    context = genmsg.MsgContext.create_default()
    file = PACKAGE / "srv" / f"{name}.srv"
    spec = genmsg.msg_loader.load_srv_from_file(context, str(file), f"gazebo_msgs/{name}")
    genmsg.msg_loader.load_depends(context, spec, search_path())
    whole, request, response = (
        genmsg.gentools.compute_md5(context, part) for part in (spec, spec.request, spec.response)
    )
    return whole, request, response


@pytest.mark.parametrize("name", MESSAGES)
def test_message(name: str) -> None:
    context = genmsg.MsgContext.create_default()
    file = PACKAGE / "msg" / f"{name}.msg"
    spec = genmsg.msg_loader.load_msg_from_file(context, str(file), f"gazebo_msgs/{name}")
    genmsg.msg_loader.load_depends(context, spec, search_path())
    assert genmsg.gentools.compute_md5(context, spec) == MESSAGES[name]


@pytest.mark.parametrize("name", SERVICES)
def test_request_and_response(name: str) -> None:
    assert service_md5(name)[1:] == SERVICES[name]


@pytest.mark.parametrize("name", WHOLE_SERVICES)
def test_whole_service(name: str) -> None:
    assert service_md5(name)[0] == WHOLE_SERVICES[name]
