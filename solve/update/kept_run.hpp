// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"
#include "solve/update/kept.hpp"

namespace brainshift::solve {

/// Why a model cannot be kept, as half a sentence ("it has cuts"); empty: it can.
std::string cannot_keep(const Model& model, const SolveOptions& options);

/// Prepares a solved model for other loads and brings it to rest once more, from where it lay. displacement: of its
/// solution, (n × 3) mm. Throws as solve() does; std::invalid_argument where cannot_keep() says why, or the state does
/// not come to rest.
KeptRun keep(const Model& model, const SolveOptions& options, const Points& displacement,
             const Progress& progress = {});

/// The answer to another load, from what the responses and the answers so far tell of it; where it loads other nodes or
/// none are known, from the state of the last load or of the run's own, whichever is nearer. Where other nodes of the
/// surface are bonded, derivatives beside them are others, too (boundary_normals.hpp): the body is then laid out anew.
/// Noise is weighed for each load anew, as a run does. The kept run is at rest under it afterwards. Stops as solve()
/// does. Of the load's conditions forces are left aside: they stay the run's. Throws as check_conditions() does;
/// std::invalid_argument where it loads other nodes than the run did, by more than half, or other ones and made_from is
/// not set, or has noise where the run had none; TooFewNodes where its conditions contradict each other; the kept run
/// then is as it was. After another throw or a failure it must be read or made again.
SolveResult update(KeptRun& kept, const Conditions& load, const Progress& progress = {});

/// The largest change of a load, mm at a node, whose answers are as near to rest as they say (KeptRun::trusted); load:
/// the run's own. Found by trial: a few loads that differ by so much are answered, and answered once more as a run
/// would, far closer. What an answer is damped for is right where what responses leave open is local; of a head that
/// drifts and turns slowly in its fluid it is not, and no bound that looks back on a few steps sees that.
double trusted_change(const KeptRun& kept, const Conditions& load, const Progress& progress);

/// Of displacements that are imposed exactly, (n × 3) mm, NaN: free.
inline SolveResult update(KeptRun& kept, const Points& prescribed, const Progress& progress = {}) {
  return update(kept, Conditions{.displacement = prescribed}, progress);
}

/// Writes it whole or not at all. key: a checksum of what it was made from, at most 128 characters. Throws
/// std::runtime_error, naming the file.
void write_kept(const std::filesystem::path& file, const KeptRun& kept, const std::string& key);

/// Nothing where there is no such file, it has another key, or it is damaged. materials, options: those of
/// the model, as they were asked for.
std::optional<KeptRun> read_kept(const std::filesystem::path& file, const std::string& key,
                                 const std::map<std::int32_t, Material>& materials, const SolveOptions& options);

}  // namespace brainshift::solve
