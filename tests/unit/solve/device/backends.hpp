// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "solve/device/backend.hpp"

namespace brainshift::solve::device {

/// What the tests of devices run on. Where there is no GPU the half that wants one is skipped.
enum class On : std::uint8_t { one_thread, gpu };

class OnDevice : public testing::TestWithParam<On> {
 protected:
  void SetUp() override {
    if (GetParam() == On::gpu && gpu() == nullptr) {
      GTEST_SKIP() << why_no_gpu();
    }
  }
  static const Backend& backend() { return GetParam() == On::gpu ? *gpu() : one_thread(); }
};

inline std::string name_of_device(const testing::TestParamInfo<On>& tested) {
  return tested.param == On::gpu ? "gpu" : "one_thread";
}

}  // namespace brainshift::solve::device
