// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joint_coupling.h"

#include <Eigen/Dense>
#include <algorithm>

namespace ardee::physics {
namespace {

constexpr double kErp = 0.2;            // share of an error that a step takes away
constexpr double kFastest = 1.0;        // rad/s or m/s: greatest rate of correction
constexpr double kTrialImpulse = 1e-6;  // N m s or N s
constexpr double kLeastExcess = 1e-9;   // rad/s or m/s
constexpr double kSoftness = 1e-6;      // rad/s per N m s, or the linear equivalent
constexpr int kMostCorrections = 8;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

double JointCoupling::excess(double step_s) const {
  const double error = follower_->position() - wanted();
  const double back = std::clamp(kErp * error / step_s, -kFastest, kFastest);
  return follower_->velocity() - coupling_.multiplier * leader_->velocity() + back;
}

void JointCoupling::push(double impulse_now, double step_s) const {
  follower_->push(impulse_now / step_s);
  leader_->push(-coupling_.multiplier * impulse_now / step_s);
}

double JointCoupling::clamp(double impulse_now, double step_s) const {
  const double most = coupling_.max_effort * step_s;
  return std::clamp(impulse_now, -most, most);
}

void step_coupled(const std::vector<JointCoupling*>& couplings, const std::vector<dBodyID>& bodies,
                  double step_s, const std::function<void()>& step) {
  const std::size_t count = couplings.size();
  BodyStates before;
  before.save(bodies);
  const auto excess_with = [&](const Eigen::VectorXd& impulses) {
    before.restore();
    for (std::size_t i = 0; i < count; ++i) couplings[i]->push(impulses[index(i)], step_s);
    step();
    Eigen::VectorXd excess(index(count));
    for (std::size_t i = 0; i < count; ++i) excess[index(i)] = couplings[i]->excess(step_s);
    return excess;
  };
  Eigen::VectorXd impulses(index(count));
  for (std::size_t i = 0; i < count; ++i) impulses[index(i)] = couplings[i]->impulse;
  const Eigen::VectorXd first = excess_with(impulses);
  Eigen::MatrixXd mobility(index(count), index(count));
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::VectorXd trial = impulses;
    trial[index(i)] += kTrialImpulse;
    mobility.col(index(i)) = (excess_with(trial) - first) / kTrialImpulse;
  }
  mobility.diagonal().array() += kSoftness;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(mobility);
  Eigen::VectorXd least = first;
  double share = 1.0;
  bool is_best = false;
  for (int i = 0; i < kMostCorrections && !(is_best && least.norm() < kLeastExcess); ++i) {
    Eigen::VectorXd wanted = impulses - share * solver.solve(least);
    for (std::size_t k = 0; k < count; ++k) {
      wanted[index(k)] = couplings[k]->clamp(wanted[index(k)], step_s);
    }
    if (wanted == impulses) break;
    const Eigen::VectorXd excess = excess_with(wanted);
    is_best = excess.norm() < least.norm();
    if (is_best) {
      impulses = wanted;
      least = excess;
    } else {
      share *= 0.5;  // a contact appeared, ended or slipped
    }
  }
  if (!is_best) excess_with(impulses);
  for (std::size_t i = 0; i < count; ++i) couplings[i]->impulse = impulses[index(i)];
}

}  // namespace ardee::physics
