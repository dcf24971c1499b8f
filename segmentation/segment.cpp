// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iomanip>
#include <mutex>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "segmentation/body/brain_body.hpp"
#include "segmentation/image/mask.hpp"
#include "segmentation/interface/check_input.hpp"
#include "segmentation/labels/label_table.hpp"
#include "segmentation/options/values.hpp"
#include "segmentation/surface/checked_surface.hpp"
#include "segmentation/surface/extract.hpp"
#include "segmentation/tissue/classify.hpp"
#include "segmentation/tissue/tumour.hpp"
#include "segmentation/tissue/ventricles.hpp"

namespace brainshift::segmentation {
namespace {

std::vector<std::uint16_t> present_labels(const LabelMap& labels, std::vector<std::uint16_t> wanted) {
  std::erase_if(wanted, [&](std::uint16_t label) { return !has_label(labels, label); });
  return wanted;
}

void check_present(const LabelMap& labels, std::uint16_t label) {
  if (!has_label(labels, label)) {
    throw std::invalid_argument("label " + std::to_string(label) +
                                " counts as brain but no voxel of the label map carries it; name the brain's labels, " +
                                "as in --brain-labels 1 or <tissue label=\"1\" .../>, or correct the image");
  }
}

struct Body {
  std::string name;
  Mask mask;
};

// Tells how far all of the bodies are, one thread at a time.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::size_t bodies) : progress_(progress), done_(bodies) {}
  Progress of(std::size_t body) {
    return [this, body](double fraction, std::string_view what) { tell(body, fraction, what); };
  }

 private:
  void tell(std::size_t body, double fraction, std::string_view what) {
    const std::scoped_lock lock(mutex_);
    done_[body] = fraction;
    const double mean = std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size());
    constexpr double start = 0.4;
    report(progress_, start + (1 - start) * mean, what);
  }

  const Progress& progress_;
  std::vector<double> done_;
  std::mutex mutex_;
};

// Each body on its own, side by side; a fault in one of them is thrown when all have ended.
std::vector<MeasuredSurface> extract_all(const std::vector<Body>& bodies, double edge_length,
                                         const Progress& progress) {
  std::vector<MeasuredSurface> surfaces(bodies.size());
  std::vector<std::exception_ptr> faults(bodies.size());
  SharedProgress shared(progress, bodies.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    try {
      surfaces[i] = extract_surface(bodies[i].mask, edge_length, bodies[i].name, shared.of(i));
    } catch (...) {
      faults[i] = std::current_exception();
    }
  }
  for (const auto& fault : faults) {
    if (fault) {
      std::rethrow_exception(fault);
    }
  }
  return surfaces;
}

// Of labels that a table told: what is labelled and not brain may bound the skull's inside.
Mask cavity_in_labels(const LabelMap& labels, const Mask& brain, double reach, std::vector<std::string>& notes) {
  constexpr std::uint16_t outer = default_label::skin;
  if (!has_label(labels, outer)) {
    return {};
  }
  Mask space = bounded_space(labels, outer, brain, reach);
  notes.emplace_back(space.voxels.empty()
                         ? "no label is fluid or skull, and the labels around the brain bound no skull: the brain's "
                           "own surface is taken for it; name the skull's label if there is one"
                         : "no label is fluid or skull, so the skull's inside is taken to reach to the labels around "
                           "the brain that are not brain");
  return space;
}

// What bounds the skull's inside: its label, the fluid around the brain, or other labels there. Empty where the brain
// itself does.
Mask cavity_of(const LabelMap& labels, const Mask& brain, const SegmentOptions& options,
               std::vector<std::string>& notes) {
  if (options.skull_label && (!options.fluid_label || encloses(labels, *options.skull_label, brain))) {
    return skull_cavity(labels, *options.skull_label, brain);
  }
  if (!options.fluid_label) {
    return {};
  }
  constexpr double reach = 10;  // mm; fluid farther off is of the spine
  Mask space = fluid_space(labels, *options.fluid_label, brain, reach);
  return space.voxels.empty() ? cavity_in_labels(labels, brain, reach, notes) : space;
}

