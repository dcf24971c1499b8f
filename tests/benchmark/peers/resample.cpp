// SPDX-License-Identifier: GPL-3.0-or-later
//
// The register stage's resampling alone, for a field that is there already.
//
//   resample convert IN OUT image|field     into another format
//   resample warp IMAGE FIELD OUT TIMES     linear; prints the least seconds of the resampling
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/progress/stopwatch.hpp"

namespace {

using namespace brainshift;

void convert(const std::vector<std::string>& words) {
  if (words[3] == "field") {
    write_image(words[2], read_vector_image(words[1]));
  } else {
    write_image(words[2], read_image(words[1]));
  }
}

void warp_image(const std::vector<std::string>& words) {
  const ScalarImage image = read_image(words[1]);
  const VectorImage field = read_vector_image(words[2]);
  ScalarImage warped;
  double least = 1e9;
  for (int i = 0; i < std::max(1, std::stoi(words[4])); ++i) {
    const Stopwatch watch;
    warped = registration::warp(image, field, registration::Interpolation::linear);
    least = std::min(least, watch.seconds());
  }
  write_image(words[3], warped);
  std::printf("%.4f\n", least);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool converting = words.size() == 4 && words[0] == "convert";
  if (!converting && !(words.size() == 5 && words[0] == "warp")) {
    std::fprintf(stderr, "usage: resample convert IN OUT image|field | warp IMAGE FIELD OUT TIMES\n");
    return 2;
  }
  try {
    converting ? convert(words) : warp_image(words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "resample: %s\n", error.what());
    return 1;
  }
  return 0;
}
