# SPDX-License-Identifier: MIT
# Where a python3 without ROS comes first on PATH, put the system's first: ROS tools start with `env python3`.
if ! python3 -c 'import rospkg, catkin_pkg' >/dev/null 2>&1 && /usr/bin/python3 -c 'import rospkg' >/dev/null 2>&1; then
  export PATH="/usr/bin:$PATH"
fi
