// SPDX-License-Identifier: MIT
#include "ros/simulator_node.h"

int main(int argc, char** argv) { return ardee::node::run_simulator(argc, argv); }
