// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/report.hpp"

#include <algorithm>
#include <fstream>
#include <future>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pipelines/report/history_plot.hpp"
#include "pipelines/report/page.hpp"
#include "pipelines/report/run_data.hpp"
#include "pipelines/report/slice_figures.hpp"
#include "pipelines/report/surface_figure.hpp"
#include "segmentation/files/make_folder.hpp"

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream) {
    throw std::runtime_error("cannot write " + file.string() + ": is the disk full or the folder read-only?");
  }
}

// The plane in which most of the load's direction lies shows the shift best.
std::size_t most_telling_plane(const View& view) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < view.planes.size(); ++i) {
    const auto across = [&](std::size_t plane) { return std::abs(view.inward[view.planes[plane].normal_axis]); };
    best = across(i) < across(best) ? i : best;
  }
  return best;
}

double tolerance_of(const nlohmann::json& record) {
  const nlohmann::json::json_pointer place("/options/solve/tolerance");
  if (!record.contains(place)) {
    return 0;
  }
  const auto& value = record.at(place);
  return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : value.get<double>();
}

// The pictures do not depend on each other: one is drawn while another's PNG is compressed.
void draw_pictures(const RunData& run, PageContent& content, const Progress& progress) {
  const View view = make_view(run);
  content.arrow_factor = arrow_factor(view);
  content.largest_displacement = run.solution->displacement.rowwise().norm().maxCoeff();
  content.blink = 3 * most_telling_plane(view);
  std::vector<std::future<std::vector<Figure>>> comparisons;
  std::vector<std::future<Figure>> displacements;
  std::vector<std::future<Figure>> labels;
  for (const SlicePlane& plane : view.planes) {
    if (run.t1 && run.warped) {
      comparisons.push_back(std::async(std::launch::async, [&] { return comparison_figures(run, view, plane); }));
    }
    if (run.labels) {
      labels.push_back(std::async(std::launch::async, [&] { return labels_figure(run, view, plane); }));
    }
    displacements.push_back(std::async(std::launch::async, [&] { return displacement_figure(run, view, plane); }));
  }
  report(progress, 0.3, "drawing the surface");
  content.surfaces.push_back(surface_figure(run, view));
  report(progress, 0.6, "drawing the slices");
  for (auto& figures : comparisons) {
    std::ranges::move(figures.get(), std::back_inserter(content.comparisons));
  }
  for (auto& figure : displacements) {
    content.displacements.push_back(figure.get());
  }
  for (auto& figure : labels) {
    content.labels.push_back(figure.get());
  }
}

}  // namespace

void write_report(const fs::path& run_folder, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading the run");
  const RunData run = read_run(run_folder);
  make_folder(out);
  PageContent content;
  content.record = run.record;
  content.has_image = run.t1.has_value() && run.warped.has_value();
  if (run.brain && run.solution) {
    draw_pictures(run, content, progress);
  }
  for (const std::vector<Figure>* figures :
       {&content.comparisons, &content.displacements, &content.labels, &content.surfaces}) {
    for (const Figure& figure : *figures) {
      write_bytes(out / (figure.name + ".svg"), figure.svg);
    }
  }
  for (const std::optional<Plot>& plot :
       {convergence_plot(run.history, tolerance_of(run.record)), energy_plot(run.history, dynamics_of(run.record))}) {
    if (plot) {
      content.plots.push_back(plot_svg(*plot));
    }
  }
  write_bytes(out / "index.html", make_page(std::move(content)));
  report(progress, 1, "done");
}

}  // namespace brainshift::pipelines
