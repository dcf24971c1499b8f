// SPDX-License-Identifier: GPL-3.0-or-later

#include "pipelines/scene/rupture_text.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace brainshift::pipelines::rupture_text_test {

template <class Read>
void expect_fault(const Read& read, const std::string& text, const std::vector<std::string>& parts) {
  try {
    read(text);
    ADD_FAILURE() << "'" << text << "' was not refused";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    for (const std::string& part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
    }
  }
}

TEST(RuptureText, GivesWhatItSaysAndElseTheDefaults) {
  const solve::Rupture stretch = rupture_from_text("stretch=1.4,distance=2,scatter=0.1,seed=7");
  EXPECT_EQ(stretch.criterion, solve::Rupture::Criterion::stretch);
  EXPECT_EQ(stretch.strength, 1.4);
  EXPECT_EQ(stretch.distance, 2);
  EXPECT_EQ(stretch.scatter, 0.1);
  EXPECT_EQ(stretch.seed, 7U);
  const solve::Rupture stress = rupture_from_text("stress=0.5");
  EXPECT_EQ(stress.criterion, solve::Rupture::Criterion::stress);
  EXPECT_EQ(stress.strength, 0.5);
  EXPECT_EQ(stress.distance, 0);
  EXPECT_EQ(stress.scatter, 0);
  EXPECT_EQ(stress.seed, 1U);
}

TEST(RuptureText, RefusesWhatCannotBe) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"", {"strength once", "stretch", "stress"}},
      {"distance=2", {"strength once"}},
      {"stretch=1.4,stress=3000", {"strength once"}},
      {"stretch=1", {"stretch", "'1'", "> 1"}},
      {"stretch=nan", {"'nan'", "> 1"}},
      {"stress=0", {"stress", "'0'", "> 0", "Pa"}},
      {"stretch=1.4,distance=-1", {"distance", "'-1'", ">= 0", "mm"}},
      {"stretch=1.4,scatter=1", {"scatter", "'1'", "< 1"}},
      {"stretch=1.4,seed=0.5", {"seed", "'0.5'", "a whole number"}},
      {"stretch=1.4,seed=-1", {"seed", "'-1'"}},
      {"stretch=1.4,stretch=1.5", {"stretch twice"}},
      {"strength=1.4", {"'strength=1.4'", "stretch, stress, distance, scatter, seed"}},
      {"stretch", {"'stretch'", "NAME=NUMBER"}},
      {"1.4", {"'1.4'", "stretch=1.4"}},
  };
  for (const auto& [text, parts] : cases) {
    expect_fault(rupture_from_text, text, parts);
    expect_fault(rupture_from_text, text, {"--rupture '" + std::string(text) + "'"});
  }
}

TEST(RuptureText, AWeakSpotIsAPlaceARadiusAndAFactor) {
  const solve::WeakSpot spot = weak_spot_from_text("-30,20,5,0.5");
  EXPECT_EQ(spot.place, Eigen::Vector2d(-30, 20));
  EXPECT_EQ(spot.radius, 5);
  EXPECT_EQ(spot.factor, 0.5);
  for (const char* text : {"", "1,2,3", "1,2,3,0.5,5", "1,2,0,0.5", "1,2,-3,0.5", "1,2,3,0", "1,2,3,1", "1,2,x,0.5"}) {
    expect_fault(weak_spot_from_text, text, {"--weak-spot is '" + std::string(text) + "'", "x,y,radius,factor"});
  }
}

}  // namespace brainshift::pipelines::rupture_text_test
