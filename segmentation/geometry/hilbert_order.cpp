// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/hilbert_order.hpp"

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <numeric>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift {

std::vector<std::int32_t> hilbert_order(const Points& points) {
  std::vector<CgalPoint> list;
  list.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& p : points.rowwise()) {
    list.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  using Map = CGAL::Pointer_property_map<CgalPoint>::type;
  using Traits = CGAL::Spatial_sort_traits_adapter_3<CgalKernel, Map>;
  CGAL::hilbert_sort(order.begin(), order.end(), Traits(CGAL::make_property_map(list)));
  return {order.begin(), order.end()};
}

}  // namespace brainshift
