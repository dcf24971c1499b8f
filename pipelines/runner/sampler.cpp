// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/sampler.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>

#include "pipelines/checksum/sha256.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/options/values.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/material/material_options.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/measured.hpp"
#include "solve/uncertainty/sample.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view sample_name = "sample_";

/// A sample's file is named by all that it depends on, so that one that is there is one that holds. Of the model itself
/// the answer stands in for its files: where nothing of it changed, it is the same to the last bit.
std::string key_of(const solve::SolveOptions& options, const Points& answer, const solve::Constants& constants) {
  std::string text = BRAINSHIFT_VERSION;
  for (const auto& option : solve::solve_options()) {
    text += '\n' + option.get(options);
  }
  for (const auto& [label, material] : constants.materials) {
    text += '\n' + std::to_string(label);
    for (const auto& option : solve::material_options()) {
      text += '\n' + option.get(material);
    }
  }
  text += '\n' + write_numbers(constants.gravity);
  if (const auto& fluid = constants.fluid) {
    text += '\n' + write_numbers(fluid->gravity) + '\n' + write_number(fluid->level) + '\n';
    text += write_numbers(fluid->gravity_of_image) + '\n' + write_number(fluid->density);
  }
  text.append(reinterpret_cast<const char*>(answer.data()), static_cast<std::size_t>(answer.size()) * sizeof(double));
  return sha256_of_text(text).substr(0, 16);
}

}  // namespace

SampleFolder::SampleFolder(fs::path folder, fs::path scratch)
    : folder_(std::move(folder)), scratch_(std::move(scratch)) {
  fs::create_directories(folder_);
}

std::optional<Points> SampleFolder::find(const std::string& key, Eigen::Index nodes) {
  const fs::path file = named(key);
  used_.insert(file);
  if (!fs::exists(file)) {
    return std::nullopt;
  }
  try {
    Points displacement = read_solution(file).displacement;
    return displacement.rows() == nodes ? std::optional(std::move(displacement)) : std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // damaged; it is computed again
  }
}

void SampleFolder::keep(const std::string& key, Solution sample) const {
  const fs::path unfinished = scratch_ / "sample.vtu";
  write_solution(unfinished, sample);
  fs::rename(unfinished, named(key));
}

void SampleFolder::clear_others() const {
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().filename().string().starts_with(sample_name) && !used_.contains(entry.path())) {
      fs::remove(entry.path());
    }
  }
}

fs::path SampleFolder::named(const std::string& key) const {
  return folder_ / (std::string(sample_name) + key + ".vtu");
}

SampleTable::SampleTable(const fs::path& file, const solve::Constants& constants) : file_(file), stream_(file) {
  stream_ << "sample,rms_mm";
  for (const auto& [label, material] : constants.materials) {
    stream_ << ",shear_modulus_" << label << ",poisson_ratio_" << label;
  }
  stream_ << ",gravity_x,gravity_y,gravity_z,fluid_level\n";
}

void SampleTable::add(int sample, const solve::Constants& constants, double rms) {
  stream_ << sample << ',' << write_number(rms);
  for (const auto& [label, material] : constants.materials) {
    stream_ << ',' << write_number(shear_modulus(material)) << ',' << write_number(material.poisson_ratio);
  }
  const Eigen::Vector3d gravity = constants.fluid ? constants.fluid->gravity : constants.gravity;
  for (const double g : gravity) {
    stream_ << ',' << write_number(g);
  }
  stream_ << ',' << (constants.fluid ? write_number(constants.fluid->level) : "") << '\n';
}

void SampleTable::close() {
  if (!stream_.flush()) {
    fail_to_write(file_);
  }
}

Sampler::Sampler(const solve::Model& model, const solve::SolveOptions& options, const solve::SolveResult& result,
                 SampleFolder folder)
    : options_(options), model_(model), answer_(result.solution), folder_(std::move(folder)) {
  if (result.measures.measured) {
    model_.conditions = solve::weighed_conditions(model.conditions, *result.measures.measured);
  }
}

std::vector<std::optional<Points>> Sampler::displacements(const std::vector<solve::Constants>& constants,
                                                          const Progress& progress) {
  std::vector<std::optional<Points>> all;
  std::vector<solve::Constants> missing;
  for (const solve::Constants& c : constants) {
    all.push_back(folder_.find(key_of(options_, answer_.displacement, c), answer_.positions.rows()));
    if (!all.back()) {
      missing.push_back(c);
    }
  }
  std::vector<std::optional<Points>> solved;
  if (!missing.empty()) {
    solved = solve::sampled_displacements(model_, options_, missing, progress);
  }
  auto next = solved.begin();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i]) {
      continue;
    }
    all[i] = std::move(*next++);
    if (all[i]) {
      keep(constants[i], *all[i]);
    }
  }
  return all;
}

void Sampler::keep(const solve::Constants& constants, const Points& displacement) const {
  Solution sample = answer_;
  sample.displacement = displacement;
  sample.reaction_force.setZero();
  sample.estimated_error.clear();
  folder_.keep(key_of(options_, answer_.displacement, constants), std::move(sample));
}

}  // namespace brainshift::pipelines