// The tissues that the labels, fitted to the brain, still have: a loose piece is none.
std::vector<std::uint16_t> still_there(const LabelMap& labels, const std::vector<std::uint16_t>& tissues,
                                       std::vector<std::string>& notes) {
  std::vector<std::uint16_t> there;
  for (const std::uint16_t label : tissues) {
    if (has_label(labels, label)) {
      there.push_back(label);
    } else {
      notes.push_back("label " + std::to_string(label) + " lies apart from the brain: it gets no surface");
    }
  }
  return there;
}

// with_surface: tissues that get one of their own.
std::vector<Body> bodies_of(const LabelMap& labels, const Mask& brain, const std::vector<std::uint16_t>& with_surface,
                            const SegmentOptions& options, std::vector<std::string>& notes) {
  std::vector<Body> bodies = {{"brain", brain}};
  for (const std::uint16_t label : with_surface) {
    bodies.push_back({"tissue_" + std::to_string(label), mask_of(labels, std::array{label})});
  }
  if (Mask cavity = cavity_of(labels, brain, options, notes); !cavity.voxels.empty()) {
    bodies.push_back({"skull", std::move(cavity)});
  }
  return bodies;
}

// What of the bounds a surface misses, as a sentence.
void note_missed(Segmentation& result, const std::string& name, const SurfaceMeasures& measures) {
  if (measures.within_bounds) {
    return;
  }
  std::ostringstream text;
  text << std::setprecision(2) << "the surface of " << name << " holds its volume to "
       << 100 * std::abs(measures.volume / measures.label_volume - 1) << " % and 95 % of it lie within "
       << measures.boundary_distance_95
       << " mm of the labels' boundary, where 1 % and 1 mm are aimed at: it is smoother than the labels";
  if (measures.lost_before > most_lost_before) {
    text << ", and had lost " << 100 * measures.lost_before << " % of their volume, thin parts, before it was fitted";
  }
  result.notes.push_back(text.str());
}

void make_surfaces(Segmentation& result, const Mask& brain, const std::vector<std::uint16_t>& tissues,
                   const SegmentOptions& options, const Progress& progress) {
  const std::vector<std::uint16_t> with_surface =
      options.tissue_surfaces ? still_there(*result.labels, tissues, result.notes) : std::vector<std::uint16_t>();
  const auto bodies = bodies_of(*result.labels, brain, with_surface, options, result.notes);
  auto surfaces = extract_all(bodies, options.edge_length, progress);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    result.measures[bodies[i].name] = surfaces[i].measures;
    note_missed(result, bodies[i].name, surfaces[i].measures);
  }
  const bool cavity = bodies.back().name == "skull";
  result.brain = surfaces.front().surface;
  result.skull = cavity ? surfaces.back().surface : result.brain;
  result.measures["skull"] = cavity ? surfaces.back().measures : surfaces.front().measures;
  for (std::size_t t = 0; t < with_surface.size(); ++t) {
    result.tissues[with_surface[t]] = std::move(surfaces[t + 1].surface);
  }
}

// Of the brain's labels that of the most voxels: the parenchyma, whatever its number.
std::uint16_t most_common(const LabelMap& labels, const std::vector<std::uint16_t>& of_brain) {
  const LabelVolumes volumes = label_volumes(labels);
  return *std::ranges::max_element(of_brain, {}, [&](std::uint16_t label) { return volumes.at(label); });
}

// What closing and filling took in becomes `filling`; loose pieces become background. Returns where the former is 1.
LabelMap fit_labels(LabelMap& labels, const Mask& tissue, const Mask& brain, std::uint16_t filling) {
  LabelMap closed{labels.geometry, std::vector<std::uint16_t>(labels.voxels.size())};
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (brain.voxels[i] != tissue.voxels[i]) {
      closed.voxels[i] = static_cast<std::uint16_t>(brain.voxels[i]);
      labels.voxels[i] = brain.voxels[i] != 0 ? filling : std::uint16_t{0};
    }
  }
  return closed;
}

