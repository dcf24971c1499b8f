// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/report.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "pipelines/report/page.hpp"
#include "pipelines/report/run_data.hpp"
#include "pipelines/report/slice_figures.hpp"
#include "pipelines/report/surface_figure.hpp"
#include "pipelines/report/weight_figure.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_page = 10'000'000;  // letters: what goes by mail
constexpr std::size_t tables = 200'000;           // and script: what else is on the page

std::array<const std::vector<Figure>*, 6> all_figures(const PageContent& content) {
  return {&content.comparisons, &content.displacements, &content.uncertainties,
          &content.labels,      &content.surfaces,      &content.weights};
}

// The pictures do not depend on each other: one is drawn while another's PNG is compressed.
void draw_pictures(const RunData& run, PageContent& content, const Progress& progress) {
  const View view = make_view(run);
  content.arrow_factor = arrow_factor(view);
  content.has_opening = view.opening.rows() > 0;
  content.largest_displacement = run.solution->displacement.rowwise().norm().maxCoeff();
  std::vector<std::future<std::vector<Figure>>> comparisons;
  std::vector<std::future<Figure>> displacements;
  std::vector<std::future<Figure>> labels;
  for (const Slice& slice : view.slices) {
    if (run.t1 && run.warped) {
      comparisons.push_back(std::async(std::launch::async, [&] { return comparison_figures(run, view, slice); }));
    }
    if (run.labels) {
      labels.push_back(std::async(std::launch::async, [&] { return labels_figure(run, view, slice); }));
    }
    displacements.push_back(std::async(std::launch::async, [&] { return displacement_figure(run, view, slice); }));
  }
  report(progress, 0.3, "drawing the surface");
  content.surfaces.push_back(surface_figure(run, view));
  report(progress, 0.6, "drawing the slices");
  for (const Slice& slice : view.slices) {
    if (!run.deviation.empty()) {
      content.uncertainties.push_back(uncertainty_figure(run, view, slice));
    }
  }
  for (auto& figures : comparisons) {
    std::ranges::move(figures.get(), std::back_inserter(content.comparisons));
  }
  for (auto& figure : displacements) {
    content.displacements.push_back(figure.get());
  }
  for (auto& figure : labels) {
    content.labels.push_back(figure.get());
  }
  if (!content.libraries.empty() && content.no_image.empty() && run.forward) {
    report(progress, 0.8, "packing the images");
    std::size_t taken = letters_of(content.libraries) + tables;
    for (const auto* figures : all_figures(content)) {
      taken = std::accumulate(figures->begin(), figures->end(), taken,
                              [](std::size_t sum, const Figure& figure) { return sum + figure.svg.size(); });
    }
    content.viewer = viewer_data(run, view, largest_page - std::min(taken, largest_page));
  }
}

void write_pages(const fs::path& run_folder, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading the run");
  const RunData run = read_run(run_folder);
  make_folder(out);
  PageContent content;
  content.record = run.record;
  content.no_image = run.no_image;
  content.libraries = viewer_libraries();
  const auto measures =
      run.record.value(nlohmann::json::json_pointer("/stages/solve/measures"), nlohmann::json::object());
  content.weights = weight_figures(measures);
  if (run.brain && run.solution) {
    draw_pictures(run, content, progress);
  }
  content.viewer.facts["history"] = run.history;
  content.viewer.facts["options"] = run.record.value("options", nlohmann::json::object());
  content.viewer.facts["measures"] = measures;
  content.viewer.facts["label_names"] = run.record.value("label_names", nlohmann::json::object());
  for (const auto* figures : all_figures(content)) {
    for (const Figure& figure : *figures) {
      write_text(out / (figure.name + ".svg"), figure.svg);
    }
  }
  write_text(out / "index.html", make_page(std::move(content)));
  report(progress, 1, "done");
}

}  // namespace

void write_report(const fs::path& run_folder, const fs::path& out, const Progress& progress) {
  try {
    write_pages(run_folder, out, progress);
  } catch (const nlohmann::json::exception& fault) {
    refuse(run_folder / "run.json", std::string("is no record of a run (") + fault.what() + "): run the scene again");
  }
}

}  // namespace brainshift::pipelines
