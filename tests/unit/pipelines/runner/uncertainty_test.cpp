// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/uncertainty.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "pipelines/runner/jobs.hpp"
#include "register/files/register_fields.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::uncertainty_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;

/// A ball of two tissues, drawn out at its top, with its samples in a folder.
class UncertaintyTest : public BallFolder {
 protected:
  SolveJob solve_job(int samples, std::optional<double> noise = {}) const {
    DiscretiseJob cells;
    cells.surface = folder_ / "ball.vtp";
    cells.options.nodes = noise ? 250 : 60;  // of few nodes too many are measured
    run_job(cells, folder_, {});
    LabelMap labels;
    labels.geometry.size.setConstant(11);
    labels.geometry.spacing.setConstant(5);
    labels.geometry.origin.setConstant(-25);
    labels.voxels.assign(labels.geometry.voxel_count(), 1);
    for (std::size_t voxel = 0; voxel < labels.voxels.size(); ++voxel) {
      labels.voxels[voxel] = voxel % 11 < 5 ? 1 : 3;  // by x
    }
    write_image(folder_ / "labels.nii.gz", labels);
    Load load;
    load.craniotomy = folder_ / "load.csv";
    load.noise = noise;
    SolveJob job{.nodes = folder_ / "nodes.vtu",
                 .cells = folder_ / "cells.vtu",
                 .labels = folder_ / "labels.nii.gz",
                 .skull = {},
                 .surface = folder_ / "ball.vtp",
                 .load = load,
                 .materials = {{1, solve::Material{}}, {3, solve::Material{.youngs_modulus = 9000}}},
                 .options = {},
                 .loading = {}};
    job.options.shape.basis = Basis::linear;
    job.options.points_per_cell = 1;
    job.options.tolerance = 0.01;
    job.uncertainty = UncertaintyJob{
        .options = {.samples = samples}, .samples = folder_ / "samples", .tissues = {{1, "parenchyma"}, {3, "tumour"}}};
    return job;
  }

  StageReport solved(const SolveJob& job, const std::string& name) const {
    fs::create_directories(folder_ / name);
    return run_job(job, folder_ / name, {});
  }

  std::set<std::string> samples() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "samples")) {
      names.insert(entry.path().filename());
    }
    return names;
  }
};

TEST_F(UncertaintyTest, IsWrittenAtTheNodesAndSaidForEachTissue) {
  press_unevenly();
  const StageReport said = solved(solve_job(4), "out");
  ASSERT_EQ(said.failure, "");
  const std::vector<double> deviation = registration::read_deviations(folder_ / "out/uncertainty.vtu");
  const Solution solution = read_solution(folder_ / "out/solution.vtu");
  ASSERT_EQ(deviation.size(), solution.spacing.size());
  double largest = 0;
  for (const double d : deviation) {
    largest = std::max(largest, d);
  }
  EXPECT_GT(largest, 0.001);
  EXPECT_LT(largest, 1) << "the load moves by 1 mm at most";
  const auto& words = said.measures["uncertainty"];
  EXPECT_EQ(words["samples"], 4);
  EXPECT_LT(words["brain_mm"], largest);
  EXPECT_EQ(read(folder_ / "out/samples.csv").find("sample,rms_mm,shear_modulus_1,poisson_ratio_1,shear_modulus_3"),
            0U);
}

TEST_F(UncertaintyTest, IsThatOfTheSamplesThatWereKept) {
  press_unevenly();
  const StageReport said = solved(solve_job(4), "out");
  std::vector<Points> drawn;
  Points own;
  const Solution solution = read_solution(folder_ / "out/solution.vtu");
  for (const std::string& name : samples()) {
    Points sample = read_solution(folder_ / "samples" / name).displacement;
    const bool is_own = (sample - solution.displacement).norm() < 1e-3 * solution.displacement.norm();
    if (is_own && own.rows() == 0) {
      own = sample;
    } else {
      drawn.push_back(sample);
    }
  }
  ASSERT_EQ(drawn.size(), 4U);
  const auto nodes = static_cast<std::size_t>(solution.positions.rows());
  const auto grid = vtu::read(folder_ / "out/uncertainty.vtu");
  const auto covariance = vtu::array(folder_ / "out/uncertainty.vtu", *grid->GetPointData(), "covariance", nodes, 6);
  const std::vector<double> deviation = registration::read_deviations(folder_ / "out/uncertainty.vtu");
  std::map<bool, std::pair<double, int>> left;  // squares, nodes
  for (std::size_t a = 0; a < nodes; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Points& sample : drawn) {
      const Eigen::RowVector3d off = sample.row(row) - own.row(row);
      spread += off.transpose() * off / 4;
    }
    EXPECT_NEAR(deviation[a], std::sqrt(spread.trace()), 1e-9);
    const std::array<double, 6> wanted = {spread(0, 0), spread(1, 1), spread(2, 2),
                                          spread(0, 1), spread(1, 2), spread(2, 0)};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(covariance[6 * a + k], wanted[k], 1e-9);
    }
    auto& [squares, count] = left[solution.positions(row, 0) < -2.5];  // half a voxel on this side of the first of 3
    squares += spread.trace();
    ++count;
  }
  const auto& words = said.measures["uncertainty"];
  EXPECT_NEAR(words["tissues_mm"]["parenchyma"], std::sqrt(left[true].first / left[true].second), 1e-9);
  EXPECT_NEAR(words["tissues_mm"]["tumour"], std::sqrt(left[false].first / left[false].second), 1e-9);
  EXPECT_NEAR(words["brain_mm"], std::sqrt((left[true].first + left[false].first) / static_cast<double>(nodes)), 1e-9);
}