// Of so much, mm³.
void note_dropped(Segmentation& result, double loose, std::size_t pieces, double all) {
  constexpr double worth_saying = 1000;  // mm³
  constexpr double much = 0.02;
  if (loose > worth_saying) {
    std::ostringstream text;
    text << (loose > much * all ? "warning: " : "") << std::fixed << std::setprecision(1) << "dropped "
         << in_millilitres(loose) << " of tissue (" << 100 * loose / all << " %) in " << pieces
         << " piece(s) that hang together with no part of the brain; if they belong to it, join them to it";
    result.notes.push_back(text.str());
  }
}

// known: the labels are of a table, which has no tissue to name.
void note_holes(Segmentation& result, double holes, bool known) {
  if (holes > 0) {
    result.notes.push_back("holes of " + in_millilitres(holes) +
                           " in the brain, whose labels are of no tissue, count as the tissue about them; " +
                           (known ? "give them the number of a ventricle or a tumour if they are one"
                                  : "name a tissue with these labels if they are another"));
  }
}

// known: the labels are of a table, so that this is a human brain.
void note_body(Segmentation& result, const BrainBody& body, const Mask& tissue, bool known) {
  result.body = BodyMeasures{.tissue_volume = volume(tissue),
                             .volume = volume(body.mask),
                             .loose_volume = body.loose_volume,
                             .loose_pieces = body.loose_pieces};
  constexpr double child = 900e3, largest = 2000e3;  // mm³; brains of adults have 1000 to 1800 ml
  const double volume = result.body->volume;
  if ((known && volume < child) || volume > largest) {
    std::ostringstream text;
    text << "warning: the brain has " << std::lround(volume / 1000) << " ml, where adults have 1000 to 1800; "
         << (volume > largest ? "is more labelled than the brain" : "is a part missing")
         << ", or are the image's lengths wrong?";
    result.notes.push_back(text.str());
  }
  if (const std::string cut = cut_sentence(body.cut, "the image's border"); !cut.empty()) {
    result.notes.push_back(cut);
  }
  note_dropped(result, body.loose_volume, body.loose_pieces, result.body->tissue_volume);
}

void note_tumour(Segmentation& result, const SegmentInput& input, const Mask& body) {
  if (input.tumour_mask) {
    if (const std::string outside = outside_body(*input.tumour_mask, body); !outside.empty()) {
      result.notes.push_back(outside);
    }
  }
}

Segmentation segment_labels(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  Segmentation result;
  result.labels = *input.labels;
  if (input.tumour_mask) {
    add_tumour(*result.labels, mask_of(*input.tumour_mask));
  }
  for (const std::uint16_t label : options.brain_labels) {
    check_present(*result.labels, label);
  }
  const Mask tissue = mask_of(*result.labels, options.brain_labels);
  report(progress, 0.1, "the brain as one body");
  const BrainBody body = brain_body(tissue, options.closing.value_or(0));
  check_edge_length(options.edge_length, body.across);
  note_body(result, body, tissue, options.fluid_label.has_value());
  note_tumour(result, input, body.mask);
  note_holes(result, body.hole_volume, options.fluid_label.has_value());
  if (options.closing.value_or(0) > 0) {
    result.closed = fit_labels(*result.labels, tissue, body.mask, most_common(*result.labels, options.brain_labels));
  }
  report(progress, 0.4, "surfaces");
  make_surfaces(result, body.mask, options.brain_labels, options, progress);
  return result;
}

// Ventricles are softer than tissue: what is not found of them resists as tissue, and the other way round.
void note_ventricles(Segmentation& result, double brain_volume) {
  constexpr std::uint16_t ventricles[] = {default_label::ventricles};
  constexpr double many_ventricles = 0.2;  // of the brain's volume; beyond most hydrocephalus
  const double found = volume(mask_of(*result.labels, ventricles));
  if (found < few_ventricles * brain_volume) {
    result.notes.push_back(
        "warning: only " + in_millilitres(found) +
        " of ventricles were told apart in the T1, where adults have 10 to 60; the others count as parenchyma. Look at "
        "the labels in the report, or give a label map");
  } else if (found > many_ventricles * brain_volume) {
    result.notes.push_back(
        "warning: " + in_millilitres(found) +
        " count as ventricles, where adults have 10 to 60; is the image a T1, in which fluid is dark? Look at the "
        "labels in the report, or give a label map");
  }
}

