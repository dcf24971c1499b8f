// SPDX-License-Identifier: GPL-3.0-or-later
// Every option's ends, through `brainshift scene --check` and through the check of the stage whose option it is: at the
// end both accept it, just beyond both refuse it with the same sentence.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "discretise/interface/option_table.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "register/interface/option_table.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/interface/option_table.hpp"
#include "solve/body/check_model.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/load/load_options.hpp"
#include "solve/material/check_material.hpp"
#include "solve/material/material_options.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::option_ends_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A value at an end of an option's range, or next to it.
struct End {
  std::string text;
  bool allowed;
};

void add_end(double end, bool is_allowed, double outward, bool whole, std::vector<End>& ends) {
  const auto text = [&](double value) { return whole ? write_number(std::llround(value)) : write_number(value); };
  const auto next = [&](double direction) {
    return whole ? end + std::copysign(1.0, direction) : std::nextafter(end, direction);
  };
  ends.push_back({text(end), is_allowed});
  ends.push_back({text(next(is_allowed ? outward : -outward)), !is_allowed});
}

template <class T>
std::vector<End> ends_of(const Option<T>& option) {
  std::vector<End> ends = {{"no such value", option.allowed == "text"}};
  if (!option.range) {
    return ends;
  }
  const Range& range = *option.range;
  const bool whole = option.allowed.starts_with("a whole number");
  if (std::isfinite(range.low)) {
    add_end(range.low, range.low_allowed, -infinity, whole, ends);
  }
  if (std::isfinite(range.high)) {
    add_end(range.high, range.high_allowed, infinity, whole, ends);
  }
  if (!whole) {
    ends.insert(ends.end(), {{"inf", false}, {"nan", false}});
  }
  return ends;
}

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

class OptionEnds : public SceneFile {
 protected:
  OptionEnds() {
    LabelMap labels;
    labels.geometry.size = {4, 4, 4};
    labels.voxels.assign(64, 0);
    labels.at(1, 1, 1) = 1;
    labels.at(2, 1, 1) = 3;
    write_image(folder_ / "labels.nii.gz", labels);
    write_load();
    Surface sheet{Points(3, 3), Triangles(1, 3)};
    sheet.vertices << 0, 0, 0, 9, 0, 0, 9, 9, 0;
    sheet.triangles << 0, 1, 2;
    write_surface(folder_ / "sheet.vtp", sheet);
  }

  /// What --check says of a scene with one element written out; the @ in it stands for the option.
  std::string check(std::string element, const std::string& name, const std::string& value) const {
    element.replace(element.find('@'), 1, " " + name + "=\"" + value + "\"");
    const auto unless = [&](const char* tag, const char* otherwise) {
      return element.starts_with(tag) ? std::string() : std::string(otherwise);
    };
    return fault("<scene><image labels=\"labels.nii.gz\"/>" + element +
                 unless("<tissues", "<tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues>") +
                 unless("<load", "<load><craniotomy file=\"load.csv\"/></load>") + "</scene>");
  }

  /// accept: the stage's check; refuse: what a user calls, which must check before all else.
  template <class T, class Accept, class Refuse>
  void walk(const OptionTable<T>& table, const std::string& element, const T& usual, const Accept& accept,
            const Refuse& refuse) const {
    for (const Option<T>& option : table) {
      for (const End& end : ends_of(option)) {
        SCOPED_TRACE(element + " " + option.name + " = " + end.text);
        const std::string sentence = refusal(option, end.text);
        const std::string in_scene = check(element, option.name, end.text);
        T options = usual;
        const bool can_be_held = option.read(options, end.text);
        if (end.allowed) {
          EXPECT_EQ(in_scene, "");
          ASSERT_TRUE(can_be_held);
          EXPECT_EQ(complaint([&] { accept(options); }), "");
          continue;
        }
        EXPECT_TRUE(in_scene.ends_with(sentence)) << in_scene << "\n" << sentence;
        if (can_be_held) {
          const std::string by_stage = complaint([&] { refuse(options); });
          EXPECT_TRUE(by_stage.ends_with(sentence)) << by_stage << "\n" << sentence;
        }
      }
    }
  }
  template <class T, class Check>
  void walk(const OptionTable<T>& table, const std::string& element, const T& usual, const Check& check_it) const {
    walk(table, element, usual, check_it, check_it);
  }
};

