// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/report.hpp"

#include <fstream>
#include <future>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pipelines/report/history_plot.hpp"
#include "pipelines/report/page.hpp"
#include "pipelines/report/run_data.hpp"
#include "pipelines/report/slice_figures.hpp"
#include "pipelines/report/surface_figure.hpp"

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

using Keeping = std::vector<std::future<PageFigure>>;

// Written as a file, and kept for the page, while the next one is drawn.
void keep(Figure drawn, const fs::path& out, Keeping& figures) {
  figures.push_back(std::async(std::launch::async, [figure = std::move(drawn), out] {
    PageFigure kept{figure.name, figure.alt, figure.picture.width, encode_png(figure.picture)};
    write_bytes(out / (figure.name + ".png"), kept.png);
    return kept;
  }));
}

std::vector<PageFigure> kept(Keeping figures) {
  std::vector<PageFigure> result;
  for (std::future<PageFigure>& figure : figures) {
    result.push_back(figure.get());
  }
  return result;
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

void draw_pictures(const RunData& run, const fs::path& out, PageContent& content, const Progress& progress) {
  const View view = make_view(run);
  content.arrow_factor = arrow_factor(view);
  content.largest_displacement = run.solution->displacement.rowwise().norm().maxCoeff();
  Keeping comparisons, displacements, surfaces;
  for (std::size_t i = 0; i < view.planes.size(); ++i) {
    report(progress, 0.3 + 0.2 * static_cast<double>(i), "drawing the " + view.planes[i].name + " slice");
    if (run.t1 && run.warped) {
      for (Figure& figure : comparison_figures(run, view, view.planes[i])) {
        keep(std::move(figure), out, comparisons);
      }
    }
    keep(displacement_figure(run, view, view.planes[i]), out, displacements);
  }
  content.blink = 3 * most_telling_plane(view);
  report(progress, 0.9, "drawing the surface");
  keep(surface_figure(run, view), out, surfaces);
  content.comparisons = kept(std::move(comparisons));
  content.displacements = kept(std::move(displacements));
  content.surfaces = kept(std::move(surfaces));
}

}  // namespace

void write_report(const fs::path& run_folder, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading the run");
  const RunData run = read_run(run_folder);
  std::error_code fault;
  fs::create_directories(out, fault);
  if (fault) {
    throw std::runtime_error("cannot make the folder " + out.string() + ": " + fault.message());
  }
  PageContent content;
  content.record = run.record;
  content.has_image = run.t1.has_value() && run.warped.has_value();
  if (run.brain && run.solution) {
    draw_pictures(run, out, content, progress);
  }
  for (const std::string& plot :
       {convergence_plot(run.history, tolerance_of(run.record)), energy_plot(run.history, dynamics_of(run.record))}) {
    if (!plot.empty()) {
      content.plots.push_back(plot);
    }
  }
  write_bytes(out / "index.html", make_page(content));
  report(progress, 1, "done");
}

}  // namespace brainshift::pipelines
