// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/uncertainty.hpp"

#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <span>
#include <stdexcept>

#include "pipelines/runner/sampler.hpp"
#include "register/field/nodal_values.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/run/measured_covariance.hpp"
#include "solve/uncertainty/draw.hpp"
#include "solve/uncertainty/sample.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

double root_mean_square(const Points& difference) {
  return std::sqrt(difference.squaredNorm() / static_cast<double>(difference.rows()));
}

/// 0: the model's own constants; then the draws of this share.
std::vector<int> sample_numbers(const solve::UncertaintyOptions& options) {
  std::vector<int> numbers = {0};
  for (int sample = options.share; sample <= options.samples; sample += options.shares) {
    numbers.push_back(sample);
  }
  return numbers;
}

Eigen::MatrixXd spread_of_constants(const UncertaintyJob& job, const Solved& solved, const fs::path& out,
                                    StageReport& said, const Progress& progress) {
  const solve::UncertaintyOptions& options = job.options;
  const solve::Constants own{solved.model.materials, solved.model.gravity, solved.model.fluid};
  Sampler sampler(solved.model, solved.options, solved.result, SampleFolder(job.samples, out));
  SampleTable table(out / "samples.csv", own);
  std::optional<Points> answer;
  std::vector<Points> samples;
  const std::vector<int> numbers = sample_numbers(options);
  // They are kept when all that are asked for at once are there.
  const std::size_t together = solve::samples_at_once(solved.options) + 1;  // beside the model's own constants
  for (std::size_t begin = 0; begin < numbers.size(); begin += together) {
    const auto group = std::span(numbers).subspan(begin, std::min(together, numbers.size() - begin));
    std::vector<solve::Constants> constants;
    for (const int sample : group) {
      constants.push_back(sample == 0 ? own : solve::drawn_constants(solved.model, options, sample));
    }
    const auto all = static_cast<double>(numbers.size()), before = static_cast<double>(begin);
    const Progress of_these = part_of(progress, before / all, (before + static_cast<double>(group.size())) / all);
    std::vector<std::optional<Points>> found = sampler.displacements(constants, of_these);
    if (begin == 0 && !(answer = std::move(found.front()))) {
      throw std::runtime_error("the model could not be solved once more for its samples; leave <uncertainty> out");
    }
    for (std::size_t i = begin == 0 ? 1 : 0; i < group.size(); ++i) {
      if (found[i]) {
        table.add(group[i], constants[i], root_mean_square(*found[i] - *answer));
        samples.push_back(std::move(*found[i]));
      }
    }
  }
  table.close();
  if (options.shares == 1) {  // else others may be of other shares
    sampler.clear_others();
  }
  said.measures["uncertainty"]["samples"] = samples.size();
  const std::size_t drawn = numbers.size() - 1;
  if (drawn == 0) {
    said.notes.push_back("warning: share " + std::to_string(options.share) + " has none of the " +
                         std::to_string(options.samples) + " samples: that its uncertainty is 0 says nothing");
  } else if (samples.empty()) {
    throw std::runtime_error(
        "none of the " + std::to_string(drawn) +
        " samples could be solved, so nothing is known of the uncertainty; leave <uncertainty> out "
        "or let it vary less");
  }
  if (const std::size_t failed = drawn - samples.size(); failed > 0) {
    said.notes.push_back("warning: " + std::to_string(failed) + " of " + std::to_string(drawn) +
                         " samples could not be solved and are left out of the uncertainty; see samples.csv");
  }
  return solve::spread_about(*answer, samples);
}

/// Of the whole and of each tissue, root mean square over its nodes, mm.
void add_words(const UncertaintyJob& job, const solve::Model& model, const std::vector<double>& deviation,
               StageReport& said) {
  struct Sum {
    double squares = 0, count = 0;
  };
  Sum brain;
  std::map<std::int32_t, Sum> tissues;
  for (std::size_t a = 0; a < deviation.size(); ++a) {
    const Eigen::Vector3d place = model.cloud.positions.row(static_cast<Eigen::Index>(a));
    const auto label = model.labels ? std::int32_t{label_at(*model.labels, place)} : 0;
    for (Sum* sum : {&brain, &tissues[label]}) {
      sum->squares += deviation[a] * deviation[a];
      sum->count += 1;
    }
  }
  auto& words = said.measures["uncertainty"];
  words["brain_mm"] = std::sqrt(brain.squares / brain.count);
  for (const auto& [label, name] : job.tissues) {
    if (const auto found = tissues.find(label); found != tissues.end()) {
      words["tissues_mm"][name] = std::sqrt(found->second.squares / found->second.count);
    }
  }
}

void write_nodes(const fs::path& file, const Points& positions, const Spread& spread) {
  const auto grid = vtu::vertex_grid(positions);
  vtkPointData& data = *grid->GetPointData();
  const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> covariance = spread.noise + spread.constants;
  vtu::add_array(data, "uncertainty", deviations(covariance));
  vtu::add_array(data, "from_noise", deviations(spread.noise));
  vtu::add_array(data, "from_constants", deviations(spread.constants));
  vtu::add_array(data, "covariance", {covariance.data(), static_cast<std::size_t>(covariance.size())}, 6);
  vtu::write(file, *grid);
}

}  // namespace

Spread write_spread(const UncertaintyJob& job, const Solved& solved, const fs::path& out, StageReport& said,
                    const Progress& progress) {
  solve::check_sampled(solved.model, solved.options);
  const Points& positions = solved.result.solution.positions;
  Spread spread{Eigen::MatrixXd::Zero(positions.rows(), 6), Eigen::MatrixXd::Zero(positions.rows(), 6)};
  if (solved.result.measures.measured) {
    spread.noise = solve::measured_covariance(solved.model, solved.options, *solved.result.measures.measured,
                                              solved.result.solution.displacement);
  }
  if (solve::varies(solved.model, job.options)) {
    spread.constants = spread_of_constants(job, solved, out, said, progress);
  }
  write_nodes(out / "uncertainty.vtu", positions, spread);
  add_words(job, solved.model, deviations(spread.noise + spread.constants), said);
  return spread;
}

void write_covariance(const fs::path& file, const Points& places, const solve::SolveResult& result,
                      const Eigen::MatrixXd& constants) {
  const bool known = constants.rows() == 0;
  Eigen::MatrixXd covariance = registration::nodal_values_at(
      result.solution, known ? Eigen::MatrixXd::Zero(result.solution.positions.rows(), 6) : constants, false, places,
      std::numeric_limits<double>::quiet_NaN());
  if (result.measures.measured) {
    covariance += result.measures.measured->covariance;
  }
  std::ofstream stream(file);
  stream << "# frame: LPS\n"
         << (known ? "# of the load's noise alone: constants are taken as known\n" : "") << "x,y,z,xx,yy,zz,xy,yz,zx\n";
  for (Eigen::Index row = 0; row < places.rows(); ++row) {
    stream << write_number(places(row, 0)) << ',' << write_number(places(row, 1)) << ','
           << write_number(places(row, 2));
    for (const double entry : covariance.row(row)) {
      stream << ',';
      if (std::isfinite(entry)) {
        stream << entry;
      }
    }
    stream << '\n';
  }
  if (!stream.flush()) {
    fail_to_write(file);
  }
}

std::vector<double> deviations(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd result = covariance.leftCols(3).rowwise().sum().cwiseMax(0).cwiseSqrt();
  return {result.begin(), result.end()};
}

}  // namespace brainshift::pipelines
