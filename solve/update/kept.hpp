// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/run/thinned_body.hpp"
#include "solve/update/departures.hpp"
#include "solve/update/responses.hpp"

namespace brainshift::solve {

namespace device {
class KeptOnDevice;
}

/// Where a body came to rest under its run's own load.
struct RestState {
  NodalVectors parameters;  ///< û in the body's order, mm
  Points prescribed;        ///< (n × 3) mm, NaN: free
  Points displacement;      ///< (n × 3) mm
  double lowest = 0;        ///< A_0 there: what a load is damped by, whatever the last one was
};

/// A solved run with all that is expensive to make: shape functions, fictitious masses, the state of rest,
/// responses to changes.
struct KeptRun {
  SolveOptions options;                  ///< that the model was solved with
  std::vector<std::uint8_t> on_surface;  ///< one a node
  Points prescribed;    ///< (n × 3) mm, NaN: free; of the load that the body is at rest under, as it was weighed
  Points displacement;  ///< (n × 3) mm, at rest
  KeptBody fine;        ///< at rest
  RestState origin;     ///< under the run's own load; responses are of it
  Points prepared_for;  ///< what was prescribed when the body of `fine` was laid out, as its derivatives know;
                        ///< no rows: it has not come to rest since
  std::optional<KeptBody> own = {};  ///< that of the run's own nodes, while `fine` is laid out for others
  double trusted = 0;                ///< mm: a load that differs from the run's by more, or of 0 each, relaxes as a run
  Responses responses;               ///< none where noise leaves springs: of what is prescribed exactly alone
  Departures departures;             ///< from the first order; not kept on disk
  std::optional<ThinnedBody> thinned = {};  ///< of a load with noise, which chooses each load's weight; else absent
  /// What was prescribed when `thinned` was made for other nodes than the run's own. Not kept on disk.
  std::optional<Points> thinned_for = {};
  /// What the run was made from, asked for by a load on other nodes. Not kept on disk: whoever made or read the run
  /// says it.
  std::function<Model()> made_from = {};
  bool ready = false;  ///< conditions and contact of `fine` are as an update makes them
  std::shared_ptr<device::KeptOnDevice> on_device = nullptr;  ///< from the first update on that options.device wants
};

}  // namespace brainshift::solve
