// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/tradeoff_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "pipelines/report/plot.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/tradeoff/front.hpp"
#include "segmentation/files/text_lines.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t basis_setting = 3;

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

double seconds_of(const TradeoffPoint& point, TradeoffTime time) {
  return time == TradeoffTime::solve ? point.solve_seconds : point.whole_seconds;
}

std::string csv(const Sweep& sweep) {
  std::ostringstream text;
  for (const TradeoffSetting& setting : tradeoff_settings) {
    text << setting.name << ',';
  }
  text << "nodes_made,integration_points,steps,solve_seconds,whole_seconds,largest_mm,percentile_95_mm,mean_mm,"
          "landmarks_mm,on_solve_front,on_whole_front,failure\n";
  const auto solve_front = front_of(sweep, TradeoffTime::solve), whole_front = front_of(sweep, TradeoffTime::whole);
  const auto on = [](const std::vector<std::size_t>& front, std::size_t i) {
    return std::find(front.begin(), front.end(), i) != front.end() ? 1 : 0;
  };
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const TradeoffPoint& p = sweep.points[i];
    for (const std::string& value : p.choice) {
      text << value << ',';
    }
    if (!p.failure.empty()) {
      text << ",,,,,,,,,0,0," << quoted_field(p.failure) << "\n";
      continue;
    }
    text << p.nodes << ',' << p.points << ',' << p.steps << ',' << p.solve_seconds << ',' << p.whole_seconds << ','
         << p.error.largest << ',' << p.error.percentile_95 << ',' << p.error.mean << ','
         << (std::isnan(p.landmark_error) ? "" : rounded(p.landmark_error)) << ',' << on(solve_front, i) << ','
         << on(whole_front, i) << ",\n";
  }
  return text.str();
}

std::string table(const Sweep& sweep, TradeoffTime time) {
  std::ostringstream text;
  text << "| nodes | points a cell | τ | basis | derivatives | precision | stop, mm | solve, s | whole run, s | 95 %, "
          "mm | "
          "largest, mm | landmarks, mm |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::size_t i : front_of(sweep, time)) {
    const TradeoffPoint& p = sweep.points[i];
    text << "| ";
    for (const std::string& value : p.choice) {
      text << value << " | ";
    }
    text << rounded(p.solve_seconds) << " | " << rounded(p.whole_seconds) << " | " << rounded(p.error.percentile_95)
         << " | " << rounded(p.error.largest) << " | "
         << (std::isnan(p.landmark_error) ? "" : rounded(p.landmark_error)) << " |\n";
  }
  return text.str();
}

/// All points, one series a basis, and the front joined.
Plot plot_of(const Sweep& sweep, TradeoffTime time) {
  const bool solve = time == TradeoffTime::solve;
  Plot plot{solve ? "tradeoff_solve" : "tradeoff_run",
            solve ? "Error against the time of the solve" : "Error against the time of the whole run",
            "seconds",
            "95th percentile of the displacement error, mm",
            {},
            Scale::log_log};
  std::map<std::string, Series> by_basis;
  for (const TradeoffPoint& p : sweep.points) {
    if (p.failure.empty()) {
      Series& series = by_basis[p.choice[basis_setting]];
      series.joined = false;
      series.x.push_back(seconds_of(p, time));
      series.y.push_back(p.error.percentile_95);
    }
  }
  for (auto& [basis, series] : by_basis) {
    series.name = basis;
    plot.series.push_back(std::move(series));
  }
  Series front{"the front", {}, {}};
  for (const std::size_t i : front_of(sweep, time)) {
    front.x.push_back(seconds_of(sweep.points[i], time));
    front.y.push_back(sweep.points[i].error.percentile_95);
  }
  plot.series.push_back(std::move(front));
  return plot;
}

}  // namespace

std::vector<std::size_t> front_of(const Sweep& sweep, TradeoffTime time) {
  std::vector<CostAndError> costs;
  std::vector<std::size_t> solved;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (sweep.points[i].failure.empty()) {
      costs.push_back({seconds_of(sweep.points[i], time), sweep.points[i].error.percentile_95});
      solved.push_back(i);
    }
  }
  std::vector<std::size_t> front = pareto_front(costs);
  for (std::size_t& i : front) {
    i = solved[i];
  }
  return front;
}

std::string front_in_words(const Sweep& sweep, TradeoffTime time) {
  std::ostringstream text;
  const TradeoffPoint* before = nullptr;
  for (const std::size_t i : front_of(sweep, time)) {
    const TradeoffPoint& p = sweep.points[i];
    text << "- " << rounded(p.solve_seconds) << " s of solve (" << rounded(p.whole_seconds)
         << " s in all) buy an error of " << rounded(p.error.percentile_95) << " mm (95 % of the brain; largest "
         << rounded(p.error.largest) << " mm";
    if (!std::isnan(p.landmark_error)) {
      text << ", landmarks " << rounded(p.landmark_error) << " mm";
    }
    text << "): " << describe(p.choice);
    if (before != nullptr) {
      text << "; " << rounded(seconds_of(p, time) / seconds_of(*before, time))
           << " times the time of the one before for " << rounded(p.error.percentile_95 / before->error.percentile_95)
           << " of its error";
    }
    text << ".\n";
    before = &p;
  }
  return text.str();
}

void write_tradeoff(const fs::path& out, const Sweep& sweep) {
  write_whole(out / "tradeoff.csv", csv(sweep));
  std::ostringstream text;
  text << "Errors are differences from a much finer solution of the same scene (" << describe(sweep.reference)
       << "), at its nodes.\n";
  for (const TradeoffTime time : {TradeoffTime::solve, TradeoffTime::whole}) {
    const Plot plot = plot_of(sweep, time);
    draw(out, plot);
    text << "\n## " << plot.title << "\n\n![](" << plot.file << ".svg)\n\n"
         << table(sweep, time) << "\n"
         << front_in_words(sweep, time);
  }
  write_whole(out / "tradeoff.md", text.str());
}

}  // namespace brainshift::pipelines
