// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty/sample.hpp"

#include "solve/device/backend.hpp"
#include "solve/ensemble/each.hpp"
#include "solve/interface/unfit_parts.hpp"
#include "solve/measured/weight.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/together.hpp"

namespace brainshift::solve {

void check_sampled(const Model& model, const SolveOptions& options) {
  refuse_unfit("<uncertainty> does not go", beyond_rest(model, options), "leave the one or the other out");
}

std::vector<std::optional<Points>> sampled_displacements(const Model& model, const SolveOptions& given,
                                                         std::span<const Constants> constants,
                                                         const Progress& progress) {
  check_sampled(model, given);
  SolveOptions options = completed(given, model);
  options.snapshot_every = 0;
  return model.cloud.size() > most_sampled_nodes ? coarse_displacements(model, options, constants, progress)
                                                 : whole_displacements(model, options, constants, progress);
}

std::size_t samples_at_once(const SolveOptions& options) {
  constexpr std::size_t on_gpu = 256;
  return options.device != Device::cpu && device::gpu() != nullptr ? on_gpu : members;
}

Eigen::MatrixXd spread_about(const Points& answer, const std::vector<Points>& samples) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(answer.rows(), 6);
  for (const Points& sample : samples) {
    for (Eigen::Index a = 0; a < answer.rows(); ++a) {
      const Eigen::Vector3d off = sample.row(a) - answer.row(a);
      sum.row(a) += six_entries(off * off.transpose());
    }
  }
  return samples.empty() ? sum : Eigen::MatrixXd(sum / static_cast<double>(samples.size()));
}

}  // namespace brainshift::solve