TEST_F(UncertaintyTest, OfALoadWithNoiseHasTheNoisesPartToo) {
  solved(solve_job(2, 0.5), "out");
  const auto grid = vtu::read(folder_ / "out/uncertainty.vtu");
  const auto nodes = static_cast<std::size_t>(grid->GetNumberOfPoints());
  const auto array = [&](const char* name) {
    return vtu::array(folder_ / "out/uncertainty.vtu", *grid->GetPointData(), name, nodes);
  };
  const auto whole = array("uncertainty"), noise = array("from_noise"), constants = array("from_constants");
  for (std::size_t a = 0; a < nodes; ++a) {
    EXPECT_NEAR(whole[a], std::hypot(noise[a], constants[a]), 1e-12);
    EXPECT_GT(noise[a], 0);
  }
}

TEST_F(UncertaintyTest, IsTheSameForAnyNumberOfThreadsAndAfterARestart) {
  const SolveJob job = solve_job(3);
  solved(job, "one");
  const std::set<std::string> kept = samples();
  EXPECT_EQ(kept.size(), 4U) << "three, and the model itself";
  fs::remove(folder_ / "samples" / *kept.begin());
  omp_set_num_threads(2);
  solved(job, "restarted");
  EXPECT_EQ(samples(), kept);
  EXPECT_EQ(read(folder_ / "one/uncertainty.vtu"), read(folder_ / "restarted/uncertainty.vtu"));
  EXPECT_EQ(read(folder_ / "one/samples.csv"), read(folder_ / "restarted/samples.csv"));
}

TEST_F(UncertaintyTest, DoesNotComputeFinishedSamplesAgainAndDoesThoseThatAreDamaged) {
  SolveJob job = solve_job(2);
  solved(job, "first");
  const std::string name = *samples().begin();
  const auto written = fs::last_write_time(folder_ / "samples" / name);
  solved(job, "second");
  EXPECT_EQ(fs::last_write_time(folder_ / "samples" / name), written);
  write("samples/" + name, "no longer a sample");
  solved(job, "third");
  EXPECT_EQ(read(folder_ / "first/uncertainty.vtu"), read(folder_ / "third/uncertainty.vtu"));
  job.uncertainty->options.samples = 3;
  solved(job, "more");
  EXPECT_EQ(samples().size(), 4U);
  job.uncertainty->options.seed = 2;
  job.uncertainty->options.samples = 2;
  solved(job, "other");
  EXPECT_EQ(samples().size(), 3U) << "samples that no longer hold are gone";
  EXPECT_NE(read(folder_ / "first/uncertainty.vtu"), read(folder_ / "other/uncertainty.vtu"));
}

TEST_F(UncertaintyTest, OfAShareLeavesTheSamplesOfOthers) {
  SolveJob job = solve_job(4);
  job.uncertainty->options.shares = 2;
  for (const int share : {1, 2}) {
    job.uncertainty->options.share = share;
    solved(job, "share" + std::to_string(share));
  }
  EXPECT_EQ(samples().size(), 5U) << "four, and the model itself";
}

TEST_F(UncertaintyTest, OfSharesThatAreBroughtTogetherIsThatOfOneRun) {
  SolveJob job = solve_job(5);
  solved(job, "one");
  const std::set<std::string> all = samples();
  fs::rename(folder_ / "samples", folder_ / "of_one");
  job.uncertainty->options.shares = 2;
  std::size_t solved_in_shares = 0;
  for (const int share : {1, 2}) {
    job.uncertainty->options.share = share;
    job.uncertainty->samples = folder_ / ("share" + std::to_string(share));
    solved_in_shares +=
        solved(job, "out" + std::to_string(share)).measures["uncertainty"]["samples"].get<std::size_t>();
    fs::copy(job.uncertainty->samples, folder_ / "samples",
             fs::copy_options::recursive | fs::copy_options::skip_existing);
  }
  EXPECT_EQ(solved_in_shares, 5U);
  EXPECT_EQ(samples(), all);
  job = solve_job(5);
  const auto written = fs::last_write_time(folder_ / "samples" / *all.begin());
  solved(job, "together");
  EXPECT_EQ(fs::last_write_time(folder_ / "samples" / *all.begin()), written);
  EXPECT_EQ(read(folder_ / "one/uncertainty.vtu"), read(folder_ / "together/uncertainty.vtu"));
  EXPECT_EQ(read(folder_ / "one/samples.csv"), read(folder_ / "together/samples.csv"));
}

