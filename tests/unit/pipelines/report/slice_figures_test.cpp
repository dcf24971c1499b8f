// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_figures.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <set>

#include "tests/unit/pipelines/report/small_run.hpp"

namespace brainshift::pipelines::slice_figures_test {

// Strokes of the colours that lines have, by the name of what they show.
std::size_t strokes(const Figure& figure, const std::string& colour) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(figure.svg.c_str()), tinyxml2::XML_SUCCESS);
  std::size_t count = 0;
  for (const auto* e = document.RootElement()->FirstChildElement("path"); e != nullptr;
       e = e->NextSiblingElement("path")) {
    count += colour == e->Attribute("stroke") ? 1 : 0;
  }
  return count;
}

const char* const before_colour = "#5ac8fa";
const char* const after_colour = "#ff963c";
const char* const opening_colour = "#46eb6e";

TEST(SliceFigures, ShowBeforeAfterAndDifferenceInTheOrderOfThePage) {
  const RunData run = small_run();
  const View view = make_view(run);
  const Slice& coronal = view.slices[1];
  const auto figures = comparison_figures(run, view, coronal);
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[0].name, "coronal_before");
  EXPECT_EQ(figures[1].name, "coronal_after");
  EXPECT_EQ(figures[2].name, "coronal_difference");
  EXPECT_EQ(figures[0].width, coronal.plane.width);
  EXPECT_GT(figures[2].width, coronal.plane.width) << "room for the colour bar";
  EXPECT_EQ(strokes(figures[0], before_colour), 1U);
  EXPECT_EQ(strokes(figures[0], opening_colour), 1U);
  EXPECT_EQ(strokes(figures[0], after_colour), 0U);
  EXPECT_EQ(strokes(figures[1], after_colour), 1U);
}

TEST(SliceFigures, ThePlaneUnderTheOpeningDoesNotCutIt) {
  const RunData run = small_run();
  const View view = make_view(run);
  EXPECT_EQ(strokes(comparison_figures(run, view, view.slices[0])[0], opening_colour), 0U);
}

TEST(SliceFigures, TheLabelsHaveAColourEachAndWhatWasTakenInOneOfItsOwn) {
  RunData run = small_run();
  const View view = make_view(run);
  run.labels = LabelMap{run.t1->geometry, std::vector<std::uint16_t>(run.t1->voxels.size(), 1)};
  const Figure one = labels_figure(run, view, view.slices[1]);
  EXPECT_EQ(one.name, "coronal_labels");
  EXPECT_EQ(strokes(one, before_colour), 1U);
  EXPECT_NE(one.svg.find("label 1"), std::string::npos);
  EXPECT_EQ(one.svg.find("taken in"), std::string::npos);
  std::fill_n(run.labels->voxels.begin(), run.labels->voxels.size() / 2, std::uint16_t{2});
  run.closed = LabelMap{run.t1->geometry, std::vector<std::uint16_t>(run.t1->voxels.size())};
  std::fill_n(run.closed->voxels.begin(), run.closed->voxels.size() / 4, std::uint16_t{1});
  run.t1.reset();
  run.record["label_names"] = {{"2", "ventricles"}};
  const View without_image = make_view(run);
  const Figure both = labels_figure(run, without_image, without_image.slices[1]);
  for (const char* name : {"label 1", "ventricles", "taken in"}) {
    EXPECT_NE(both.svg.find(name), std::string::npos) << name;
  }
}

TEST(SliceFigures, LabelsFarApartHaveDifferentColours) {
  RunData run = small_run();
  const View view = make_view(run);
  run.labels = LabelMap{run.t1->geometry, std::vector<std::uint16_t>(run.t1->voxels.size(), 1)};
  std::fill_n(run.labels->voxels.begin(), run.labels->voxels.size() / 2, std::uint16_t{9});
  tinyxml2::XMLDocument document;
  document.Parse(labels_figure(run, view, view.slices[1]).svg.c_str());
  std::set<std::string> colours;
  for (const auto* e = document.RootElement()->FirstChildElement("rect"); e != nullptr;
       e = e->NextSiblingElement("rect")) {
    colours.insert(e->Attribute("fill"));
  }
  EXPECT_EQ(colours.size(), 3U) << "black, and two";
}

TEST(SliceFigures, TissueThatIsTakenOutDoesNotMove) {
  RunData run = small_run();
  run.labels = LabelMap{run.t1->geometry, std::vector<std::uint16_t>(run.t1->voxels.size(), 1)};
  std::fill_n(run.labels->voxels.begin(), run.labels->voxels.size() / 2, std::uint16_t{2});
  const std::size_t all = make_view(run).slices[1].inside.size();
  run.record["options"]["resection"]["labels"] = "2 7";
  const View view = make_view(run);
  EXPECT_LT(view.slices[1].inside.size(), all);
  for (const std::size_t pixel : view.slices[1].inside) {
    EXPECT_EQ(label_at(*run.labels, centre_of(view.slices[1].plane, pixel)), 1);
  }
}

TEST(SliceFigures, TheDisplacementIsDrawnWithAndWithoutAnImageAndAField) {
  RunData run = small_run();
  run.solution->spacing.assign(run.solution->spacing.size(), 30.0);  // its nodes, all on the surface, know the inside
  const View view = make_view(run);
  const Figure over_image = displacement_figure(run, view, view.slices[1]);
  EXPECT_EQ(strokes(over_image, "#ffffff"), 7U) << "arrows, the scale and five ticks of the colour bar";
  run.forward = VectorImage{run.t1->geometry, {}};
  run.forward->voxels.assign(run.t1->voxels.size(), {0, 0, 0});
  run.t1.reset();
  const View without_image = make_view(run);
  EXPECT_EQ(strokes(displacement_figure(run, without_image, without_image.slices[1]), "#ffffff"), 6U)
      << "a field that moves nothing";
}

TEST(SliceFigures, WithoutAFieldADisplacementBetweenNodesLiesBetweenTheirs) {
  const RunData run = small_run();
  const Points at_nodes = displacement_at(run, run.solution->positions);
  EXPECT_LT((at_nodes - run.solution->displacement).cwiseAbs().maxCoeff(), 1e-9);
  const double sunk = displacement_at(run, Points({{11, 0, 20}}))(0, 2);
  EXPECT_LT(sunk, 0);
  EXPECT_GT(sunk, -4);
}

TEST(SliceFigures, ArrowsAreLengthenedUntilTheyAreSeen) {
  View view{};
  for (const auto& [largest, factor] : {std::pair{30.0, 1.0}, {8.0, 2.0}, {2.0, 5.0}, {0.0, 10.0}}) {
    view.shift.high = largest;
    EXPECT_EQ(arrow_factor(view), factor) << largest;
  }
}

}  // namespace brainshift::pipelines::slice_figures_test