TEST_F(OptionEnds, OfSegmentation) {
  using segmentation::SegmentOptions;
  walk(
      segmentation::segment_options(), "<stage name=\"segment\"@/>", SegmentOptions{},
      [](const SegmentOptions& o) { segmentation::check_options(o); },
      [](const SegmentOptions& o) { segmentation::segment({}, o); });
}

TEST_F(OptionEnds, OfDiscretisation) {
  using discretise::DiscretiseOptions;
  walk(
      discretise::discretise_options(), "<stage name=\"discretise\"@/>", DiscretiseOptions{},
      [](const DiscretiseOptions& o) { discretise::check_options(o); },
      [](const DiscretiseOptions& o) { discretise::discretise({}, nullptr, o); });
}

TEST_F(OptionEnds, OfRefinement) {
  using discretise::Refinement;
  walk(
      discretise::refinement_options(), "<stage name=\"discretise\"@/>", Refinement{},
      [](const Refinement& r) { discretise::check_options({.craniotomy = r}); },
      [](const Refinement& r) { discretise::discretise({}, nullptr, {.craniotomy = r}); });
}

TEST_F(OptionEnds, OfTheSolver) {
  using solve::SolveOptions;
  walk(
      solve::solve_options(), "<stage name=\"solve\"@/>", SolveOptions{},
      [](const SolveOptions& o) { solve::check_options(o); }, [](const SolveOptions& o) { solve::solve({}, o); });
}

TEST_F(OptionEnds, OfRegistration) {
  using registration::RegisterOptions;
  walk(
      registration::register_options(), "<stage name=\"register\"@/>", RegisterOptions{},
      [](const RegisterOptions& o) { registration::check_options(o); },
      [](const RegisterOptions& o) { registration::register_images({}, o); });
}

TEST_F(OptionEnds, OfMaterials) {
  walk(solve::material_options(), "<tissues><tissue label=\"1\"@/><tissue label=\"3\"/></tissues>", solve::Material{},
       [](const solve::Material& material) { solve::check_material("the material of label 1", material); });
}

TEST_F(OptionEnds, OfResections) {
  walk(
      OptionTable<solve::Resection>{*find_option(solve::resection_options(), "pressure")}, "<resection labels=\"3\"@/>",
      solve::Resection{.labels = {3}}, [](const solve::Resection& r) { check_table(solve::resection_options(), r); },
      [](const solve::Resection& r) {
        solve::Model model;
        model.resection = r;
        solve::check_model(model);
      });
}

TEST_F(OptionEnds, OfOpenings) {
  using solve::OpeningOptions;
  walk(
      solve::opening_options(), "<load@><craniotomy file=\"load.csv\"/></load>", OpeningOptions{},
      [](const OpeningOptions& o) { check_table(solve::opening_options(), o); },
      [](const OpeningOptions& o) { solve::prescribed_on_surface_nodes({}, {}, o); });
}

TEST_F(OptionEnds, OfSimulatedCraniotomies) {
  using solve::SimulatedCraniotomy;
  OptionTable<SimulatedCraniotomy> numbers = solve::simulated_craniotomy_options();
  std::erase_if(numbers, [](const auto& option) { return option.required; });
  walk(
      numbers, "<load><simulated centre=\"0 0 0\"@/></load>", SimulatedCraniotomy{},
      [](const SimulatedCraniotomy& s) { check_table(solve::simulated_craniotomy_options(), s); },
      [](const SimulatedCraniotomy& s) { solve::simulated_craniotomy({}, s); });
}

TEST_F(OptionEnds, OfCuts) {
  const auto walk_one = [&](const char* name, const std::string& element) {
    walk(OptionTable<solve::CutTiming>{*find_option(solve::cut_timing_options(), name)}, element, solve::CutTiming{},
         [](const solve::CutTiming& timing) { solve::times_along({}, timing, "sheet.vtp"); });
  };
  walk_one("start", "<cuts><cut file=\"sheet.vtp\"@/></cuts>");
  walk_one("speed", "<cuts><cut file=\"sheet.vtp\" direction=\"1 0 0\"@/></cuts>");
  walk_one("direction", "<cuts><cut file=\"sheet.vtp\" speed=\"1\"@/></cuts>");
}

}  // namespace brainshift::pipelines::option_ends_test
