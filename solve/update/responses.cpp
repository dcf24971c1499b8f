// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/responses.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solve/arrays/shared_work.hpp"
#include "solve/ensemble/each.hpp"
#include "solve/ensemble/relax_together.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t most_waves = 16;  // a direction
constexpr double wave_width = 0.8;      // of the opening's radius of gyration: of bells that a change is a sum of
constexpr double like_the_load = 10;    // variance of a change that fades as the load does, over that of any other
constexpr double amplitude = 0.2;       // mm, at the node where a wave is largest: for the first order
constexpr double closer = 0.02;         // stop, over the tolerance: a response is multiplied by up to 1 mm / amplitude
constexpr std::size_t most_nodes = 1500;  // waves over n nodes take n³ operations
constexpr int most_steps = 1500;          // that a response is worth

/// The likeliest first. A change is smooth over the opening, and more of it goes with the load than not: it is larger
/// where the load is. The waves are its principal components.
Eigen::MatrixXd waves_over(const std::vector<std::int32_t>& nodes, const Points& positions, const Points& prescribed) {
  const Points places = positions(nodes, Eigen::all);
  const Points loads = prescribed(nodes, Eigen::all);
  const Eigen::VectorXd sizes = loads.array().isNaN().select(0, loads.array()).matrix().rowwise().norm();
  const double largest = sizes.maxCoeff();
  const Eigen::VectorXd share = largest > 0 ? Eigen::VectorXd(sizes / largest) : sizes;
  const double gyration = std::sqrt((places.rowwise() - places.colwise().mean()).rowwise().squaredNorm().mean());
  const double width = gyration > 0 ? wave_width * gyration : 1;
  const auto count = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd covariance(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::ArrayXd distance = (places.rowwise() - places.row(i)).rowwise().squaredNorm() / (2 * width * width);
    covariance.col(i) = ((-distance).exp() * (1 + like_the_load * share[i] * share.array())).matrix();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(covariance);
  return principal.eigenvectors().rowwise().reverse().leftCols(std::min(count, static_cast<Eigen::Index>(most_waves)));
}

/// One wave along one axis.
struct Column {
  std::size_t wave, axis;
  double size;  ///< mm that the wave is multiplied by
};

Member loaded_by(const Column& column, const Responses& responses, const KeptBody& kept, const Points& prescribed) {
  Points changed = prescribed;
  for (std::size_t i = 0; i < responses.nodes.size(); ++i) {
    changed(responses.nodes[i], static_cast<Eigen::Index>(column.axis)) +=
        column.size * responses.waves[column.wave * responses.nodes.size() + i];
  }
  return {.laws = kept.body.laws,
          .external = kept.body.external,
          .prescribed = changed(kept.body.original, Eigen::all),
          .start = kept.parameters};
}

std::vector<Column> columns_of(const Eigen::MatrixXd& waves) {
  std::vector<Column> columns;
  for (Eigen::Index w = 0; w < waves.cols(); ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns.push_back({static_cast<std::size_t>(w), axis, amplitude / waves.col(w).cwiseAbs().maxCoeff()});
    }
  }
  return columns;
}

/// now: û under the column; empty where it has not come to rest.
void note_response(const NodalVectors& now, const KeptBody& kept, const Column& column, Responses& responses) {
  float* const response = responses.parameters.data() + (3 * column.wave + column.axis) * 3 * kept.body.nodes();
  for (std::size_t a = 0; a < now.size() / 4; ++a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      response[3 * a + axis] = static_cast<float>((now[4 * a + axis] - kept.parameters[4 * a + axis]) / column.size);
    }
  }
}