Segmentation segment_t1(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  LabelMap mask = *input.brain_mask;
  if (input.tumour_mask) {
    add_tumour(mask, mask_of(*input.tumour_mask));
  }
  const Mask tissue = mask_of(mask);
  const BrainBody body = brain_body(tissue, options.closing.value_or(0));
  check_edge_length(options.edge_length, body.across);
  Segmentation result;
  note_tumour(result, input, body.mask);
  report(progress, 0.1, "tissue classes");
  Classification classified = classify(*input.t1, body.mask, options);
  result.labels = std::move(classified.labels);
  result.memberships = std::move(classified.memberships);
  note_body(result, body, tissue, false);
  note_ventricles(result, result.body->volume);
  if (input.tumour_mask) {
    add_tumour(*result.labels, in_body(*input.tumour_mask, body.mask));
  }
  report(progress, 0.4, "surfaces");
  const std::vector<std::uint16_t> classes = {default_label::parenchyma, default_label::ventricles,
                                              default_label::tumour};
  make_surfaces(result, body.mask, present_labels(*result.labels, classes), options, progress);
  return result;
}

// Wrapping fills grooves and long edges cut bumps off: of a surface that loses or gains much.
void note_volume(Segmentation& result, double given, const CheckedSurface& checked, double edge_length) {
  if (checked.closed_holes > 0) {
    result.notes.push_back("the surface had holes, " + std::to_string(checked.closed_holes) +
                           " of them, which were closed with triangles");
  }
  constexpr double much = 0.03;  // edges of 5 mm take 0.02 of a ball of 40 mm
  const double left = checked.measures.volume + checked.loose_volume;
  const bool changed = std::abs(left - given) > much * given, repaired = checked.measures.repaired;
  if (changed || repaired) {
    result.notes.push_back((changed ? "warning: " : "") +
                           (repaired ? std::string("the surface is open or cuts itself and was wrapped")
                                     : "the surface was remeshed to edges of " + write_number(edge_length) + " mm") +
                           "; it holds " + in_millilitres(left) + ", as it was given " + in_millilitres(given) +
                           (!changed   ? ""
                            : repaired ? "; close its holes, or take out what cuts it, first"
                                       : "; give a shorter edge_length"));
  }
}

Segmentation segment_surface(const SegmentInput& input, const SegmentOptions& options) {
  if (input.surface->triangles.rows() > 0) {
    const double across = extent(*input.surface);
    check_across(across,
                 "is the surface in metres or micrometres, or has it a stray vertex? Scale it, or remove that vertex");
    check_edge_length(options.edge_length, across);
  }
  CheckedSurface checked = checked_surface(*input.surface, options.edge_length);
  Segmentation result;
  result.brain = std::move(checked.surface);
  result.skull = result.brain;
  result.measures["brain"] = checked.measures;
  result.measures["skull"] = checked.measures;
  note_dropped(result, checked.loose_volume, checked.loose_pieces, checked.loose_volume + checked.measures.volume);
  Surface about_middle = *input.surface;  // of an open surface the volume depends on the origin
  about_middle.vertices.rowwise() -= input.surface->vertices.colwise().mean().eval();
  note_volume(result, std::abs(volume(about_middle)), checked, options.edge_length);
  return result;
}

}  // namespace

Segmentation segment(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  check_input(input, options);
  report(progress, 0.0, "checking the input");
  Segmentation result = input.surface  ? segment_surface(input, options)
                        : input.labels ? segment_labels(input, options, progress)
                                       : segment_t1(input, options, progress);
  report(progress, 1.0, "done");
  return result;
}

}  // namespace brainshift::segmentation
