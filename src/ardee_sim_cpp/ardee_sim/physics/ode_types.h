// SPDX-License-Identifier: MIT
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <memory>

#include "ardee_sim/core/pose.h"

namespace ardee::physics {

struct OdeDeleter {
  void operator()(dxThreadingImplementation* threads) const {
    dThreadingFreeImplementation(threads);
  }
  void operator()(dxWorld* world) const { dWorldDestroy(world); }
  void operator()(dxBody* body) const { dBodyDestroy(body); }
  void operator()(dxJoint* joint) const { dJointDestroy(joint); }
  void operator()(dxJointGroup* group) const { dJointGroupDestroy(group); }
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
  void operator()(dxTriMeshData* data) const { dGeomTriMeshDataDestroy(data); }
};
using ThreadingHandle = std::unique_ptr<dxThreadingImplementation, OdeDeleter>;
using WorldHandle = std::unique_ptr<dxWorld, OdeDeleter>;
using BodyHandle = std::unique_ptr<dxBody, OdeDeleter>;
using JointHandle = std::unique_ptr<dxJoint, OdeDeleter>;
using JointGroupHandle = std::unique_ptr<dxJointGroup, OdeDeleter>;
using GeomHandle = std::unique_ptr<dxGeom, OdeDeleter>;
using TriMeshDataHandle = std::unique_ptr<dxTriMeshData, OdeDeleter>;

inline Eigen::Vector3d to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Eigen::Quaterniond to_quaternion(const dReal* q) { return {q[0], q[1], q[2], q[3]}; }

inline Pose body_pose(dBodyID body) {
  return {to_vector(dBodyGetPosition(body)), to_quaternion(dBodyGetQuaternion(body))};
}

inline void set_body_pose(dBodyID body, const Pose& X_WB) {
  const dQuaternion q = {X_WB.q.w(), X_WB.q.x(), X_WB.q.y(), X_WB.q.z()};
  dBodySetPosition(body, X_WB.p.x(), X_WB.p.y(), X_WB.p.z());
  dBodySetQuaternion(body, q);
}

inline Eigen::AlignedBox3d geom_bounds(dGeomID geom) {
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  return {Eigen::Vector3d(aabb[0], aabb[2], aabb[4]), Eigen::Vector3d(aabb[1], aabb[3], aabb[5])};
}

/// Row-major 3 x 4 rotation, ODE's layout.
inline Eigen::Matrix3d to_matrix(const dReal* r) {
  Eigen::Matrix3d m;
  m << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return m;
}

}  // namespace ardee::physics
