// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/page.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "pipelines/report/weight_figure.hpp"

namespace brainshift::pipelines::page_test {

using nlohmann::json;

bool has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

Figure figure(const std::string& name) {
  Svg svg(name, name, 30, 20);
  return {name, 30, 20, std::move(svg).str()};
}

PageContent full_content() {
  PageContent content;
  content.record = {{"scene", "/somewhere/<a & b>.xml"},
                    {"version", "9.8"},
                    {"threads", 3},
                    {"options", {{"solve", {{"basis", "linear"}, {"shape", ""}}}}},
                    {"stages",
                     {{"solve",
                       {{"status", "done"},
                        {"seconds", 12.5},
                        {"peak_memory_mb", 2500.0},
                        {"sizes", {{"nodes", 12000}, {"integration_points", 34000}}},
                        {"measures", {{"converged", false}, {"brain", {{"closed", true}}}}}}}}}};
  content.has_opening = true;
  content.comparisons = {figure("b"), figure("a"), figure("d")};
  content.displacements = {figure("u")};
  content.surfaces = {figure("surface")};
  content.labels = {figure("l")};
  content.viewer.facts = {{"history", "step,time\n1,1\n"}};
  return content;
}

TEST(Page, IsWellFormedAndHasNothingLeftToFill) {
  const std::string page = make_page(full_content());
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(page.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  for (const char* left : {"{{", "}}", "each=", "<picture", "<!-- "}) {
    EXPECT_FALSE(has(page, left)) << left;
  }
}

TEST(Page, AsksForNothingFromOutside) {
  const std::string page = make_page(full_content());
  for (const char* link : {"src=", "@import", "<link", "<script"}) {
    EXPECT_FALSE(has(page, link)) << link;
  }
}

TEST(Page, TurnsWithLibrariesAndAnImageAndElseSaysWhyNot) {
  const char* const says_why = "Nothing on this page turns";
  PageContent content = full_content();
  EXPECT_TRUE(has(make_page(content), says_why));
  EXPECT_TRUE(has(make_page(content), "solve/history.csv"));
  content.libraries = {{"niivue", "H4sI"}};
  const std::string curves = make_page(content);
  EXPECT_FALSE(has(curves, says_why));
  EXPECT_FALSE(has(curves, "id=\"canvas\""));
  EXPECT_TRUE(has(curves, "<script type=\"text/plain\" id=\"niivue\">H4sI</script>"));
  EXPECT_TRUE(has(curves, viewer_script()));
  content.viewer.arrays = {{"image", "eJw="}};
  const std::string page = make_page(content);
  EXPECT_TRUE(has(page, "id=\"canvas\""));
  EXPECT_TRUE(has(page, "id=\"image\">eJw=</script>"));
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(page.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  for (const char* link : {"src=", "@import", "<link", "http"}) {
    EXPECT_FALSE(has(viewer_script(), link)) << link;
  }
}

TEST(Page, ShowsWhatTheRunMeasured) {
  const std::string page = make_page(full_content());
  for (const char* text : {"scene &lt;a &amp; b&gt;.xml, brainshift 9.8, 3 threads", "12,000", "34,000", "12.5 s",
                           "2.62 GB", "0 of 1", ">OUTSIDE<", "12 mm under the centre", "true to scale", "linear"}) {
    EXPECT_TRUE(has(page, text)) << text;
  }
  EXPECT_FALSE(has(page, ">shape ")) << "an option without a value";
}

TEST(Page, LeavesOutWhatThereIsNot) {
  const std::string page = make_page({.record = json::object(), .no_image = "There is no image to warp."});
  for (const char* heading : {"Before, after", "<h2>Displacement", "converged", "simulated", "did not finish"}) {
    EXPECT_FALSE(has(page, heading)) << heading;
  }
  EXPECT_TRUE(has(page, "no image to warp"));
  EXPECT_TRUE(has(page, "not known")) << "the number of nodes";
}

TEST(Page, SaysThatAStageFailedAndThatALoadIsSimulated) {
  PageContent content = full_content();
  content.record["stages"]["solve"]["failure"] = "It <burst>.";
  content.record["options"]["load.simulated"] = {{"depth", 8}};
  content.record["options"]["solve"]["dynamics"] = "transient";
  const std::string page = make_page(content);
  EXPECT_TRUE(has(page, "The stage solve did not finish.</b> It &lt;burst&gt;. What is shown"));
  EXPECT_TRUE(has(page, "The load is simulated."));
  EXPECT_TRUE(has(page, "<h2>Energies</h2>"));
  EXPECT_FALSE(has(page, "How the solver converged"));
}

std::size_t times(const std::string& page, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + text.size())) {
    ++count;
  }
  return count;
}

TEST(Page, ShowsWarningsAtTheTopAndOtherNotesBesideTheStages) {
  PageContent content = full_content();
  auto& stages = content.record["stages"];
  stages["segment"]["notes"] = {"took <scan> & mask", "warning: the T1 is black"};
  stages["solve"]["notes"] = {"warning: one point <contradicts> the others", "took <scan> & mask",
                              "warning: the T1 is black"};
  const std::string page = make_page(content);
  const std::string black = "<b>Warning of the stage segment:</b> the T1 is black</li>";
  const std::string contradicts = "<b>Warning of the stage solve:</b> one point &lt;contradicts&gt; the others</li>";
  const std::string took = "<span class=\"name\">segment: </span>took &lt;scan&gt; &amp; mask</li>";
  for (const std::string& text : {black, contradicts, took}) {
    EXPECT_EQ(times(page, text), 1U) << text;
  }
  for (const char* once : {"the T1 is black", "took &lt;scan", "contradicts"}) {
    EXPECT_EQ(times(page, once), 1U) << once;
  }
  EXPECT_LT(page.find(black), page.find(contradicts)) << "in the order in which the stages run";
  EXPECT_LT(page.find(contradicts), page.find("class=\"tiles\""));
  EXPECT_GT(page.find(took), page.find("<h2>Stages</h2>"));
  EXPECT_FALSE(has(page, "warning:")) << "the mark has become words";
}

TEST(Page, SaysNothingOfNotesWhereThereAreNone) {
  const char* const warns = "Read this before you rely";
  const char* const notes = "What the stages noted";
  PageContent content = full_content();
  auto& said = content.record["stages"]["solve"]["notes"];
  for (const json& nothing : {json(), json::array(), json{""}}) {
    said = nothing;
    EXPECT_FALSE(has(make_page(content), warns)) << nothing;
    EXPECT_FALSE(has(make_page(content), notes)) << nothing;
  }
  content.record["stages"]["solve"].erase("notes");
  EXPECT_FALSE(has(make_page(content), warns));
  EXPECT_FALSE(has(make_page(content), notes));
}

TEST(Page, ShowsTheNotesOfAStateAsThoseOfARun) {
  PageContent content = full_content();
  content.record["state"] = "drained";
  content.record["stages"]["solve"]["status"] = "kept";
  content.record["stages"]["solve"]["notes"] = {"warning: the fluid is gone"};
  EXPECT_TRUE(has(make_page(content), "<b>Warning of the stage solve:</b> the fluid is gone"));
}

TEST(Page, SaysHowFarTheTrackersRegistrationWasOffAndHowWellThatIsKnown) {
  const char* const heading = "The tracker's registration";
  EXPECT_FALSE(has(make_page(full_content()), heading));
  PageContent content = full_content();
  auto& measures = content.record["stages"]["solve"]["measures"];
  measures["registration_angle_deg"] = 4.321;
  measures["registration_shift_mm"] = 5.5;
  measures["registration_deviation_mm"] = 2.25;
  const std::string page = make_page(content);
  EXPECT_TRUE(has(page, heading));
  EXPECT_TRUE(has(page, "a turn of 4.32° and a shift of 5.5 mm"));
  EXPECT_TRUE(has(page, "± 2.25 mm"));
  measures["registration_deviation_mm"] = json();  // as run.json holds what is no number
  EXPECT_TRUE(has(make_page(content), "a turn of 4.32° and a shift of 5.5 mm</b>; what is shown"));
}

TEST(Page, SaysHowFarTheAnswerMayBeOffInWordsBesideTheMap) {
  PageContent content = full_content();
  EXPECT_FALSE(has(make_page(content), "How far this may be off"));
  content = full_content();
  content.uncertainties = {figure("n")};
  content.record["stages"]["solve"]["measures"]["uncertainty"] = {
      {"samples", 16}, {"brain_mm", 1.25}, {"tissues_mm", {{"tumour", 0.8}}}};
  const std::string page = make_page(content);
  EXPECT_TRUE(has(page, "1.25 mm over the whole brain, 0.8 mm in tumour"));
  EXPECT_TRUE(has(page, "16 solutions"));
}

TEST(Page, ExplainsTheWeightOfALoadWithNoiseAndHintsWhereThereIsNone) {
  const char* const hint = "imposed exactly, as no noise is given";
  EXPECT_FALSE(has(make_page(full_content()), hint)) << "no load was measured";
  PageContent content = full_content();
  content.record["options"]["load.craniotomy"] = {{"file", "load.csv"}};
  EXPECT_TRUE(has(make_page(content), hint));
  content.record["stages"]["solve"].erase("measures");
  EXPECT_FALSE(has(make_page(content), hint)) << "nothing was imposed yet";
  content = full_content();
  content.record["options"]["load.craniotomy"] = {{"file", "load.csv"}};
  auto& measures = content.record["stages"]["solve"]["measures"];
  measures["weight_mJ"] = 0.5;
  measures["noise_factor"] = 1.2;
  for (const double weight : {0.1, 0.5, 2.0}) {
    measures["weights"].push_back({{"weight_mJ", weight}, {"misfit", 10 / weight}, {"energy_mJ", weight}});
  }
  content.weights = weight_figures(measures);
  const std::string page = make_page(content);
  EXPECT_FALSE(has(page, hint));
  EXPECT_TRUE(has(page, "0.5 mJ was chosen"));
  EXPECT_TRUE(has(page, "id=\"weights\""));
  EXPECT_TRUE(has(page, "the one that was taken, 0.5 mJ"));
  EXPECT_FALSE(has(page, "taken for motion"));
  measures["smooth_motion"] = {{"length_mm", 20}, {"along_mm", 4}, {"across_mm", 0.1}};
  EXPECT_TRUE(has(make_page(content), "alike over 20 mm"));
  EXPECT_FALSE(has(make_page(content), "a tenth of that at"));
  measures["smooth_motion"]["fades"] = true;
  EXPECT_TRUE(has(make_page(content), "a tenth of that at"));
}

TEST(Page, HintsAtTheNoiseOfEveryKindOfMeasuredLoad) {
  const char* const hint = "imposed exactly, as no noise is given";
  const char* const camera = "a stereo camera is off by";
  const char* const program = "registration of two images is off, too";
  for (const char* load : {"load.craniotomy", "load.markups", "load.surfaces", "load.field"}) {
    PageContent content = full_content();
    content.record["options"][load] = {{"file", "load"}};
    const std::string page = make_page(content);
    const bool computed = load == std::string("load.field");
    EXPECT_TRUE(has(page, hint)) << load;
    EXPECT_EQ(has(page, camera), !computed) << load;
    EXPECT_EQ(has(page, program), computed) << load;
    content.record["stages"]["solve"]["measures"]["weight_mJ"] = 0.5;
    EXPECT_FALSE(has(make_page(content), hint)) << load;
  }
  PageContent content = full_content();
  content.record["options"]["load.simulated"] = {{"depth", 8}};
  EXPECT_FALSE(has(make_page(content), hint)) << "nobody measured it";
}

}  // namespace brainshift::pipelines::page_test
