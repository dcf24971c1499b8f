// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/triangle_tree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <iterator>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift {

namespace {

using TreeTriangle = CgalKernel::Triangle_3;
using TreePrimitive = CGAL::AABB_triangle_primitive<CgalKernel, std::vector<TreeTriangle>::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, TreePrimitive>>;

CgalPoint to_cgal(const Eigen::Vector3d& x) {
  return {x.x(), x.y(), x.z()};
}

}  // namespace

struct TriangleTree::Impl {
  std::vector<TreeTriangle> triangles;
  AabbTree tree;

  std::size_t index(AabbTree::Primitive_id id) const { return static_cast<std::size_t>(id - triangles.cbegin()); }
};

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles) {
  auto impl = std::make_shared<Impl>();
  for (const Triangle& t : triangles) {
    impl->triangles.emplace_back(to_cgal(t.a), to_cgal(t.b), to_cgal(t.c));
  }
  impl->tree.insert(impl->triangles.cbegin(), impl->triangles.cend());
  impl->tree.build();
  impl->tree.accelerate_distance_queries();
  impl_ = std::move(impl);
}

std::size_t TriangleTree::nearest(const Eigen::Vector3d& x) const {
  return impl_->index(impl_->tree.closest_point_and_primitive(to_cgal(x)).second);
}

double TriangleTree::squared_distance(const Eigen::Vector3d& x) const {
  return impl_->tree.squared_distance(to_cgal(x));
}

void TriangleTree::find_crossed(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                std::vector<std::size_t>& found) const {
  std::vector<AabbTree::Primitive_id> crossed;
  impl_->tree.all_intersected_primitives(CgalKernel::Segment_3(to_cgal(from), to_cgal(to)),
                                         std::back_inserter(crossed));
  found.clear();
  for (const AabbTree::Primitive_id& id : crossed) {
    found.push_back(impl_->index(id));
  }
}

}  // namespace brainshift