TEST_F(UncertaintyTest, LeavesTheSolutionAsItIs) {
  SolveJob job = solve_job(2);
  solved(job, "with");
  job.uncertainty.reset();
  solved(job, "without");
  EXPECT_EQ(read(folder_ / "with/solution.vtu"), read(folder_ / "without/solution.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "without/uncertainty.vtu"));
}

TEST_F(UncertaintyTest, GivesEachLandmarkOfTheBrainACovariance) {
  SolveJob job = solve_job(2);
  job.landmarks = write("landmarks.fcsv",
                        "# CoordinateSystem = LPS\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,"
                        "associatedNodeID\n1,0,0,5,0,0,0,1,1,1,0,a,,\n2,0,0,500,0,0,0,1,1,1,0,b,,\n");
  solved(job, "out");
  const std::string table = read(folder_ / "out/uncertainty.csv");
  EXPECT_EQ(table.find("# frame: LPS\nx,y,z,xx,yy,zz,xy,yz,zx\n0,0,5,"), 0U);
  EXPECT_EQ(table.find(",,"), table.find("\n0,0,500,,,,,,\n") + 8) << "nothing is known outside";
  std::istringstream row(table.substr(table.find("0,0,5,") + 6));
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double square = 0;
    char comma = ' ';
    row >> square >> comma;
    squares += square;
  }
  // The landmark is between nodes, whose deviations it lies between.
  const std::vector<double> deviation = registration::read_deviations(folder_ / "out/uncertainty.vtu");
  const auto [least, most] = std::minmax_element(deviation.begin(), deviation.end());
  EXPECT_GT(std::sqrt(squares), 0.5 * *least);
  EXPECT_LT(std::sqrt(squares), 1.5 * *most);
}

TEST_F(UncertaintyTest, RefusesALoadWhosePointsDoNotTellAMotionFromNoise) {
  const SolveJob job = solve_job(2, 0.5);
  const std::string head = "# frame: LPS\nx,y,z,ux,uy,uz\n", point = "0,0,20,0,0,-1\n";
  for (const std::string& points : {point, point + point + point}) {
    write("load.csv", head + points);
    expect_parts(refusal([&] { solved(job, "out"); }), {"1 measured points", "measure three or more"});
  }
}

TEST_F(UncertaintyTest, RefusesARegistrationByPointsInLine) {
  SolveJob job = solve_job(2, 0.5);
  job.load->registration_unknown = true;
  write("load.csv", "# frame: LPS\nx,y,z,ux,uy,uz\n0,0,20,0,0,-1\n2,0.001,20,0,0,-1\n4,0,20,0,0,-1\n-3,0,20,0,0,-1\n");
  expect_parts(refusal([&] { solved(job, "out"); }), {"not in line", "found 4, all nearly in one line"});
}

/// The mean of the two would hide both.
TEST_F(UncertaintyTest, NamesThePlaceThatWasMeasuredTwiceAndDifferently) {
  const SolveJob job = solve_job(2, 0.5);
  std::string text = read(folder_ / "load.csv");
  const std::size_t last = text.find_last_of('\n', text.size() - 2) + 1;
  const std::string row = text.substr(last), place = row.substr(0, row.find(',', row.find(',', row.find(',') + 1) + 1));
  write("load.csv", text + place + ",18,0,0\n");
  std::string notes;
  for (const std::string& note : solved(job, "out").notes) {
    notes += note + "\n";
  }
  expect_parts(notes, {"warning: what was measured near (", "standard deviations from what the other points say"});
}

TEST_F(UncertaintyTest, NamesThePointThatContradictsTheOthers) {
  const SolveJob job = solve_job(2, 0.5);
  const solve::CraniotomyLoad dense = solve::read_craniotomy_csv(folder_ / "load.csv");
  const auto every_fifth = Eigen::seq(0, Eigen::last, 5);
  solve::CraniotomyLoad load{dense.positions(every_fifth, Eigen::all), dense.displacement(every_fifth, Eigen::all), {}};
  load.sigma = Points(0, 3);
  load.displacement.row(0) += Eigen::RowVector3d(15, 0, 0);
  solve::write_craniotomy_csv(folder_ / "load.csv", load);
  const StageReport said = solved(job, "out");
  std::string notes;
  for (const std::string& note : said.notes) {
    notes += note + "\n";
  }
  expect_parts(notes, {"warning: what was measured near (", "standard deviations"});
}

}  // namespace brainshift::pipelines::uncertainty_test
