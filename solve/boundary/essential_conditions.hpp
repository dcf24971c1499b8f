// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/boundary/patch_rim.hpp"
#include "solve/interface/conditions.hpp"
#include "solve/interface/options.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Essential conditions on Σφû, EBCIEM (Joldes et al. 2017): after a step the parameters are projected onto V û = ū,
///   û ← û + M⁻¹Vᵀ μ,  (V M⁻¹ Vᵀ) μ = ū − V û,
/// with V the shape functions at the constrained nodes, or, of those on the rim of a patch, a little inside it
/// (PatchRim). The multipliers give the reaction forces.
/// Each component (x, y, z) has its own constrained nodes.
class EssentialConditions {
 public:
  using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// Of V M⁻¹ Vᵀ. Solves without allocating, as Eigen's solve() does not.
  struct Factor {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
    Eigen::VectorXd pivot;

    explicit Factor(const Eigen::SparseMatrix<double>& system) : ldlt(system), pivot(ldlt.vectorD()) {}
    void solve(Eigen::VectorXd& x, Eigen::VectorXd& scratch) const;
  };

  /// The conditions of one component.
  struct Component {
    std::vector<std::int32_t> node;
    RowMatrix shape;                         ///< V, (conditions × nodes)
    RowMatrix extension;                     ///< ū of the nodes' conditions from what is prescribed at the nodes
    Eigen::VectorXd prescribed;              ///< ū, mm
    Eigen::VectorXd multiplier;              ///< μ
    Eigen::VectorXd loaded;                  ///< 1 where the node is loaded, else 0
    Eigen::VectorXd lumped;                  ///< of the simplified form
    Eigen::VectorXd scratch;                 ///< of apply()
    Eigen::SparseMatrix<double> compliance;  ///< C/s, mm/µN; empty: held exactly
    Eigen::VectorXd multiplier_before;       ///< μ of the step before; empty: held exactly
    std::shared_ptr<Factor> factor;          ///< components with the same system share it
  };

  /// Nothing is prescribed.
  EssentialConditions() = default;
  /// prescribed (n × 3) mm, NaN: free, none infinite. nodal_rows: shape functions at all nodes' positions. names: what
  /// the user calls the nodes. rim: where nodes are held inside the rim of a patch.
  EssentialConditions(const Points& prescribed, const ShapeRows& nodal_rows, std::vector<std::int32_t> names,
                      Imposition imposition = Imposition::exact, const PatchRim& rim = {});

  /// The same with the noise of a measurement. inner_rows: shape functions at its inner points. Conditions that give
  /// way are springs s C⁻¹ that act at the end of the step: (V M⁻¹ Vᵀ + C/(sα)) μ = ū − V û. This is stable however
  /// stiff they are, and as σ → 0 it is the exact imposition.
  EssentialConditions(const Points& prescribed, const ShapeRows& nodal_rows, std::vector<std::int32_t> names,
                      const Measurement& measured, const ShapeRows& inner_rows, const PatchRim& rim = {});

  /// Prescribes other values, (n × 3) mm, and forgets all multipliers. Returns false, and does nothing, where they are
  /// prescribed at other nodes, or these give way.
  bool prescribe(const Points& prescribed);

  /// Whether any of them are springs.
  bool give_way() const;

  /// Nodes whose parameters are in any of the conditions, ascending.
  std::vector<std::int32_t> nodes() const;

  /// Factorises (or lumps) V M⁻¹ Vᵀ for nodal masses (one a node); alpha of the steps, where conditions give way.
  /// Throws TooFewNodes, naming a node, when it is singular: two constrained nodes say the same.
  void factorise(std::span<const double> mass, double alpha = 1);

  /// Projects the parameters onto V û = fraction · ū. The multipliers are kept.
  void apply(double fraction, NodalVectors& parameters);

  /// Reaction forces at the nodes, (n × 3): the last multipliers over `step_squared` (the α of the time step), µN. Zero
  /// at free components.
  Points reactions(double step_squared, std::size_t nodes) const;
  /// The same of other multipliers, those of the components one after the other.
  Points reactions(double step_squared, std::size_t nodes, std::span<const double> multipliers) const;

  /// Sum of the reactions on nodes that are loaded: whose prescribed displacement is not all zero, µN.
  Eigen::Vector3d reaction_of_loaded(double step_squared) const;

  /// Largest |V û − fraction · ū|, mm.
  double largest_error(double fraction, const NodalVectors& parameters) const;

  /// Σ μ·ū over all conditions: the rate of work of the reactions by the load's fraction, times α.
  double multiplier_work() const;

  /// Stiffness of the springs in the last step, Δuᵀ (s C⁻¹) Δu α, from û before it and now; 0 where nothing gives way
  /// or the load came on.
  double spring_work(const NodalVectors& before, const NodalVectors& now) const;

  /// These nodes are held, not loaded, whatever is prescribed there: reaction_of_loaded() leaves them out.
  void count_as_held(std::span<const std::int32_t> nodes);

  const std::array<Component, 3>& components() const { return component_; }

 private:
  bool nothing_prescribed() const;
  /// For `inverse_mass_`, and where conditions give way for α.
  bool is_factorised(double alpha) const;

  std::array<Component, 3> component_;
  std::vector<double> inverse_mass_;
  double alpha_ = 0;  // of the last factorise()
  std::vector<std::int32_t> names_;
  Imposition imposition_ = Imposition::exact;
  bool same_compliance_ = true;           // of the three components
  std::array<double, 2> fraction_{0, 0};  // of the last two steps
};

}  // namespace brainshift::solve
