// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole chain: from a T1, its labels and the displacements measured on the cortex to the warped image.
//
//   brainshift phantom --out head
//   chain head/t1.nii.gz head/labels.nii.gz head/craniotomy.csv out
#include <filesystem>
#include <iostream>

#include "discretise/discretise.hpp"
#include "register/registration.hpp"
#include "segmentation/segment.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/material/named_materials.hpp"
#include "solve/solve.hpp"

int main(int count, char** words) {
  using namespace brainshift;
  if (count != 5) {
    std::cerr << "usage: chain T1 LABELS CRANIOTOMY.csv FOLDER\n";
    return 2;
  }
  // 1. Labels to surfaces. The phantom's labels 1, 2 and 3 are brain, the default.
  const auto head = segmentation::segment({.labels = read_label_map(words[2])}, {});

  // 2. The brain's surface to nodes and background cells.
  const auto body = discretise::discretise(head.brain, &*head.labels, {.nodes = 3000});

  // 3. What is solved: materials by label, the load at the nodes under the opening, the skull.
  solve::Model model;
  model.cloud = body.cloud;
  model.cells = body.cells;
  model.labels = head.labels;
  model.materials = {{1, *solve::named_material("brain")},
                     {2, *solve::named_material("ventricle")},
                     {3, *solve::named_material("tumour")}};
  model.skull = head.skull;
  model.conditions.displacement = solve::prescribed_on_surface_nodes(model.cloud, solve::read_craniotomy_csv(words[3]));
  const auto moved = solve::solve(model, {.start = solve::Start::coarse});

  // 4. The displacement to fields and warped images.
  const auto warped = registration::register_images(
      {.solution = moved.solution, .brain = head.brain, .t1 = read_image(words[1]), .labels = head.labels}, {});
  std::filesystem::create_directories(words[4]);
  registration::write_registration(words[4], warped);

  std::cout << moved.measures.nodes << " nodes, " << moved.measures.steps << " steps, "
            << (moved.measures.converged ? "converged" : moved.failure) << "; the cortex moves by "
            << moved.measures.largest_displacement << " mm at most\n";
  return moved.measures.converged ? 0 : 3;
}