/// A wave without all of its responses counts as unknown.
void keep_whole_waves(const std::vector<bool>& whole, Responses& responses) {
  const std::size_t nodes = responses.nodes.size(), size = responses.parameters.size() / whole.size();
  std::size_t kept = 0;
  for (std::size_t w = 0; w < whole.size(); ++w) {
    if (whole[w]) {
      std::copy_n(responses.waves.data() + w * nodes, nodes, responses.waves.data() + kept * nodes);
      std::copy_n(responses.parameters.data() + w * size, size, responses.parameters.data() + kept * size);
      ++kept;
    }
  }
  responses.waves.resize(kept * nodes);
  responses.parameters.resize(kept * size);
}

}  // namespace

std::vector<std::int32_t> loaded_nodes(const Points& prescribed) {
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    if (is_loaded(prescribed, a)) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

Responses responses_of(const KeptBody& kept, const Points& prescribed, const SolveOptions& given,
                       const Progress& progress) {
  Responses responses{.nodes = loaded_nodes(prescribed), .waves = {}, .parameters = {}};
  if (responses.nodes.empty() || responses.nodes.size() > most_nodes) {
    return {};
  }
  const Eigen::MatrixXd waves = waves_over(responses.nodes, kept.body.positions, prescribed);
  responses.waves.assign(waves.data(), waves.data() + waves.size());
  responses.parameters.assign(responses.count() * 9 * kept.body.nodes(), 0.0F);
  SolveOptions options = given;
  options.tolerance *= closer;
  options.max_steps = std::min(options.max_steps, most_steps);
  options.snapshot_every = 0;
  const std::vector<Column> columns = columns_of(waves);
  std::vector<bool> whole(responses.count(), true);
  for (std::size_t first = 0; first < columns.size(); first += members) {
    report(progress, static_cast<double>(first) / static_cast<double>(columns.size()), "responses to changes");
    const std::size_t last = std::min(first + members, columns.size());
    std::vector<Member> loads;
    for (std::size_t c = first; c < last; ++c) {
      loads.push_back(loaded_by(columns[c], responses, kept, prescribed));
    }
    if (!may_go_together(kept.body, loads, options)) {
      return {};
    }
    const std::vector<MemberResult> moved =
        relax_together(kept.body, loads, {}, options, {}, true, BoundOf::parameters);
    for (std::size_t c = first; c < last; ++c) {
      note_response(moved[c - first].parameters, kept, columns[c], responses);
      whole[columns[c].wave] = whole[columns[c].wave] && !moved[c - first].parameters.empty();
    }
  }
  keep_whole_waves(whole, responses);
  return responses;
}

NodalVectors answered(const NodalVectors& at_rest, const Responses& responses, const Points& change) {
  const auto count = static_cast<Eigen::Index>(responses.count()),
             loaded = static_cast<Eigen::Index>(responses.nodes.size());
  const Eigen::Map<const Eigen::MatrixXd> waves(responses.waves.data(), loaded, count);
  const Eigen::MatrixXd shares = change(responses.nodes, Eigen::all).transpose() * waves;  // (3 × waves)
  const auto nodes = static_cast<Eigen::Index>(at_rest.size() / 4);
  const Eigen::Map<const Eigen::MatrixXf> of_waves(responses.parameters.data(), 3 * nodes, 3 * count);
  const Eigen::VectorXf of_shares = Eigen::Map<const Eigen::VectorXd>(shares.data(), shares.size()).cast<float>();
  NodalVectors parameters = at_rest;
  Eigen::Map<Eigen::Matrix4Xd> sum(parameters.data(), 4, nodes);
  share_work((nodes + nodes_a_part - 1) / nodes_a_part, 1, [&](std::int64_t part) {
    const Eigen::Index first = part * nodes_a_part, size = std::min(nodes_a_part, nodes - first);
    const Eigen::VectorXf change_of_part = of_waves.middleRows(3 * first, 3 * size) * of_shares;
    sum.middleCols(first, size).topRows<3>() +=
        Eigen::Map<const Eigen::Matrix3Xf>(change_of_part.data(), 3, size).cast<double>();
  });
  return parameters;
}

}  // namespace brainshift::solve
